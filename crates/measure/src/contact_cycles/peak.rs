//! Extremes of quantities between the samples of a contact.
//!
//! Between two events the quantities are smooth, and a polynomial through a few samples gives their extreme. Near an event they are not
//! smooth: as gross slip approaches, the edge of the stick area moves linearly to the centre. For a paraboloid, the force differs from its
//! limit by the power 3/2 of the remaining time. Therefore these polynomials are in the square root of this time, without a linear term.

use super::{ROUNDING, Track};
use crate::series::extent;
use std::ops::Range;

/// Samples whose distance in time is below this fraction of the mean distance count as one sample.
const NEAR: f64 = 0.01;
/// Maximum distance of the nearest sample from an event for an extrapolation to the event, in mean distances.
const FAR: f64 = 1.5;
/// Maximum influence of the last sample on the extrapolated value, relative to the range of values.
///
/// A fast transient after the event, such as the decay of damping forces at the onset of slip, has a larger influence. The extrapolation is
/// then rejected.
const CREDIBLE: f64 = 1e-3;
/// Number of neighbouring samples on each side of a polynomial.
const SIDE: usize = 2;
/// Number of bisections that locate an extreme. The error of its value is quadratic in the remaining interval.
const HALVINGS: u32 = 32;

impl Track {
    /// Returns the minimum and maximum of `values` over a cycle.
    ///
    /// Unless the extreme is an event, it is that of a polynomial through the sample and up to four neighbours, none of them beyond an
    /// event. The error is of sixth order in the sampling interval. A closed cycle is continued periodically. If values may jump at events,
    /// polynomials exclude samples at events, and the limits on both sides of events are included.
    pub(super) fn peaks(&self, span: &Range<usize>, values: &[f64], is_continuous: bool) -> (f64, f64) {
        let (low, high) = extent(&values[span.start..=span.end]);
        let of = (values, high - low, is_continuous);
        let vertex = |extreme: f64| self.vertex((span.start, span.end), of, extreme);
        let met = (vertex(low), vertex(high));
        if is_continuous {
            return met;
        }
        let events = (span.start..=span.end).filter(|i| self.bends[*i]);
        let limits = events.flat_map(|event| self.limits(span, (values, high - low), event));
        limits.fold(met, |(low, high), limit| (low.min(limit), high.max(limit)))
    }

    /// Returns the limits of `values` on both sides of an event, by extrapolating polynomials.
    ///
    /// A limit is omitted if the samples are too few or too far away, or if it depends too much on the last sample. `range` is
    /// the range of the values.
    fn limits(
        &self,
        span: &Range<usize>,
        (values, range): (&[f64], f64),
        event: usize,
    ) -> impl Iterator<Item = f64> {
        let ends = (span.start, span.end);
        let before = self.side(ends, event, false, |j| (j > span.start).then(|| j - 1));
        let after = self.side(ends, event, false, |j| (j < span.end).then_some(j + 1));
        [before, after].into_iter().filter_map(move |side| {
            let [(_, gone), .., (_, all)] = side[..] else { return None };
            let is_near = gone * (side.len() - 1) as f64 <= FAR * (all - gone);
            let points = || side.iter().map(|(j, way)| (*way, values[*j]));
            let limit = Polynomial::through(points()).at(0.0)[0];
            let fewer = Polynomial::through(points().take(side.len() - 1)).at(0.0)[0];
            (is_near && (limit - fewer).abs() <= CREDIBLE * range).then_some(limit)
        })
    }

