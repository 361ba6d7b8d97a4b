//! The search for a balance of forces.

use super::statics::Statics;
use super::{Settling, elimination};
use crate::scene::{Axis, SMALL_ANGLE};
use crate::state::State;
use nalgebra::DVector;
use std::collections::VecDeque;
use std::rc::Rc;

/// Most iterations.
// Bounds the search where there is no equilibrium: no start differs with 40.
const ITERATIONS: u32 = 400;
/// Most iterations without progress: the rest is rounding.
// Half of it moves one example by rounding; with 1 a climber and rows begin otherwise, by less than another path of steps makes of it.
const PATIENCE: u32 = 8;
/// Pseudo-time from which on an iteration is Newton's but for the rounding of its step, and with which a search begins beside a balance.
// Begun with much more, a body that the next part of the loads sets free is gone at once.
pub(super) const NEWTON: f64 = 1e4;
/// Most halvings of a step that goes too far.
const HALVINGS: u32 = 40;
/// Largest imbalance of an equilibrium, in units of what acts on a coordinate.
// Decides only whether there is one: Newton's method goes on to rounding, and no start differs at 1e-8 or 1e-10.
const BALANCED: f64 = 1e-9;
/// Forces that are added up on a coordinate, about.
const ROUNDED: f64 = 4.0;
/// A step this long finds nothing that holds a body any more, m or rad.
// With 1e12 natural lengths instead a body that nothing holds finds a rest far away.
const LOST: f64 = 1e3;

/// Places that a search remembers. Where only rounding is left it comes to the same few over and over.
// A stage on 1 000 contacts asks 11 000 times what is left at a place, of 1 370 places.
const REMEMBERED: usize = 32;

/// A place of the free coordinates, and what is left unbalanced there.
#[derive(Debug)]
pub(super) struct Balance {
    /// Components of the state.
    pub(super) y: Vec<f64>,
    /// Forces that are left, N or N m.
    pub(super) residual: DVector<f64>,
    /// Whether that is nothing, at small angles.
    pub(super) holds: bool,
    /// A coordinate beyond them, where that is nothing.
    pub(super) turned: Option<usize>,
    /// Largest of them in parts of what acts on the coordinate.
    size: f64,
    statics: Statics,
}

/// What is to be balanced.
pub(super) struct Search<'a> {
    settling: &'a Settling<'a>,
    state: &'a State,
    /// Forces that are still to be put on, N or N m.
    missing: &'a DVector<f64>,
    /// Coordinates that stay where they are and ask for no balance.
    held: &'a [bool],
    /// Places looked at last, the next one to be forgotten first.
    seen: VecDeque<Rc<Balance>>,
    /// How many places have been looked at.
    looked: u32,
}

impl Balance {
    /// Whether what is left on a coordinate is more than rounding.
    pub(super) fn is_off(&self, i: usize) -> bool {
        self.residual[i].abs() > BALANCED * self.statics.acting[i]
    }

    /// The coordinate, of those that are not held, that is farthest from balance, by what acts on it.
    pub(super) fn farthest(&self, held: &[bool]) -> Option<usize> {
        let share = |i: usize| self.residual[i].abs() / self.statics.acting[i];
        let off = (0..self.residual.len()).filter(|i| !held[*i] && self.is_off(*i));
        off.max_by(|a, b| share(*a).total_cmp(&share(*b)))
    }

    /// Whether part of a step from here comes to a place, to the last bit.
    fn leads_to(&self, place: &Self, (step, share): (&DVector<f64>, f64)) -> bool {
        // Coordinates come first, the rest stays as it is.
        let moved = self.y.iter().zip(step).map(|(y, step)| y + share * step);
        moved.zip(&place.y).all(|(a, b)| a.to_bits() == b.to_bits())
    }
}

impl<'a> Search<'a> {
    pub(super) fn new(
        settling: &'a Settling<'a>,
        state: &'a State,
        (missing, held): (&'a DVector<f64>, &'a [bool]),
    ) -> Self {
        Self { settling, state, missing, held, seen: VecDeque::with_capacity(REMEMBERED), looked: 0 }
    }

