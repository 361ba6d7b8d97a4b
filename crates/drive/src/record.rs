//! What is written down: rows on a regular grid, events, and their channels; looks into the contacts.

mod extent;
mod trace;

pub use extent::Extent;
pub use trace::Trace;

use crate::Model;
use crate::component::Component;
use crate::contact::{Contact, Mode};
use crate::equations::{Components, Equations};
use crate::event::{Event, Source};
use crate::model::{Binding, Body, Link};
use crate::scene::Axis;
use crate::state::State;
use stickslip_contact::{ContactState, Memory, Outcome, Segment};

/// Receiver of a run's output. Whatever it does, the trajectory stays the same.
///
/// Rows come in ascending time at the plan's interval, the first and the last of the run among them; events
/// in between, in order.
pub trait Record {
    /// A row of values, one for each of [`Model::channels`].
    fn row(&mut self, values: &[f64]);

    /// An event and the row of values after it.
    fn event(&mut self, event: &Event, values: &[f64]);

    /// The next moment at which the record wants to look into the contacts, s; none for never again. Asked before the
    /// run and after every look; moments ascend, and those before the run's beginning are passed over.
    fn next_look(&mut self) -> Option<f64> {
        None
    }

    /// The memories of the contacts at the moment asked for, s, in the scene's order: what they would be if a step ended
    /// there. A moment to which a contact cannot be followed, because it outgrows its row or is not finite, is left out.
    fn look(&mut self, t: f64, memories: &[Memory]) {
        let _ = (t, memories);
    }

    /// Whether the record wants every path that a contact's memory takes; asked where a run begins. They come by [`Self::path`].
    fn follows(&self) -> bool {
        false
    }

    /// What the memory of contact `c`, by its place in the scene, has committed: in order, all of a step before the next look.
    /// Displacements are counted from where the bodies started. What the end of a run leaves uncommitted is in its last look.
    fn path(&mut self, c: usize, segment: Segment) {
        let _ = (c, segment);
    }

    /// The next moment at which the record wants a row for itself, s; none for never again. Asked as looks are. A moment within
    /// four last places of the end of a step is that end.
    fn next_mark(&mut self) -> Option<f64> {
        None
    }

    /// The row of the moment asked for: read off the same step as rows, whose interval it does not depend on.
    fn mark(&mut self, values: &[f64]) {
        let _ = values;
    }

    /// The bodies, by their place in the scene, whose extent along x is wanted: the one that steps, and the one that moves it; asked
    /// before the run. Such a record reads every step.
    fn watched(&self) -> [Option<usize>; 2] {
        [None; 2]
    }

    /// How far these bodies went along x since the last call: before every mark, and whenever a run is put down. Between both ends
    /// of a step x is the cubic that has its positions and velocities.
    fn extents(&mut self, extents: [Extent; 2]) {
        let _ = extents;
    }

    /// Asked now and then with the time reached, s; `false` interrupts the run.
    fn goes_on(&mut self, t: f64) -> bool {
        let _ = t;
        true
    }

    /// From when until when rows at the plan's interval are wanted, s, both included; asked where a run begins. The first and the
    /// last row of the run come anyway.
    fn rows_within(&self) -> [f64; 2] {
        [0.0, f64::INFINITY]
    }

    /// The state at which an interval between two located events ends, its laws still those of the interval; memories that wait
    /// for an event of their own stay where they are.
    fn leaves(&mut self, state: &State) {
        let _ = state;
    }

    /// The state at which an interval begins, with its laws: where a run between located events begins, and after every event.
    fn enters(&mut self, state: &State) {
        let _ = state;
    }

    /// Whether events are wanted; their rows cost an evaluation each.
    fn wants_events(&self) -> bool {
        true
    }

    /// Whether events between which a run steps come with a row; without, they cost nothing and come with an empty one.
    fn wants_event_rows(&self) -> bool {
        true
    }
}

/// Keeps nothing.
impl Record for () {
    fn row(&mut self, _: &[f64]) {}
    fn event(&mut self, _: &Event, _: &[f64]) {}
    fn wants_events(&self) -> bool {
        false
    }
}

/// One column of a trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Channel {
    /// Name with its SI unit, such as `slider.x_m`.
    pub name: String,
    /// Whether the values are codes of [`state_name`] instead of numbers.
    pub is_state: bool,
}

/// Code of a contact's state in a row.
fn state_code(state: ContactState) -> f64 {
    match state {
        ContactState::Open => 0.0,
        ContactState::Stick => 1.0,
        ContactState::Partial => 2.0,
        ContactState::Slip => 3.0,
    }
}

/// Word for a state code: open, stick, partial or slip.
pub fn state_name(code: f64) -> &'static str {
    match code {
        0.0 => "open",
        1.0 => "stick",
        2.0 => "partial",
        _ => "slip",
    }
}

