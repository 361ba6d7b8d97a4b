//! Contacts in the precomputed forces of an interval.

use super::length::{Length, Row};
use crate::contact::{Contact, Motion, Press};
use crate::equations::{Equations, Sum};
use crate::interval::Closed;
use crate::model::Model;
use crate::state::State;
use crate::{Piece, Waveform};
use stickslip_contact::{Branch, FixedDepthBranch, Law, Profile};

/// Contact at constant indentation on one branch of its slip memory, with a closed-form force.
#[derive(Debug, Clone)]
pub(super) struct Steady<'a, R> {
    u: Length<'a, R>,
    count: f64,
    branch: FixedDepthBranch,
    profile: &'a Profile,
}

/// Motion of a contact, laid out flat.
#[derive(Debug, Clone)]
pub(crate) struct Lever<'a, R> {
    u: Length<'a, R>,
    depth: Depth<'a, R>,
}

/// Source of the indentation.
#[derive(Debug, Clone)]
enum Depth<'a, R> {
    /// Constant indentation d (m) with the reduced normal force M(d) (m²).
    Constant { d: f64, reduced_force: f64 },
    /// Motion of the bodies.
    Coupled(Length<'a, R>),
    /// Indentation prescribed by the present smooth piece of a waveform.
    Prescribed { waveform: &'a Waveform, piece: Piece },
}

/// Contact with variable indentation, damping or growth, whose force has no closed form in u alone.
#[derive(Debug, Clone)]
pub(super) struct Moving<'a, R> {
    pub(super) index: usize,
    contact: &'a Contact,
    lever: Lever<'a, R>,
    form: Form,
    /// Indices of its friction work, force and elastic energy in the state, if it may grow.
    slot: Option<[usize; 3]>,
}

/// Law of a contact in the forms of a kernel.
#[derive(Debug, Clone)]
enum Form {
    Slip(Branch),
    Grow,
    /// Full force law of the slip memory.
    Whole,
}

impl<'a, R: Row> Steady<'a, R> {
    pub(super) fn of(closed: &Closed<'a>) -> Self {
        let u = Length { row: R::of(&closed.contact.u.free), followed: closed.followed };
        let profile = closed.contact.interface.profile();
        Self { u, count: closed.contact.count, branch: closed.branch, profile }
    }

    /// Sets another branch of the slip memory.
    pub(super) fn renew(&mut self, branch: FixedDepthBranch) {
        self.branch = branch;
    }

    #[inline(always)]
    pub(super) fn act(&self, t: f64, x: &[f64], sum: &mut Sum<'_>) {
        let followed = self.u.followed.at(t);
        let force = self
            .u
            .row
            .act(x, sum.dv, |own| -self.count * self.branch.force(self.profile, own + followed.value));
        sum.input -= force * followed.rate;
    }
}

impl<'a, R: Row> Lever<'a, R> {
    /// Returns the motion of a contact without damping along the normal, if its prescribed parts have closed forms.
    pub(crate) fn of(contact: &'a Contact, model: &'a Model, state: &State) -> Option<Self> {
        // The motion of a row depends on its law.
        if contact.normal_damping > 0.0 || !contact.engine.branches() || model.free.is_empty() {
            return None;
        }
        let depth = match &contact.press {
            Press::Constant { d, reduced_force } => Depth::Constant { d: *d, reduced_force: *reduced_force },
            Press::Coupled(measure) => Depth::Coupled(Length::of(measure, model, state)?),
            // Outputs of blocks have no piece.
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => {
                Depth::Prescribed { waveform: model.waveforms.get(*w)?, piece: *state.pieces.get(*w)? }
            }
        };
        Some(Self { u: Length::of(&contact.u, model, state)?, depth })
    }

    /// Returns the motion of the contact at time t (s) with positions x and velocities v.
    #[inline(always)]
    pub(crate) fn motion(&self, contact: &Contact, t: f64, (x, v): (&[f64], &[f64])) -> Motion {
        let u = self.u.at(t, x, Some(v));
        let (d, dd) = match &self.depth {
            Depth::Constant { d, .. } => (*d, 0.0),
            Depth::Coupled(length) => {
                let d = length.at(t, x, Some(v));
                (d.value, d.rate)
            }
            Depth::Prescribed { waveform, piece } => contact.pressed(waveform.sample(piece, t), None),
        };
        Motion { d, u: u.value, dd, du: u.rate }
    }

