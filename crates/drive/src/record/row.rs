//! Channels of a row, and the energies of a model.

use crate::Model;
use crate::component::Component;
use crate::contact::{Contact, Motion};
use crate::equations::{Components, Equations};
use crate::event::Source;
use crate::model::{Binding, Body, Link};
use crate::scene::Axis;
use crate::state::State;
use stickslip_contact::{Apex, ContactState, Memory, Outcome};

/// Column of a trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Channel {
    /// Name with its SI unit, such as `slider.x_m`.
    pub name: String,
    /// Whether the values are codes of [`state_name`] instead of numbers.
    pub is_state: bool,
}

/// Returns the code of a contact's state in a row.
#[must_use]
pub fn state_code(state: ContactState) -> f64 {
    match state {
        ContactState::Open => 0.0,
        ContactState::Stick => 1.0,
        ContactState::Partial => 2.0,
        ContactState::Slip => 3.0,
    }
}

/// Returns the name of a state code: open, stick, partial or slip.
pub fn state_name(code: f64) -> &'static str {
    match code {
        0.0 => "open",
        1.0 => "stick",
        2.0 => "partial",
        _ => "slip",
    }
}

impl Model {
    /// Returns the channels of a row in order, with the names of their parts and SI units.
    ///
    /// | channels | content |
    /// | --- | --- |
    /// | `time_s` | time |
    /// | `BODY.x_m`, `.vx_m_s`, … | displacement from the reference position and velocity, of every coordinate that is not fixed |
    /// | `CONTACT.u_m`, `.d_m` | displacement of the first body relative to the second, indentation |
    /// | `CONTACT.fx_N`, `.fn_N` | forces of all identical contacts; `fx_N` contains contact damping |
    /// | `STOP_low.d_m`, `.fn_N`, `STOP_high…` | penetration of an end stop, negative before it, and its force |
    /// | `CONTACT.a_m` | contact radius |
    /// | `CONTACT.stick_m`, `.state` | stick radius; state, see [`state_name`] |
    /// | `CONTACT.elastic_J`, `.friction_J` | tangential elastic energy and friction work of all identical contacts |
    /// | `BLOCK.…` | columns of the block |
    /// | `energy.…_J` | input work since the start, kinetic and elastic energy, friction and damping work, error of the energy balance |
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
            // Components name their own columns.
            names.extend(columns(&contact.name, contact));
        }
        for wired in &self.blocks {
            names.extend(columns(&wired.name, wired.block()));
        }
        let energies = ["input", "kinetic", "elastic", "friction", "damping", "error"];
        names.extend(energies.map(|e| format!("energy.{e}_J")));
        names.into_iter().map(|name| Channel { is_state: name.ends_with(".state"), name }).collect()
    }

    /// Returns the coordinates that are not fixed, with the names of their bodies.
    fn moving(&self) -> impl Iterator<Item = (&str, Axis, Binding)> {
        let axes = [Axis::X, Axis::Z, Axis::Pitch];
        let of = move |body: &Body| axes.into_iter().zip(body.bindings);
        let all = self
            .bodies
            .iter()
            .flat_map(move |body| of(body).map(|(axis, place)| (body.name.as_str(), axis, place)));
        all.filter(|(_, _, place)| !matches!(place, Binding::Held(_)))
    }

    /// Returns the name of the source of an event; `waveform` returns the name of a waveform.
    pub fn source_name(&self, source: Source, waveform: impl Fn(usize) -> String) -> String {
        match source {
            Source::Contact(c) => self.contacts[c].name.clone(),
            Source::Waveform(w) => waveform(w),
            Source::Block(k) => self.blocks[k].name.clone(),
        }
    }
}

/// Returns the column names of a component with its name as prefix, each with its SI unit.
fn columns(name: &str, component: &(impl Component + ?Sized)) -> impl Iterator<Item = String> {
    component.columns().into_iter().map(move |column| format!("{name}.{column}"))
}