    /// Looks for forces = missing from y on, by Newton's method with a pseudo-time: (K + D/τ)·Δq = forces - missing,
    /// where D is the natural stiffness of each coordinate. A body that nothing holds falls along its load, faster and
    /// faster, until something does, and the method becomes Newton's.
    ///
    /// Where it ends is the best place if all balances there, or else the last. A search from a balance under nearly the same loads may
    /// begin as [`NEWTON`] says.
    pub(super) fn from(mut self, y: &[f64], mut tau: f64) -> Rc<Balance> {
        let mut now = self.at(y.to_vec());
        let (mut best, mut idle) = (Rc::clone(&now), 0);
        for _ in 0..ITERATIONS {
            // A balance that holds is still bettered until only rounding is left: it is where a run starts
            // from.
            if best.size == 0.0 || best.holds && idle > PATIENCE {
                break;
            }
            let Some(step) = self.step(&now, tau).filter(|step| step.amax() < LOST) else { break };
            idle += 1;
            let looked = self.looked;
            let (whole, push) = (self.along(&now, &step, 1.0), now.residual.dot(&step));
            // Where Newton's method comes back to where it has been it goes round among the same few places.
            if best.holds && tau > NEWTON && looked == self.looked {
                break;
            }
            // Less imbalance, or still pushed on along the step: a body that falls towards what will hold it
            // is no nearer to balance yet.
            let good = whole.size < now.size || push > 0.0 && !overshoots(&now, &whole, &step);
            tau = (tau * if good { 3.0 } else { 0.3 }).clamp(1e-6, 1e18);
            if good {
                now = whole;
            } else if push > 0.0 {
                now = self.shorter(&now, whole, &step);
            }
            if now.size < best.size {
                (best, idle) = (Rc::clone(&now), 0);
            }
        }
        if best.holds { best } else { now }
    }

    /// The step of an iteration; none where the matrix has no inverse.
    fn step(&self, now: &Balance, tau: f64) -> Option<DVector<f64>> {
        let (mut matrix, mut residual) = (now.statics.stiffness.clone(), now.residual.clone());
        for (i, free) in self.settling.model.free.iter().enumerate() {
            // mω² is the natural stiffness: for large τ the step is Newton's, for small τ it follows the
            // force.
            matrix[(i, i)] += free.mass * (free.scale.1 / free.scale.0).powi(2) / tau;
            if self.held[i] {
                // A held coordinate keeps its row of the identity: its step is 0 whatever the others do.
                matrix.row_mut(i).fill(0.0);
                (matrix[(i, i)], residual[i]) = (1.0, 0.0);
            }
        }
        elimination::solve(matrix, residual).filter(|step| step.iter().all(|x| x.is_finite()))
    }