    /// Returns the extreme of a polynomial near the sample with the value `extreme`, or `extreme` itself if there is no such polynomial.
    fn vertex(
        &self,
        (first, last): (usize, usize),
        (values, range, is_continuous): (&[f64], f64, bool),
        extreme: f64,
    ) -> f64 {
        let Some(i) = (first..=last).find(|i| values[*i] == extreme) else { return extreme };
        // A polynomial is valid only for samples between two events.
        if self.bends[i] {
            return extreme;
        }
        // After its end, a closed cycle continues at its start. An open cycle has no neighbours there.
        let apart = (values[last] - values[first]).abs();
        if (i == first || i == last) && apart > ROUNDING * range {
            return extreme;
        }
        let before = |j: usize| Some(if j > first { j - 1 } else { last - 1 });
        let after = |j: usize| Some(if j < last { j + 1 } else { first + 1 });
        let back = self.side((first, last), i, is_continuous, before);
        let on = self.side((first, last), i, is_continuous, after);
        let (Some((_, gone)), Some((_, to_go))) = (back.first(), on.first()) else { return extreme };
        let of = |(j, way): &(usize, f64)| (*way, values[*j] - extreme);
        let bend =
            |side: &[(usize, f64)]| side.len() <= SIDE && side.last().is_some_and(|(j, _)| self.bends[*j]);
        let rise = match (bend(&back), bend(&on)) {
            (false, true) => by_roots(back.iter().map(of), on.iter().map(of)),
            (true, false) => by_roots(on.iter().map(of), back.iter().map(of)),
            _ => {
                // Use equal numbers of neighbours on both sides, and more on one side if there are too few on the other.
                let few = |own: usize, other: usize| own.min((2 * SIDE).saturating_sub(other.min(SIDE)));
                let (left, right) = (few(back.len(), on.len()), few(on.len(), back.len()));
                let left = back[..left].iter().map(of).map(|(way, value)| (-way, value));
                let points = [(0.0, 0.0)].into_iter().chain(left).chain(on[..right].iter().map(of));
                Polynomial::through(points).extreme([-gone, *to_go])
            }
        };
        extreme + rise.unwrap_or(0.0)
    }

    /// Returns the indices of the neighbours of sample `i` on one side, with their distances in time, s.
    ///
    /// Of neighbours that are very close to each other, only one is used. The search ends at an event.
    fn side(
        &self,
        (first, last): (usize, usize),
        i: usize,
        is_continuous: bool,
        next: impl Fn(usize) -> Option<usize>,
    ) -> Vec<(usize, f64)> {
        let period = self.t[last] - self.t[first];
        let least = NEAR * period / (last - first) as f64;
        let (mut found, mut j, mut way, mut told) = (Vec::with_capacity(2 * SIDE), i, 0.0, 0.0);
        for _ in first..last {
            let Some(after) = next(j) else { break };
            let gone = (self.t[after] - self.t[j]).abs();
            j = after;
            way += gone.min((period - gone).abs());
            let is_end = self.bends[j];
            if way - told >= least && (is_continuous || !is_end) {
                found.push((j, way));
                told = way;
            }
            if is_end || found.len() == 2 * SIDE {
                break;
            }
        }
        found
    }
}

/// Returns the extreme of a polynomial in the square root of the time to an event, relative to the value at the sample.
///
/// `away` contains the samples on the side without the event, `towards` the samples up to the event. Each sample is given by its distance,
/// s, and its value relative to that of the central sample.
fn by_roots(
    away: impl Iterator<Item = (f64, f64)> + Clone,
    towards: impl DoubleEndedIterator<Item = (f64, f64)> + Clone,
) -> Option<f64> {
    let ((before, _), (after, _), (event, there)) =
        (away.clone().next()?, towards.clone().next()?, towards.clone().next_back()?);
    let towards = towards.rev().skip(1).map(|(way, value)| (event - way, value));
    let away = away.map(|(way, value)| (event + way, value));
    let moments = towards.chain([(event, 0.0)]).chain(away).take(2 * SIDE);
    // The event is used as two equal points, so that the polynomial has slope 0 there.
    let points = [(0.0, there); 2].into_iter().chain(moments.map(|(way, value)| (way.sqrt(), value)));
    let nearest = (event - after).max(NEAR * NEAR * event);
    Polynomial::through(points).extreme([nearest.sqrt(), (event + before).sqrt()])
}

/// Interpolating polynomial in Newton's form.
struct Polynomial {
    places: Vec<f64>,
    differences: Vec<f64>,
}

impl Polynomial {
    /// Returns the polynomial through the points. Two equal consecutive points give slope 0 there.
    fn through(points: impl Iterator<Item = (f64, f64)>) -> Self {
        let (places, mut differences): (Vec<f64>, Vec<f64>) = points.unzip();
        for order in 1..places.len() {
            for k in (order..places.len()).rev() {
                let apart = places[k] - places[k - order];
                differences[k] =
                    if apart == 0.0 { 0.0 } else { (differences[k] - differences[k - 1]) / apart };
            }
        }
        Self { places, differences }
    }

    /// Returns the value and the slope at x.
    fn at(&self, x: f64) -> [f64; 2] {
        let terms = self.places.iter().zip(&self.differences).rev();
        terms.fold([0.0; 2], |[value, slope], (place, difference)| {
            [difference + (x - place) * value, value + (x - place) * slope]
        })
    }