    /// Returns d̈ and ü, m/s², from the accelerations of the coordinates. A waveform that presses the contact directly is not included.
    #[inline(always)]
    pub(crate) fn second(&self, t: f64, a: &[f64]) -> (f64, f64) {
        let bend = match &self.depth {
            Depth::Coupled(length) => length.bend(t, a),
            Depth::Constant { .. } | Depth::Prescribed { .. } => 0.0,
        };
        (bend, self.u.bend(t, a))
    }
}

impl<'a, R: Row> Moving<'a, R> {
    /// Returns the contact under a law; `None` for laws that only the general equations have.
    pub(super) fn of(index: usize, model: &'a Model, state: &State, grows: bool) -> Option<Self> {
        let contact = &model.contacts[index];
        let straight = contact.goes_straight(&state.pieces);
        let layout = model.layout();
        let slot = contact.slot.filter(|_| grows && !straight);
        let slot = slot.map(|slot| [layout.friction(slot), layout.force(slot), layout.elastic(slot)]);
        let form = match Form::of(&state.modes[index], slot.is_some()) {
            None if !grows && state.modes[index].is_whole() && !contact.inert => Form::Whole,
            form => form?,
        };
        Some(Self { index, contact, lever: Lever::of(contact, model, state)?, form, slot })
    }

    /// Sets another law. Returns false if only the general equations have it.
    pub(super) fn renew(&mut self, law: &Law) -> bool {
        let form = Form::of(law, self.slot.is_some());
        let has_form = form.is_some();
        self.form = form.unwrap_or(Form::Grow);
        has_form
    }

    /// Adds the contact forces: normal -count·E\*M(d) along d, if bodies press the contact, and tangential -count·F_x with damping along u.
    #[inline(always)]
    pub(super) fn act(
        &self,
        (eq, y): (&Equations<'_>, &[f64]),
        t: f64,
        (x, v): (&[f64], &[f64]),
        (sum, extra): (&mut Sum<'_>, &mut [f64]),
    ) {
        let (contact, v, n) = (self.contact, Some(v), x.len());
        let u = self.lever.u.at(t, x, v);
        let law = &contact.interface;
        let (d, dd, reduced_force) = match &self.lever.depth {
            Depth::Constant { d, reduced_force } => (*d, 0.0, *reduced_force),
            Depth::Coupled(length) => {
                let d = length.at(t, x, v);
                let reduced_force = law.reduced_force(d.value);
                let press = contact.count * (law.normal_modulus() * reduced_force);
                sum.along(&length.row, d.driven, -press);
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
                    extra[friction - 2 * n] = power;
                    force
                }
                None => branch.force(law, d, u.value, reduced_force),
            },
            Form::Whole => eq.memories[self.index].force(law, motion.apex()),
            // During growth, and where the branch does not apply, the memory computes the force.
            _ => self.ask((eq, y), &motion, extra),
        };
        let force = if law.damping() > 0.0 {
            let (memory, law) = eq.law(self.index);
            let [force, damping] = law.damped((contact, memory), &motion, force);
            // Dissipated in sticking springs, separate from friction. Steps of fixed length integrate it along their paths.
            if eq.layout.located {
                sum.damping += contact.count * damping * motion.du;
            }
            force
        } else {
            force
        };
        sum.along(&self.lever.u.row, u.driven, -contact.count * force);
    }

    /// Returns the force (N) of one contact from its slip memory, and writes the derivatives of its states.
    #[inline(never)]
    fn ask(&self, (eq, y): (&Equations<'_>, &[f64]), motion: &Motion, extra: &mut [f64]) -> f64 {
        let (contact, (memory, law)) = (self.contact, eq.law(self.index));
        let grown = || self.slot.map_or(0.0, |[_, force, _]| y[force]);
        let force = law.force((contact, memory), motion, grown);
        if let Some(places) = self.slot {
            let rates = law.growth_rates((contact, memory), motion, force);
            for (place, rate) in places.into_iter().zip([rates.friction, rates.force, rates.elastic]) {
                extra[place - 2 * eq.layout.free] = rate;
            }
        }
        force
    }
}

impl Form {
    fn of(law: &Law, has_slot: bool) -> Option<Self> {
        match law.branch() {
            Some(branch) => Some(Self::Slip(*branch)),
            // Otherwise the memory computes the force.
            None => (law.grows() && has_slot).then_some(Self::Grow),
        }
    }
}
