//! One spring along a straight path in the (d, u) plane.
//!
//! Friction limit and trial stretch are linear along the path. A spring therefore sticks throughout, or sticks first and then slips
//! in one direction. The final stretch follows from the limit at the end. The friction work follows from the slip distance and the
//! limits at both ends of the slip. A row is thus exact along a straight path of any length, except for its discretization.

use super::Springs;
use super::lanes::clamp;
use crate::Apex;

/// Straight path with quantities that all springs share.
pub(super) struct Chord {
    /// Start of the path.
    pub(super) from: Apex,
    /// End of the path.
    pub(super) to: Apex,
    /// Slope κ of the friction limit.
    slope: f64,
    /// Change κΔd of the friction limit along the path.
    growth: f64,
    /// Fraction of the path per slip distance of a spring that slips forward, 1/(Δu-κΔd); 0 if no spring can.
    forward: f64,
    /// Fraction of the path per slip distance of a spring that slips backward, 1/|Δu+κΔd|; 0 if no spring can.
    backward: f64,
}

/// Effect of a path on one spring.
#[derive(Clone, Copy)]
pub(super) struct Slide {
    /// Rest position at the end, m.
    pub(super) anchor: f64,
    /// Stretch at the end, m.
    pub(super) stretch: f64,
    /// Friction work over G\* and the spring's length, m².
    pub(super) work: f64,
}

impl Chord {
    /// Creates the path between two apexes, for springs with the slope κ of the friction limit.
    pub(super) fn new(from: Apex, to: Apex, slope: f64) -> Self {
        let (travel, growth) = (to.u - from.u, slope * (to.d - from.d));
        let inverse = |rate: f64| if rate > 0.0 { 1.0 / rate } else { 0.0 };
        Self {
            from,
            to,
            slope,
            growth,
            forward: inverse(travel - growth),
            backward: inverse(-travel - growth),
        }
    }

    /// Returns the friction limit κ(d-h) at the end, m.
    #[inline]
    pub(super) fn limit(&self, h: f64) -> f64 {
        self.slope * (self.to.d - h)
    }

    /// Returns the stretch at the end over d-h, for a spring that touches for the first time along the path.
    pub(super) fn fresh_stretch_per_rise(&self) -> f64 {
        clamp((self.to.u - self.from.u) / (self.to.d - self.from.d), self.slope)
    }

    /// Returns u at the time when a spring touches: its initial rest position.
    // The value u at the end of the path would leave new springs unstretched, an error of first order.
    #[inline]
    pub(super) fn touching_anchor(&self, h: f64) -> f64 {
        self.to.u - (self.to.u - self.from.u) * ((self.to.d - h) / (self.to.d - self.from.d))
    }

    /// Returns the effect of the path on a spring in contact at the end, from its rest position `anchor`.
    ///
    /// A spring that slips forward moves its rest position by D = (Δu-κΔd) times the fraction of the path in which it slips. The mean
    /// limit over the slip is L - ½κΔd times that fraction, where L is the limit at the end. The formula also holds for a spring that
    /// has just touched.
    #[inline(always)]
    pub(super) fn slide(&self, h: f64, anchor: f64) -> Slide {
        let (u, limit) = (self.to.u, self.limit(h));
        let trial = u - anchor;
        let edge = u - limit.copysign(trial);
        // Rounding must not make the stretch smaller than the limit, because the spring would seem to stick. One unit in the last
        // place is sufficient.
        let ulp = (edge.abs() * f64::EPSILON).copysign(trial);
        let edge = if (u - edge).abs() < limit { edge - ulp } else { edge };
        let moved = if trial.abs() > limit { edge } else { anchor };
        let way = (moved - anchor).abs();
        let part = way * if trial > 0.0 { self.forward } else { self.backward };
        let part = if part < 1.0 { part } else { 1.0 };
        Slide { anchor: moved, stretch: clamp(trial, limit), work: way * (limit - 0.5 * self.growth * part) }
    }

    /// Returns the friction work over G\* of the springs `after..before`, which leave contact along the path.
    ///
    /// These springs stick, then slip until their limit is 0.
    pub(super) fn leaving_work(
        &self,
        springs: &Springs,
        anchors: &[f64],
        after: usize,
        before: usize,
    ) -> f64 {
        if after >= before {
            return 0.0;
        }
        let leaving = springs.range(after, before);
        let work = |((&h, &length), &anchor): ((&f64, &f64), &f64)| {
            let contact = (self.from.d - h) / (self.from.d - self.to.d);
            let way = self.from.u + (self.to.u - self.from.u) * contact - anchor;
            let part = way.abs() * if way > 0.0 { self.forward } else { self.backward };
            let part = if part < contact { part } else { contact };
            length * way.abs() * (-0.5 * self.growth * part)
        };
        leaving.heights.iter().zip(leaving.lengths).zip(&anchors[after..before]).map(work).sum()
    }
}
