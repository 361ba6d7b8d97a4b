//! The swing of a single slider between two events, in closed form but for one smooth quadrature.
//!
//! Where nothing but steady contacts acts on a single slider and all of them slide over the same straight follower, the
//! displacement q between the two counts alone: q̈ = b(q), falling as slip spreads. Its first integral is known,
//! q̇² = ν² = ν₀² + 2∫b dq, concave in q, with one zero before and one after the motion: the turning points q₁ < q₂ of an
//! oscillation of which the interval is an arc. With
//!
//! q = (q₁+q₂)/2 - (q₂-q₁)/2 cos θ,   ν² = 2 (q-q₁)(q₂-q) K,   K = (b̄[q₁,q] - b̄[q,q₂])/(q₂-q₁),
//!
//! b̄ the mean of b over a range, time is T = ∫dθ/√(2K): K is ω²/2 for a spring and changes slowly for a contact, so that a
//! few nodes of Gauss and Legendre give all digits, whatever the number of periods in a second.
//!
//! Closed forms are there for the paraboloid, M = c h^{3/2}: b = b₀ + Σ αM(h), h = h₀ - λq. Means of M are taken over roots
//! of heights, so that no swing is too small for its digits.
//!
//! Source: Landau, Lifshitz, *Mechanics*, 3rd ed., section 11 (motion in one dimension); the mean of the force in place of
//! the difference of the potential is the discrete gradient of Gonzalez, J. Nonlinear Sci. 6 (1996) 449.

mod course;
mod spring;

use super::Interval;
use crate::Model;
use crate::model::Free;
use crate::quadrature;
use spring::Spring;
use std::f64::consts::PI;

/// Steps of Halley's method to a turning point: three suffice, more are for slow starts.
const HALLEY: usize = 30;
/// Part of its height at the start below which a slip front comes so near to the centre that its branch point is felt.
const BRANCH: f64 = 0.1;
/// Swings smaller than this share of the natural length are left to the stepper: it knows rest from rounding.
const SMALLEST: f64 = 1e-9;

/// Motion of the slider until its next event. Scratch: made anew after each event.
#[derive(Debug, Clone, Default)]
pub(crate) struct Swing {
    /// Direction of the slide along the coordinate, ±1.
    sense: f64,
    /// Speed of the followers along the coordinate, m/s: q̇ = ±(ẋ + drift).
    drift: f64,
    /// Where and when it begins.
    start: Place,
    mobility: f64,
    /// Constant force on the slider, N.
    load: f64,
    /// b₀ along the slide, m/s².
    push: f64,
    springs: Vec<Spring>,
    /// Where the first piece of memory ends, m; ∞ if none does.
    reach: f64,
    /// Turning points before and after, m.
    low: f64,
    high: f64,
    /// Angles at the start and at the end.
    from: f64,
    to: f64,
    /// Duration until the event, s; ∞ if there is none.
    pub(crate) duration: f64,
    /// Whether the slide turns at the end; otherwise a piece of memory ends.
    pub(crate) turns: bool,
    /// Whether the slide ends near the centre of a contact.
    nears: bool,
    /// Relative error allowed of times.
    allowed: f64,
    pub(crate) evaluations: u64,
}

/// Time (s), position (m) and velocity (m/s).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Place {
    pub(crate) t: f64,
    pub(crate) x: f64,
    pub(crate) v: f64,
}

impl Swing {
    /// Room for the contacts of a model.
    pub(crate) fn of(model: &Model) -> Self {
        Self { springs: Vec::with_capacity(model.contacts.len()), ..Self::default() }
    }

    /// Takes up what an interval has become; false where it has no such form.
    pub(crate) fn begin(&mut self, interval: &Interval<'_>, slider: &Free, start: Place) -> bool {
        let Some(pull) = &interval.slider else { return false };
        let Some(first) = interval.steady.first() else { return false };
        if first.arm == 0.0 {
            return false;
        }
        self.sense = (first.sense() * first.arm).signum();
        self.drift = first.driven() / first.arm;
        self.start = start;
        (self.mobility, self.load) = (slider.mobility, slider.force);
        self.push = self.sense * pull.acceleration;
        self.reach = f64::INFINITY;
        for steady in &interval.steady {
            if steady.sense() * steady.arm * self.sense <= 0.0 || steady.driven() != self.drift * steady.arm {
                return false;
            }
            self.reach = self.reach.min(steady.reach(start.t, start.x));
        }
        self.springs.clear();
        for pull in &interval.pulls {
            let Some((volume, height, lean)) = pull.root_law(start.t, start.x) else { return false };
            let (gain, lean) = (self.sense * pull.acceleration * volume, -self.sense * lean);
            // Slip that spreads must hold back.
            if !(gain > 0.0 && lean > 0.0 && height > 0.0) {
                return false;
            }
            self.springs.push(Spring::new(gain, lean, height));
        }
        true
    }

    /// Speed of the slide at the start, m/s.
    fn speed(&self) -> f64 {
        self.sense * (self.start.v + self.drift)
    }

