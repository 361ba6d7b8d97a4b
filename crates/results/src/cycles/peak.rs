//! Extremes between the moments of a contact.

use super::{ROUNDING, Track, range};
use std::ops::Range;

/// Moments nearer than this share of their mean distance are one.
const NEAR: f64 = 0.01;

impl Track {
    /// Least and largest value over a cycle: where an extreme is no event, those of the parabola through the moment and its
    /// neighbours, whose error is of the fourth order in the time between them. A cycle that comes back goes on where it began. Where
    /// values may jump at events, one next to an event is an extreme as it is.
    pub(super) fn peaks(&self, span: &Range<usize>, values: &[f64], is_continuous: bool) -> (f64, f64) {
        let (low, high) = range(&values[span.start..=span.end]);
        let of = (values, high - low, is_continuous);
        let vertex = |extreme: f64| self.vertex((span.start, span.end), of, extreme);
        (vertex(low), vertex(high))
    }

    /// The extreme of the parabola about the moment at which `extreme` is met; the extreme itself where there is none.
    fn vertex(
        &self,
        (first, last): (usize, usize),
        (values, range, is_continuous): (&[f64], f64, bool),
        extreme: f64,
    ) -> f64 {
        let Some(i) = (first..=last).find(|i| values[*i] == extreme) else { return extreme };
        // Only moments of a motion without bends are on one parabola.
        if self.bends[i] {
            return extreme;
        }
        let (Some((before, back)), Some((after, on))) = (
            self.neighbour((first, last), i, |j| if j > first { j - 1 } else { last - 1 }),
            self.neighbour((first, last), i, |j| if j < last { j + 1 } else { first + 1 }),
        ) else {
            return extreme;
        };
        if !is_continuous && (self.bends[before] || self.bends[after]) {
            return extreme;
        }
        // A cycle that comes back goes on where it began, to the last digits; others end there.
        let apart = (values[last] - values[first]).abs();
        if (i == first || i == last) && apart > ROUNDING * range {
            return extreme;
        }
        let [down, up] = [(extreme - values[before]) / back, (values[after] - extreme) / on];
        let (slope, bend) = ((down * on + up * back) / (back + on), (up - down) / (back + on));
        // Where both neighbours are as high nothing bends.
        let rise = 0.25 * slope * slope / bend;
        if rise.is_finite() { extreme - rise } else { extreme }
    }

    /// The moment next to moment `i` on one side, and how far it is, s: not one so near that its difference is rounding, and none
    /// beyond a bend.
    fn neighbour(
        &self,
        (first, last): (usize, usize),
        i: usize,
        next: impl Fn(usize) -> usize,
    ) -> Option<(usize, f64)> {
        let period = self.t[last] - self.t[first];
        let least = NEAR * period / (last - first) as f64;
        let mut j = next(i);
        for _ in first..last {
            let way = (self.t[j] - self.t[i]).abs();
            let way = way.min((period - way).abs());
            if way >= least {
                return Some((j, way));
            }
            if self.bends[j] {
                return None;
            }
            j = next(j);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::Moment;
    use super::*;

    fn track(n: u32, phase: f64, bends: bool) -> Track {
        let mut track = Track::default();
        for k in 0..=n {
            let t = f64::from(k) / f64::from(n);
            let force = (std::f64::consts::TAU * t + phase).sin();
            let moment = Moment { u: t, d: 0.0, force, normal: 0.0, friction: 0.0, damping: 0.0, bends };
            track.push(t, moment);
        }
        track
    }

    /// A sine of 64 moments has peaks of ±1: the moments miss them by up to h²/8, the parabolas by h⁴/24 at most, h = 2π/64.
    #[test]
    fn peaks_of_a_sine_are_those_of_the_sine() {
        let h: f64 = std::f64::consts::TAU / 64.0;
        let mut worst: [f64; 2] = [0.0; 2];
        for k in 0..10 {
            let track = track(64, 0.1 * h * f64::from(k) + 1.0, false);
            let missed = |(low, high): (f64, f64)| (low + 1.0).abs().max((high - 1.0).abs());
            worst[0] = worst[0].max(missed(range(&track.force)));
            worst[1] = worst[1].max(missed(track.peaks(&(0..64), &track.force, true)));
        }
        assert!(worst[0] > 1e-3 && worst[1] < h.powi(4) / 24.0, "{worst:?}");
    }

    /// An event is where something bends: its own value is the extreme.
    #[test]
    fn an_extreme_that_is_an_event_stays() {
        let bent = track(64, 1.0, true);
        assert_eq!(bent.peaks(&(0..64), &bent.force, true), range(&bent.force));
        // Up straight to 1, and at an event down at once: no parabola goes above.
        let mut jumping = Track::default();
        for (t, force, bends) in [(0.0, 0.0, false), (0.5, 0.5, false), (1.0, 1.0, false), (1.5, -9.0, true)]
        {
            jumping.push(t, Moment { u: t, d: 0.0, force, normal: 0.0, friction: 0.0, damping: 0.0, bends });
        }
        assert_eq!(jumping.peaks(&(0..3), &jumping.force, false).1, 1.0);
    }
}
