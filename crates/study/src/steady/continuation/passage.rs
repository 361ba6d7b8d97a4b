//! What lies between two motions of a branch: a place where its motions change their kind, or an event.

use super::arm::{Probe, Walk};
use super::bifurcation::{Bifurcation, Mark, Test, root, turn};
use super::error::Trouble;
use super::happened::{Change, Happened, changes, swap};
use super::standing::Standing;

/// Motions on either side of an event that are farther apart than this are of two branches.
const JUMP: f64 = 1e-3;
/// Where so many events lie within this share of the range the next ones are told as one, no longer than that: reversals of a ring that dies
/// out vanish one after the other.
const CROWD: f64 = 1e-4;
const CLOSE: usize = 2;
/// What an event takes back of the one before, no more than so many times the accuracy of places away, is rounding at the place of both.
const FLICKER: f64 = 1e3;

impl Walk<'_> {
    /// Finds what lies between two motions in whose periods the same happens.
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
            // Elsewhere only what is taken for its tangent turns back.
            if test == Test::Fold && turn(here) * turn(next) > 0.0 {
                return Err(Trouble::Bends);
            }
            let Some((at, standing)) = best else { continue };
            if !test.is_met(&standing) {
                // It has jumped over zero: for the others, too.
                if !found.iter().any(|(.., mark)| matches!(mark.kind, Bifurcation::Break(_))) {
                    found.push(self.broken((here, next), [low, high])?);
                }
                continue;
            }
            let Some(kind) = test.kind(&standing) else { continue };
            // Where the branch turns the bracket has no width: what is left is the tolerance of the runs.
            let width = (0.5 * (high - low) * standing.pace().abs()).max(self.bench.options.tolerance);
            let half_width = width * self.bench.span;
            // Near the place no multiplier is far from 1: its side is what counts.
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

    /// A place at which the derivatives of the motion jump, between two lengths along a tangent.
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

    /// Closes in on an event between a motion and one in whose period something else happens, and goes on from beyond it.
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

    /// Whether events lie so close that one more is not told from those that follow.
    fn is_crowded(&self, here: &Standing) -> bool {
        let near = |value: &&f64| (**value - here.point.value).abs() < CROWD * self.bench.span;
        self.passed.iter().rev().take(CLOSE).filter(near).count() == CLOSE
    }

    /// Adds a place, unless what happens there takes back the event before it.
    pub(super) fn add(&mut self, mark: Mark) {
        // One without a width is told from another moment of the same period.
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

    /// Tells what differs between a motion and one just beyond, if anything does, where the varied number goes on in a sense.
    pub(super) fn event(
        &mut self,
        sense: f64,
        before: &Standing,
        (value, happened, stable): (f64, &Happened, bool),
    ) {
        let values = [before.point.value, value];
        let mut sides = [(&before.happened, before.point.is_stable()), (happened, stable)];
        // How far the two are apart in the varied number may be rounding.
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

/// Whether what changes at two places is the same, there and back.
fn is_reverse(one: &[Change], other: &[Change]) -> bool {
    let back = |change: &Change| Change { below: change.above, above: change.below, ..change.clone() };
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| back(one) == *other)
}