    /// A step that goes too far is halved towards the place where nothing pushes along it any more. Without friction that
    /// is the lowest energy along the step, so that the energy falls from iteration to iteration.
    fn shorter(&mut self, now: &Rc<Balance>, whole: Rc<Balance>, step: &DVector<f64>) -> Rc<Balance> {
        let (mut near, mut far) = ((0.0, Rc::clone(now)), (1.0, whole));
        let mut place = Rc::clone(now);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near.0 + far.0);
            // Where only rounding is left it comes back to one of both ends, of which is known on which side they are.
            if now.leads_to(&near.1, (step, middle)) {
                (near.0, place) = (middle, Rc::clone(&near.1));
                continue;
            }
            if now.leads_to(&far.1, (step, middle)) {
                (far.0, place) = (middle, Rc::clone(&far.1));
                continue;
            }
            place = self.along(now, step, middle);
            // Between half of the push gone and half of it turned round a step is good enough: the next one
            // is Newton's again.
            if overshoots(now, &place, step) {
                far = (middle, Rc::clone(&place));
            } else if place.residual.dot(step) > 0.5 * now.residual.dot(step) {
                near = (middle, Rc::clone(&place));
            } else {
                break;
            }
        }
        place
    }

    /// Part of a step.
    fn along(&mut self, now: &Balance, step: &DVector<f64>, share: f64) -> Rc<Balance> {
        let mut y = now.y.clone();
        y.iter_mut().zip(step).for_each(|(y, step)| *y += share * step);
        self.at(y)
    }

    /// What is left at a place, looked up where it was looked at before: there it is the same to the last bit.
    fn at(&mut self, y: Vec<f64>) -> Rc<Balance> {
        let same = |seen: &&Rc<Balance>| seen.y.iter().zip(&y).all(|(a, b)| a.to_bits() == b.to_bits());
        if let Some(seen) = self.seen.iter().rev().find(same) {
            return Rc::clone(seen);
        }
        let balance = Rc::new(self.left(y));
        self.looked += 1;
        if self.seen.len() == REMEMBERED {
            self.seen.pop_front();
        }
        self.seen.push_back(Rc::clone(&balance));
        balance
    }

    /// Coordinates along one axis that forces tie to each other, those alone left out.
    fn groups<'s>(&'s self, statics: &'s Statics) -> impl Iterator<Item = Vec<usize>> + 's {
        let free = &self.settling.model.free;
        let mut seen = self.held.to_vec();
        let tied = |i: usize, j: usize| statics.stiffness[(i, j)] != 0.0 || statics.stiffness[(j, i)] != 0.0;
        let from = (0..free.len()).filter(|i| free[*i].axis != Axis::Pitch);
        from.filter_map(move |first| {
            let mut group = vec![first];
            if std::mem::replace(&mut seen[first], true) {
                return None;
            }
            let mut next = 0;
            while let Some(&i) = group.get(next) {
                for j in 0..free.len() {
                    if !seen[j] && free[j].axis == free[first].axis && tied(i, j) {
                        seen[j] = true;
                        group.push(j);
                    }
                }
                next += 1;
            }
            (group.len() > 1).then_some(group)
        })
    }

    /// What is left at a place: the static forces less what is still missing. It holds where every free
    /// coordinate's rest is at most 1e-9 of what acts on it, beside rounding. What bodies do to each other has none for all of them
    /// together: a pair that slides away would find a balance where rounding of its way is as much as what pulls.
    fn left(&self, y: Vec<f64>) -> Balance {
        let statics = self.settling.statics(self.state, &y);
        let residual = &statics.net - self.missing;
        let (mut size, mut holds, mut is_noise) = (0.0_f64, true, false);
        // What acts on one coordinate is rounded, and a link hands that on to another on which nothing else acts: by works
        // along natural lengths they are of one kind.
        let free = &self.settling.model.free;
        let works = free.iter().zip(&statics.acting).map(|(free, acting)| free.scale.0 * acting);
        let rounding = ROUNDED * f64::EPSILON * works.fold(0.0, f64::max);
        let allowed =
            |i: usize| BALANCED * (statics.acting[i] + self.missing[i].abs()) + rounding / free[i].scale.0;
        for i in (0..residual.len()).filter(|i| !self.held[*i] && residual[*i] != 0.0) {
            let (left, acting) = (residual[i].abs(), statics.acting[i] + self.missing[i].abs());
            size = size.max(left / acting);
            // Rounding of a place far away is a force of a stiff contact: it is allowed beside the share of
            // what acts.
            holds &= left <= allowed(i) + statics.noise[i];
            is_noise |= left > allowed(i);
        }
        holds &= !is_noise
            || self.groups(&statics).all(|group| {
                let left: f64 = group.iter().map(|i| residual[*i]).sum();
                left.abs()
                    <= group.iter().map(|i| allowed(*i)).sum::<f64>() + statics.noise_together(&group, &y)
            });
        // Far round, rounding of places holds what tips a body.
        let is_turned =
            |i: &usize| free[*i].axis == Axis::Pitch && !self.held[*i] && y[*i].abs() > SMALL_ANGLE;
        let turned = (0..free.len()).find(is_turned).filter(|_| holds);
        holds &= turned.is_none();
        Balance { y, residual, holds, turned, size, statics }
    }
}

/// Whether what is left after a step pushes back along it, half as hard as it pushed before.
///
/// Half as hard: Newton's step on a force that bends overshoots a little and is a good one all the same.
fn overshoots(from: &Balance, to: &Balance, step: &DVector<f64>) -> bool {
    to.residual.dot(step) < -0.5 * from.residual.dot(step)
}
