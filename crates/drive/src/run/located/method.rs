//! The solver of a run between located events.

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

/// Order of a solver, for step control, and what its steps may do.
type Steps = (u32, StepLimits);

/// Of explicit methods.
fn explicit(order: u32) -> Steps {
    (order, StepLimits::default())
}

/// Of the implicit one.
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
            // The work put in is the only integral: nothing dissipates but contacts, which book for themselves.
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

/// Rooms of runs between located events, by the kind of their solver: runs of one shape take turns in one of them.
#[derive(Default)]
pub(in crate::run) struct Workspace {
    one: Option<Room<Paired<One>>>,
    many: Option<Room<Paired>>,
    general: Option<Room<DormandPrince>>,
}

impl Workspace {
    /// Moves a state that has begun to the end of its plan; `way` is room for what is put down with it.
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
            // Its solver holds differences of one model: no room is kept.
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