    /// Returns the value where the slope changes sign within an interval. Returns `None` if the slopes at both ends have equal signs.
    fn extreme(&self, [mut low, mut high]: [f64; 2]) -> Option<f64> {
        let slope = |x: f64| self.at(x)[1];
        let rises = slope(low) > 0.0;
        if rises == (slope(high) > 0.0) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if (slope(middle) > 0.0) == rises { low = middle } else { high = middle }
        }
        Some(self.at(low)[0]).filter(|value| value.is_finite())
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

    /// A sine with 64 samples per period has the peaks ±1. The samples miss them by up to h²/8 with h = 2π/64.
    ///
    /// Quartic interpolation has the error |x(x²-h²)(x²-4h²)|/5! times the fifth derivative, which is below 2.5 h for |x| ≤ h/2.
    #[test]
    fn peaks_of_a_sine_are_those_of_the_sine() {
        let h: f64 = std::f64::consts::TAU / 64.0;
        let mut worst: [f64; 2] = [0.0; 2];
        for k in 0..10 {
            let track = track(64, 0.1 * h * f64::from(k) + 1.0, false);
            let missed = |(low, high): (f64, f64)| (low + 1.0).abs().max((high - 1.0).abs());
            worst[0] = worst[0].max(missed(extent(&track.force)));
            worst[1] = worst[1].max(missed(track.peaks(&(0..64), &track.force, true)));
        }
        assert!(worst[0] > 1e-3 && worst[1] < 1.42 * 2.5 * h.powi(6) / 120.0, "{worst:?}");
    }

    /// The function 1 - s - (s_e - s)^{3/2} before an event at s_e. Its minimum is at (s_e - s)^{1/2} = 2/3.
    #[test]
    fn an_extreme_just_before_gross_slip_is_met() {
        let (event, h) = (0.5, 0.1);
        for shift in 0..9 {
            let mut track = Track::default();
            let last = event + 4.0 / 9.0 - 0.1 * h * f64::from(shift);
            let value = |s: f64| 1.0 - s - 2.0 * (event - s).max(0.0).powf(1.5);
            let moments = (0..20).map(|k| (last - h * f64::from(20 - k), false));
            for (t, bends) in moments.filter(|(t, _)| *t < event).chain([(event, true), (event + h, false)]) {
                let force = value(t);
                track
                    .push(t, Moment { u: t, d: 0.0, force, normal: 0.0, friction: 0.0, damping: 0.0, bends });
            }
            let most = track.peaks(&(0..track.t.len() - 1), &track.force, true).1;
            let exact = value(event - 1.0 / 9.0);
            assert!((most - exact).abs() < 1e-12, "{shift} {most} {exact}");
        }
    }

    /// A force that increases by t³ up to a corner and jumps down there. No sample has its limit before the jump.
    #[test]
    fn a_peak_just_before_a_jump_is_met() {
        let mut track = Track::default();
        for k in 0..=40 {
            let (t, bends) = (0.025 * f64::from(k), k == 20);
            let force = if t < 0.5 { t * t * t } else { -0.1 * (1.0 - t) };
            track.push(t, Moment { u: t, d: 0.0, force, normal: 0.0, friction: 0.0, damping: 0.0, bends });
        }
        let (low, high) = track.peaks(&(0..40), &track.force, false);
        assert!((high - 0.125).abs() < 1e-14 && (low + 0.05).abs() < 1e-14, "{low} {high}");
        assert!((track.peaks(&(0..40), &track.force, true).1 - 0.125).abs() > 1e-3);
    }

    /// An event is a kink: its own value is the extreme.
    #[test]
    fn an_extreme_that_is_an_event_stays() {
        let bent = track(64, 1.0, true);
        assert_eq!(bent.peaks(&(0..64), &bent.force, true), extent(&bent.force));
        // Linear up to an event and a jump down there: no parabola exceeds the value before the jump.
        let mut jumping = Track::default();
        for (t, force, bends) in [(0.0, 0.0, false), (0.5, 0.5, false), (1.0, 1.0, false), (1.5, -9.0, true)]
        {
            jumping.push(t, Moment { u: t, d: 0.0, force, normal: 0.0, friction: 0.0, damping: 0.0, bends });
        }
        assert_eq!(jumping.peaks(&(0..3), &jumping.force, false).1, 1.5);
    }
}
