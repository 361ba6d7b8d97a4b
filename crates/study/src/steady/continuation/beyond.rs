//! Beyond a place where a branch does not go on by steps, however short: what the drive comes to there by itself.

use super::arm::{End, Walk};
use super::corrector::ROUNDING;
use super::error::Trouble;
use super::happened::{Period, stretch};
use super::standing::{Standing, by_value};
use crate::grip::{Grip, Loose};
use crate::steady::{Options, SteadyError, moment, named};
use nalgebra::DVector;
use stickslip_drive::scene::Axis;

/// How far beyond its end a branch is looked for again, as a share of the range, the nearest first.
const BEYOND: [f64; 5] = [1e-8, 1e-6, 1e-5, 1e-4, 1e-3];
/// By how much bodies may be faster or slower there, as a share of their largest speed, at some moments of the period.
const ALIKE: f64 = 1e-2;
const MOMENTS: u32 = 8;
/// Most periods of one search.
const SEARCH: u32 = 500;
/// How far beyond a body is let slide, and for how many periods at most.
const AWAY: [f64; 3] = [1e-6, 1e-4, 1e-3];
const SLIDES: u32 = 64;
/// Each of its steps is longer by more than this share than the one before.
const FASTER: f64 = 1e-9;
/// What rounding leaves of a period is as much as a defect may be that counts as none, but for the few steps that add it up.
const ROUNDED: f64 = 0.1 * ROUNDING;
const AXES: [Axis; 3] = [Axis::X, Axis::Z, Axis::Pitch];

