//! Contacts in the precomputed forces of an interval.

use super::length::{Length, Sums, dot, row};
use crate::contact::{Contact, Motion, Press};
use crate::equations::Equations;
use crate::interval::Closed;
use crate::model::Model;
use crate::state::State;
use crate::{Piece, Waveform};
use stickslip_contact::{Branch, FixedDepthBranch, Profile};

/// Contact at constant indentation on one branch of its slip memory, with a closed-form force.
#[derive(Debug, Clone)]
pub(super) struct Steady<'a> {
    u: Length<'a>,
    count: f64,
    branch: FixedDepthBranch,
    profile: &'a Profile,
}

/// Contact with variable indentation, damping or growth, whose force has no closed form in u alone.
#[derive(Debug, Clone)]
pub(super) struct Moving<'a> {
    index: usize,
    contact: &'a Contact,
    u: Length<'a>,
    depth: Depth<'a>,
    form: Form,
    /// Indices of its friction work, force and elastic energy in the state, if it may grow.
    slot: Option<[usize; 3]>,
}

/// Source of the indentation.
#[derive(Debug, Clone)]
enum Depth<'a> {
    /// Constant indentation d (m) with the reduced normal force M(d) (m²).
    Constant { d: f64, reduced_force: f64 },
    /// Motion of the bodies.
    Coupled(Length<'a>),
    /// Indentation prescribed by the present smooth piece of a waveform.
    Prescribed { waveform: &'a Waveform, piece: Piece },
}

/// Law of a contact in the forms of a kernel.
#[derive(Debug, Clone)]
enum Form {
    Slip(Branch),
    Grow,
}

impl<'a> Steady<'a> {
    pub(super) fn of(closed: &Closed<'a>) -> Self {
        let u = Length { row: row(&closed.contact.u.free), followed: closed.followed };
        let profile = closed.contact.interface.profile();
        Self { u, count: closed.contact.count, branch: closed.branch, profile }
    }

    /// Sets another branch of the slip memory.
    pub(super) fn renew(&mut self, branch: FixedDepthBranch) {
        self.branch = branch;
    }

    #[inline(always)]
    pub(super) fn act<const N: usize>(&self, t: f64, x: &[f64; N], sums: &mut Sums<N>) {
        let followed = self.u.followed.at(t);
        let u = dot(&self.u.row, x) + followed.value;
        sums.apply(&self.u.row, followed.rate, -self.count * self.branch.force(self.profile, u));
    }
}

impl<'a> Moving<'a> {
    pub(super) fn of(index: usize, model: &'a Model, state: &State) -> Option<Self> {
        let contact = &model.contacts[index];
        if contact.normal_damping > 0.0 {
            return None;
        }
        let depth = match &contact.press {
            Press::Constant { d, reduced_force } => Depth::Constant { d: *d, reduced_force: *reduced_force },
            Press::Coupled(measure) => Depth::Coupled(Length::of(measure, model, state)?),
            // Without growth only accelerations may be evaluated, which this form does not support.
            Press::Force(_) | Press::Indentation(_) | Press::Radius(_) if contact.slot.is_none() => {
                return None;
            }
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => {
                // Outputs of blocks have no piece.
                Depth::Prescribed { waveform: model.waveforms.get(*w)?, piece: *state.pieces.get(*w)? }
            }
        };
        let straight = contact.goes_straight(&state.pieces);
        let layout = model.layout();
        let slot = contact.slot.filter(|_| !straight);
        let law = &state.modes[index];
        let form = match law.branch() {
            Some(branch) => Form::Slip(*branch),
            // Otherwise the memory computes the force.
            None if law.grows() && slot.is_some() => Form::Grow,
            None => return None,
        };
        let u = Length::of(&contact.u, model, state)?;
        let slot = slot.map(|slot| [layout.friction(slot), layout.force(slot), layout.elastic(slot)]);
        Some(Self { index, contact, u, depth, form, slot })
    }

    /// Adds the contact forces: normal -count·E\*M(d) along d, if bodies press the contact, and tangential -count·F_x with damping along u.
    #[inline(always)]
    pub(super) fn act<const N: usize>(
        &self,
        (eq, y): (&Equations<'_>, &[f64]),
        t: f64,
        at: (&[f64; N], &[f64; N]),
        (sums, extra): (&mut Sums<N>, &mut [f64]),
    ) {
        let (contact, u) = (self.contact, self.u.at(t, at));
        let law = &contact.interface;
        let (d, dd, reduced_force) = match &self.depth {
            Depth::Constant { d, reduced_force } => (*d, 0.0, *reduced_force),
            Depth::Coupled(length) => {
                let d = length.at(t, at);
                let reduced_force = law.reduced_force(d.value);
                let press = contact.count * (law.normal_modulus() * reduced_force);
                sums.apply(&length.row, d.driven, -press);
                (d.value, d.rate, reduced_force)
            }
            Depth::Prescribed { waveform, piece } => {
                let (d, dd) = contact.pressed(waveform.sample(piece, t), None);
                (d, dd, law.reduced_force(d))
            }
        };
        let motion = Motion { d, u: u.value, dd, du: u.rate };
        let force = match &self.form {
            Form::Slip(branch) if branch.covers(d, u.value) => match self.slot {
                Some([friction, ..]) => {
                    let [force, power] = branch.drag(law, &motion, reduced_force);
                    extra[friction - 2 * N] = power;
                    force
                }
                None => branch.force(law, d, u.value, reduced_force),
            },
            // During growth, and where the branch does not apply, the memory computes the force.
            _ => self.ask::<N>((eq, y), &motion, extra),
        };
        let force = if law.damping() > 0.0 {
            let (memory, law) = eq.law(self.index);
            let [force, damping] = law.damped((contact, memory), &motion, force);
            // Dissipated in sticking springs, separate from friction. Steps of fixed length integrate it along their paths.
            if eq.layout.located {
                sums.damping += contact.count * damping * motion.du;
            }
            force
        } else {
            force
        };
        sums.apply(&self.u.row, u.driven, -contact.count * force);
    }

    /// Returns the force (N) of one contact from its slip memory, and writes the derivatives of its states.
    #[inline(never)]
    fn ask<const N: usize>(
        &self,
        (eq, y): (&Equations<'_>, &[f64]),
        motion: &Motion,
        extra: &mut [f64],
    ) -> f64 {
        let (contact, (memory, law)) = (self.contact, eq.law(self.index));
        let grown = || self.slot.map_or(0.0, |[_, force, _]| y[force]);
        let force = law.force((contact, memory), motion, grown);
        if let Some(places) = self.slot {
            let rates = law.growth_rates((contact, memory), motion, force);
            for (place, rate) in places.into_iter().zip([rates.friction, rates.force, rates.elastic]) {
                extra[place - 2 * N] = rate;
            }
        }
        force
    }
}
