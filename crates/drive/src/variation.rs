//! The variation of a run: how its motion changes with small numbers, led along with it.
//!
//! Between two events every contact follows one smooth law, and a small change δ of a state obeys the linear equations
//!
//! M δẍ = -Σ n (δF_x ∇u + E\* m(d) δd ∇d) - Σ (k δe + c δė) ∇e,  δF_x = G\*[m(h) δu + σκ(m(d) - m(h)) δd - ∫₀ʰ δp dm],
//!
//! h the height of the slip front, u, d and e linear in the coordinates. The last term is what the contact remembers: the anchors
//! p of its springs below the front, each moved by δp ([`Anchors`]). The equations are integrated beside the motion they belong to,
//! step by step of the run, all numbers in one pass.
//!
//! At an event nothing jumps. Forces are continuous in places, velocities and the memory curve, so a law that ends a little
//! earlier or later changes nothing to first order; where an edge turns, its level stands still, so that the knot it leaves
//! has moved as the edge had. Proof and exceptions: `docs/numerics.md`, "Variations".

mod anchors;
mod arcs;
mod corners;
mod energies;
mod error;
mod growth;
mod parameter;
mod steps;
mod tangent;
mod turning;
mod works;

pub use energies::EnergyRates;
pub use error::VariationError;
pub use parameter::Parameter;

use crate::contact::{Contact, Mode};
use crate::event::Event;
use crate::model::Binding;
use crate::record::{Record, Stride};
use crate::scene::Axis;
use crate::state::{Layout, State};
use crate::{Model, Piece};
pub(crate) use anchors::Anchors;
use anchors::Held;
use arcs::Arc;
use corners::Corner;
use parameter::{Moment, Moving};
use steps::Passed;
use stickslip_stepper::{Coefficients, Gauss, NODES};
use works::Works;

/// How a run's state changes with a few numbers: a record that a run is told to.
///
/// It follows a run between located events, by [`Run::advance`](crate::Run::advance) from the first call on, and has the
/// derivatives at the end after [`Self::finish`]. Made by [`Section::variation`](crate::section::Section::variation). The run itself stays as it is to
/// the last bit.
#[derive(Debug)]
pub struct Variation<'m> {
    model: &'m Model,
    layout: Layout,
    /// Numbers of the scene, which are the last ones.
    parameters: &'m [Parameter],
    /// The corner at which the interval has ended.
    corner: Option<Corner>,
    /// Derivatives of the components, one number after the other.
    columns: Vec<f64>,
    /// What the contacts remember.
    anchors: Vec<Anchors>,
    /// The state at which the interval began; none before the run has, and after it has ended.
    from: Option<Box<State>>,
    /// The same of the interval that has just ended.
    left: Option<Box<State>>,
    outcome: Result<(), VariationError>,
    tolerance: f64,
    /// Longest step of the equations, as a part of the run's.
    longest: f64,
    /// What is put in and lost on the way.
    works: Works,
    /// What the contacts hold in the interval, and which of them act on the derivatives; what links make of these.
    held: Vec<Held>,
    acting: Vec<usize>,
    links: Vec<f64>,
    /// How high their fronts are where a step of the run begins, as parts of the depth.
    heights: Vec<f64>,
    /// How each number of the scene moves each waveform on these pieces.
    moving: Vec<Moving>,
    pieces: Vec<Piece>,
    /// Whether the run has told a step of it.
    strode: bool,
    /// Detours of the run before it was followed.
    detours: Option<u64>,
    method: Gauss,
    nodes: Vec<Coefficients>,
    /// Of arcs of swings.
    arc: Arc,
    /// Natural scales of velocities and forces.
    scale: Vec<f64>,
    /// The motion at a node.
    y: Vec<f64>,
    /// The same at all nodes, where numbers of the scene need it, and when a step begins and how long it is, s.
    passed: Vec<Passed>,
    time: f64,
    length: f64,
}