impl Walk<'_> {
    /// Looks for the branch beyond a place where it does not go on by steps, however short.
    pub(super) fn beyond(&mut self, here: &Standing, trouble: &Trouble) -> Result<Standing, End> {
        if let Trouble::Refused(why) = trouble {
            return Err(End::Refused(why.clone()));
        }
        let mut nearest = None;
        for away in BEYOND {
            match self.anew(here, away) {
                Ok(next) => return Ok(next),
                Err(End::Lost(why)) => nearest = nearest.or(Some(why)),
                Err(end) => return Err(end),
            }
        }
        if self.slides_away(here) {
            return Err(self.sliding());
        }
        if let Some(lengths) = self.lengths(here).filter(|lengths| lengths * f64::EPSILON > ROUNDED) {
            return Err(End::Rounded(lengths));
        }
        Err(End::Lost(format!("{trouble}; beyond, {}", nearest.unwrap_or_default())))
    }

    /// How many natural lengths a period of a motion leads.
    fn lengths(&self, of: &Standing) -> Option<f64> {
        let map = self.bench.map_at(&of.place).ok()?;
        Some(map.reach(&of.place.fixed.image))
    }

    /// The motion that the drive comes to by itself, so far beyond, if it is one that the branch goes on with.
    fn anew(&mut self, here: &Standing, away: f64) -> Result<Standing, End> {
        let sense = here.pace().signum();
        let value = self.within(here, away).ok_or_else(|| End::Lost("the range ends".to_owned()))?;
        let lost = |why: &dyn std::fmt::Display| End::Lost(why.to_string());
        let other = |trouble: Trouble| match trouble {
            Trouble::Steady(SteadyError::Shakedown { contacts, .. }) => End::Shakedown(contacts),
            Trouble::Refused(why) => End::Refused(why),
            trouble if trouble.is_final() => End::Interrupted,
            trouble => lost(&trouble),
        };
        let options = Options { periods: SEARCH, ..self.bench.options };
        let place = self.bench.variant(value).and_then(|variant| self.bench.found(&variant, &options));
        let place = place.map_err(other)?;
        let mut map = self.bench.map_at(&place).map_err(other)?;
        let (still, _) = moment::twice(&mut map, &place.fixed, None).map_err(|error| other(error.into()))?;
        drop(map);
        let period = Period::of(self.bench, &place).map_err(other)?;
        if !still.is_empty() {
            // What is held for ever neither fades nor grows.
            self.event(here.pace(), here, (value, &period.happened, true));
            return Err(End::Shakedown(named(&place.variant.drive.model, &still)));
        }
        let row = by_value(place.fixed.defect.len(), sense);
        let next = Standing::of(self.bench, place, period, (Some(self.measure), &row));
        let mut next = next.map_err(other)?;
        if next.is_loose {
            return Err(self.sliding());
        }
        next.point.piece = here.point.piece + 1;
        if !self.is_alike(here, &next).map_err(other)? {
            return Err(lost(&"the drive converges to another motion"));
        }
        self.event(here.pace(), here, (value, &next.happened, next.point.is_stable()));
        self.keep(&next);
        Ok(next)
    }

    /// The value so far beyond, if that is in the range.
    fn within(&self, here: &Standing, away: f64) -> Option<f64> {
        let value = here.point.value + here.pace().signum() * away * self.bench.span;
        (self.range[0]..=self.range[1]).contains(&value).then_some(value)
    }

    /// Whether a little beyond the figures' body slides all through, faster from period to period.
    fn slides_away(&self, here: &Standing) -> bool {
        let beyond = AWAY.iter().filter_map(|away| self.within(here, *away));
        beyond.map(|value| self.slides(here, value)).any(|slides| matches!(slides, Ok(true)))
    }

    /// The same at a value, from a motion on.
    fn slides(&self, here: &Standing, value: f64) -> Result<bool, Trouble> {
        let variant = self.bench.variant(value)?;
        let Some(body) = variant.job.scenario.figures.body else { return Ok(false) };
        let still = DVector::zeros(here.count());
        let mut state =
            self.bench.elsewhere((&here.place.fixed.state, &here.place.variant), &variant, &still)?;
        let (mut map, mut grip) = (self.bench.map(&variant), Grip::new(&variant.job, body));
        let mut before: Option<f64> = None;
        for _ in 0..SLIDES {
            let (next, _, loose) = stretch(&mut map, state.clone(), variant.drive.period, Some(&mut grip))?;
            let places = [&state, &next].map(|state| state.coordinate(map.model(), body, Axis::X));
            let [Some((from, _)), Some((to, _))] = places else { return Ok(false) };
            let step = to - from;
            if loose == Some(Loose::Slides) {
                if before.is_some_and(|before| step.abs() > (1.0 + FASTER) * before.abs()) {
                    return Ok(true);
                }
                before = Some(step);
            }
            state = next;
        }
        Ok(false)
    }

    /// Whether all bodies move alike through the period, at most little faster or slower.
    fn is_alike(&self, here: &Standing, next: &Standing) -> Result<bool, Trouble> {
        let [one, other] = [self.speeds(here)?, self.speeds(next)?];
        let mut pairs = one.into_iter().zip(other);
        Ok(pairs.all(|(one, other)| {
            let most = one.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
            one.iter().zip(&other).all(|(one, other)| (one - other).abs() <= ALIKE * most)
        }))
    }

    /// Speed of every body along x, z and pitch at some moments of the period, m/s or rad/s.
    fn speeds(&self, of: &Standing) -> Result<Vec<Vec<f64>>, Trouble> {
        let mut map = self.bench.map_at(&of.place)?;
        let (model, period, mut state) = (map.model(), map.period(), of.place.fixed.state.clone());
        let bodies = of.place.variant.job.scenario.scene.bodies.len();
        let first = (state.time() / period).ceil();
        let mut speeds = vec![Vec::new(); bodies * AXES.len()];
        for moment in 0..MOMENTS {
            let time = (first + f64::from(moment) / f64::from(MOMENTS)) * period;
            state = map.lead(state, time, &mut ())?;
            for body in 0..bodies {
                for (k, axis) in AXES.into_iter().enumerate() {
                    let speed = state.coordinate(model, body, axis).map_or(0.0, |(_, speed)| speed);
                    speeds[body * AXES.len() + k].push(speed);
                }
            }
        }
        Ok(speeds)
    }
}
