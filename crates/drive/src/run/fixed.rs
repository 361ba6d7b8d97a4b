//! Fixed steps, without events.
//!
//! A step is never cut and never chosen: an error that events make is the stepper's own, of second order at
//! best. The work of a run is known beforehand.

use super::chords::Chords;
use crate::record::Record;
use crate::{Model, Plan, RunError, State};
use stickslip_stepper::FixedStep;

/// Runs in steps of `step`; the last one is shorter where the end asks for it.
///
/// Steps end at from + k·step (s), multiplied and not summed up. Fails at once where `step` is as long as the
/// longest with which small motions do not grow, else as [`Chords::accept`] does.
pub(super) fn run<F: FixedStep>(
    model: &Model,
    plan: &Plan,
    step: f64,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let limit = model.longest_step(plan.stepper).unwrap_or(f64::INFINITY);
    // Beyond it the stiffest motion grows at every step: refused instead of exploding.
    if step >= limit {
        return Err(RunError::Unstable { step, limit });
    }
    let from = state.t;
    let mut chords = Chords::new(model, plan, state, record);
    let mut stepper = F::of(&chords.equations());
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
            // Slopes kept from the step before belong to the other side of the corner.
            stepper.restart();
        }
        stepper.step(&chords.equations(), t, &mut y, end - t);
        outcome = chords.accept(end, &y);
    }
    chords.write_now();
    chords.state.counts.evaluations += stepper.evaluations();
    outcome
}
