//! Static forces on the free coordinates and their derivatives (stiffness matrix).

use super::Settling;
use crate::contact::Contact;
use crate::equations::Components;
use crate::model::Measure;
use crate::state::State;
use nalgebra::{DMatrix, DVector};
use stickslip_contact::{Apex, Memory, Move};

/// Static forces on the free coordinates, N or N m.
#[derive(Debug, Clone)]
pub(super) struct Statics {
    /// Sum of the forces on each coordinate.
    pub(super) net: DVector<f64>,
    /// Sum of the magnitudes of the forces, with friction at its limit; the reference for an imbalance.
    pub(super) acting: DVector<f64>,
    /// Rounding of the forces.
    pub(super) noise: DVector<f64>,
    /// Largest constant part of a displacement between bodies, m.
    constant: f64,
    /// Stiffness matrix -∂F/∂q.
    pub(super) stiffness: DMatrix<f64>,
}

impl Statics {
    /// Adds a force along a displacement between bodies; `size` is the magnitude that counts for the reference.
    fn push(&mut self, along: &Measure, force: f64, size: f64) {
        for &(i, a) in &along.free {
            self.net[i] += a * force;
            self.acting[i] += (a * size).abs();
        }
    }

    /// Adds a stiffness k: a force along one displacement per change of another displacement.
    fn stiffen(&mut self, along: &Measure, with: &Measure, k: f64, y: &[f64]) {
        let size: f64 = with.constant.abs() + with.free.iter().map(|&(j, b)| (b * y[j]).abs()).sum::<f64>();
        self.constant = self.constant.max(with.constant.abs());
        for &(i, a) in &along.free {
            self.noise[i] += 4.0 * f64::EPSILON * size * (a * k).abs();
            with.free.iter().for_each(|&(j, b)| self.stiffness[(i, j)] += a * b * k);
        }
    }

    /// Returns the rounding of the sum of forces on a group of coordinates at y; internal forces cancel.
    pub(super) fn noise_together(&self, group: &[usize], y: &[f64]) -> f64 {
        let stiffness = |j: usize| group.iter().map(|i| self.stiffness[(*i, j)]).sum::<f64>().abs();
        let noise = |(j, y): (usize, &f64)| stiffness(j) * (self.constant + y.abs());
        4.0 * f64::EPSILON * y[..self.net.len()].iter().enumerate().map(noise).sum::<f64>()
    }
}

impl Settling<'_> {
    /// Returns the static forces for given positions y of the free coordinates, which the contacts reach on straight paths.
    ///
    /// Loads, contact forces, links and waveforms are taken at t = 0; the slip memories are not changed. A stiffness is positive if its
    /// force opposes the displacement.
    pub(super) fn statics(&self, state: &State, y: &[f64]) -> Statics {
        let (model, eq) = (self.model, self.model.equations(state));
        let n = model.free.len();
        let loads = DVector::from_iterator(n, model.free.iter().map(|f| f.force));
        let (acting, noise) = (loads.abs(), DVector::zeros(n));
        let mut statics =
            Statics { net: loads, acting, noise, constant: 0.0, stiffness: DMatrix::zeros(n, n) };
        let mut answers = self.answers.borrow_mut();
        let contacts = model.contacts.iter().zip(&state.memories).zip(self.apexes(state, y));
        for (((contact, memory), to), answer) in contacts.zip(answers.iter_mut()) {
            if !answer.is_at(to) {
                *answer = Answer::of(contact, memory, to);
            }
            let Answer { tangents, pressing, .. } = *answer;
            let count = contact.count;
            // The reference uses the possible friction force, as the actual one may be near zero. A coefficient above 1 counts as
            // 1.
            let limit = contact.interface.friction().min(1.0) * pressing;
            statics.push(&contact.u, -count * tangents.force, count * tangents.force.abs().max(limit));
            statics.stiffen(&contact.u, &contact.u, count * tangents.along, y);
            if let Some(normal) = contact.coupling() {
                let force = count * pressing;
                statics.push(normal, -force, force);
                statics.stiffen(normal, normal, count * answer.stiffness, y);
                // F_x depends on d but F_N not on u: the matrix is not symmetric.
                statics.stiffen(&contact.u, normal, count * tangents.across, y);
            }
        }
        for link in &model.links {
            let elongation = eq.read(&link.elongation, &Components { t: 0.0, y: |i: usize| y[i] }).value;
            let stroke = eq.stroke(link, &Components { t: 0.0, y: |i: usize| y[i] }).value;
            let stretch = stroke - elongation;
            // Dampers have no force at rest.
            let force = link.stiffness * stretch;
            statics.push(&link.elongation, force + link.preload, force.abs() + link.preload.abs());
            statics.stiffen(&link.elongation, &link.elongation, link.stiffness, y);
        }
        for load in &model.loads {
            let force = load.arm * eq.sample(load.waveform, 0.0).value;
            statics.net[load.free] += force;
            statics.acting[load.free] += force.abs();
        }
        statics
    }

    /// Returns indentation d and displacement u of all contacts for positions y of the free coordinates.
    pub(super) fn apexes<'a>(&'a self, state: &'a State, y: &'a [f64]) -> impl Iterator<Item = Apex> + 'a {
        let eq = self.model.equations(state);
        self.model.contacts.iter().zip(&self.depths).map(move |(contact, depth)| {
            let at = Components { t: 0.0, y: |i: usize| y[i] };
            let d = contact.coupling().map_or(*depth, |measure| eq.read(measure, &at).value);
            Apex { d, u: eq.read(&contact.u, &at).value }
        })
    }
}

