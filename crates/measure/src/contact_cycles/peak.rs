//! Extremes between the moments of a contact.
//!
//! Between two events values are smooth, and a polynomial through a few moments has their extreme. Next to an event they are not: as gross
//! slip comes near, the part of the springs that still holds ends at a place that goes straight to the centre, and of a paraboloid
//! the force is short of its limit by the power 3/2 of the time that is left. So polynomials there are in the root of it, without a term of
//! the first order.

use super::{ROUNDING, Track};
use crate::series::extent;
use std::ops::Range;

/// Moments nearer than this share of their mean distance are one.
const NEAR: f64 = 0.01;
/// How far from an event the next moment may be for a limit there, in mean distances of those after it.
const FAR: f64 = 1.5;
/// By how much of the range of values a limit may depend on the last of the moments that tell it: more does where a fast motion follows
/// an event, such as what is left of damping where a contact begins to slide. Of a damped ball that is shaken by 200 µm the peak was 6.5 %
/// above the limit of friction.
const CREDIBLE: f64 = 1e-3;
/// Neighbours on either side.
const SIDE: usize = 2;
/// Halvings of the time between neighbours: values there differ by the square of what is left.
const HALVINGS: u32 = 32;

impl Track {
    /// Least and largest value over a cycle: where an extreme is no event, those of the polynomial through the moment and its
    /// neighbours, up to four and none beyond an event: of the sixth order in the time between them. A cycle that comes back goes on where it
    /// began. Where values may jump at events, one next to an event is an extreme as it is.
    /// There the limits on both sides are values, too.
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

    /// What values come to on both sides of an event, by the polynomials through the moments before and after it; none where there are
    /// too few, none so near that these tell it, or where one of them less tells another limit, by a share of the `range`.
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

    /// The extreme of the polynomial about the moment at which `extreme` is met; the extreme itself where there is none.
    fn vertex(
        &self,
        (first, last): (usize, usize),
        (values, range, is_continuous): (&[f64], f64, bool),
        extreme: f64,
    ) -> f64 {
        let Some(i) = (first..=last).find(|i| values[*i] == extreme) else { return extreme };
        // Only moments of a motion without bends are on one polynomial.
        if self.bends[i] {
            return extreme;
        }
        // A cycle that comes back goes on where it began, to the last digits; others end there.
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
                // As many on either side as there are, and more on one where there are too few on the other.
                let few = |own: usize, other: usize| own.min((2 * SIDE).saturating_sub(other.min(SIDE)));
                let (left, right) = (few(back.len(), on.len()), few(on.len(), back.len()));
                let left = back[..left].iter().map(of).map(|(way, value)| (-way, value));
                let points = [(0.0, 0.0)].into_iter().chain(left).chain(on[..right].iter().map(of));
                Polynomial::through(points).extreme([-gone, *to_go])
            }
        };
        extreme + rise.unwrap_or(0.0)
    }

    /// The moments next to moment `i` on one side, and how far they are, s: none so near another that their difference is rounding, and
    /// none beyond a bend.
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

/// The extreme of the polynomial in the root of the time to an event by a moment, and those away from the event and towards it, which is the
/// last of these: how far they are, s, and by how much values are larger there.
fn by_roots(
    away: impl Iterator<Item = (f64, f64)> + Clone,
    towards: impl DoubleEndedIterator<Item = (f64, f64)> + Clone,
) -> Option<f64> {
    let ((before, _), (after, _), (event, there)) =
        (away.clone().next()?, towards.clone().next()?, towards.clone().next_back()?);
    let towards = towards.rev().skip(1).map(|(way, value)| (event - way, value));
    let away = away.map(|(way, value)| (event + way, value));
    let moments = towards.chain([(event, 0.0)]).chain(away).take(2 * SIDE);
    // Twice, and flat there.
    let points = [(0.0, there); 2].into_iter().chain(moments.map(|(way, value)| (way.sqrt(), value)));
    let nearest = (event - after).max(NEAR * NEAR * event);
    Polynomial::through(points).extreme([nearest.sqrt(), (event + before).sqrt()])
}

/// Newton's form of a polynomial.
struct Polynomial {
    places: Vec<f64>,
    differences: Vec<f64>,
}

impl Polynomial {
    /// Through points; flat where two in a row are one.
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

    /// Its value and its slope.
    fn at(&self, x: f64) -> [f64; 2] {
        let terms = self.places.iter().zip(&self.differences).rev();
        terms.fold([0.0; 2], |[value, slope], (place, difference)| {
            [difference + (x - place) * value, value + (x - place) * slope]
        })
    }

    /// Its value where its slope changes its sign between two places; none where it has the same at both.
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

    /// A sine of 64 moments has peaks of ±1: the moments miss them by up to h²/8, quartics by |x(x²-h²)(x²-4h²)|/5! of the fifth derivative,
    /// which is below 2.5 h so near to a peak, |x| ≤ h/2, h = 2π/64.
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

    /// 1 - s - (s_e - s)^{3/2} towards an event at s_e: least where (s_e - s)^{1/2} = 2/3.
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

    /// A force that rises by t³ up to a corner and jumps to nothing there: the limit before it, which no moment meets.
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

    /// An event is where something bends: its own value is the extreme.
    #[test]
    fn an_extreme_that_is_an_event_stays() {
        let bent = track(64, 1.0, true);
        assert_eq!(bent.peaks(&(0..64), &bent.force, true), extent(&bent.force));
        // Up straight, and at an event down at once: no parabola goes above what it comes to there.
        let mut jumping = Track::default();
        for (t, force, bends) in [(0.0, 0.0, false), (0.5, 0.5, false), (1.0, 1.0, false), (1.5, -9.0, true)]
        {
            jumping.push(t, Moment { u: t, d: 0.0, force, normal: 0.0, friction: 0.0, damping: 0.0, bends });
        }
        assert_eq!(jumping.peaks(&(0..3), &jumping.force, false).1, 1.5);
    }
}
