//! Gross slip over sinusoidal prescribed motions.
//!
//! The contact forces are constant in gross slip, so the slider's motion is a parabola for any prescribed motion. The velocity of slip is
//! s(t) = ±(v + at + ḟ). The bound J of the sines' third derivative bounds s̈. Hence s stays above s + ṡτ - Jτ²/2, whose zero is never
//! later than that of s. An iteration over these zeros misses no zero of s and converges quadratically.

use super::{SMALLEST, Swing};
use crate::interval::{Closed, Followed, Interval};
use crate::{Sample, Waveform};

/// Largest number of iterations for the end of slip; beyond it the motion is integrated numerically.
const LOOKS: u32 = 64;

/// Sinusoidal prescribed motion along a coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sway<'a> {
    waveform: &'a Waveform,
    /// Factor by which the waveform moves the coordinate.
    factor: f64,
    /// Upper bound of the third time derivative, m/s³.
    jerk: f64,
}

impl<'a> Sway<'a> {
    /// Returns the prescribed motion of a contact; `None` if the motion is linear in time.
    fn of(closed: &Closed<'a>) -> Option<Self> {
        let Followed::Sines { factor, waveform, .. } = closed.followed else { return None };
        let factor = factor / closed.arm;
        Some(Self { waveform, factor, jerk: factor.abs() * waveform.sines_jerk() })
    }

    /// Returns whether another contact has the same prescribed motion, so that slip of both contacts ends together.
    fn drags(&self, closed: &Closed<'_>) -> bool {
        match closed.followed {
            Followed::Sines { factor, waveform, .. } => {
                std::ptr::eq(waveform, self.waveform) && factor == self.factor * closed.arm
            }
            Followed::Line { .. } => false,
        }
    }

    /// Returns the prescribed motion along the coordinate at time t, m, with its time derivatives.
    #[inline(always)]
    pub(super) fn at(&self, t: f64) -> Sample {
        let Sample { value, rate, acceleration } = self.waveform.sines_at(t);
        let factor = self.factor;
        Sample { value: factor * value, rate: factor * rate, acceleration: factor * acceleration }
    }
}

impl<'a> Swing<'a> {
    /// Sets up the motion for an interval with sinusoidal prescribed motions. Returns false unless all contacts are in gross slip over the
    /// same prescribed motion.
    #[inline(never)]
    pub(super) fn begin_swayed(&mut self, interval: &Interval<'a>) -> bool {
        self.slips.clear();
        self.reach = f64::INFINITY;
        self.sway = interval.closed.first().and_then(Sway::of);
        let Some(sway) = &self.sway else { return false };
        let slides = |closed: &Closed<'_>| {
            closed.branch.is_gross() && closed.sense() * closed.arm * self.sense > 0.0 && sway.drags(closed)
        };
        if !interval.closed.iter().all(slides) {
            return false;
        }
        let held: f64 = interval
            .closed
            .iter()
            .map(|closed| closed.contact.count * closed.arm * closed.branch.forces().0)
            .sum();
        self.push = self.sense * self.mobility * (self.load - held);
        true
    }

    /// Returns the constant force of the contacts on the slider in gross slip, N.
    pub(super) fn held(&self) -> f64 {
        self.load - self.sense * self.push / self.mobility
    }

    /// Computes the end of slip. Returns false if no end is found, or if the slip distance does not exceed rounding. `length` is the
    /// natural length, m.
    #[inline(never)]
    pub(super) fn aim_swayed(&mut self, sway: &Sway<'_>, length: f64) -> bool {
        let Some(duration) = self.slides_for(sway) else { return false };
        (self.duration, self.turns) = (duration, true);
        let (start, end) = (self.start, self.end());
        let way = (end.x - start.x) + (sway.at(end.t).value - sway.at(start.t).value);
        way.abs() > SMALLEST * length
    }

    /// Returns the duration of gross slip, s.
    fn slides_for(&mut self, sway: &Sway<'_>) -> Option<f64> {
        let mut passed = 0.0;
        for _ in 0..LOOKS {
            self.evaluations += 1;
            let Sample { rate, acceleration, .. } = sway.at(self.start.t + passed);
            let speed = self.sense * (self.start.v + rate) + self.push * passed;
            let rise = self.push + self.sense * acceleration;
            // Only rounding leads beyond the end, unless there is no slip at the start.
            if speed <= 0.0 {
                return (passed > 0.0).then_some(passed);
            }
            // Without a sine there may be no end.
            if !passed.is_finite() {
                return None;
            }
            let step = zero(speed, rise, sway.jerk);
            passed += step;
            // The remaining error is of second order.
            if sway.jerk * step * step <= -f64::EPSILON * rise * passed {
                return Some(passed);
            }
        }
        None
    }
}

