//! Special points between two orbits of a branch: bifurcations and events.

use super::arm::{Probe, Walk};
use super::bifurcation::{Bifurcation, Mark, Test, root, turn};
use super::error::Trouble;
use super::happened::{Change, Happened, changes, swap};
use super::standing::Standing;

/// Distance between the orbits on both sides of an event above which the orbits belong to different branches.
const JUMP: f64 = 1e-3;
/// If `CLOSE` events lie within the fraction `CROWD` of the parameter range, further events within this distance are located together. An
/// example are reversals of decaying ringing, which vanish one after another.
const CROWD: f64 = 1e-4;
const CLOSE: usize = 2;
/// Distance of two events that cancel each other, as a multiple of the accuracy, below which both result from rounding errors.
const FLICKER: f64 = 1e3;

impl Walk<'_> {
    /// Locates bifurcations between two orbits with the same events.
    pub(super) fn cross(&mut self, here: &Standing, next: &Standing, length: f64) -> Result<(), Trouble> {
        let mut found: Vec<(f64, Standing, Mark)> = Vec::new();
        for test in Test::ALL {
            let [at_here, at_next] = [here, next].map(|standing| test.at(standing, self.measure));
            if at_here * at_next >= 0.0 || [here, next].iter().all(|standing| test.is_idle(standing)) {
                continue;
            }
            let value = |at: f64| {
                let standing = self.stand(here, self.probe(here, at, None)?)?;
                Ok::<_, Trouble>((test.at(&standing, self.measure), (at, standing)))
            };
            let ([low, high], best) = root((0.0, at_here), (length, at_next), self.accuracy, value)?;
            // If ∏(1 - λ) keeps its sign, only the computed tangent turns back, not the branch.
            if test == Test::Fold && turn(here) * turn(next) > 0.0 {
                return Err(Trouble::Bends);
            }
            let Some((at, standing)) = best else { continue };
            if !test.is_met(&standing) {
                // Multipliers jumped over the condition of the bifurcation. The same jump may affect other test functions.
                if !found.iter().any(|(.., mark)| matches!(mark.kind, Bifurcation::Break(_))) {
                    found.push(self.broken((here, next), [low, high])?);
                }
                continue;
            }
            let Some(kind) = test.kind(&standing) else { continue };
            // At a fold the bracket has no width in the parameter; the tolerance of the runs remains.
            let width = (0.5 * (high - low) * standing.pace().abs()).max(self.bench.options.tolerance);
            let half_width = width * self.bench.span;
            // Near a bifurcation a multiplier has a modulus close to 1, so stability is decided without regard to the error of the modulus.
            let sides = [here, next].map(|standing| standing.point.radius() < 1.0);
            let mark = self.mark(kind, &standing, half_width, sides);
            found.push((at, standing, mark));
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, standing, mark) in found {
            self.keep(&standing);
            self.arm.marks.push(mark);
        }
        Ok(())
    }

    /// Returns the point at which the derivatives of the Poincaré map jump, between two distances along the tangent.
    fn broken(
        &self,
        (here, next): (&Standing, &Standing),
        lengths: [f64; 2],
    ) -> Result<(f64, Standing, Mark), Trouble> {
        let [before, after] = [self.probe(here, lengths[0], None)?, self.probe(here, lengths[1], None)?];
        let mut orders = [before.period.order.as_slice(), after.period.order.as_slice()];
        if here.pace() < 0.0 {
            orders.reverse();
        }
        let kind = Bifurcation::Break(swap(orders));
        let [low, high] = [&before, &after].map(|probe| probe.corrected.place.variant.value);
        let standing = self.stand(here, before)?;
        let sides = [here, next].map(|standing| standing.point.is_stable());
        let mark = self.mark(kind, &standing, 0.5 * (high - low).abs(), sides);
        Ok((lengths[0], standing, Mark { value: 0.5 * (low + high), ..mark }))
    }

    fn mark(&self, kind: Bifurcation, at: &Standing, half_width: f64, along: [bool; 2]) -> Mark {
        let [first, second] = along;
        let stable = if at.pace() < 0.0 && kind != Bifurcation::Fold { [second, first] } else { along };
        Mark { kind, value: at.point.value, half_width, step: at.point.step, stable }
    }

    /// Locates an event between two orbits with different events by bisection, and continues the branch beyond the event.
    pub(super) fn pass(&mut self, here: &Standing, far: Probe, length: f64) -> Result<Standing, Trouble> {
        let (mut low, mut high) = (0.0, length);
        let (mut near, mut far): (Option<Probe>, Probe) = (None, far);
        let accuracy = if self.is_crowded(here) { CROWD } else { self.accuracy };
        while high - low > accuracy {
            let middle = 0.5 * (low + high);
            let probe = self.probe(here, middle, None)?;
            if probe.period.happened == here.happened {
                (low, near) = (middle, Some(probe));
            } else {
                (high, far) = (middle, probe);
            }
        }
        let gone = near.as_ref().map_or_else(|| &here.tangent * 0.0, |near| near.corrected.gone.clone());
        if self.measure.length(&(&far.corrected.gone - gone)) > JUMP {
            return Err(Trouble::Bends);
        }
        let before = match near {
            Some(near) => self.stand(here, near)?,
            None => here.clone(),
        };
        let mut beyond = self.stand(&before, far)?;
        if beyond.pace() * here.pace() < 0.0 && turn(&beyond) * turn(here) > 0.0 {
            return Err(Trouble::Bends);
        }
        if low > 0.0 {
            self.cross(here, &before, low)?;
            self.keep(&before);
        }
        beyond.point.piece += 1;
        let after = (beyond.point.value, &beyond.happened, beyond.point.is_stable());
        self.event(here.pace(), &before, after);
        if beyond.is_loose {
            return Err(Trouble::Slides);
        }
        self.keep(&beyond);
        Ok(beyond)
    }

    /// Returns whether several events are so close to an orbit that the next events are located together.
    fn is_crowded(&self, here: &Standing) -> bool {
        let near = |value: &&f64| (**value - here.point.value).abs() < CROWD * self.bench.span;
        self.passed.iter().rev().take(CLOSE).filter(near).count() == CLOSE
    }

    /// Adds a special point, unless it cancels the previous event.
    pub(super) fn add(&mut self, mark: Mark) {
        // An event whose bracket has no width results from a new instant of the Poincaré section.
        if matches!(mark.kind, Bifurcation::Event(_)) && mark.half_width > 0.0 {
            self.passed.push(mark.value);
        }
        let apart = FLICKER * self.accuracy * self.bench.span;
        let takes_back = |last: &Mark| match (&last.kind, &mark.kind) {
            (Bifurcation::Event(last_changes), Bifurcation::Event(changes)) => {
                (last.value - mark.value).abs() < apart && is_reverse(last_changes, changes)
            }
            _ => false,
        };
        if self.arm.marks.last().is_some_and(takes_back) {
            self.arm.marks.pop();
        } else {
            self.arm.marks.push(mark);
        }
    }

    /// Adds a special point for the differences in the events of an orbit and of another orbit just beyond it. `sense` is the direction of
    /// the parameter.
    pub(super) fn event(
        &mut self,
        sense: f64,
        before: &Standing,
        (value, happened, stable): (f64, &Happened, bool),
    ) {
        let values = [before.point.value, value];
        let mut sides = [(&before.happened, before.point.is_stable()), (happened, stable)];
        // The direction is given, because the difference of the two parameter values may be a rounding error.
        if sense < 0.0 {
            sides.reverse();
        }
        let changes = changes(sides[0].0, sides[1].0);
        if changes.is_empty() {
            return;
        }
        self.arm.marks.push(Mark {
            kind: Bifurcation::Event(changes),
            value: 0.5 * (values[0] + values[1]),
            half_width: 0.5 * (values[0] - values[1]).abs(),
            step: before.point.step,
            stable: sides.map(|(_, stable)| stable),
        });
    }
}

/// Returns whether two changes cancel each other.
fn is_reverse(one: &[Change], other: &[Change]) -> bool {
    let back = |change: &Change| Change { below: change.above, above: change.below, ..change.clone() };
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| back(one) == *other)
}
