//! Gross slip over followers on sines.
//!
//! What is dragged in gross slip feels a constant force, however its followers move: the slider runs along a parabola, and what
//! they do tells only when the slide ends. Its speed along the slide, s(t) = ±(v + at + ḟ), has a curvature of at most the bound J of
//! the sines' third derivative: from any moment on it stays above s + ṡτ - Jτ²/2, whose zero is never beyond that of s. Going from
//! one such zero to the next finds the first fall of s, leaves out none, and converges as Newton's method does.

use super::{SMALLEST, Swing};
use crate::interval::{Closed, Followed, Interval};
use crate::{Sample, Waveform};

/// Most moments looked at until the slide ends; then it is left to steps.
// Within a period slides over a sine take 6, at most 12, and over a sum of three, the highest of order 7, 11 and at most 29.
const LOOKS: u32 = 64;

/// Followers on sines, as they move along a coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sway<'a> {
    waveform: &'a Waveform,
    /// Of the waveform along the coordinate.
    factor: f64,
    /// A bound of the third derivative, m/s³.
    jerk: f64,
}

impl<'a> Sway<'a> {
    /// What drags a contact; none where that is a line.
    fn of(closed: &Closed<'a>) -> Option<Self> {
        let Followed::Sines { factor, waveform, .. } = closed.followed else { return None };
        let factor = factor / closed.arm;
        Some(Self { waveform, factor, jerk: factor.abs() * waveform.sines_jerk() })
    }

    /// Whether another contact is dragged alike, so that both slides end at once.
    fn drags(&self, closed: &Closed<'_>) -> bool {
        match closed.followed {
            Followed::Sines { factor, waveform, .. } => {
                std::ptr::eq(waveform, self.waveform) && factor == self.factor * closed.arm
            }
            Followed::Line { .. } => false,
        }
    }

    /// Along the coordinate at time t, m and its derivatives.
    #[inline(always)]
    pub(super) fn at(&self, t: f64) -> Sample {
        let Sample { value, rate, acceleration } = self.waveform.sines_at(t);
        let factor = self.factor;
        Sample { value: factor * value, rate: factor * rate, acceleration: factor * acceleration }
    }
}

impl<'a> Swing<'a> {
    /// Takes up an interval whose followers are on sines; false where not all contacts are in gross slip over the same ones.
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

    /// What the contacts hold the slider back with along the coordinate, N, in gross slip.
    pub(super) fn held(&self) -> f64 {
        self.load - self.sense * self.push / self.mobility
    }

    /// Finds the end of a slide; false where it is not found, or the slide is no longer than rounding. `length` is the natural
    /// one, m.
    #[inline(never)]
    pub(super) fn aim_swayed(&mut self, sway: &Sway<'_>, length: f64) -> bool {
        let Some(duration) = self.slides_for(sway) else { return false };
        (self.duration, self.turns) = (duration, true);
        let (start, end) = (self.start, self.end());
        let way = (end.x - start.x) + (sway.at(end.t).value - sway.at(start.t).value);
        way.abs() > SMALLEST * length
    }

    /// How long it slides, s.
    fn slides_for(&mut self, sway: &Sway<'_>) -> Option<f64> {
        let mut passed = 0.0;
        for _ in 0..LOOKS {
            self.evaluations += 1;
            let Sample { rate, acceleration, .. } = sway.at(self.start.t + passed);
            let speed = self.sense * (self.start.v + rate) + self.push * passed;
            let rise = self.push + self.sense * acceleration;
            // Beyond the end leads rounding alone, but where nothing slides at the start.
            if speed <= 0.0 {
                return (passed > 0.0).then_some(passed);
            }
            // No sine, and no end.
            if !passed.is_finite() {
                return None;
            }
            let step = zero(speed, rise, sway.jerk);
            passed += step;
            // What is left after this step is the square of it.
            if sway.jerk * step * step <= -f64::EPSILON * rise * passed {
                return Some(passed);
            }
        }
        None
    }
}

/// The zero of s + ṡτ - Jτ²/2 ahead, s.
fn zero(speed: f64, rise: f64, jerk: f64) -> f64 {
    let root = (rise * rise + 2.0 * jerk * speed).sqrt();
    // No difference of like numbers.
    if rise > 0.0 { (rise + root) / jerk } else { 2.0 * speed / (root - rise) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::PhasePoint;
    use crate::waveform::{Harmonic, Shape, Timing};

    /// Fastest foot of one sine, and of sines with a wave of their own on top, m/s; period 1 s.
    fn waveforms() -> [Waveform; 2] {
        let one = Shape::Sine { amplitude: 1.0, phase: 0.3, offset: 0.1 };
        let term = |amplitude, order, phase| Harmonic { amplitude, order, phase };
        let terms = vec![term(1.0, 1.0, 0.3), term(0.2, 3.0, 1.0), term(-0.05, 7.0, 2.0)];
        [one, Shape::Harmonics { terms }].map(|shape| Waveform::new(shape, Timing::every(1.0)).unwrap())
    }

    /// Slides of all senses, speeds and pushes end where the speed first falls through zero on a grid of 2000 moments a period,
    /// by bisection between two of them: none earlier, none later.
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
