//! Which way an input goes.

use stickslip_drive::Sample;

/// Name of the event in which an input turns.
pub(super) const TURNED: &str = "input turns";
/// How far ahead an input is looked at whose rate may be rounding, in units of 1/rate.
// At a reversal found to 1e-13 of a step its rate has the sign of a last bit; a billionth of a period later it has its own.
const AHEAD: f64 = 1e-9;

/// The sense in which an input goes on, 1 or -1; none where it stands. `rate` is the fastest at which it swings, 1/s.
pub(super) fn heading(input: &Sample, rate: f64) -> Option<f64> {
    let soon = input.rate + input.acceleration * (AHEAD / rate);
    (soon != 0.0).then(|| soon.signum())
}