/// Returns the positive zero τ of s + ṡτ - Jτ²/2, s.
fn zero(speed: f64, rise: f64, jerk: f64) -> f64 {
    let root = (rise * rise + 2.0 * jerk * speed).sqrt();
    // Avoids cancellation.
    if rise > 0.0 { (rise + root) / jerk } else { 2.0 * speed / (root - rise) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::PhasePoint;
    use crate::waveform::{Harmonic, Shape, Timing};

    /// One sine, and a sum of sines; period 1 s.
    fn waveforms() -> [Waveform; 2] {
        let one = Shape::Sine { amplitude: 1.0, phase: 0.3, offset: 0.1 };
        let term = |amplitude, order, phase| Harmonic { amplitude, order, phase };
        let terms = vec![term(1.0, 1.0, 0.3), term(0.2, 3.0, 1.0), term(-0.05, 7.0, 2.0)];
        [one, Shape::Harmonics { terms }].map(|shape| Waveform::new(shape, Timing::every(1.0)).unwrap())
    }

    /// Slip ends at the first zero of its velocity on a fine grid, refined by bisection.
    #[test]
    fn a_slide_ends_at_the_first_fall_of_its_speed() {
        let (mut found, mut most) = (0, 0);
        for (waveform, k) in waveforms().iter().flat_map(|waveform| (0..2000).map(move |k| (waveform, k))) {
            let sense = if k % 2 == 0 { 1.0 } else { -1.0 };
            let (t, v, push) =
                (0.0137 * f64::from(k % 73), 0.61 * f64::from(k % 37 - 18), -0.5 * f64::from(k % 11));
            let sway = Sway { waveform, factor: 1.0, jerk: waveform.sines_jerk() };
            let speed = |passed: f64| sense * (v + waveform.sines_at(t + passed).rate) + push * passed;
            if speed(0.0) <= 0.0 {
                continue;
            }
            let start = PhasePoint { t, x: 0.0, v };
            let mut swing = Swing { sense, start, mobility: 1.0, push, sway: Some(sway), ..Swing::default() };
            let end = swing.slides_for(&sway);
            let grid = |i: i32| f64::from(i) / 2000.0;
            let Some(first) = (1..2000).find(|i| speed(grid(*i)) < 0.0) else {
                assert!(end.is_none_or(|end| end > 0.999), "{k}: {end:?}");
                continue;
            };
            let (mut low, mut high) = (grid(first - 1), grid(first));
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if speed(middle) > 0.0 { low = middle } else { high = middle }
            }
            let slope = (speed(high + 1e-6) - speed(high - 1e-6)).abs() / 2e-6;
            let rounding = 1e-14 * (v.abs() + 10.0) / slope;
            assert!(
                end.is_some_and(|end| (end - high).abs() <= rounding + 4e-15 * high),
                "{k}: {end:?} {high}"
            );
            (found, most) = (found + 1, most.max(swing.evaluations));
        }
        assert!(found > 1500, "{found}");
        assert!(most < 30, "{most}");
    }
}
