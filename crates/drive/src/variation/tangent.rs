//! The linear equations of a variation.

use super::anchors::{Anchors, Held};
use crate::contact::{Contact, Mode, Motion};
use crate::equations::Equations;
use crate::model::Measure;
use crate::state::Layout;
use stickslip_contact::Memory;
use stickslip_stepper::System;

/// The law of a contact until the next event, and what it holds.
pub(super) struct Tangent<'a> {
    contact: &'a Contact,
    law: (&'a Memory, &'a Mode),
    held: Held,
}

/// How the force of one contact changes at a moment.
#[derive(Clone, Copy, Default)]
struct Stiffness {
    /// ∂F_x/∂u and ∂F_x/∂d, N/m.
    along: f64,
    across: f64,
    /// ∂F_N/∂d where the bodies press it, N/m.
    normal: f64,
    /// Height below which springs stick, m.
    front: f64,
}

impl<'a> Tangent<'a> {
    /// Those of all contacts, on the laws of the equations.
    pub(super) fn all(eq: &Equations<'a>, anchors: &[Anchors]) -> Vec<Self> {
        let contacts = eq.model.contacts.iter().zip(anchors).enumerate();
        let of = |(c, (contact, anchors)): (usize, (&'a Contact, &Anchors))| {
            let law = eq.law(c);
            let held = if contact.inert { Held::default() } else { Held::of(anchors, contact, law.0) };
            Self { contact, law, held }
        };
        contacts.map(of).collect()
    }

    /// (δu, δd) of a contact by each number, from the derivatives of the components.
    pub(super) fn moved(contact: &Contact, columns: &[f64], layout: Layout) -> Vec<(f64, f64)> {
        let of = |measure: &Measure, column: &[f64]| measure.free.iter().map(|(i, a)| a * column[*i]).sum();
        let each = columns.chunks_exact(layout.dimension());
        each.map(|column| (of(&contact.u, column), contact.coupling().map_or(0.0, |d| of(d, column))))
            .collect()
    }

    fn stiffness(&self, motion: &Motion) -> Stiffness {
        let (contact, (memory, mode)) = (self.contact, self.law);
        let law = &contact.interface;
        let normal = match mode {
            Mode::Open => 0.0,
            _ if contact.coupling().is_none() => 0.0,
            _ => law.normal_stiffness(motion.d),
        };
        match mode {
            Mode::Slip(branch) => {
                let front = if branch.is_gross() { 0.0 } else { contact.front(memory, branch, motion) };
                let along = law.stick_stiffness(front);
                let across = branch.sense() * law.stick_slope() * (law.stick_stiffness(motion.d) - along);
                Stiffness { along, across, normal, front }
            }
            Mode::Open | Mode::Grow | Mode::Whole { .. } | Mode::Lull { .. } => {
                Stiffness { normal, ..Stiffness::default() }
            }
        }
    }

    /// Adds what the contact does to each number's slopes.
    fn act(&self, varied: &Varied<'_>, (t, y): (f64, &[f64]), dy: &mut [f64]) {
        let (contact, layout) = (self.contact, varied.eq.layout);
        if *self.law.1 == Mode::Open {
            return;
        }
        let motion = varied.eq.motion(contact, t, |i| y[i]);
        let Stiffness { along, across, normal, front } = self.stiffness(&motion);
        let (law, grows) = (&contact.interface, contact.slot.filter(|_| *self.law.1 == Mode::Grow));
        let (modulus, profile) = (law.tangential_modulus(), law.profile());
        let cut = self.held.at(profile, front);
        let swell = if grows.is_some() { swelling(contact, motion.d) } else { 0.0 };
        let columns = y[varied.dimension..].chunks_exact(varied.dimension);
        let slopes = dy[varied.dimension..].chunks_exact_mut(varied.dimension);
        for (j, (column, slope)) in columns.zip(slopes).enumerate() {
            let of = |measure: &Measure, from: usize| -> f64 {
                measure.free.iter().map(|(i, a)| a * column[from + i]).sum()
            };
            let du = of(&contact.u, 0);
            let dd = contact.coupling().map_or(0.0, |d| of(d, 0));
            let mut force =
                along * du + across * dd - modulus * cut.map_or(0.0, |cut| self.held.sum(&cut, j));
            if let Some(slot) = grows {
                force = column[layout.force(slot)];
                let rate = of(&contact.u, layout.free);
                slope[layout.force(slot)] =
                    law.stick_stiffness(motion.d) * rate + modulus * swell * motion.du * dd;
            }
            let push = |slope: &mut [f64], measure: &Measure, force: f64| {
                measure.free.iter().for_each(|(i, a)| slope[layout.velocity(*i)] -= a * force);
            };
            push(slope, &contact.u, contact.count * force);
            if let Some(d) = contact.coupling() {
                push(slope, d, contact.count * normal * dd);
            }
        }
    }
}

/// m'(d): the contact length grows by twice what the radius does, dg/da = 1/a'.
fn swelling(contact: &Contact, d: f64) -> f64 {
    let profile = contact.interface.profile();
    let slope = profile.depth_slope(profile.radius(d));
    if slope > 0.0 && slope.is_finite() { 2.0 / slope } else { 0.0 }
}

/// A motion and its derivatives, one after the other.
pub(super) struct Varied<'a> {
    pub(super) eq: Equations<'a>,
    pub(super) tangents: Vec<Tangent<'a>>,
    /// Components of the motion.
    pub(super) dimension: usize,
    /// How many numbers.
    pub(super) count: usize,
}

impl Varied<'_> {
    /// Springs, dampers and actuators.
    fn links(&self, y: &[f64], dy: &mut [f64]) {
        let layout = self.eq.layout;
        for link in &self.eq.model.links {
            let columns = y[self.dimension..].chunks_exact(self.dimension);
            for (column, slope) in columns.zip(dy[self.dimension..].chunks_exact_mut(self.dimension)) {
                let mut force = 0.0;
                for (i, a) in &link.elongation.free {
                    force -= a * (link.stiffness * column[*i] + link.damping * column[layout.velocity(*i)]);
                }
                for (i, a) in &link.elongation.free {
                    slope[layout.velocity(*i)] += a * force;
                }
            }
        }
    }
}

impl System for Varied<'_> {
    fn dimension(&self) -> usize {
        self.dimension * (1 + self.count)
    }

    fn positions(&self) -> usize {
        0
    }

    fn total(&self) -> usize {
        self.dimension().max(self.eq.total())
    }

    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let (layout, all) = (self.eq.layout, self.dimension());
        self.eq.slopes(t, &y[..self.dimension], dy);
        // The integrals of work are not led along.
        dy[self.dimension..].fill(0.0);
        for tangent in &self.tangents {
            tangent.act(self, (t, &y[..all]), &mut dy[..all]);
        }
        self.links(&y[..all], &mut dy[..all]);
        let columns = y[self.dimension..all].chunks_exact(self.dimension);
        for (column, slope) in columns.zip(dy[self.dimension..all].chunks_exact_mut(self.dimension)) {
            for (i, free) in self.eq.model.free.iter().enumerate() {
                slope[i] = column[layout.velocity(i)];
                slope[layout.velocity(i)] *= free.mobility;
            }
        }
    }
}
