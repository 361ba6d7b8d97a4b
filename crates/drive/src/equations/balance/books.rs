//! Energy balance of quasi-static coordinates, and overload of their contacts.

use super::super::sum::{Components, Sum, View};
use super::super::{Equations, Sample};
use super::Instant;
use crate::model::Balanced;
use crate::scene::Axis;

impl Equations<'_> {
    /// Adds the contributions of quasi-static coordinates: rates of positions that are states, and the power of the loads.
    ///
    /// The power L q̇ of a load L diverges near gross slip. Therefore the work is computed as L q at the present position minus the
    /// integral of q L̇.
    // Not inlined, as most models have no balanced coordinates.
    #[inline(never)]
    pub(in crate::equations) fn balance(&self, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        for (b, balanced) in self.model.balanced.iter().enumerate() {
            let place = self.made(self.pieces.len() + self.blocks.len() + b, at);
            let load = self.load(balanced, at.time());
            sum.input -= load.value * place.rate + place.value * load.rate;
            if let Some(slot) = balanced.slot.filter(|_| self.carries(balanced)) {
                extra[self.layout.balanced(slot) - 2 * self.layout.free] = place.rate;
            }
        }
    }

    /// Returns the external load on a quasi-static coordinate, N.
    fn load(&self, balanced: &Balanced, t: f64) -> Sample {
        let mut sum = Sample { value: balanced.own.force, rate: 0.0, acceleration: 0.0 };
        for &(w, a) in &balanced.own.loads {
            let sample = self.sample(w, t);
            sum.value += a * sample.value;
            sum.rate += a * sample.rate;
        }
        sum
    }

    /// Returns Σ L q over quasi-static coordinates, J: the work of their loads L without the integral of q L̇.
    pub(crate) fn laden(&self, t: f64, y: &impl Fn(usize) -> f64) -> f64 {
        let read = |i: usize| y(i);
        let at = Components { t, y: &read as &dyn Fn(usize) -> f64 };
        let of = |(b, balanced): (usize, &Balanced)| self.load(balanced, t).value * self.place_value(b, &at);
        self.model.balanced.iter().enumerate().map(of).sum()
    }

    pub(crate) fn place_value(&self, b: usize, at: &Instant<'_>) -> f64 {
        let balanced = &self.model.balanced[b];
        if !balanced.contacts.is_empty() {
            return self.place_of(b, at);
        }
        let led = balanced.led.iter().map(|(other, a)| a * self.place_of(*other, at));
        self.pull(&balanced.pull, at).value + led.sum::<f64>()
    }

    /// Returns whether the normal load on coordinate `b` is zero or presses one of its contacts. Any load presses a body between floor and
    /// ceiling. A load of at most `rounding` (N) is judged by its change in time.
    pub(crate) fn presses(&self, b: usize, at: &Instant<'_>, rounding: f64) -> bool {
        let balanced = &self.model.balanced[b];
        let Sample { value, rate, acceleration } = self.pull(&balanced.pull, at);
        let ahead = self.model.moment;
        let push = if value.abs() > rounding { value } else { ahead * (rate + 0.5 * ahead * acceleration) };
        push == 0.0 || balanced.contacts.iter().any(|(_, a)| a * push > 0.0)
    }

    /// Returns the load on quasi-static coordinate `b` and the limit of its contacts, N; `None` if a spring or contact holds the load.
    ///
    /// The function `gone` returns whether a contact has reached its limit.
    pub(crate) fn given_way(
        &self,
        b: usize,
        at: &Instant<'_>,
        gone: impl Fn(usize) -> bool,
    ) -> Option<[f64; 2]> {
        let balanced = &self.model.balanced[b];
        if balanced.contacts.is_empty()
            || balanced.stiffness > 0.0
            || !balanced.contacts.iter().all(|(c, _)| gone(*c))
        {
            return None;
        }
        let limit = |c: usize| match balanced.axis {
            Axis::Z => 0.0,
            _ => {
                let contact = &self.model.contacts[c];
                let pressed = self.modes[c].press(contact, self.depth_of(contact, at).0)[0].max(0.0);
                contact.count * contact.interface.friction() * pressed
            }
        };
        let limit = balanced.contacts.iter().map(|(c, _)| limit(*c)).sum();
        Some([self.pull(&balanced.pull, at).value, limit])
    }
}
