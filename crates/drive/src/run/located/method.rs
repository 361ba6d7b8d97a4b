//! The solver of a run between located events.

use super::{Located, Setting};
use crate::Plan;
use crate::method::{Method, SceneTraits, stepping};
use crate::model::Model;
use stickslip_stepper::{DOP853_ORDER, DormandPrince, NYSTROM_ORDER, One, Paired};

/// A run between located events, by the method of the scene's intervals without a closed form: where no force depends on a
/// velocity, one that spares a third of the evaluations.
pub(in crate::run) enum LocatedRun<'a> {
    /// A single free coordinate.
    One(Box<Located<'a, Paired<One>>>),
    /// Several.
    Many(Box<Located<'a, Paired>>),
    /// With dampers, varying loads or growth.
    General(Box<Located<'a, DormandPrince>>),
}

impl<'a> LocatedRun<'a> {
    pub(in crate::run) fn new(model: &'a Model, plan: &Plan, tolerance: f64) -> Self {
        let layout = model.layout();
        let setting = Setting { model, layout, tolerance, method: stepping(&SceneTraits::of(model)).0 };
        match (setting.method, layout.free) {
            // The work put in is the only integral: nothing dissipates but contacts, which book for themselves.
            (Method::Nystrom, 1) => {
                let solver = Paired::one(layout.total());
                Self::One(Box::new(Located::new(setting, plan, solver, NYSTROM_ORDER)))
            }
            (Method::Nystrom, free) => {
                let solver = Paired::new(free, 1, layout.total());
                Self::Many(Box::new(Located::new(setting, plan, solver, NYSTROM_ORDER)))
            }
            _ => {
                let solver = DormandPrince::new(layout.dimension(), layout.total());
                Self::General(Box::new(Located::new(setting, plan, solver, DOP853_ORDER)))
            }
        }
    }
}
