//! Position and velocity in a closed-form oscillation at a given time.

use super::{PhasePoint, Swing};

/// Largest number of Newton steps to the position at a time.
const NEWTON: usize = 8;

impl Swing<'_> {
    /// Returns position and velocity of the slider at the event that ends the motion.
    pub(crate) fn end(&self) -> PhasePoint {
        let t = self.start.t + self.duration;
        if self.slips.is_empty() {
            return self.freely(t, self.duration);
        }
        let (way, v) =
            // At a turning point the velocity of slip is exactly zero.
            if self.turns { (self.high, -self.drift) } else { (self.reach, self.velocity(self.reach)) };
        self.place((t, self.duration), way, v)
    }

    /// Returns position and velocity of the slider at a time before the event.
    pub(crate) fn at(&mut self, t: f64) -> PhasePoint {
        let passed = t - self.start.t;
        if self.slips.is_empty() {
            return self.freely(t, passed);
        }
        let at = self.clock_at(passed);
        let way = self.way(at);
        self.place((t, passed), way, self.velocity(way))
    }

    /// Returns the integration variable (angle or displacement) after `passed` seconds.
    pub(super) fn clock_at(&mut self, passed: f64) -> f64 {
        let whole = self.to - self.from;
        // Always computed from the start, so that rows do not depend on other rows.
        let mut at = self.guess(passed / self.duration);
        let (mut known, mut left) = (self.from, passed);
        for _ in 0..NEWTON {
            // A short range needs less relative accuracy.
            let part = ((at - known) / whole).abs();
            left -= self.time_between(known, at, self.allowed / part, part).0;
            known = at;
            let [slowness] = self.slowness([at]);
            let step = left / slowness;
            at = (at + step).clamp(self.from, self.to);
            // The remaining error is of second order.
            if step.abs() <= self.near * whole {
                break;
            }
        }
        at
    }

    /// Returns a guess of the integration variable at a fraction of the duration: a cubic polynomial with the slopes of both ends.
    fn guess(&self, share: f64) -> f64 {
        let (whole, share) = (self.to - self.from, share.clamp(0.0, 1.0));
        let [first, last] =
            self.slowness([self.from, self.to]).map(|slowness| self.duration / slowness - whole);
        let rest = 1.0 - share;
        let guess = self.from + whole * share + share * rest * (rest * first - share * last);
        // If the cubic leaves the range, the guess is proportional.
        if guess > self.from && guess < self.to { guess } else { self.from + whole * share }
    }

    /// Returns the slider's velocity at q, m/s. If slip is about as fast as at the start, the velocity is computed from its change, to
    /// avoid cancellation against a much faster prescribed motion.
    pub(super) fn velocity(&self, way: f64) -> f64 {
        let (first, [last]) = (self.speed(), self.speed_at([way]));
        let gain = if last > 0.5 * first && last < 2.0 * first {
            let [[mean], ..] = self.force([way]);
            2.0 * way * mean / (first + last)
        } else {
            // Near a turning point the quotient above is inaccurate.
            last - first
        };
        self.start.v + self.sense * gain
    }

    /// Returns the slider's motion in gross slip, a parabola.
    pub(super) fn freely(&self, t: f64, passed: f64) -> PhasePoint {
        let PhasePoint { x, v, .. } = self.start;
        let gain = self.sense * self.push * passed;
        let turned = self.turns && passed == self.duration;
        PhasePoint {
            t,
            x: x + (v + 0.5 * gain) * passed,
            v: if turned { -self.drift_at(t) } else { v + gain },
        }
    }

    /// Returns the slider's motion from the displacement. `passed` is the time since the start without the rounding of `t`, because fast
    /// prescribed motions are sensitive to this rounding.
    pub(super) fn place(&self, (t, passed): (f64, f64), way: f64, v: f64) -> PhasePoint {
        PhasePoint { t, x: self.start.x + (self.sense * way - self.drift * passed), v }
    }

    /// Returns the work of the prescribed motion up to a point, J. For a linear motion this is velocity times the missing momentum of the
    /// slider, for sines displacement times the constant contact force.
    pub(crate) fn work(&self, to: &PhasePoint) -> f64 {
        if let Some(sway) = &self.sway {
            return self.held() * (sway.at(to.t).value - sway.at(self.start.t).value);
        }
        self.drift * (self.load * (to.t - self.start.t) - (to.v - self.start.v) / self.mobility)
    }
}
