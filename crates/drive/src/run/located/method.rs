//! Integrator of a run with located events.

use super::allowance::differences;
use super::{Located, Room, Setting};
use crate::method::{Method, SceneTraits, stepping};
use crate::model::Model;
use crate::record::Record;
use crate::run::advance::Advance;
use crate::state::{Layout, LocatedWay, State};
use crate::{Plan, RunError};
use stickslip_stepper::{
    DOP853_ORDER, DormandPrince, NYSTROM_ORDER, One, Paired, RADAU_ORDER, Radau, StepLimits,
};

/// Smallest factor by which a single rejection shortens an implicit step.
const SHRINK: f64 = 0.1;

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

impl<'a> Setting<'a> {
    fn of(model: &'a Model, tolerance: f64) -> Self {
        Self { model, layout: model.layout(), tolerance, method: stepping(&SceneTraits::of(model)).0 }
    }
}

/// Returns a run with located events, with the integrator of intervals without a closed-form solution.
///
/// If no force depends on a velocity, a Runge–Kutta–Nyström method needs a third fewer evaluations.
pub(in crate::run) fn located<'a>(model: &'a Model, plan: &Plan, tolerance: f64) -> Box<dyn Advance + 'a> {
    let (setting, layout) = (Setting::of(model, tolerance), model.layout());
    match (setting.method, layout.free) {
        // The input work is the only integral, because only contacts dissipate, and they commit their own friction work.
        (Method::Nystrom, 1) => {
            Box::new(Located::new(setting, plan, Paired::one(layout.total()), explicit(NYSTROM_ORDER)))
        }
        (Method::Nystrom, free) => {
            let solver = Paired::new(free, 1, layout.total());
            Box::new(Located::new(setting, plan, solver, explicit(NYSTROM_ORDER)))
        }
        (Method::Radau, _) => Box::new(Located::new(setting, plan, radau(model, layout), implicit())),
        _ => Box::new(general(setting, plan)),
    }
}

/// Returns a run of any model by the general integrator.
#[cfg(test)]
pub(super) fn generally<'a>(model: &'a Model, plan: &Plan, tolerance: f64) -> Located<'a, DormandPrince> {
    general(Setting::of(model, tolerance), plan)
}

/// Returns a run for dampers, varying loads and contacts growing in full stick.
fn general<'a>(setting: Setting<'a>, plan: &Plan) -> Located<'a, DormandPrince> {
    let solver = DormandPrince::new(setting.layout.dimension(), setting.layout.total());
    Located::new(setting, plan, solver, explicit(DOP853_ORDER))
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
        let (setting, layout) = (Setting::of(model, tolerance), model.layout());
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
