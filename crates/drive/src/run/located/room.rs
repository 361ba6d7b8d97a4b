//! Storage of a run with located events, kept for the next run.
//!
//! The storage contains only buffers, which every run fills again. A run does not depend on earlier ones.

use super::turning::Turning;
use super::watch::Watch;
use super::{Located, Setting};
use crate::equations::Equations;
use crate::interval::{Interval, Swing};
use crate::model::Model;
use crate::record::Record;
use crate::run::advance::Advance;
use crate::run::horizon::Goal;
use crate::run::ledger::Ledger;
use crate::run::output::{Opening, Output};
use crate::state::{Layout, LocatedWay, State, Window};
use crate::{Plan, RunError};
use stickslip_stepper::{Attempt, Hand, StepLimits};

/// Storage for runs with one integrator.
pub(super) struct Room<A> {
    /// Layout for which the integrator was created.
    layout: Layout,
    pub(super) solver: A,
    /// Allowed absolute errors.
    pub(super) scale: Vec<f64>,
    pub(super) interval: Interval<'static>,
    pub(super) swing: Swing<'static>,
    pub(super) watch: Watch,
    pub(super) ledger: Ledger,
    pub(super) turning: Turning,
    pub(super) output: Output,
    pub(super) windows: Vec<Window>,
    /// Storage for the run data of the state.
    pub(super) way: Option<Box<LocatedWay>>,
}

impl<A> Room<A> {
    /// Creates empty storage.
    pub(super) fn of(solver: A, layout: Layout) -> Self {
        let nothing = Model::blank();
        Self {
            layout,
            solver,
            scale: Vec::new(),
            interval: Interval::of(&nothing).emptied(),
            swing: Swing::default(),
            watch: Watch::default(),
            ledger: Ledger::new(&nothing, 0),
            turning: Turning::default(),
            output: Output::new(None, layout),
            windows: Vec::new(),
            way: None,
        }
    }
}

impl<A: for<'e> Attempt<Equations<'e>> + Send> Room<A> {
    /// Runs a started state to the end of its plan, in existing storage if that has the same layout.
    pub(super) fn run(
        room: &mut Option<Self>,
        (setting, plan, control): (Setting<'_>, &Plan, (u32, StepLimits)),
        solver: impl FnOnce() -> A,
        (state, way): (&mut State, Option<Box<LocatedWay>>),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let fits = |room: &Self| room.layout == setting.layout;
        let own = room.take().filter(fits).unwrap_or_else(|| Self::of(solver(), setting.layout));
        let mut run = Located::within(Self { way, ..own }, setting, plan, control);
        let outcome = run.finish(state, plan, record);
        *room = Some(run.leave());
        outcome
    }
}

impl<A: for<'e> Attempt<Equations<'e>> + Send> Located<'_, A> {
    /// Runs a state to the end of its plan.
    fn finish(&mut self, state: &mut State, plan: &Plan, record: &mut dyn Record) -> Result<(), RunError> {
        let model = self.setting.model;
        state.check_inputs(model, plan.duration)?;
        for (memory, contact) in state.memories.iter_mut().zip(&model.contacts) {
            memory.bound(&contact.interface, self.remembers());
        }
        self.set_out(state, Opening::Row, record);
        let outcome = self.go(state, Goal::End(plan.duration), record);
        if outcome.is_err() {
            self.write_now(state, record);
        }
        self.settle_books(state);
        outcome
    }

    /// Returns the storage for another run.
    fn leave(mut self) -> Room<A> {
        self.motion.solver.set_hand(Hand::default());
        Room {
            layout: self.setting.layout,
            solver: self.motion.solver,
            scale: self.motion.allowance.allowed.scale,
            interval: self.interval.emptied(),
            swing: self.swing.emptied(),
            watch: self.watch,
            ledger: self.ledger,
            turning: self.turning,
            output: self.output,
            windows: self.bounds.windows,
            way: self.spare,
        }
    }
}
