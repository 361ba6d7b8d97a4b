//! Springs, dampers and actuators in the precomputed forces of an interval.

use super::length::{Length, Sums, dot};
use crate::interval::Followed;
use crate::model::{Link, Model, Stroke};
use crate::state::State;

/// A spring, damper or actuator.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tie<'a> {
    elongation: Length<'a>,
    stroke: Followed<'a>,
    stiffness: f64,
    damping: f64,
    preload: f64,
}

impl<'a> Tie<'a> {
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
    pub(super) fn act<const N: usize>(
        &self,
        t: f64,
        (x, v): (&[f64; N], Option<&[f64; N]>),
        sums: &mut Sums<N>,
    ) {
        let (followed, stroke) = (self.elongation.followed.at(t), self.stroke.at(t));
        let stretch = stroke.value - (dot(&self.elongation.row, x) + followed.value);
        let own = v.map_or(0.0, |v| dot(&self.elongation.row, v));
        let rate = stroke.rate - (own + followed.rate);
        let force = self.stiffness * stretch + self.damping * rate;
        sums.apply(&self.elongation.row, followed.rate, force + self.preload);
        sums.input += force * stroke.rate;
        sums.damping += self.damping * rate * rate;
    }
}
