//! One spring along a straight chord of the (d, u) plane.
//!
//! Limit and trial stretch of a spring are both linear along the chord, so it sticks first and then slips in
//! one direction to the end, or sticks throughout: the end follows from clamping, and the friction work from
//! the anchor's way and the limit at its two ends.
//!
//! So a row is exact along a chord of any length, as the curve is; what it errs by is the size of its cells.

use super::Springs;
use super::lanes::clamp;
use crate::Apex;

/// A chord with what all its springs share.
pub(super) struct Chord {
    /// Where it starts.
    pub(super) from: Apex,
    /// Where it ends.
    pub(super) to: Apex,
    /// κ.
    slope: f64,
    /// Growth κΔd of the limit along the chord.
    growth: f64,
    /// 1/(Δu-κΔd), part of the chord per way of an anchor that slips forward; 0 if none can.
    forward: f64,
    /// 1/|Δu+κΔd|, the same for one that slips backward.
    backward: f64,
}

/// What a chord does to one spring.
#[derive(Clone, Copy)]
pub(super) struct Slide {
    /// Its anchor at the end, m.
    pub(super) anchor: f64,
    /// Its stretch at the end, m.
    pub(super) stretch: f64,
    /// Friction work over G\* and the spring's length, m².
    pub(super) work: f64,
}

impl Chord {
    /// The chord between two apexes for springs with the slope κ of the stick limit.
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

    /// Limit κ(d-h) at the end.
    #[inline]
    pub(super) fn limit(&self, h: f64) -> f64 {
        self.slope * (self.to.d - h)
    }

    /// Stretch at the end, per depth d-h below it, of a spring that first touched along the chord.
    pub(super) fn fresh_stretch_per_rise(&self) -> f64 {
        clamp((self.to.u - self.from.u) / (self.to.d - self.from.d), self.slope)
    }

    /// u at the moment when a spring first touches, which is where it is anchored.
    // Not u at the end of the chord, which would leave all springs of a step unstretched: a loss of order one in the steps of
    // a growing contact.
    #[inline]
    pub(super) fn touching_anchor(&self, h: f64) -> f64 {
        self.to.u - (self.to.u - self.from.u) * ((self.to.d - h) / (self.to.d - self.from.d))
    }

    /// A spring that touches at the end, from the anchor it had or touched with.
    ///
    /// Slipping forward its anchor moves by D = (Δu-κΔd)·(part of the chord it slips), so its limit has the
    /// mean L - ½κΔd·part over the slip, L at the end. That holds for a spring that has just touched as well.
    #[inline(always)]
    pub(super) fn slide(&self, h: f64, anchor: f64) -> Slide {
        let (u, limit) = (self.to.u, self.limit(h));
        let trial = u - anchor;
        let edge = u - limit.copysign(trial);
        // u - edge must not come out below the limit: the spring would seem to stick. Rounding takes half of all slipping
        // springs there, and an ulp of the edge brings every one of them back (ten million drawn at random).
        let ulp = (edge.abs() * f64::EPSILON).copysign(trial);
        let edge = if (u - edge).abs() < limit { edge - ulp } else { edge };
        let moved = if trial.abs() > limit { edge } else { anchor };
        let way = (moved - anchor).abs();
        let part = way * if trial > 0.0 { self.forward } else { self.backward };
        let part = if part < 1.0 { part } else { 1.0 };
        Slide { anchor: moved, stretch: clamp(trial, limit), work: way * (limit - 0.5 * self.growth * part) }
    }

    /// Friction work over G\* of the springs `after..before`, which leave contact along the chord: they stick,
    /// then slip until their limit is 0.
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
