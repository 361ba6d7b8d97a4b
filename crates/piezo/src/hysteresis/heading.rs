//! Direction of an input.

use stickslip_drive::Sample;

/// Name of the event at which an input reverses.
pub(super) const TURNED: &str = "input turns";
/// Time by which the rate of the input is extrapolated, in units of 1/rate.
// At a reversal located to 1e-13 of a step, rounding would determine the sign of the rate itself.
const AHEAD: f64 = 1e-9;

/// Returns the direction of the input's motion, 1 or -1; `None` for an input at rest.
///
/// `rate` is the largest angular frequency of the input, 1/s.
pub(super) fn heading(input: &Sample, rate: f64) -> Option<f64> {
    let soon = input.rate + input.acceleration * (AHEAD / rate);
    (soon != 0.0).then(|| soon.signum())
}
