//! Newton search for a static balance of forces.

use super::statics::Statics;
use super::{Settling, elimination};
use crate::scene::{Axis, SMALL_ANGLE};
use crate::state::State;
use nalgebra::DVector;
use std::collections::VecDeque;
use std::rc::Rc;

/// Largest number of iterations.
const ITERATIONS: u32 = 400;
/// Largest number of iterations without progress; further changes are rounding.
const PATIENCE: u32 = 8;
/// Pseudo-time above which an iteration equals a Newton step; also its initial value near a known equilibrium.
pub(super) const NEWTON: f64 = 1e4;
/// Largest number of halvings of a step.
const HALVINGS: u32 = 40;
/// Largest imbalance of an equilibrium, relative to the acting forces.
const BALANCED: f64 = 1e-9;
/// Typical number of forces on a coordinate, for an estimate of their rounding.
const ROUNDED: f64 = 4.0;
/// Length of an iteration step above which the body counts as not held, m or rad.
const LOST: f64 = 1e3;

/// Number of cached positions; near the rounding limit the search revisits the same positions.
const REMEMBERED: usize = 32;

/// Positions of the free coordinates and the imbalance of forces there.
#[derive(Debug)]
pub(super) struct Balance {
    /// Components of the state.
    pub(super) y: Vec<f64>,
    /// Remaining imbalance of each coordinate, N or N m.
    pub(super) residual: DVector<f64>,
    /// Whether the forces are balanced at small angles.
    pub(super) holds: bool,
    /// Index of a pitch coordinate that is not small although the forces are balanced.
    pub(super) turned: Option<usize>,
    /// Largest imbalance relative to the acting forces.
    size: f64,
    statics: Statics,
}

/// Search for an equilibrium.
pub(super) struct Search<'a> {
    settling: &'a Settling<'a>,
    state: &'a State,
    /// Loads not yet applied, N or N m.
    missing: &'a DVector<f64>,
    /// Whether each coordinate is held fixed and needs no balance.
    held: &'a [bool],
    /// Cached positions, oldest first.
    seen: VecDeque<Rc<Balance>>,
    /// Number of evaluated positions.
    looked: u32,
}

impl Balance {
    /// Returns whether the imbalance of a coordinate exceeds rounding.
    pub(super) fn is_off(&self, i: usize) -> bool {
        self.residual[i].abs() > BALANCED * self.statics.acting[i]
    }

    /// Returns the released coordinate with the largest relative imbalance.
    pub(super) fn farthest(&self, held: &[bool]) -> Option<usize> {
        let share = |i: usize| self.residual[i].abs() / self.statics.acting[i];
        let off = (0..self.residual.len()).filter(|i| !held[*i] && self.is_off(*i));
        off.max_by(|a, b| share(*a).total_cmp(&share(*b)))
    }

