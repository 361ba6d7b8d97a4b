//! Search for the branch beyond a point where even the shortest step fails, by simulation at a parameter value slightly beyond.

use super::arm::{End, Walk};
use super::corrector::ROUNDING;
use super::error::Trouble;
use super::happened::{Period, stretch};
use super::standing::{Standing, by_value};
use crate::grip::{Grip, Loose};
use crate::steady::{Options, SteadyError, moment, named};
use nalgebra::DVector;
use stickslip_drive::scene::Axis;

/// Distances from the last orbit at which the branch is searched for, as fractions of the parameter range.
const BEYOND: [f64; 5] = [1e-8, 1e-6, 1e-5, 1e-4, 1e-3];
/// Largest difference of velocities at which two orbits belong to the same branch, relative to the largest velocity of the body. `MOMENTS`
/// is the number of instants at which velocities are compared.
const ALIKE: f64 = 1e-2;
const MOMENTS: u32 = 8;
/// Maximum number of periods of one search.
const SEARCH: u32 = 500;
/// Distances from the last orbit at which sliding is examined, as fractions of the parameter range, and maximum number of periods.
const AWAY: [f64; 3] = [1e-6, 1e-4, 1e-3];
const SLIDES: u32 = 64;
/// Smallest relative increase of the displacement per period that counts as acceleration.
const FASTER: f64 = 1e-9;
/// Rounding error of a period above which the branch ends, as a part of the defect that is accepted as zero.
const ROUNDED: f64 = 0.1 * ROUNDING;
const AXES: [Axis; 3] = [Axis::X, Axis::Z, Axis::Pitch];

impl Walk<'_> {
    /// Searches for the branch beyond a point where even the shortest step fails.
    ///
    /// # Errors
    /// Returns the reason for the end of the branch.
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

    /// Returns the largest displacement per period of an orbit, in natural scales.
    fn lengths(&self, of: &Standing) -> Option<f64> {
        let map = self.bench.map_at(&of.place).ok()?;
        Some(map.reach(&of.place.fixed.image))
    }

    /// Finds the orbit to which the drive converges at a distance beyond the last orbit, if the found orbit continues the branch.
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
            // A disturbance of a permanently stuck region neither grows nor decays, so the orbit counts as stable.
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
            return Err(lost(&"the drive converges to another orbit"));
        }
        self.event(here.pace(), here, (value, &next.happened, next.point.is_stable()));
        self.keep(&next);
        Ok(next)
    }

    /// Returns the parameter value at a distance beyond an orbit, if this value is within the range.
    fn within(&self, here: &Standing, away: f64) -> Option<f64> {
        let value = here.point.value + here.pace().signum() * away * self.bench.span;
        (self.range[0]..=self.range[1]).contains(&value).then_some(value)
    }

    /// Returns whether the body named in `figures` slides and accelerates at a parameter value slightly beyond an orbit.
    fn slides_away(&self, here: &Standing) -> bool {
        let beyond = AWAY.iter().filter_map(|away| self.within(here, *away));
        beyond.map(|value| self.slides(here, value)).any(|slides| matches!(slides, Ok(true)))
    }

    /// Returns whether the body named in `figures` slides and accelerates at a parameter value, starting from an orbit.
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

    /// Returns whether all bodies have nearly the same velocities in two orbits during the period.
    fn is_alike(&self, here: &Standing, next: &Standing) -> Result<bool, Trouble> {
        let [one, other] = [self.speeds(here)?, self.speeds(next)?];
        let mut pairs = one.into_iter().zip(other);
        Ok(pairs.all(|(one, other)| {
            let most = one.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
            one.iter().zip(&other).all(|(one, other)| (one - other).abs() <= ALIKE * most)
        }))
    }

    /// Returns the velocities of every body along x, z and pitch at some instants of the period, m/s or rad/s.
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
