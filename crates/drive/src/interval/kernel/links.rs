//! Springs, dampers and actuators in the precomputed forces of an interval.

use super::length::{Length, Row};
use crate::equations::Sum;
use crate::interval::Followed;
use crate::model::{Link, Model, Stroke};
use crate::state::State;

/// Spring between free coordinates, without damper, input power and loss.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spring<R> {
    row: R,
    /// Elongation (Σ coefficient · coordinate) at which only the preload acts, m.
    rest: f64,
    stiffness: f64,
    preload: f64,
}

/// Spring with damping or prescribed motion, damper or actuator.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tie<'a, R> {
    elongation: Length<'a, R>,
    stroke: Followed<'a>,
    stiffness: f64,
    damping: f64,
    preload: f64,
}

impl<'a, R: Row> Tie<'a, R> {
    pub(super) fn of(link: &Link, model: &'a Model, state: &State) -> Option<Self> {
        let stroke = match link.stroke {
            Stroke::Constant(constant) => Followed::constant(constant),
            Stroke::Driven(w) => Followed::signal(w, model, state)?,
        };
        let elongation = Length::of(&link.elongation, model, state)?;
        let Link { stiffness, damping, preload, .. } = *link;
        Some(Self { elongation, stroke, stiffness, damping, preload })
    }

    /// Adds the force k(s - e) + c(ṡ - ė) + preload along the elongation e. The input power of the stroke s is (k(s - e) + c(ṡ - ė))ṡ; the
    /// work of the preload is a potential energy. Without velocities there is no damping, and rates are those of prescribed motions.
    #[inline(always)]
    pub(super) fn act(&self, t: f64, (x, v): (&[f64], Option<&[f64]>), sum: &mut Sum<'_>) {
        let (elongation, stroke) = (self.elongation.at(t, x, v), self.stroke.at(t));
        let (stretch, rate) = (stroke.value - elongation.value, stroke.rate - elongation.rate);
        let force = self.stiffness * stretch + self.damping * rate;
        sum.along(&self.elongation.row, elongation.driven, force + self.preload);
        sum.input += force * stroke.rate;
        sum.damping += self.damping * rate * rate;
    }
}

impl<R: Row> Spring<R> {
    /// Returns a tie as a plain spring; `None` if the tie has damping or prescribed motion.
    pub(super) fn of(tie: &Tie<'_, R>) -> Option<Self> {
        let ([place, 0.0, _], [slack, 0.0, _]) = (tie.elongation.followed.line()?, tie.stroke.line()?) else {
            return None;
        };
        let Tie { elongation, stiffness, damping, preload, .. } = *tie;
        (damping == 0.0).then_some(Self { row: elongation.row, rest: slack - place, stiffness, preload })
    }

    #[inline(always)]
    pub(super) fn act(&self, x: &[f64], forces: &mut [f64]) {
        self.row.act(x, forces, |length| self.stiffness * (self.rest - length) + self.preload);
    }
}
