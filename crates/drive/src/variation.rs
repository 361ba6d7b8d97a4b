//! The variation of a run: how its motion changes with small numbers, led along with it.
//!
//! Between two events every contact follows one smooth law, and a small change δ of a state obeys the linear equations
//!
//! M δẍ = -Σ n (δF_x ∇u + E\* m(d) δd ∇d) - Σ (k δe + c δė) ∇e,  δF_x = G\*[m(h) δu + σκ(m(d) - m(h)) δd - ∫₀ʰ δp dm],
//!
//! h the height of the slip front, u, d and e linear in the coordinates. The last term is what the contact remembers: the anchors
//! p of its springs below the front, each moved by δp ([`Anchors`]). The equations are integrated beside the motion they belong to,
//! from event to event, all numbers in one pass.
//!
//! At an event nothing jumps. Forces are continuous in places, velocities and the memory curve, so a law that ends a little
//! earlier or later changes nothing to first order; where an edge turns, its level stands still, so that the knot it leaves
//! has moved as the edge had. Proof and exceptions: `docs/numerics.md`, "Variations".

mod anchors;
mod error;
mod growth;
mod singular;
mod tangent;
mod turning;

pub use error::VariationError;

use crate::contact::{Contact, Mode};
use crate::equations::Equations;
use crate::event::Event;
use crate::model::Binding;
use crate::record::Record;
use crate::scene::Axis;
use crate::state::{Layout, State};
use crate::{Model, Waveform};
pub(crate) use anchors::Anchors;
use singular::Singular;
use stickslip_stepper::{
    Attempt, Completion, DOP853_ORDER, DormandPrince, Step, StepControl, StepHistory, StepLimits, Target,
};
use tangent::{Tangent, Varied};

/// Tightest tolerance of the variation's own steps: multipliers of the impact drive, the climber and the three-ball stage are those of
/// 1e-12 to 1e-10, at half the cost.
const TIGHTEST: f64 = 1e-10;
/// Steps per interval at which the variation is given up: the run takes far fewer.
const MOST_STEPS: u32 = 100_000;

/// How a run's state changes with a few numbers: a record that a run is told to.
///
/// It follows a run between located events, by [`Run::advance`](crate::Run::advance) from the first call on, and has the
/// derivatives at the end after [`Self::finish`]. Made by [`Section::variation`](crate::section::Section::variation). The run itself stays as it is to
/// the last bit.
#[derive(Debug)]
pub struct Variation<'m> {
    model: &'m Model,
    layout: Layout,
    /// Derivatives of the components, one number after the other.
    columns: Vec<f64>,
    /// What the contacts remember.
    anchors: Vec<Anchors>,
    /// The state at which the interval began; none before the run has, and after it has ended.
    from: Option<State>,
    /// The same of the interval that has just ended.
    left: Option<State>,
    outcome: Result<(), VariationError>,
    tolerance: f64,
    solver: DormandPrince,
    control: StepControl,
    /// Next step, s; 0 before the first one.
    step: f64,
    /// Absolute error allowed of each component, of the motion and of its derivatives.
    scale: Vec<f64>,
    /// The motion and its derivatives.
    y: Vec<f64>,
}

impl<'m> Variation<'m> {
    /// The variation with derivatives to begin with: those of the components, `columns`, one number after the other, and those of
    /// the memories. Numbers are counted in natural scales.
    ///
    /// # Errors
    ///
    /// A scene with a part whose variation is not known.
    pub(crate) fn new(
        model: &'m Model,
        (columns, anchors): (Vec<f64>, Vec<Anchors>),
        tolerance: f64,
    ) -> Result<Self, VariationError> {
        check(model)?;
        let layout = model.layout();
        let (dimension, steps) = (layout.dimension(), tolerance.max(TIGHTEST));
        let longest = model.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min);
        let own = natural(model, layout);
        let count = columns.len().checked_div(dimension).unwrap_or(0);
        let all = dimension * (1 + count);
        Ok(Self {
            solver: DormandPrince::new(all, all.max(layout.total())),
            control: StepControl::new(DOP853_ORDER, StepLimits { longest, ..StepLimits::default() }),
            step: 0.0,
            scale: own.iter().map(|natural| steps * natural).cycle().take(all).collect(),
            y: Vec::with_capacity(all),
            model,
            layout,
            columns,
            anchors,
            from: None,
            left: None,
            outcome: Ok(()),
            tolerance,
        })
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
        if to.counts.detours != from.counts.detours || anywhere_whole(from) || anywhere_whole(to) {
            return Err(VariationError::Accumulates { t: to.t });
        }
        if to.memories.iter().any(|memory| memory.merged().knots > 0) {
            return Err(VariationError::Accumulates { t: to.t });
        }
        if to.t > from.t && !self.columns.is_empty() {
            self.integrate(from, to)?;
        }
        for (c, contact) in self.model.contacts.iter().enumerate() {
            // Memories of others wait for an event of their own.
            if !contact.inert && to.memories[c].apex() != from.memories[c].apex() {
                let moved = Tangent::moved(contact, &self.columns, self.layout);
                self.reach_end(contact, (from, to), &moved);
                let has_edge = self.has_edge(contact, from, to);
                self.anchors[c].follow(&to.memories[c], &moved, has_edge);
            }
        }
        Ok(())
    }

    /// Integrates the motion and its derivatives over an interval.
    fn integrate(&mut self, from: &State, to: &State) -> Result<(), VariationError> {
        let dimension = self.layout.dimension();
        self.y.clear();
        self.y.extend_from_slice(&from.y[..dimension]);
        self.y.extend_from_slice(&self.columns);
        let eq = Equations::on(self.model, from, self.layout, false);
        let tangents = Tangent::all(&eq, &self.anchors);
        let varied = Varied { eq, tangents, dimension, count: self.count() };
        let singular = Singular::of(self.model, from, to);
        self.solver.start(&varied, from.t, &self.y);
        if self.step == 0.0 {
            self.step = self.solver.first_step(&varied, to.t - from.t, &self.scale);
        }
        self.control.set_history(StepHistory::BLANK);
        let (mut t, mut made, mut refused) = (from.t, 0, false);
        while t < to.t {
            let (end, grade) = singular.aim((from.t, t, to.t), self.step, refused);
            let error = self.solver.attempt(&varied, Target { end, grade }, &self.scale);
            let h = end - t;
            let verdict = self.control.propose(error, h);
            (made, refused) = (made + 1, !verdict.accepted);
            let stuck = !verdict.accepted && verdict.next <= 4.0 * f64::EPSILON * t.abs();
            if made > MOST_STEPS || stuck {
                return Err(VariationError::NotSmooth { t });
            }
            if verdict.accepted {
                self.solver.complete(&varied, Completion::EndSlopes);
                self.grow((from, to), &varied);
                self.solver.accept();
                t = end;
                // A step that the end of the interval cut says little about the next.
                self.step = if h < self.step { self.step.max(verdict.next) } else { verdict.next };
            } else {
                self.step = verdict.next;
            }
        }
        let all = dimension + self.columns.len();
        self.columns.copy_from_slice(&self.solver.span().begin[dimension..all]);
        Ok(())
    }
}

impl Record for Variation<'_> {
    fn row(&mut self, _: &[f64]) {}

    fn event(&mut self, _: &Event, _: &[f64]) {}

    fn wants_events(&self) -> bool {
        false
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
        if self.outcome.is_ok()
            && let Some(left) = &left
        {
            self.outcome = self.check_turns(left, state);
        }
        self.begin_growth(left.as_ref(), state);
        self.from = Some(state.clone());
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