    /// Finds the event that ends the motion, to an error of the place of `allowed` (m); false where that fails.
    /// `length` is the natural one.
    pub(crate) fn aim(&mut self, length: f64, allowed: f64) -> bool {
        self.evaluations = 0;
        let speed = self.speed();
        if speed.is_nan() || speed < 0.0 || self.reach <= 0.0 {
            return false;
        }
        if self.springs.is_empty() {
            return self.aim_free(speed, length);
        }
        let [_, pull, bend] = self.force(0.0);
        if speed == 0.0 && pull <= 0.0 || bend >= 0.0 {
            return false;
        }
        // Where a spring of the stiffness at the start would turn.
        let swing = (pull * pull - bend * speed * speed).sqrt();
        let (short, long) = (speed * speed / (swing + pull.abs()), (swing + pull.abs()) / -bend);
        let (before, after) = if pull > 0.0 { (-short, long) } else { (-long, short) };
        let low = if speed == 0.0 { Some(0.0) } else { self.turning(speed, before) };
        let (Some(low), Some(high)) = (low, self.turning(speed, after)) else { return false };
        if !(high > 0.0 && low <= 0.0 && high - low > SMALLEST * length) {
            return false;
        }
        (self.low, self.high) = (low, high);
        self.springs.iter_mut().for_each(|spring| spring.swing_between(low, high));
        self.turns = high <= self.reach;
        self.from = if low < 0.0 { self.angle(0.0) } else { 0.0 };
        self.to = if self.turns { PI } else { self.angle(self.reach) };
        let span = self.to - self.from;
        let rough = span * self.slowness(0.5 * (self.from + self.to));
        // What a relative error of time displaces.
        let way = (0.5 * span * (high - low)).max(self.drift.abs() * rough);
        self.allowed = allowed / way;
        let end = self.reach.min(high);
        self.nears = self.springs.iter().any(|s| s.height - s.lean * end < BRANCH * s.height);
        let (duration, is_good) = self.time_between(self.from, self.to, self.allowed, 1.0);
        self.duration = duration;
        is_good && duration > 0.0
    }

    /// Time from one angle to another, s, `part` of the whole way, and whether its relative error is as allowed.
    #[inline(always)]
    fn time_between(&mut self, from: f64, to: f64, allowed: f64, part: f64) -> (f64, bool) {
        let (span, mean) = if self.nears {
            // Where slip reaches the centre, M ends as a power 3/2 of the height: the root of the way that is left sees no
            // such end.
            let [start, end] = [from, to].map(|angle| (self.to - angle).max(0.0).sqrt());
            let slowness = |share: f64| {
                let left = start + (end - start) * share;
                2.0 * left * self.slowness(self.to - left * left)
            };
            (start - end, quadrature::mean(allowed, part, slowness))
        } else {
            (to - from, quadrature::mean(allowed, part, |share| self.slowness(from + (to - from) * share)))
        };
        self.evaluations += mean.asked;
        (span * mean.value, mean.error <= allowed)
    }

    /// The same in gross slip: a parabola.
    fn aim_free(&mut self, speed: f64, length: f64) -> bool {
        self.turns = self.push < 0.0;
        let way = 0.5 * speed * speed / -self.push;
        self.duration = if self.turns { speed / -self.push } else { f64::INFINITY };
        // At rest it is the stepper that knows what is next.
        speed > 0.0 && (way > SMALLEST * length || !self.turns)
    }

    /// The turning point near a guess: ν₀² + 2∫b = 0 by Halley's method, m.
    fn turning(&mut self, speed: f64, guess: f64) -> Option<f64> {
        let mut q = guess;
        for _ in 0..HALLEY {
            self.evaluations += 1;
            let [mean, force, bend] = self.force(q);
            let left = speed * speed + 2.0 * q * mean;
            let step = 2.0 * left * force / (4.0 * force * force - left * bend);
            q -= step;
            // The last step is exact to the third power of itself.
            if step.abs() <= 1e-6 * q.abs() {
                return (force * guess < 0.0).then_some(q);
            }
        }
        None
    }

    /// Mean of b from the start to q, b at q (m/s²) and its slope there (1/s²).
    fn force(&self, q: f64) -> [f64; 3] {
        let mut sum = [self.push, self.push, 0.0];
        for spring in &self.springs {
            let pull = spring.pull(q);
            (0..3).for_each(|i| sum[i] += pull[i]);
        }
        sum
    }

    /// K at q, 1/s².
    #[inline(always)]
    fn stiffness(&self, q: f64) -> f64 {
        match &self.springs[..] {
            [spring] => spring.stiffness(q),
            springs => springs.iter().map(|spring| spring.stiffness(q)).sum(),
        }
    }

    /// dt/dθ = 1/√(2K), s.
    #[inline(always)]
    fn slowness(&self, angle: f64) -> f64 {
        (0.5 / self.stiffness(self.way(angle))).sqrt()
    }

    /// q at an angle, m.
    #[inline(always)]
    fn way(&self, angle: f64) -> f64 {
        let half = sine(0.5 * angle);
        self.low + (self.high - self.low) * half * half
    }

    /// The angle at q, 0 to π.
    fn angle(&self, q: f64) -> f64 {
        2.0 * (q - self.low).max(0.0).sqrt().atan2((self.high - q).max(0.0).sqrt())
    }
}

/// Sine of 0 to π/2 by its series, to 3e-16: a call of the library's for each node would cost more than all else there.
#[inline(always)]
fn sine(x: f64) -> f64 {
    const TERMS: [f64; 10] = {
        let (mut terms, mut term, mut k) = ([0.0; 10], 1.0, 0);
        while k < 10 {
            terms[9 - k] = term;
            term /= -(((2 * k + 2) * (2 * k + 3)) as f64);
            k += 1;
        }
        terms
    };
    let square = x * x;
    x * TERMS.iter().fold(0.0, |sum, term| sum * square + term)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_is_the_sine() {
        let worst = (0..=1000).map(|i| 0.5 * PI * f64::from(i) / 1000.0).map(|x| (sine(x) - x.sin()).abs());
        assert!(worst.fold(0.0, f64::max) < 4e-16);
    }
}
