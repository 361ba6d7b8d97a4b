//! Where a swing is at a time.

use super::{PhasePoint, Swing};

/// Steps to the place at a time: each squares the error.
// Two give the same bits as eight; one leaves P1 at 1e-9 an error of 1.5e-6 u_c instead of 3e-13.
const NEWTON: usize = 8;

impl Swing<'_> {
    /// Place and velocity at the event.
    pub(crate) fn end(&self) -> PhasePoint {
        let t = self.start.t + self.duration;
        if self.slips.is_empty() {
            return self.freely(t, self.duration);
        }
        let (way, v) =
            // At a turning point the slide is at rest to the last bit, and not by a root of a small
            // difference.
            if self.turns { (self.high, -self.drift) } else { (self.reach, self.velocity(self.reach)) };
        self.place((t, self.duration), way, v)
    }

    /// Place and velocity at a time before the event.
    pub(crate) fn at(&mut self, t: f64) -> PhasePoint {
        let passed = t - self.start.t;
        if self.slips.is_empty() {
            return self.freely(t, passed);
        }
        let at = self.clock_at(passed);
        let way = self.way(at);
        self.place((t, passed), way, self.velocity(way))
    }

    /// Where the clock stands then.
    pub(super) fn clock_at(&mut self, passed: f64) -> f64 {
        let whole = self.to - self.from;
        // Every moment from the start on, not from the one before: rows are the same whatever others there are.
        let mut at = self.guess(passed / self.duration);
        let (mut known, mut left) = (self.from, passed);
        for _ in 0..NEWTON {
            // The shorter the way, the less its digits count.
            let part = ((at - known) / whole).abs();
            left -= self.time_between(known, at, self.allowed / part, part).0;
            known = at;
            let [slowness] = self.slowness([at]);
            let step = left / slowness;
            at = (at + step).clamp(self.from, self.to);
            // What is left after this step is the square of it.
            if step.abs() <= self.near * whole {
                break;
            }
        }
        at
    }

    /// Where the clock stands about a share of the duration: the cubic with the paces of both ends.
    fn guess(&self, share: f64) -> f64 {
        let (whole, share) = (self.to - self.from, share.clamp(0.0, 1.0));
        let [first, last] =
            self.slowness([self.from, self.to]).map(|slowness| self.duration / slowness - whole);
        let rest = 1.0 - share;
        let guess = self.from + whole * share + share * rest * (rest * first - share * last);
        // A cubic may leave the way where the paces of its ends differ much: then in proportion.
        if guess > self.from && guess < self.to { guess } else { self.from + whole * share }
    }

    /// The slider's velocity at q, m/s. Where the slide is about as fast as at the start by what it has gained, not by what the
    /// followers' speed leaves of ν, which may be thousands of times as fast.
    pub(super) fn velocity(&self, way: f64) -> f64 {
        let (first, [last]) = (self.speed(), self.speed_at([way]));
        let gain = if last > 0.5 * first && last < 2.0 * first {
            let [[mean], ..] = self.force([way]);
            2.0 * way * mean / (first + last)
        } else {
            // Next to a turning point that quotient has no digits.
            last - first
        };
        self.start.v + self.sense * gain
    }

    /// In gross slip: a parabola.
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

    /// `passed` is what `t` would be from the start on without its rounding: a fast follower's way depends on it.
    pub(super) fn place(&self, (t, passed): (f64, f64), way: f64, v: f64) -> PhasePoint {
        PhasePoint { t, x: self.start.x + (self.sense * way - self.drift * passed), v }
    }

    /// Work that the followers have put in up to a place, J: their speed times what the slider's momentum lacks of the
    /// impulse of its load; on sines, under constant forces, their way times what holds the slider back.
    pub(crate) fn work(&self, to: &PhasePoint) -> f64 {
        if let Some(sway) = &self.sway {
            return self.held() * (sway.at(to.t).value - sway.at(self.start.t).value);
        }
        self.drift * (self.load * (to.t - self.start.t) - (to.v - self.start.v) / self.mobility)
    }
}