impl Model {
    /// Channels of a row, in order, each under the name of its part and with its SI unit.
    ///
    /// | channels | what |
    /// | --- | --- |
    /// | `time_s` | time |
    /// | `BODY.x_m`, `.vx_m_s`, … | displacement from the position drawn and its rate, of every coordinate that is not fixed |
    /// | `CONTACT.u_m`, `.d_m` | displacement of the first body against the second, indentation |
    /// | `CONTACT.fx_N`, `.fn_N` | forces of all identical contacts together; that of damped stuck springs is in `fx_N` |
    /// | `CONTACT.a_m` | contact radius |
    /// | `CONTACT.stick_m`, `.state` | radius inside which no spring is at its limit, and the word for it, [`state_name`] |
    /// | `CONTACT.elastic_J`, `.friction_J` | tangential energy stored and lost, of all identical contacts together |
    /// | `BLOCK.…` | whatever the block says of itself |
    /// | `energy.…_J` | work put in since the start, kinetic and stored energy, lost to friction and to dampers, and what is left |
    pub fn channels(&self) -> Vec<Channel> {
        let mut names = vec!["time_s".to_owned()];
        for (name, axis, _) in self.moving() {
            let quantities = match axis {
                Axis::X => ["x_m", "vx_m_s"],
                Axis::Z => ["z_m", "vz_m_s"],
                Axis::Pitch => ["pitch_rad", "vpitch_rad_s"],
            };
            names.extend(quantities.map(|q| format!("{name}.{q}")));
        }
        for contact in &self.contacts {
            // Components name their own columns: a new kind of them adds none here.
            names.extend(columns(&contact.name, contact));
        }
        for wired in &self.blocks {
            names.extend(columns(&wired.name, wired.block()));
        }
        let energies = ["input", "kinetic", "elastic", "friction", "damping", "error"];
        names.extend(energies.map(|e| format!("energy.{e}_J")));
        names.into_iter().map(|name| Channel { is_state: name.ends_with(".state"), name }).collect()
    }

    /// Coordinates that are not fixed, under their bodies' names.
    fn moving(&self) -> impl Iterator<Item = (&str, Axis, Binding)> {
        let axes = [Axis::X, Axis::Z, Axis::Pitch];
        let of = move |body: &Body| axes.into_iter().zip(body.bindings);
        let all = self
            .bodies
            .iter()
            .flat_map(move |body| of(body).map(|(axis, place)| (body.name.as_str(), axis, place)));
        all.filter(|(_, _, place)| !matches!(place, Binding::Held(_)))
    }

    /// Name of the source of an event.
    pub fn source_name(&self, source: Source, waveform: impl Fn(usize) -> String) -> String {
        match source {
            Source::Contact(c) => self.contacts[c].name.clone(),
            Source::Waveform(w) => waveform(w),
            Source::Block(k) => self.blocks[k].name.clone(),
        }
    }
}

/// Columns of a component under its name.
///
/// Each is the component's own word with its SI unit, such as `fx_N`.
fn columns(name: &str, component: &(impl Component + ?Sized)) -> impl Iterator<Item = String> {
    component.columns().into_iter().map(move |column| format!("{name}.{column}"))
}

/// Energies of a moment, J.
#[derive(Debug, Clone, Copy, Default)]
struct Books {
    /// Of followers, loads and gravity since the start.
    input: f64,
    kinetic: f64,
    /// Stored in contacts, along both directions, links and blocks.
    elastic: f64,
    friction: f64,
}

/// Fills `row` with the channels at time t; `y` reads a component.
///
/// error = input - (kinetic + elastic - origin) - friction - damping, J: 0 but for the errors of integration,
/// since each of the parts is booked for itself.
pub(crate) fn fill(
    equations: &Equations<'_>,
    state: &State,
    t: f64,
    y: &impl Fn(usize) -> f64,
    row: &mut Vec<f64>,
) {
    row.clear();
    row.push(t);
    let (model, layout) = (equations.model, equations.layout);
    // Constant forces do their work along the way whatever the time: read off the place it has no error of
    // integration.
    let input = y(layout.input()) + model.lifted(|i| state.shifts[i] + y(i)) + state.jumps;
    let laden = if model.balanced.is_empty() { 0.0 } else { equations.laden(t, y) };
    let mut books = Books { input: input + laden, ..Books::default() };
    for (_, _, place) in model.moving() {
        let [position, rate] = equations.place(place, t, y);
        // From where the bodies started, as it is told: the run counts from near by.
        row.extend([position + if let Binding::Free(i) = place { state.shifts[i] } else { 0.0 }, rate]);
    }
    for (c, contact) in model.contacts.iter().enumerate() {
        contact_columns(equations, state, (c, contact), t, y, row, &mut books);
    }
    for k in 0..model.blocks.len() {
        books.elastic += equations.block_columns(k, t, y, row);
    }
    for link in &model.links {
        books.elastic += link_energy(equations, link, t, y);
    }
    for (i, free) in model.free.iter().enumerate() {
        books.kinetic += 0.5 * free.mass * y(layout.velocity(i)).powi(2);
    }
    let damping = y(layout.damping()) + state.lost;
    // Friction is booked from what was swept and not as this remainder, which would make every balance look
    // closed.
    let error = books.input - (books.kinetic + books.elastic - state.origin) - books.friction - damping;
    row.extend([books.input, books.kinetic, books.elastic, books.friction, damping, error]);
}