/// Energies at one time, J.
#[derive(Debug, Clone, Copy, Default)]
struct Books {
    /// Work of prescribed motions, loads and gravity since the start.
    input: f64,
    kinetic: f64,
    /// Energy stored in contacts (normal and tangential), links and blocks.
    elastic: f64,
    friction: f64,
    damping: f64,
}

impl Books {
    /// Returns the error of the energy balance: input - (kinetic + elastic - origin) - friction - damping, J.
    fn error(&self, state: &State) -> f64 {
        // Friction is computed from slip, not as the remainder of the balance.
        self.input - (self.kinetic + self.elastic - state.origin) - self.friction - self.damping
    }
}

/// Motion and response of a contact at one time. Energies and friction are sums over all identical contacts.
struct Response {
    motion: Motion,
    /// Force and energies of one contact.
    outcome: Outcome,
    /// Friction work since the start, J.
    friction: f64,
}

/// Part of a model with columns and energies of its own.
enum Part<'r> {
    Contact(usize, &'r Contact, Response),
    Block(usize),
}

/// Fills `row` with the channels at time t (s); `y` returns a component of the state.
///
/// Each energy is computed separately, so the balance error consists of integration errors only.
pub(crate) fn fill(
    equations: &Equations<'_>,
    state: &State,
    t: f64,
    y: &impl Fn(usize) -> f64,
    row: &mut Vec<f64>,
) {
    row.clear();
    row.push(t);
    for (_, _, place) in equations.model.moving() {
        let [position, rate] = equations.place(place, t, y);
        // Displacements count from the initial position; the state uses a shifted origin.
        row.extend([position + if let Binding::Free(i) = place { state.shifts[i] } else { 0.0 }, rate]);
    }
    let books = energies(equations, state, t, y, |part, books| match part {
        Part::Contact(c, contact, response) => {
            contact_columns(equations, state, (c, contact), &response, row);
        }
        Part::Block(k) => books.elastic += equations.block_columns(k, t, y, row),
    });
    let Books { input, kinetic, elastic, friction, damping } = books;
    row.extend([input, kinetic, elastic, friction, damping, books.error(state)]);
}

