//! The linear equations of a variation.

use super::anchors::Held;
use crate::Model;
use crate::contact::{Contact, Mode, Motion};
use crate::equations::Equations;
use crate::model::Measure;
use crate::state::Layout;
use stickslip_contact::Memory;
use stickslip_stepper::{Coefficients, Components};

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

/// (δu, δd) of a contact by each number, from the derivatives of the components.
pub(super) fn moved(contact: &Contact, columns: &[f64], layout: Layout) -> Vec<(f64, f64)> {
    let of = |measure: &Measure, column: &[f64]| measure.free.iter().map(|(i, a)| a * column[*i]).sum();
    let each = columns.chunks_exact(layout.dimension());
    each.map(|column| (of(&contact.u, column), contact.coupling().map_or(0.0, |d| of(d, column)))).collect()
}

/// Whether a contact in a mode acts on derivatives: in gross slip at a given depth its force is what it is.
pub(super) fn acts(contact: &Contact, mode: &Mode) -> bool {
    match mode {
        Mode::Open => false,
        _ if contact.coupling().is_some() => true,
        Mode::Slip(branch) => !branch.is_gross() && !contact.inert,
        Mode::Grow => true,
        Mode::Whole { .. } | Mode::Lull { .. } => false,
    }
}

/// What springs, dampers and actuators make of places and velocities: accelerations, row by row.
pub(super) fn links(model: &Model) -> Vec<f64> {
    let free = model.free.len();
    let mut matrix = vec![0.0; 2 * free * free];
    for link in &model.links {
        for (i, a) in &link.elongation.free {
            let row = &mut matrix[2 * free * i..2 * free * (i + 1)];
            let share = -model.free[*i].mobility * a;
            for (k, b) in &link.elongation.free {
                row[*k] += share * b * link.stiffness;
                row[free + k] += share * b * link.damping;
            }
        }
    }
    matrix
}

impl Stiffness {
    /// Of a contact by its law.
    fn of(contact: &Contact, (memory, mode): (&Memory, &Mode), motion: &Motion) -> Self {
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
                let across = match contact.coupling() {
                    Some(_) => branch.sense() * law.stick_slope() * (law.stick_stiffness(motion.d) - along),
                    None => 0.0,
                };
                Self { along, across, normal, front }
            }
            Mode::Open | Mode::Grow | Mode::Whole { .. } | Mode::Lull { .. } => {
                Self { normal, ..Self::default() }
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

/// The linear equations of an interval.
pub(super) struct Laws<'a> {
    pub(super) eq: Equations<'a>,
    /// What each contact holds, and those that act.
    pub(super) held: &'a [Held],
    pub(super) acting: &'a [usize],
    /// What [`links`] make.
    pub(super) links: &'a [f64],
    pub(super) components: Components,
    /// How many numbers.
    pub(super) count: usize,
}

impl Laws<'_> {
    /// The equations at a time, s, and where the motion is then.
    pub(super) fn lay_out(&self, (t, y): (f64, &[f64]), node: &mut Coefficients) {
        let Components { positions, rates, .. } = self.components;
        let wide = positions + rates;
        node.matrix.clear();
        node.matrix.resize(rates * wide, 0.0);
        if !self.eq.model.links.is_empty() {
            let rows = node.matrix.chunks_exact_mut(wide).zip(self.links.chunks_exact(2 * positions));
            rows.for_each(|(row, links)| row[..2 * positions].copy_from_slice(links));
        }
        node.forcing.clear();
        for c in self.acting {
            let contact = &self.eq.model.contacts[*c];
            let motion = self.eq.motion(contact, t, |i| y[i]);
            self.act(contact, &motion, node);
            if let (Some(slot), Mode::Grow) = (contact.slot, self.eq.law(*c).1) {
                self.grow((contact, slot), &motion, &mut node.matrix);
            }
        }
    }

    /// Adds what a contact does to each number's accelerations.
    fn act(&self, contact: &Contact, motion: &Motion, node: &mut Coefficients) {
        let law = self.eq.law(contact.place);
        let Stiffness { along, across, normal, front } = Stiffness::of(contact, law, motion);
        let wide = self.components.positions + self.components.rates;
        let slot = contact.slot.filter(|_| *law.1 == Mode::Grow);
        let held = &self.held[contact.place];
        let cut = held.at(contact.interface.profile(), front);
        if cut.is_some() && node.forcing.is_empty() {
            node.forcing.resize(self.components.rates * self.count, 0.0);
        }
        let across_to = contact.coupling().map_or(&[][..], |d| &d.free);
        for (i, a) in &contact.u.free {
            let share = -self.eq.model.free[*i].mobility * a * contact.count;
            let row = &mut node.matrix[i * wide..(i + 1) * wide];
            match slot {
                Some(slot) => row[self.eq.layout.force(slot)] += share,
                None => {
                    contact.u.free.iter().for_each(|(k, b)| row[*k] += share * along * b);
                    across_to.iter().for_each(|(k, b)| row[*k] += share * across * b);
                }
            }
            if let Some(cut) = &cut {
                let pull = share * contact.interface.tangential_modulus();
                let row = &mut node.forcing[i * self.count..(i + 1) * self.count];
                row.iter_mut().enumerate().for_each(|(j, x)| *x -= pull * held.sum(cut, j));
            }
        }
        for (i, a) in across_to {
            let share = -self.eq.model.free[*i].mobility * a * contact.count * normal;
            let row = &mut node.matrix[i * wide..(i + 1) * wide];
            across_to.iter().for_each(|(k, b)| row[*k] += share * b);
        }
    }

    /// How the force of a growing contact changes.
    fn grow(&self, (contact, slot): (&Contact, usize), motion: &Motion, matrix: &mut [f64]) {
        let Components { positions, rates, .. } = self.components;
        let (wide, layout, law) = (positions + rates, self.eq.layout, &contact.interface);
        let from = (layout.force(slot) - positions) * wide;
        let row = &mut matrix[from..from + wide];
        let stiffness = law.stick_stiffness(motion.d);
        contact.u.free.iter().for_each(|(k, b)| row[layout.velocity(*k)] += stiffness * b);
        let swell = law.tangential_modulus() * swelling(contact, motion.d) * motion.du;
        let across = contact.coupling().map_or(&[][..], |d| &d.free);
        across.iter().for_each(|(k, b)| row[*k] += swell * b);
    }
}