impl<'m> Variation<'m> {
    /// The variation with derivatives to begin with: those of the components, `columns`, one number after the other, and those of
    /// the memories. Numbers are counted in natural scales; the last ones are the `parameters` of the scene.
    ///
    /// # Errors
    ///
    /// A scene with a part whose variation is not known.
    pub(crate) fn new(
        (model, parameters): (&'m Model, &'m [Parameter]),
        (columns, anchors): (Vec<f64>, Vec<Anchors>),
        tolerance: f64,
    ) -> Result<Self, VariationError> {
        check(model)?;
        let layout = model.layout();
        Ok(Self {
            held: vec![Held::default(); model.contacts.len()],
            acting: Vec::new(),
            heights: Vec::new(),
            moving: Vec::new(),
            pieces: Vec::new(),
            links: tangent::links(model),
            strode: false,
            detours: None,
            method: Gauss::default(),
            arc: Arc::default(),
            nodes: vec![Coefficients::default(); NODES],
            scale: natural(model, layout).split_off(layout.free),
            y: vec![0.0; layout.total()],
            passed: vec![Passed::default(); NODES],
            time: 0.0,
            length: 0.0,
            model,
            parameters,
            corner: None,
            layout,
            columns,
            anchors,
            from: None,
            left: None,
            outcome: Ok(()),
            tolerance,
            longest: 1.0,
            works: Works::default(),
        })
    }

    /// With books of energies that have begun.
    fn beginning(self, works: Works) -> Self {
        Self { works, ..self }
    }

    /// Leads energies along as well, from a run's start on ([`Self::energies`]).
    #[must_use]
    pub fn with_energies(self) -> Self {
        Self { works: self.works.led(self.layout), ..self }
    }

    /// In steps of half the length at most: what differs from a variation in whole ones is what those miss, whatever they tell.
    #[must_use]
    pub fn in_halves(self) -> Self {
        Self { longest: 0.5, ..self }
    }

    /// Ends the variation where the run stands, its memories come along ([`Run::stop`](crate::Run::stop)).
    ///
    /// # Errors
    ///
    /// What on the way had no derivative.
    pub fn finish(&mut self, state: &State) -> Result<(), VariationError> {
        if self.outcome.is_ok() && self.from.is_none() {
            self.outcome = Err(VariationError::Unlocated);
        }
        self.leaves(state);
        if self.outcome.is_ok() && self.detours.is_some_and(|detours| state.counts.detours != detours) {
            self.outcome = Err(VariationError::Accumulates { t: state.t });
        }
        if self.outcome.is_ok() {
            self.outcome = self.check_rest(state);
        }
        self.outcome.clone()
    }

    /// How many numbers there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.columns.len().checked_div(self.layout.dimension()).unwrap_or(0)
    }

    /// Derivatives by number `j`, in its natural scale, of a body's coordinate and its rate, m and m/s or rad and rad/s: the body at
    /// this place of the scene; those of a coordinate that is not free are 0.
    #[must_use]
    pub fn coordinate(&self, index: usize, axis: Axis, j: usize) -> Option<(f64, f64)> {
        let column = self.column(j)?;
        Some(match self.model.bodies.get(index)?.bindings[axis as usize] {
            Binding::Free(i) => (column[i], column[self.layout.velocity(i)]),
            Binding::Held(_) | Binding::Driven(_) => (0.0, 0.0),
        })
    }

    /// Derivatives of the components by number `j`.
    pub(crate) fn column(&self, j: usize) -> Option<&[f64]> {
        self.columns.chunks_exact(self.layout.dimension().max(1)).nth(j)
    }

    /// What contact `c` remembers.
    pub(crate) fn anchors(&self, c: usize) -> &Anchors {
        &self.anchors[c]
    }

    /// From the state at which the interval began to where it ends.
    fn pass(&mut self, from: &State, to: &State) -> Result<(), VariationError> {
        let whole = |(mode, contact): (&Mode, &Contact)| matches!(mode, Mode::Whole { .. }) && !contact.inert;
        let anywhere_whole = |state: &State| state.modes.iter().zip(&self.model.contacts).any(whole);
        if anywhere_whole(from) || anywhere_whole(to) {
            return Err(VariationError::Accumulates { t: to.t });
        }
        if to.memories.iter().any(|memory| memory.merged().knots > 0) {
            return Err(VariationError::Accumulates { t: to.t });
        }
        self.works.look(to);
        self.corner = self.corner_at(to)?;
        if !self.acts() {
            self.drift(to.t - from.t);
        } else if to.t > from.t && !self.strode {
            return Err(VariationError::Unlocated);
        }
        for (c, contact) in self.model.contacts.iter().enumerate() {
            // Memories of others wait for an event of their own.
            if !contact.inert && to.memories[c].apex() != from.memories[c].apex() {
                let moved = self.moved_at_corner(contact, to);
                let has_edge = self.has_edge(contact, from, to);
                let steeper = self.steeper(c);
                self.anchors[c].follow((contact, &to.memories[c]), (&moved, &steeper), has_edge);
            }
        }
        Ok(())
    }

    /// Waveforms where a run stands.
    fn moment<'a>(&'a self, state: &'a State) -> Moment<'a> {
        let moving = if state.pieces == self.pieces { &self.moving[..] } else { &[] };
        Moment { moving, ..Moment::of(self.model, state) }
    }

    /// (δu, δd) of a contact by each number.
    fn moved(&self, contact: &Contact, at: Moment<'_>) -> Vec<(f64, f64)> {
        self.moved_by(contact, &self.columns, at)
    }

    /// The same from other derivatives of the components.
    fn moved_by(&self, contact: &Contact, columns: &[f64], at: Moment<'_>) -> Vec<(f64, f64)> {
        let mut moved = tangent::moved(contact, columns, self.layout);
        let first = self.count() - self.parameters.len();
        for ((place, parameter), moved) in self.parameters.iter().enumerate().zip(&mut moved[first..]) {
            let shift = parameter.shift(contact, at.by(place));
            *moved = (moved.0 + shift.u, moved.1 + shift.d);
        }
        moved
    }

    /// δκ of a contact by each number of the scene.
    fn steeper(&self, c: usize) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.slope(c)).collect()
    }

    /// The laws of an interval begin.
    fn take_up(&mut self, state: &State) {
        self.strode = false;
        self.acting.clear();
        if self.pieces != state.pieces {
            self.pieces.clone_from(&state.pieces);
            self.moving.clear();
            for parameter in self.parameters {
                self.moving.extend(parameter.moving(&state.pieces, state.t));
            }
        }
        for (c, contact) in self.model.contacts.iter().enumerate() {
            if !contact.inert {
                self.held[c].renew(&mut self.anchors[c], (contact, &state.memories[c]));
            }
            if tangent::acts(contact, &state.modes[c], !self.parameters.is_empty()) {
                self.acting.push(c);
            }
        }
    }
}

