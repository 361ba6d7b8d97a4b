//! Duration of a closed-form oscillation by numerical quadrature.

use super::{Clock, Swing};
use crate::quadrature::{self, Lanes, each, lanes};
use crate::sine::sine;

use std::f64::consts::PI;

impl Swing<'_> {
    /// Returns the time between two values of the integration variable, s, and whether its relative error is below `allowed`. `part` is the
    /// fraction of the whole integration range.
    #[inline(always)]
    pub(super) fn time_between(&mut self, from: f64, to: f64, allowed: f64, part: f64) -> (f64, bool) {
        let (span, mean) = if self.nears {
            // Near the centre M has a power 3/2 of the height; over the root of the remaining range the integrand is smooth.
            let [start, end] = each([from, to], |at| (self.to - at).max(0.0).sqrt());
            let slowness = |shares: Lanes| {
                let left = each(shares, |share| start + (end - start) * share);
                let slowness = self.slowness(each(left, |left| self.to - left * left));
                lanes(|i| 2.0 * left[i] * slowness[i])
            };
            (start - end, quadrature::mean(allowed, part, slowness))
        } else if self.clock == Clock::Angle && from == 0.0 && to == PI {
            // Between two turning points the nodes are known in advance.
            let range = self.high - self.low;
            let slowness = |shares: Lanes| self.angular(each(shares, |share| self.low + range * share));
            (PI, quadrature::mean_over_arc(allowed, slowness))
        } else {
            let slowness = |shares: Lanes| self.slowness(each(shares, |share| from + (to - from) * share));
            (to - from, quadrature::mean(allowed, part, slowness))
        };
        // Each node evaluates the forces once.
        self.evaluations += mean.asked;
        (span * mean.value, mean.error <= allowed)
    }

    /// Returns the integrand of time: dt/dθ = 1/√(2K), s, or dt/dq = 1/ν, s/m.
    #[inline(always)]
    pub(super) fn slowness<const N: usize>(&self, at: [f64; N]) -> [f64; N] {
        if self.clock == Clock::Way {
            return each(self.speed_at(at), f64::recip);
        }
        self.angular(each(at, |at| self.swung(at)))
    }

    /// Returns the integrand dt/dθ at displacement q, s.
    #[inline(always)]
    fn angular<const N: usize>(&self, ways: [f64; N]) -> [f64; N] {
        each(self.stiffness(ways), |stiffness| (0.5 / stiffness).sqrt())
    }

    /// Returns the displacement q for a value of the integration variable, m.
    #[inline(always)]
    pub(super) fn way(&self, at: f64) -> f64 {
        if self.clock == Clock::Way { at } else { self.swung(at) }
    }

    /// Returns the displacement q at an angle θ, m.
    #[inline(always)]
    fn swung(&self, angle: f64) -> f64 {
        // (1 - cos θ)/2 as a square avoids cancellation near the first turning point.
        let half = sine(0.5 * angle);
        self.low + (self.high - self.low) * half * half
    }

    /// Returns the velocity of slip ν at displacement q, m/s.
    #[inline(always)]
    pub(super) fn speed_at<const N: usize>(&self, ways: [f64; N]) -> [f64; N] {
        if self.clock == Clock::Way {
            let ([mean, ..], speed) = (self.force(ways), self.speed());
            return lanes(|i| (speed * speed + 2.0 * ways[i] * mean[i]).sqrt());
        }
        // ν² as a product vanishes exactly at the turning points.
        let stiffness = self.stiffness(ways);
        let inside = |q: f64| (q - self.low).max(0.0) * (self.high - q).max(0.0);
        lanes(|i| (2.0 * inside(ways[i]) * stiffness[i]).sqrt())
    }

    /// Returns the angle θ at displacement q, 0 to π.
    pub(super) fn angle(&self, q: f64) -> f64 {
        2.0 * math::atan2((q - self.low).max(0.0).sqrt(), (self.high - q).max(0.0).sqrt())
    }
}