/// What the books of a moment leave open, and the sum of all that is in them, J: rounding goes by the latter. `row` is
/// scratch.
pub(crate) fn balance(
    equations: &Equations<'_>,
    state: &State,
    t: f64,
    y: &impl Fn(usize) -> f64,
    row: &mut Vec<f64>,
) -> (f64, f64) {
    fill(equations, state, t, y, row);
    let books = &row[row.len().saturating_sub(6)..];
    (books.last().copied().unwrap_or(0.0), books.iter().map(|energy| energy.abs()).sum())
}

/// Columns of one contact: the sum over its identical members.
///
/// Force and energies of all `count` members; displacement, depth and stick radius of one. In the books the
/// energies of all contacts add up.
fn contact_columns(
    equations: &Equations<'_>,
    state: &State,
    (c, contact): (usize, &Contact),
    t: f64,
    y: &impl Fn(usize) -> f64,
    row: &mut Vec<f64>,
    books: &mut Books,
) {
    let layout = equations.layout;
    let motion = equations.motion(contact, t, y);
    let slot = contact.slot.filter(|_| layout.growing > 0);
    let straight = contact.goes_straight(equations.pieces);
    // In full stick the memory stands at the step's start: force and energy are the states, and every spring
    // sticks. Errors of steps may leave an energy of zero a little below it; raised to zero it would be missing in the books.
    let mut outcome = match (state.modes[c], slot.filter(|_| !straight)) {
        (Mode::Grow, Some(slot)) => Outcome {
            force: y(layout.force(slot)),
            elastic: y(layout.elastic(slot)),
            friction: 0.0,
            stick_radius: contact.interface.profile().radius(motion.d),
            state: ContactState::Stick,
        },
        _ => equations.memories[c].preview(&contact.interface, motion.apex()),
    };
    if contact.interface.friction() == 0.0 && outcome.state == ContactState::Stick {
        // At a limit of nothing is every spring: it slides, and remembers nothing of it.
        (outcome.state, outcome.stick_radius) = (ContactState::Slip, 0.0);
    }
    if let Some(slot) = slot {
        // By the whole law and on a straight path nothing is integrated: the chord from the apex has its own.
        let chord = straight || matches!(state.modes[c], Mode::Whole { .. });
        let rest = match chord {
            true => outcome.friction,
            false => contact.beside_growth(&equations.memories[c], motion.apex()),
        };
        outcome.friction = y(layout.friction(slot)) + rest;
    }
    let count = contact.count;
    let friction = state.friction[c] + count * outcome.friction;
    let normal = count * contact.interface.normal_energy(motion.d);
    // What sets the indentation does the work of pressing; a coupled contact's bodies do it among themselves.
    // A constant load presses before the start and does no work in the run.
    if !contact.is_constant() && contact.coupling().is_none() {
        books.input += normal;
    }
    // The force is that on the bodies, springs and damping together; energy and friction are of the springs
    // alone.
    let damping = match contact.interface.damping() {
        0.0 => 0.0,
        _ => contact.viscosity(equations.law(c), &motion) * motion.du,
    };
    books.elastic += normal + count * outcome.elastic;
    books.friction += friction;
    row.extend([
        motion.u + state.shift(contact),
        motion.d,
        count * (outcome.force + damping),
        count * contact.interface.normal_force(motion.d),
        equations.memories[c].radius(&contact.interface, motion.d),
        outcome.stick_radius,
        state_code(outcome.state),
        count * outcome.elastic,
        friction,
    ]);
}

/// Potential energy of a link, J: ½k(s-e)² less the work its preload has done.
pub(crate) fn link_energy(equations: &Equations<'_>, link: &Link, t: f64, y: &impl Fn(usize) -> f64) -> f64 {
    let at = Components { t, y };
    let stroke = equations.stroke(link, &at).value;
    let length = equations.read(&link.elongation, &at).value;
    0.5 * link.stiffness * (stroke - length).powi(2) - link.preload * length
}
