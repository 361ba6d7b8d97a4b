//! Fixed steps: velocity Verlet and classical Runge–Kutta, without events.

use super::chords::Chords;
use crate::record::Record;
use crate::{Model, Plan, RunError, State};
use stickslip_stepper::{Rk4, System, Verlet};

/// Which method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Method {
    Verlet,
    Rk4,
}

/// The two methods behind one call.
enum Stepping {
    Verlet(Verlet),
    Rk4(Rk4),
}

/// Runs in steps of `step`; the last one is shorter where the end asks for it.
pub(super) fn run(
    model: &Model,
    plan: &Plan,
    method: Method,
    step: f64,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let limit = model.longest_step(plan.stepper).unwrap_or(f64::INFINITY);
    if step >= limit {
        return Err(RunError::Unstable { step, limit });
    }
    let from = state.t;
    let mut chords = Chords::new(model, plan, state, record);
    let (dimension, total) = (chords.layout.dimension(), chords.layout.total());
    let mut stepping = match method {
        Method::Verlet => Stepping::Verlet(Verlet::new(chords.layout.free, dimension, total)),
        Method::Rk4 => Stepping::Rk4(Rk4::new(dimension, total)),
    };
    let mut y = chords.state.y.clone();
    chords.write_now();
    let mut outcome = Ok(());
    let mut k = 0.0;
    while chords.goes_on() && outcome.is_ok() {
        k += 1.0;
        let t = chords.state.t;
        let aim = from + k * step;
        // A remainder below round-off belongs to this step.
        let end = if aim > plan.duration - 1e-9 * step { plan.duration } else { aim };
        if chords.enter(end) {
            stepping.restart();
        }
        stepping.step(&chords.equations(), t, &mut y, end - t);
        outcome = chords.accept(end, &y);
    }
    chords.write_now();
    chords.state.counts.evaluations += stepping.evaluations();
    outcome
}

impl Stepping {
    fn step(&mut self, system: &impl System, t: f64, y: &mut [f64], h: f64) {
        match self {
            Self::Verlet(verlet) => verlet.step(system, t, y, h),
            Self::Rk4(rk4) => rk4.step(system, t, y, h),
        }
    }

    /// After a corner the slopes kept from the step before belong to its other side.
    fn restart(&mut self) {
        if let Self::Verlet(verlet) = self {
            verlet.restart();
        }
    }

    fn evaluations(&self) -> u64 {
        match self {
            Self::Verlet(verlet) => verlet.evaluations(),
            Self::Rk4(rk4) => rk4.evaluations(),
        }
    }
}
