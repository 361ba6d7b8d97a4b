//! Phase angle of a waveform, and sine and cosine of angles.

use super::harmonics::Harmonic;
use crate::waveform::{Sample, Timing};
use std::f64::consts::TAU;

/// Phase angle of a waveform and the rate of this angle at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    /// Angle, rad, between -π and π before the phase is added.
    angle: f64,
    /// Angular frequency, rad/s.
    omega: f64,
}

impl Turn {
    #[inline]
    pub(super) fn at(timing: &Timing, t: f64) -> Self {
        let turns = (t - timing.delay) / timing.period;
        // Whole turns are removed first, because 2π would magnify their rounding.
        Self { angle: TAU * (turns - whole(turns)) + timing.phase, omega: TAU / timing.period }
    }

    /// Returns one sine and its derivatives.
    #[inline]
    pub(super) fn term(&self, harmonic: Harmonic) -> Sample {
        let order = harmonic.order;
        let [sin, cos] = sin_cos(order * self.angle + harmonic.phase);
        let (value, speed) = (harmonic.amplitude * sin, order * self.omega);
        Sample { value, rate: harmonic.amplitude * speed * cos, acceleration: -value * speed * speed }
    }
}

/// 3·2⁵¹. Adding and subtracting this constant rounds a number below 2⁵¹ to an integer.
const WHOLE: f64 = 6_755_399_441_055_744.0;
/// Number of table cells in a turn.
const CELLS: usize = 64;
/// π/32, the width of a cell, as a sum. The first part has 33 bits, so its product with an integer below 2²⁰ is exact.
const CELL: [f64; 2] = [1.570_796_326_734_125_6 / 16.0, 6.077_100_506_506_192e-11 / 16.0];
/// Largest angle for which the table is used, rad.
const FAR: f64 = 1e5;
/// sin(kπ/32) for a quarter of a turn, rounded from 40 digits.
const QUARTER: [f64; 17] = [
    0.0,
    0.098_017_140_329_560_6,
    0.195_090_322_016_128_28,
    0.290_284_677_254_462_4,
    0.382_683_432_365_089_8,
    0.471_396_736_825_997_64,
    0.555_570_233_019_602_2,
    0.634_393_284_163_645_5,
    std::f64::consts::FRAC_1_SQRT_2,
    0.773_010_453_362_737,
    0.831_469_612_302_545_2,
    0.881_921_264_348_355,
    0.923_879_532_511_286_7,
    0.956_940_335_732_208_8,
    0.980_785_280_403_230_4,
    0.995_184_726_672_196_9,
    1.0,
];
/// Sine and cosine at the middle of every cell.
static CIRCLE: [[f64; 2]; CELLS] = circle();

const fn circle() -> [[f64; 2]; CELLS] {
    let mut circle = [[0.0; 2]; CELLS];
    let mut k = 0;
    while k < 16 {
        let [sin, cos] = [QUARTER[k], QUARTER[16 - k]];
        circle[k] = [sin, cos];
        circle[k + 16] = [cos, -sin];
        circle[k + 32] = [-sin, -cos];
        circle[k + 48] = [-cos, sin];
        k += 1;
    }
    circle
}

/// Returns the nearest integer; for numbers beyond 2⁵¹ an integer close to the number.
// Faster than a library function on processors without a rounding instruction.
#[inline(always)]
fn whole(x: f64) -> f64 {
    (x + WHOLE) - WHOLE
}

/// Returns sine and cosine of an angle (rad), with errors below one unit in the last place of 1; exactly 0 and 1 at 0.
///
/// The bits of the result are the same on every machine.
#[inline(always)]
fn sin_cos(angle: f64) -> [f64; 2] {
    if angle.abs() < FAR { near(angle) } else { far(angle) }
}

#[cold]
#[inline(never)]
fn far(angle: f64) -> [f64; 2] {
    math::sin_cos(angle).into()
}

/// Returns sine and cosine by the addition theorem from the middle of the nearest cell. The rest r of the angle is at most π/64; the series
/// up to r⁷ and r⁸ have errors below 5e-18.
#[inline(always)]
fn near(angle: f64) -> [f64; 2] {
    const PER_RADIAN: f64 = CELLS as f64 / TAU;
    // The last bits of the sum hold the nearest cell.
    let sum = angle * PER_RADIAN + WHOLE;
    let cells = sum - WHOLE;
    let r = (angle - cells * CELL[0]) - cells * CELL[1];
    let z = r * r;
    let sin = r + r * (z * (-1.0 / 6.0 + z * (1.0 / 120.0 - z * (1.0 / 5040.0))));
    // Cosine minus 1, to avoid rounding.
    let cos = z * (-0.5 + z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z * (1.0 / 40320.0))));
    #[expect(clippy::cast_possible_truncation, reason = "the last six bits count")]
    let [s, c] = CIRCLE[sum.to_bits() as usize % CELLS];
    [s + (c * sin + s * cos), c + (c * cos - s * sin)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_are_those_of_the_library_to_the_last_place() {
        // glibc's sin and cos are accurate to 0.55 units in the last place.
        let mut angle = -40.0;
        while angle < 40.0 {
            let [sin, cos] = sin_cos(angle);
            assert!((sin - f64::sin(angle)).abs() <= f64::EPSILON, "sin {angle}");
            assert!((cos - f64::cos(angle)).abs() <= f64::EPSILON, "cos {angle}");
            angle += 0.001_234_567;
        }
        for angle in [0.0, 0.99e5, -0.99e5, 1.1e5, 1e300] {
            let [sin, cos] = sin_cos(angle);
            assert!(
                (sin - f64::sin(angle)).abs() <= 1e-15 && (cos - f64::cos(angle)).abs() <= 1e-15,
                "{angle}"
            );
        }
    }

    #[test]
    fn whole_numbers() {
        for (x, nearest) in [(0.4, 0.0), (0.6, 1.0), (-1.6, -2.0), (1e6 + 0.3, 1e6), (2e15, 2e15)] {
            assert!((whole(x) - nearest).abs() == 0.0, "{x}");
        }
    }
}
