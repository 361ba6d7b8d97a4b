//! The solver of a run between located events.

use super::allowance::differences;
use super::{Located, Setting};
use crate::method::{Method, SceneTraits, stepping};
use crate::model::Model;
use crate::record::Record;
use crate::run::horizon::Goal;
use crate::run::output::Opening;
use crate::state::State;
use crate::{Limits, Plan, RunError};
use stickslip_stepper::{
    DOP853_ORDER, DormandPrince, NYSTROM_ORDER, One, Paired, RADAU_ORDER, Radau, StepLimits,
};

/// Strongest shortening of an implicit step at once.
// Where a follower turns, the first step that sees what settles there is a millionth of the one before.
const SHRINK: f64 = 0.1;

/// A run between located events, by the method of the scene's intervals without a closed form: where no force depends on a
/// velocity, one that spares a third of the evaluations.
pub(in crate::run) enum LocatedRun<'a> {
    /// A single free coordinate.
    One(Box<Located<'a, Paired<One>>>),
    /// Several.
    Many(Box<Located<'a, Paired>>),
    /// With dampers, varying loads or growth.
    General(Box<Located<'a, DormandPrince>>),
    /// With something stiff among them.
    Stiff(Box<Located<'a, Radau>>),
}

impl<'a> LocatedRun<'a> {
    pub(in crate::run) fn new(model: &'a Model, plan: &Plan, tolerance: f64) -> Self {
        let layout = model.layout();
        let setting = Setting { model, layout, tolerance, method: stepping(&SceneTraits::of(model)).0 };
        let limits = StepLimits::default();
        match (setting.method, layout.free) {
            // The work put in is the only integral: nothing dissipates but contacts, which book for themselves.
            (Method::Nystrom, 1) => {
                let solver = Paired::one(layout.total());
                Self::One(Box::new(Located::new(setting, plan, solver, (NYSTROM_ORDER, limits))))
            }
            (Method::Nystrom, free) => {
                let solver = Paired::new(free, 1, layout.total());
                Self::Many(Box::new(Located::new(setting, plan, solver, (NYSTROM_ORDER, limits))))
            }
            (Method::Radau, free) => {
                let coupled = (layout.dimension(), free);
                let solver = Radau::new(coupled, layout.total(), differences(model));
                let limits = StepLimits { shrink: SHRINK, ..limits };
                Self::Stiff(Box::new(Located::new(setting, plan, solver, (RADAU_ORDER, limits))))
            }
            _ => {
                let solver = DormandPrince::new(layout.dimension(), layout.total());
                Self::General(Box::new(Located::new(setting, plan, solver, (DOP853_ORDER, limits))))
            }
        }
    }
}

/// One method of whichever run it is.
macro_rules! each {
    ($located:expr, $run:ident => $call:expr) => {
        match $located {
            Self::One($run) => $call,
            Self::Many($run) => $call,
            Self::General($run) => $call,
            Self::Stiff($run) => $call,
        }
    };
}

impl LocatedRun<'_> {
    /// Takes up a state: begins a run there, or goes on with one.
    pub(in crate::run) fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        each!(self, run => run.set_out(state, opening, record));
    }

    /// Goes as far as a goal says, and puts down in the state what its future depends on.
    pub(in crate::run) fn go(
        &mut self,
        state: &mut State,
        goal: Goal,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        each!(self, run => run.go(state, goal, record))
    }

    /// Stops at other limits from here on.
    pub(in crate::run) fn limit(&mut self, limits: Limits) {
        each!(self, run => run.limit(limits));
    }

    /// Tells the range of a watched body so far.
    pub(in crate::run) fn hand_over(&mut self, record: &mut dyn Record) {
        each!(self, run => run.hand_over(record));
    }

    /// Turning points of contacts made or given up.
    pub(in crate::run) fn touched(&self) -> u64 {
        each!(self, run => run.touched())
    }

    /// How many turning points a contact remembers.
    pub(in crate::run) fn remembers(&self) -> usize {
        each!(self, run => run.remembers())
    }

    /// Brings memories that wait for an event to where the state is.
    pub(in crate::run) fn settle_books(&mut self, state: &mut State) {
        each!(self, run => run.settle_books(state));
    }

    /// Writes the row of where the run stopped.
    pub(in crate::run) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        each!(self, run => run.write_now(state, record));
    }
}