impl Record for Variation<'_> {
    fn row(&mut self, _: &[f64]) {}

    fn event(&mut self, _: &Event, _: &[f64]) {}

    fn wants_events(&self) -> bool {
        false
    }

    fn strides(&self) -> bool {
        true
    }

    fn stride(&mut self, stride: &mut dyn Stride) {
        let Some(from) = self.from.take() else { return };
        if self.outcome.is_ok() && !self.columns.is_empty() {
            self.outcome = self.follow(&from, stride);
        }
        self.strode = true;
        self.from = Some(from);
    }

    fn leaves(&mut self, state: &State) {
        let Some(from) = self.from.take() else { return };
        if self.outcome.is_ok() {
            self.outcome = self.pass(&from, state);
        }
        self.left = Some(from);
    }

    fn enters(&mut self, state: &State) {
        let left = self.left.take();
        // A detour is told by nobody: it begins between an interval and the next one.
        let detours = *self.detours.get_or_insert(state.counts.detours);
        if self.outcome.is_ok() && state.counts.detours != detours {
            self.outcome = Err(VariationError::Accumulates { t: state.t });
        }
        if self.outcome.is_ok()
            && let Some(left) = &left
        {
            self.outcome = self.check_turns(left, state);
            self.turn_corner(state);
        }
        self.begin_growth(left.as_deref(), state);
        self.take_up(state);
        // In the room of the interval before.
        self.from = Some(match left {
            Some(mut room) => {
                room.copy(state);
                room
            }
            None => Box::new(state.clone()),
        });
    }
}

/// What of a scene has a variation.
fn check(model: &Model) -> Result<(), VariationError> {
    if let Some(block) = model.blocks.first() {
        return Err(VariationError::Block(block.name.clone()));
    }
    if let Some(balanced) = model.balanced.first() {
        return Err(VariationError::Massless(model.bodies[balanced.body].name.clone()));
    }
    for contact in model.contacts.iter().filter(|contact| !contact.inert) {
        let name = || contact.name.clone();
        if contact.interface.damping() > 0.0 {
            return Err(VariationError::Damped(name()));
        }
        if !contact.engine.branches() {
            return Err(VariationError::Row(name()));
        }
        if contact.interface.profile().has_kinks() {
            return Err(VariationError::Profile(name()));
        }
    }
    Ok(())
}

/// Natural scale of each component.
fn natural(model: &Model, layout: Layout) -> Vec<f64> {
    let mut natural = vec![1.0; layout.dimension()];
    for (i, free) in model.free.iter().enumerate() {
        (natural[i], natural[layout.velocity(i)]) = free.scale;
    }
    for contact in &model.contacts {
        if let Some(slot) = contact.slot.filter(|_| contact.friction_limit() > 0.0) {
            natural[layout.force(slot)] = contact.friction_limit();
        }
    }
    natural
}
