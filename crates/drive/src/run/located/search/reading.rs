//! Values and rates of event functions at both ends of a step and inside it, and their near-zero bands.

use super::{Search, Seen};
use crate::contact::{Contact, Motion};
use crate::equations::Equations;
use crate::run::located::watch::Moving;
use crate::run::located::watched::Watched;
use stickslip_contact::{Guard, bands};
use stickslip_stepper::{Attempt, Completion, Span};

impl<A: for<'q> Attempt<Equations<'q>>> Search<'_, '_, A> {
    /// Returns the value of an event function at the start of the step.
    #[inline(always)]
    pub(super) fn at_begin(&self, watched: Watched<'_>) -> f64 {
        self.value(watched, self.from, || (self.solver.span().time, self.solver.span().begin))
    }

    /// Returns the value of an event function at the end of the step.
    #[inline(always)]
    pub(super) fn at_end(&self, watched: Watched<'_>) -> f64 {
        self.value(watched, self.to, || (self.solver.span().end_time, self.solver.span().end))
    }

    /// Returns the value of an event function at one end of the step.
    ///
    /// `contacts` are the contacts at that end; `place` returns time and components for blocks.
    #[inline(always)]
    pub(super) fn value<'y>(
        &self,
        watched: Watched<'_>,
        contacts: &[Moving],
        place: impl Fn() -> (f64, &'y [f64]),
    ) -> f64 {
        match watched {
            Watched::Closed(steady, guard) => steady.guard(guard, &contacts[steady.index].motion),
            Watched::Contact(index, contact, guard) => {
                guard.value(contact, self.eq.law(index), &contacts[index].motion)
            }
            Watched::Block(k, guard) => {
                let (t, y) = place();
                self.eq.block_guard(k, guard, t, |i| y[i])
            }
        }
    }

    /// Returns the rates of an event function at both ends of the step; 0 for a block, whose rates are unknown.
    #[inline(always)]
    pub(super) fn rates(&self, watched: Watched<'_>) -> [f64; 2] {
        let rate = |ends: &[Moving]| match watched {
            Watched::Closed(steady, guard) => {
                let Moving { motion, second: (_, pull) } = &ends[steady.index];
                steady.guard_rate(guard, motion, *pull)
            }
            Watched::Contact(index, contact, guard) => {
                let Moving { motion, second } = &ends[index];
                guard.rate(contact, &self.eq.modes[index], motion, *second)
            }
            Watched::Block(..) => 0.0,
        };
        [rate(self.from), rate(self.to)]
    }

    /// Returns the value of an event function at time t inside the step, from the dense output.
    #[inline(always)]
    pub(super) fn inside(&self, watched: Watched<'_>, t: f64) -> f64 {
        let part = self.solver.part(t);
        let value = |i: usize| self.solver.value_at(i, part);
        match watched {
            Watched::Closed(steady, guard) => {
                // Each event function needs either u or u̇.
                let at = match guard {
                    Guard::Piece => Motion { u: steady.displacement(t, value), ..Motion::default() },
                    _ => {
                        let speed = steady.speed(t, |i| value(self.eq.layout.velocity(i)));
                        Motion { du: speed, ..Motion::default() }
                    }
                };
                steady.guard(guard, &at)
            }
            Watched::Contact(index, contact, guard) => {
                let at = if guard.is_length() {
                    self.eq.standing(contact, t, value)
                } else {
                    self.eq.motion(contact, t, value)
                };
                guard.value(contact, self.eq.law(index), &at)
            }
            Watched::Block(k, guard) => self.eq.block_guard(k, guard, t, value),
        }
    }

    /// Returns time and motion of a contact at a fraction of the step, from the dense output.
    ///
    /// The motion is stored, because several event functions of a contact need it.
    pub(super) fn motion_at(&mut self, index: usize, contact: &Contact, part: f64) -> (f64, Motion) {
        let Span { time, end_time, .. } = self.solver.span();
        let t = time + part * (end_time - time);
        if self.seen.first().is_some_and(|seen| seen.contact != index) {
            self.seen.clear();
        }
        if let Some(seen) = self.seen.iter().find(|seen| seen.part == part) {
            return (t, seen.motion);
        }
        self.solver.complete(self.eq, Completion::Dense);
        let at = self.solver.part(t);
        let motion = self.eq.motion(contact, t, |i| self.solver.value_at(i, at));
        // Without room the motion is computed again next time.
        let _ = self.seen.try_push(Seen { contact: index, part, motion });
        (t, motion)
    }

    /// Returns the deadband and the near-zero band of an event function, both around zero.
    pub(super) fn bands(&self, watched: Watched<'_>) -> (f64, f64) {
        let (dead, near) = self.own_bands(watched);
        let (contact, guard) = match watched {
            Watched::Closed(steady, guard) => (steady.contact, guard),
            Watched::Contact(_, contact, guard) => (contact, guard),
            Watched::Block(..) => return (dead, near),
        };
        // Rounding of large body positions disturbs the small u of a contact between moving bodies. The deadband
        // includes that noise, up to the nearness.
        let begin = self.solver.span().begin;
        (dead.max(guard.noise(contact, contact.u.travel(|i| begin[i])).min(near)), near)
    }

    /// Returns the deadband and the near-zero band of an event function without the rounding noise of large positions.
    #[inline(always)]
    pub(super) fn own_bands(&self, watched: Watched<'_>) -> (f64, f64) {
        match watched {
            Watched::Closed(steady, guard) => {
                guard.bands(steady.contact, self.tolerance, self.from[steady.index].motion.u)
            }
            Watched::Contact(index, contact, guard) => {
                guard.bands(contact, self.tolerance, self.from[index].motion.u)
            }
            Watched::Block(k, guard) => {
                bands(self.eq.model.blocks[k].block().guard_scale(guard), self.tolerance)
            }
        }
    }
}