    /// Returns whether a fraction of a step ends exactly at a cached position.
    fn leads_to(&self, place: &Self, (step, share): (&DVector<f64>, f64)) -> bool {
        // Coordinates come first; all other components stay.
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

    /// Solves forces = missing loads by Newton's method with a pseudo-time τ: (K + D/τ)·Δq = forces - missing loads, starting at y. D is
    /// the natural stiffness of each coordinate. For small τ a body moves along its load; for large τ the step is Newton's.
    ///
    /// Returns the best balance found, or the last position if none was found. Near an equilibrium, begin with τ = [`NEWTON`].
    pub(super) fn from(mut self, y: &[f64], mut tau: f64) -> Rc<Balance> {
        let mut now = self.at(y.to_vec());
        let (mut best, mut idle) = (Rc::clone(&now), 0);
        for _ in 0..ITERATIONS {
            // A balance is improved until only rounding is left.
            if best.size == 0.0 || best.holds && idle > PATIENCE {
                break;
            }
            let Some(step) = self.step(&now, tau).filter(|step| step.amax() < LOST) else { break };
            idle += 1;
            let looked = self.looked;
            let (whole, push) = (self.along(&now, &step, 1.0), now.residual.dot(&step));
            // A step to a cached position shows a cycle.
            if best.holds && tau > NEWTON && looked == self.looked {
                break;
            }
            // Progress is less imbalance, or a force that still acts along the step.
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

    /// Returns the displacement step of one iteration; `None` if the matrix is singular.
    fn step(&self, now: &Balance, tau: f64) -> Option<DVector<f64>> {
        let (mut matrix, mut residual) = (now.statics.stiffness.clone(), now.residual.clone());
        for (i, free) in self.settling.model.free.iter().enumerate() {
            // mω² is the natural stiffness.
            matrix[(i, i)] += free.mass * (free.scale.1 / free.scale.0).powi(2) / tau;
            if self.held[i] {
                // A held coordinate has a row of the identity, so its step is 0.
                matrix.row_mut(i).fill(0.0);
                (matrix[(i, i)], residual[i]) = (1.0, 0.0);
            }
        }
        elimination::solve(matrix, residual).filter(|step| step.iter().all(|x| x.is_finite()))
    }

    /// Shortens a step by bisection to the position where no force acts along the step. Without friction this position minimises the energy
    /// along the step.
    fn shorter(&mut self, now: &Rc<Balance>, whole: Rc<Balance>, step: &DVector<f64>) -> Rc<Balance> {
        let (mut near, mut far) = ((0.0, Rc::clone(now)), (1.0, whole));
        let mut place = Rc::clone(now);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near.0 + far.0);
            // Near rounding the middle may equal one end.
            if now.leads_to(&near.1, (step, middle)) {
                (near.0, place) = (middle, Rc::clone(&near.1));
                continue;
            }
            if now.leads_to(&far.1, (step, middle)) {
                (far.0, place) = (middle, Rc::clone(&far.1));
                continue;
            }
            place = self.along(now, step, middle);
            // Accepts positions where the force along the step is between half and minus half of its initial value.
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

    /// Returns the balance after a fraction of a step.
    fn along(&mut self, now: &Balance, step: &DVector<f64>, share: f64) -> Rc<Balance> {
        let mut y = now.y.clone();
        y.iter_mut().zip(step).for_each(|(y, step)| *y += share * step);
        self.at(y)
    }

    /// Returns the balance of forces at a position, from the cache if possible.
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

    /// Returns groups of at least two coupled coordinates along one axis.
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

    /// Returns the balance at a position: static forces minus missing loads. The position is an equilibrium if the imbalance of every
    /// released coordinate is at most 1e-9 of the acting forces, plus rounding. Groups of coupled coordinates must also be balanced in sum,
    /// because rounding of large distances would hide a net force.
    fn left(&self, y: Vec<f64>) -> Balance {
        let statics = self.settling.statics(self.state, &y);
        let residual = &statics.net - self.missing;
        let (mut size, mut holds, mut is_noise) = (0.0_f64, true, false);
        // Rounding of one force acts on all coordinates that links connect; natural lengths convert it.
        let free = &self.settling.model.free;
        let works = free.iter().zip(&statics.acting).map(|(free, acting)| free.scale.0 * acting);
        let rounding = ROUNDED * f64::EPSILON * works.fold(0.0, f64::max);
        let allowed =
            |i: usize| BALANCED * (statics.acting[i] + self.missing[i].abs()) + rounding / free[i].scale.0;
        for i in (0..residual.len()).filter(|i| !self.held[*i] && residual[*i] != 0.0) {
            let (left, acting) = (residual[i].abs(), statics.acting[i] + self.missing[i].abs());
            size = size.max(left / acting);
            // Rounding of large positions is a force in stiff contacts.
            holds &= left <= allowed(i) + statics.noise[i];
            is_noise |= left > allowed(i);
        }
        holds &= !is_noise
            || self.groups(&statics).all(|group| {
                let left: f64 = group.iter().map(|i| residual[*i]).sum();
                left.abs()
                    <= group.iter().map(|i| allowed(*i)).sum::<f64>() + statics.noise_together(&group, &y)
            });
        // At large angles rounding could hold a tilting body.
        let is_turned =
            |i: &usize| free[*i].axis == Axis::Pitch && !self.held[*i] && y[*i].abs() > SMALL_ANGLE;
        let turned = (0..free.len()).find(is_turned).filter(|_| holds);
        holds &= turned.is_none();
        Balance { y, residual, holds, turned, size, statics }
    }
}

/// Returns whether the force along a step has reversed and exceeds half of its initial value. Newton steps may overshoot by less.
fn overshoots(from: &Balance, to: &Balance, step: &DVector<f64>) -> bool {
    to.residual.dot(step) < -0.5 * from.residual.dot(step)
}