/// Cached force and stiffness of a contact at the end of a straight path; valid while slip memory and end point are unchanged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answer {
    to: Apex,
    tangents: Tangents,
    /// F_N, N.
    pressing: f64,
    /// Normal stiffness dF_N/dd, N/m; 0 if no body presses the contact.
    stiffness: f64,
}

impl Answer {
    /// Empty cache entry: its end point is NaN, which never equals another one.
    pub(super) const NONE: Self = Self {
        to: Apex { d: f64::NAN, u: f64::NAN },
        tangents: Tangents { force: 0.0, along: 0.0, across: 0.0 },
        pressing: 0.0,
        stiffness: 0.0,
    };

    fn of(contact: &Contact, memory: &Memory, to: Apex) -> Self {
        let law = &contact.interface;
        let stiffness = contact.coupling().map_or(0.0, |_| law.normal_stiffness(to.d));
        Self { to, tangents: tangents(contact, memory, to), pressing: law.normal_force(to.d), stiffness }
    }

    fn is_at(&self, to: Apex) -> bool {
        self.to.d.to_bits() == to.d.to_bits() && self.to.u.to_bits() == to.u.to_bits()
    }
}

/// Tangential force F_x of one contact at the end of a straight path (N), and its derivatives with respect to the end point (N/m).
#[derive(Debug, Clone, Copy, Default)]
struct Tangents {
    force: f64,
    /// Derivative with respect to u at constant d.
    along: f64,
    /// Derivative with respect to d at constant u.
    across: f64,
}

/// Returns the tangential force at the end of a straight path (chord), with derivatives. A chord with growing d in full stick adds the
/// force G\*(Δu/Δd)ΔM. Its derivatives with respect to the chord's end differ from the stiffness beyond the end.
fn tangents(contact: &Contact, memory: &Memory, to: Apex) -> Tangents {
    if contact.inert {
        return Tangents::default();
    }
    let (law, from) = (&contact.interface, memory.apex());
    let response = memory.trial(law, Move::Chord(to));
    // Displacements from the memory's position; without any, the derivatives are those of continuing.
    let (rise, shift) = (to.d - from.d, to.u - from.u);
    let (mut along, mut across) = (response.stiffness, response.coupling);
    // For a short chord differences would be rounding.
    if to.d > 0.0 && shift.abs() <= law.stick_slope() * rise && rise > SHORT * to.d {
        along = law.tangential_modulus() * (law.reduced_force(to.d) - law.reduced_force(from.d)) / rise;
        across = shift / rise * (law.stick_stiffness(to.d) - along);
    }
    Tangents { force: response.force, along, across }
}

/// Relative growth of d below which a straight path counts as its end point.
const SHORT: f64 = 1e-6;
