//! The static forces on the free coordinates, and how they change.

use super::Settling;
use crate::contact::Contact;
use crate::equations::Components;
use crate::model::Measure;
use crate::state::State;
use nalgebra::{DMatrix, DVector};
use stickslip_contact::{Apex, Memory, Move};

/// Forces on the free coordinates at rest, N or N m.
#[derive(Debug, Clone)]
pub(super) struct Statics {
    /// Their sum on each coordinate.
    pub(super) net: DVector<f64>,
    /// The sum of their magnitudes, friction at its limit: what an imbalance is measured against.
    pub(super) acting: DVector<f64>,
    /// What rounding of the coordinates makes of them.
    pub(super) noise: DVector<f64>,
    /// The largest length that lies between places of no free coordinate, m.
    constant: f64,
    /// -∂F/∂q.
    pub(super) stiffness: DMatrix<f64>,
}

impl Statics {
    /// A force along a measure that could as well have another size.
    fn push(&mut self, along: &Measure, force: f64, size: f64) {
        for &(i, a) in &along.free {
            self.net[i] += a * force;
            self.acting[i] += (a * size).abs();
        }
    }

    /// Forces along a measure that fall by k per metre of another.
    fn stiffen(&mut self, along: &Measure, with: &Measure, k: f64, y: &[f64]) {
        let size: f64 = with.constant.abs() + with.free.iter().map(|&(j, b)| (b * y[j]).abs()).sum::<f64>();
        self.constant = self.constant.max(with.constant.abs());
        for &(i, a) in &along.free {
            self.noise[i] += 4.0 * f64::EPSILON * size * (a * k).abs();
            with.free.iter().for_each(|&(j, b)| self.stiffness[(i, j)] += a * b * k);
        }
    }

    /// What rounding of the coordinates, at y, makes of the sum of the forces on some of them: that of what acts between these cancels.
    pub(super) fn noise_together(&self, group: &[usize], y: &[f64]) -> f64 {
        let stiffness = |j: usize| group.iter().map(|i| self.stiffness[(*i, j)]).sum::<f64>().abs();
        let noise = |(j, y): (usize, &f64)| stiffness(j) * (self.constant + y.abs());
        4.0 * f64::EPSILON * y[..self.net.len()].iter().enumerate().map(noise).sum::<f64>()
    }
}

impl Settling<'_> {
    /// The forces with the free coordinates at y, the contacts on straight paths from where they stand.
    ///
    /// Loads, contacts (normal and tangential), links and waveforms at t = 0; nothing is committed. The
    /// stiffness has the sign of springs: positive where a force falls with the way.
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
            // What could act counts, not what does: near F_x = 0 a contact would else ask for a balance to
            // more digits than there are. A coefficient above 1 makes no force that its load does not.
            let limit = contact.interface.friction().min(1.0) * pressing;
            statics.push(&contact.u, -count * tangents.force, count * tangents.force.abs().max(limit));
            statics.stiffen(&contact.u, &contact.u, count * tangents.along, y);
            if let Some(normal) = contact.coupling() {
                let force = count * pressing;
                statics.push(normal, -force, force);
                statics.stiffen(normal, normal, count * answer.stiffness, y);
                // Deeper contacts hold harder: F_x depends on d, but F_N not on u, and the matrix is not
                // symmetric.
                statics.stiffen(&contact.u, normal, count * tangents.across, y);
            }
        }
        for link in &model.links {
            let elongation = eq.read(&link.elongation, &Components { t: 0.0, y: |i: usize| y[i] }).value;
            let stroke = eq.stroke(link, &Components { t: 0.0, y: |i: usize| y[i] }).value;
            let stretch = stroke - elongation;
            // Without its dampers: nothing moves.
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

    /// Where the contacts are with the free coordinates at y.
    pub(super) fn apexes<'a>(&'a self, state: &'a State, y: &'a [f64]) -> impl Iterator<Item = Apex> + 'a {
        let eq = self.model.equations(state);
        self.model.contacts.iter().zip(&self.depths).map(move |(contact, depth)| {
            let at = Components { t: 0.0, y: |i: usize| y[i] };
            let d = contact.coupling().map_or(*depth, |measure| eq.read(measure, &at).value);
            Apex { d, u: eq.read(&contact.u, &at).value }
        })
    }
}

/// What one contact answers at the end of a chord; the same as long as its memory stays and the end is the same to the last bit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answer {
    to: Apex,
    tangents: Tangents,
    /// F_N, N.
    pressing: f64,
    /// dF_N/dd, N/m; 0 where no body presses.
    stiffness: f64,
}

impl Answer {
    /// None yet: no end is not a number.
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

/// F_x of one contact at the end of a chord (N) and its derivatives with respect to that end (N/m).
#[derive(Debug, Clone, Copy, Default)]
struct Tangents {
    force: f64,
    /// With u at constant d.
    along: f64,
    /// With d at constant u.
    across: f64,
}

/// A chord that grows in stick adds G\*(Δu/Δd)ΔM: another end makes another chord, so its tangents are not those of
/// going on from there. From high above the ground they differ by orders of magnitude.
fn tangents(contact: &Contact, memory: &Memory, to: Apex) -> Tangents {
    if contact.inert {
        return Tangents::default();
    }
    let (law, from) = (&contact.interface, memory.apex());
    let response = memory.trial(law, Move::Chord(to));
    // The way from where the memory stands; no way at all has the tangents of going on.
    let (rise, shift) = (to.d - from.d, to.u - from.u);
    let (mut along, mut across) = (response.stiffness, response.coupling);
    // A short chord is as good as its end, and differences would be rounding.
    if to.d > 0.0 && shift.abs() <= law.stick_slope() * rise && rise > SHORT * to.d {
        along = law.tangential_modulus() * (law.reduced_force(to.d) - law.reduced_force(from.d)) / rise;
        across = shift / rise * (law.stick_stiffness(to.d) - along);
    }
    Tangents { force: response.force, along, across }
}

/// Growth of a contact, in parts of its depth, that is too short to tell a chord from its end.
// It need not be sharp: no start differs at 1e-5 or 1e-7.
const SHORT: f64 = 1e-6;