/// Returns the energies at time t (s). Calls `each` for every contact and block, in the order of the columns; a block adds its own energy.
fn energies(
    equations: &Equations<'_>,
    state: &State,
    t: f64,
    y: &impl Fn(usize) -> f64,
    mut each: impl FnMut(Part<'_>, &mut Books),
) -> Books {
    let (model, layout) = (equations.model, equations.layout);
    // The work of constant forces follows from positions and has no integration error.
    let input = y(layout.input()) + model.lifted(|i| state.shifts[i] + y(i)) + state.jumps;
    let laden = if model.balanced.is_empty() { 0.0 } else { equations.laden(t, y) };
    let damping = y(layout.damping()) + state.lost;
    let mut books = Books { input: input + laden, damping, ..Books::default() };
    for (c, contact) in model.contacts.iter().enumerate() {
        let response = response(equations, state, (c, contact), t, y);
        let normal = contact.count * equations.normal_energy(contact, t, y);
        // The source of a prescribed indentation does the work of pressing. Constant loads do no work in the run.
        if !contact.is_constant() && contact.coupling().is_none() {
            books.input += normal;
        }
        books.elastic += normal + contact.count * response.outcome.elastic;
        books.friction += response.friction;
        each(Part::Contact(c, contact, response), &mut books);
    }
    (0..model.blocks.len()).for_each(|k| each(Part::Block(k), &mut books));
    for link in &model.links {
        books.elastic += link_energy(equations, link, t, y);
    }
    for (i, free) in model.free.iter().enumerate() {
        books.kinetic += 0.5 * free.mass * y(layout.velocity(i)).powi(2);
    }
    books
}

/// Returns motion and response of a contact at time t (s).
fn response(
    equations: &Equations<'_>,
    state: &State,
    (c, contact): (usize, &Contact),
    t: f64,
    y: &impl Fn(usize) -> f64,
) -> Response {
    let layout = equations.layout;
    let motion = equations.motion(contact, t, y);
    let slot = contact.slot.filter(|_| layout.growing > 0);
    let straight = contact.goes_straight(equations.pieces);
    // In full stick force and energy are states, and every spring sticks. Integration errors may make a small energy negative; it
    // is not clipped, as the balance would change.
    let grown = slot.filter(|_| !straight && state.modes[c].grows());
    let mut outcome = match grown {
        Some(slot) => Outcome {
            force: y(layout.force(slot)),
            elastic: y(layout.elastic(slot)),
            friction: 0.0,
            stick_radius: contact.interface.profile().radius(motion.d),
            state: ContactState::Stick,
        },
        _ => equations.memories[c].preview(&contact.interface, motion.apex()),
    };
    if contact.interface.friction() == 0.0 && outcome.state == ContactState::Stick {
        // Without friction every spring slips.
        (outcome.state, outcome.stick_radius) = (ContactState::Slip, 0.0);
    }
    if let Some(slot) = slot {
        // Under the full force law and on a straight path nothing is integrated: the chord has its own friction work.
        let chord = straight || state.modes[c].is_whole();
        let rest = match chord {
            true => outcome.friction,
            false => beside_growth(contact, &equations.memories[c], motion.apex()),
        };
        outcome.friction = y(layout.friction(slot)) + rest;
    }
    let friction = state.friction[c] + contact.count * outcome.friction;
    Response { motion, outcome, friction }
}

/// Appends the columns of a contact to a row. Forces and energies are sums over all identical contacts; displacement, indentation and
/// stick radius are those of one contact.
fn contact_columns(
    equations: &Equations<'_>,
    state: &State,
    (c, contact): (usize, &Contact),
    Response { motion, outcome, friction }: &Response,
    row: &mut Vec<f64>,
) {
    let count = contact.count;
    if contact.stop {
        row.extend([motion.d, count * contact.interface.normal_force(motion.d)]);
        return;
    }
    // The force contains contact damping; energy and friction belong to the springs.
    let force = match contact.interface.damping() {
        0.0 => outcome.force,
        _ => {
            let (memory, law) = equations.law(c);
            law.damped((contact, memory), motion, outcome.force)[0]
        }
    };
    row.extend([
        motion.u + state.shift(contact),
        motion.d,
        count * force,
        count * contact.interface.normal_force(motion.d),
        equations.memories[c].radius(&contact.interface, motion.d),
        outcome.stick_radius,
        state_code(outcome.state),
        count * outcome.elastic,
        *friction,
    ]);
}

/// Returns the error of the energy balance, and the sum of all energies as a measure of its rounding, J. `row` is scratch.
pub(crate) fn balance(
    equations: &Equations<'_>,
    state: &State,
    t: f64,
    y: &impl Fn(usize) -> f64,
    row: &mut Vec<f64>,
) -> (f64, f64) {
    row.clear();
    let books = energies(equations, state, t, y, |part, books| match part {
        Part::Contact(..) => {}
        Part::Block(k) => books.elastic += equations.block_columns(k, t, y, row),
    });
    let all = [books.input, books.kinetic, books.elastic, books.friction, books.damping, books.error(state)];
    (books.error(state), all.iter().map(|energy| energy.abs()).sum())
}

/// Returns the potential energy of a link, J: ½k(s-e)² minus the work of its preload.
pub(crate) fn link_energy(equations: &Equations<'_>, link: &Link, t: f64, y: &impl Fn(usize) -> f64) -> f64 {
    let at = Components { t, y };
    let stroke = equations.stroke(link, &at).value;
    let length = equations.read(&link.elongation, &at).value;
    0.5 * link.stiffness * (stroke - length).powi(2) - link.preload * length
}

/// Returns the friction work of a chord where it leaves a path of growth, J. Its rates do not contain this work.
fn beside_growth(contact: &Contact, memory: &Memory, to: Apex) -> f64 {
    memory.branching().map_or(0.0, |branching| branching.beside_growth(&contact.interface, to))
}
