//! Integrator of a run with located events.

use super::allowance::differences;
use super::{Located, Room, Setting};
use crate::method::{Method, SceneTraits, stepping};
use crate::model::Model;
use crate::record::Record;
use crate::run::horizon::Goal;
use crate::run::output::Opening;
use crate::state::{Layout, LocatedWay, State};
use crate::{Plan, RunError};
use stickslip_stepper::{
    DOP853_ORDER, DormandPrince, NYSTROM_ORDER, One, Paired, RADAU_ORDER, Radau, StepLimits,
};

/// Smallest factor by which a single rejection shortens an implicit step.
const SHRINK: f64 = 0.1;

/// Run with located events, for each integrator of intervals without a closed-form solution.
///
/// If no force depends on a velocity, a Runge–Kutta–Nyström method needs a third fewer evaluations.
pub(in crate::run) enum LocatedRun<'a> {
    /// Runge–Kutta–Nyström with a single free coordinate.
    One(Box<Located<'a, Paired<One>>>),
    /// Runge–Kutta–Nyström with several free coordinates.
    Many(Box<Located<'a, Paired>>),
    /// Dormand–Prince, for dampers, varying loads and contacts growing in full stick.
    General(Box<Located<'a, DormandPrince>>),
    /// Radau IIA, for stiff models.
    Stiff(Box<Located<'a, Radau>>),
}

/// Order of an integrator for step control, and limits of its steps.
type Steps = (u32, StepLimits);

/// Returns order and step limits of an explicit method.
fn explicit(order: u32) -> Steps {
    (order, StepLimits::default())
}

/// Returns order and step limits of the implicit method.
fn implicit() -> Steps {
    (RADAU_ORDER, StepLimits { shrink: SHRINK, ..StepLimits::default() })
}

fn radau(model: &Model, layout: Layout) -> Radau {
    Radau::new((layout.dimension(), layout.free), layout.total(), differences(model))
}

impl<'a> LocatedRun<'a> {
    pub(in crate::run) fn new(model: &'a Model, plan: &Plan, tolerance: f64) -> Self {
        let layout = model.layout();
        let setting = Setting { model, layout, tolerance, method: stepping(&SceneTraits::of(model)).0 };
        match (setting.method, layout.free) {
            // The input work is the only integral, because only contacts dissipate, and they commit their own friction work.
            (Method::Nystrom, 1) => {
                let solver = Paired::one(layout.total());
                Self::One(Box::new(Located::new(setting, plan, solver, explicit(NYSTROM_ORDER))))
            }
            (Method::Nystrom, free) => {
                let solver = Paired::new(free, 1, layout.total());
                Self::Many(Box::new(Located::new(setting, plan, solver, explicit(NYSTROM_ORDER))))
            }
            (Method::Radau, _) => {
                Self::Stiff(Box::new(Located::new(setting, plan, radau(model, layout), implicit())))
            }
            _ => {
                let solver = DormandPrince::new(layout.dimension(), layout.total());
                Self::General(Box::new(Located::new(setting, plan, solver, explicit(DOP853_ORDER))))
            }
        }
    }
}

/// Storage for runs with located events, by integrator. Consecutive runs with the same layout reuse it.
#[derive(Default)]
pub(in crate::run) struct Workspace {
    one: Option<Room<Paired<One>>>,
    many: Option<Room<Paired>>,
    general: Option<Room<DormandPrince>>,
}

impl Workspace {
    /// Runs a started state to the end of its plan. `way` is storage for the run data of the state.
    pub(in crate::run) fn run(
        &mut self,
        (model, plan, tolerance): (&Model, &Plan, f64),
        state: &mut State,
        way: Option<Box<LocatedWay>>,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let layout = model.layout();
        let setting = Setting { model, layout, tolerance, method: stepping(&SceneTraits::of(model)).0 };
        let to = (state, way);
        match (setting.method, layout.free) {
            (Method::Nystrom, 1) => {
                let solver = || Paired::one(layout.total());
                Room::run(&mut self.one, (setting, plan, explicit(NYSTROM_ORDER)), solver, to, record)
            }
            (Method::Nystrom, free) => {
                let solver = || Paired::new(free, 1, layout.total());
                Room::run(&mut self.many, (setting, plan, explicit(NYSTROM_ORDER)), solver, to, record)
            }
            // The integrator contains finite differences of one model, so its storage is not kept.
            (Method::Radau, _) => {
                Room::run(&mut None, (setting, plan, implicit()), || radau(model, layout), to, record)
            }
            _ => {
                let solver = || DormandPrince::new(layout.dimension(), layout.total());
                Room::run(&mut self.general, (setting, plan, explicit(DOP853_ORDER)), solver, to, record)
            }
        }
    }
}

/// Calls one method on the run, whatever its integrator.
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
    /// Starts or continues the run from a state.
    pub(in crate::run) fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        each!(self, run => run.set_out(state, opening, record));
    }

    /// Advances the state to a goal and saves in it everything that the next step depends on.
    pub(in crate::run) fn go(
        &mut self,
        state: &mut State,
        goal: Goal,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        each!(self, run => run.go(state, goal, record))
    }

    /// Passes the extents of the watched bodies to the record.
    pub(in crate::run) fn hand_over(&mut self, record: &mut dyn Record) {
        each!(self, run => run.hand_over(record));
    }

    /// Returns the number of reversals added to or removed from slip memories.
    pub(in crate::run) fn touched(&self) -> u64 {
        each!(self, run => run.touched())
    }

    /// Returns the largest number of reversals that a slip memory keeps.
    pub(in crate::run) fn remembers(&self) -> usize {
        each!(self, run => run.remembers())
    }

    /// Commits the slip memories that wait for an event.
    pub(in crate::run) fn settle_books(&mut self, state: &mut State) {
        each!(self, run => run.settle_books(state));
    }

    /// Writes the current state as a row.
    pub(in crate::run) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        each!(self, run => run.write_now(state, record));
    }
}
