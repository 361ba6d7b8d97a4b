//! How far a waveform has turned: what its sines share.

use super::harmonics::Harmonic;
use crate::waveform::{Sample, Timing};
use std::f64::consts::TAU;

/// Angle of a waveform and its rate at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    /// rad, between 0 and 2π before the phase is added.
    angle: f64,
    /// rad/s.
    omega: f64,
}

impl Turn {
    #[inline]
    pub(super) fn at(timing: &Timing, t: f64) -> Self {
        let turns = (t - timing.delay) / timing.period;
        // Whole turns are taken off before the multiplication by 2π, whose rounding they would magnify.
        Self { angle: TAU * (turns - floor(turns)) + timing.phase, omega: TAU / timing.period }
    }

    /// One sine and its derivatives.
    #[inline]
    pub(super) fn term(&self, harmonic: Harmonic) -> Sample {
        let order = harmonic.order;
        let [sin, cos] = sin_cos(order * self.angle + harmonic.phase);
        let (value, speed) = (harmonic.amplitude * sin, order * self.omega);
        Sample { value, rate: harmonic.amplitude * speed * cos, acceleration: -value * speed * speed }
    }
}

/// 3·2⁵¹: added to a number below 2⁵¹ and taken off again it leaves the nearest whole one.
const WHOLE: f64 = 6_755_399_441_055_744.0;
/// π/2 in two parts, the first of 33 bits: its product with a whole number below 2²⁰ is exact.
const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
/// Beyond this angle, rad, the parts are too short.
const FAR: f64 = 1e6;

/// The nearest whole number.
// A function of the library where processors may lack the instruction: a tenth of what a sine costs.
#[inline(always)]
fn nearest(x: f64) -> f64 {
    if x.abs() < 0.25 * WHOLE { (x + WHOLE) - WHOLE } else { x.round() }
}

/// The largest whole number that is not above.
#[inline(always)]
fn floor(x: f64) -> f64 {
    let whole = nearest(x);
    if whole > x { whole - 1.0 } else { whole }
}

/// Sine and cosine of an angle, rad, within a unit of the last place of either.
///
/// By quarter turns and the polynomials of the kernels of `FreeBSD`'s msun on [-π/4, π/4] (K. C. Ng, errors below 2^-58); the same
/// bits on every machine, and a quarter of the instructions of the library's.
#[inline(always)]
fn sin_cos(angle: f64) -> [f64; 2] {
    if angle.abs() < FAR { near(angle) } else { angle.sin_cos().into() }
}

#[inline(always)]
fn near(angle: f64) -> [f64; 2] {
    // The nearest whole number of them, which no angle here is too large for.
    let quarters = (angle * std::f64::consts::FRAC_2_PI + WHOLE) - WHOLE;
    // What is left of the quarter turn, and what rounding has taken of it.
    let (most, least) = (angle - quarters * QUARTER[0], quarters * QUARTER[1]);
    let r = most - least;
    let (z, tail) = (r * r, (most - r) - least);
    let s = 0.008_333_333_333_322_49
        + z * (-0.000_198_412_698_298_579_5
            + z * (2.755_731_370_707_006_8e-6
                + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10)));
    let cube = z * r;
    let sin = r - ((z * (0.5 * tail - cube * s) - tail) + cube * 0.166_666_666_666_666_32);
    let c = 0.041_666_666_666_666_6
        + z * (-0.001_388_888_888_887_411
            + z * (2.480_158_728_947_673e-5
                + z * (-2.755_731_435_139_066_3e-7
                    + z * (2.087_572_321_298_175e-9 - z * 1.135_964_755_778_819_5e-11))));
    let half = 0.5 * z;
    let one = 1.0 - half;
    let cos = one + (((1.0 - one) - half) + (z * z * c - r * tail));
    // Whole: -2⁵¹ ... 2⁵¹.
    #[expect(clippy::cast_possible_truncation, reason = "a whole number below 2^20")]
    match (quarters as i64) & 3 {
        0 => [sin, cos],
        1 => [cos, -sin],
        2 => [-sin, -cos],
        _ => [-cos, sin],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_are_those_of_the_library_to_the_last_place() {
        // glibc's sin and cos are right within 0.55 units of the last place.
        let mut angle = -40.0;
        while angle < 40.0 {
            let [sin, cos] = sin_cos(angle);
            assert!((sin - f64::sin(angle)).abs() <= f64::EPSILON, "sin {angle}");
            assert!((cos - f64::cos(angle)).abs() <= f64::EPSILON, "cos {angle}");
            angle += 0.001_234_567;
        }
        for angle in [0.0, 1e5, -9.9e5, 1.1e6, 1e300] {
            let [sin, cos] = sin_cos(angle);
            assert!(
                (sin - f64::sin(angle)).abs() <= 1e-15 && (cos - f64::cos(angle)).abs() <= 1e-15,
                "{angle}"
            );
        }
    }

    #[test]
    fn whole_numbers() {
        for (x, whole) in [(0.4, 0.0), (0.6, 1.0), (-1.6, -2.0), (1e6 + 0.3, 1e6), (1e17, 1e17)] {
            assert!((nearest(x) - whole).abs() == 0.0, "{x}");
            assert!((floor(x) - f64::floor(x)).abs() == 0.0, "{x}");
        }
    }
}
