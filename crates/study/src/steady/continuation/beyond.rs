//! Beyond a place where a branch does not go on by steps, however short: what the drive comes to there by itself.

use super::arm::{End, Walk};
use super::error::Trouble;
use super::happened::Period;
use super::standing::{Standing, by_value};
use crate::steady::{SteadyError, moment};
use stickslip_drive::scene::Axis;

/// How far beyond its end a branch is looked for again, as a share of the range, and by how much bodies may be faster or slower there, as a
/// share of their largest speed, at some moments of the period.
const BEYOND: f64 = 1e-8;
const ALIKE: f64 = 1e-2;
const MOMENTS: u32 = 8;
const AXES: [Axis; 3] = [Axis::X, Axis::Z, Axis::Pitch];

impl Walk<'_> {
    /// Looks for the branch beyond a place where it does not go on by steps, however short.
    pub(super) fn beyond(&mut self, here: &Standing, trouble: &Trouble) -> Result<Standing, End> {
        if let Trouble::Refused(why) = trouble {
            return Err(End::Refused(why.clone()));
        }
        let sense = here.pace().signum();
        let value = here.point.value + sense * BEYOND * self.bench.span;
        let lost = |why: &dyn std::fmt::Display| End::Lost(format!("{trouble}; beyond, {why}"));
        let place = self.bench.variant(value).and_then(|variant| self.bench.found(&variant));
        let place = match place {
            Ok(place) => place,
            Err(Trouble::Steady(SteadyError::Shakedown { contacts, .. })) => {
                return Err(End::Shakedown(contacts));
            }
            Err(trouble) if trouble.is_final() => return Err(End::Interrupted),
            Err(other) => return Err(lost(&other)),
        };
        let still = moment::twice(&mut self.bench.map_at(&place), &place.fixed, None);
        let (still, _) = still.map_err(|error| lost(&error))?;
        let period = Period::of(self.bench, &place).map_err(|error| lost(&error))?;
        if !still.is_empty() {
            // What is held for ever neither fades nor grows.
            self.event(here, (value, &period.happened, true));
            let names = place.variant.drive.model.contacts().map(|(name, _)| name.to_owned()).enumerate();
            return Err(End::Shakedown(
                names.filter(|(c, _)| still.contains(c)).map(|(_, name)| name).collect(),
            ));
        }
        let row = by_value(place.fixed.defect.len(), sense);
        let next = Standing::of(self.bench, place, period, (Some(self.measure), &row));
        let mut next = next.map_err(|error| lost(&error))?;
        next.point.piece = here.point.piece + 1;
        if !self.is_alike(here, &next).map_err(|error| lost(&error))? {
            return Err(lost(&"the drive comes to another motion"));
        }
        self.event(here, (value, &next.happened, next.point.is_stable()));
        self.keep(&next);
        Ok(next)
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
        let mut map = self.bench.map_at(&of.place);
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
