//! What of a contact moves with a number of its scene.

use super::levers::{Levers, Moved};
use super::{Beside, Moment, Parameter, sampled};
use crate::contact::{Contact, Motion, Press};
use crate::model::Measure;
use crate::{Model, Sample, State};
use stickslip_contact::{Memory, Profile};

/// How the constants of a contact move.
#[derive(Debug, Clone)]
pub(super) struct ContactRates {
    /// Where it lies: levers of u, and of d where its bodies press it.
    slide: Levers,
    depth: Levers,
    /// Constants of u and d, m.
    u: f64,
    d: f64,
    /// G\* and E\*, each as a share of it.
    tangential: f64,
    normal: f64,
    /// κ.
    slope: f64,
    profile: bool,
    /// Whether what presses it moves, by its waveform alone or also by the law.
    follows: bool,
    presses: bool,
    /// Whether anything of it moves.
    any: bool,
}

/// How far a contact is moved at a moment where its bodies stand as they do.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::variation) struct Shift {
    pub(in crate::variation) u: f64,
    pub(in crate::variation) d: f64,
    /// By which its rate of sliding changes, m/s.
    pub(in crate::variation) du: f64,
    /// What followers make of that, and of the rate of its depth where bodies press it, m/s.
    pub(in crate::variation) driven: [f64; 2],
}

impl ContactRates {
    pub(super) fn of(contact: &Contact, beside: &Beside, waveforms: &[bool]) -> Self {
        let (c, law) = (contact.place, &contact.interface);
        let rate = |of: fn(&Contact) -> f64| beside.rate(|other| of(&other.contacts[c]));
        let profile = beside.models.iter().any(|it| it.contacts[c].interface.profile() != law.profile());
        let normal = rate(|it| it.interface.normal_modulus()) / law.normal_modulus();
        let moves = contact.press.waveform().is_some_and(|w| waveforms[w]);
        let rates = Self {
            slide: Levers::of(beside, |other| Some(&other.contacts[c].u)),
            depth: Levers::of(beside, |other| other.contacts[c].coupling()),
            u: rate(|it| it.u.constant),
            d: rate(|it| match &it.press {
                Press::Constant { d, .. } => *d,
                Press::Coupled(measure) => measure.constant,
                Press::Force(_) | Press::Indentation(_) | Press::Radius(_) => 0.0,
            }),
            tangential: rate(|it| it.interface.tangential_modulus()) / law.tangential_modulus(),
            normal,
            slope: rate(|it| it.interface.stick_slope()),
            profile,
            follows: moves,
            presses: profile || normal != 0.0,
            any: false,
        };
        let Self { u, d, tangential, slope, presses, .. } = rates;
        let is_elsewhere = rates.slide.any() || rates.depth.any();
        let follows = |measure: &Measure| measure.driven.iter().any(|(w, _)| waveforms[*w]);
        let any = [u, d, tangential, slope].iter().any(|rate| *rate != 0.0)
            || presses
            || moves
            || is_elsewhere
            || follows(&contact.u)
            || contact.coupling().is_some_and(follows);
        Self { any, ..rates }
    }
}

impl Parameter {
    /// How a contact is moved.
    pub(in crate::variation) fn shift(&self, contact: &Contact, at: Moment<'_>) -> Shift {
        let (c, rates) = (contact.place, &self.contacts[contact.place]);
        if !rates.any {
            return Shift::default();
        }
        let still = |value: f64| Moved { value, ..Moved::default() };
        let slide = self.moved((&contact.u, &rates.slide), at);
        let depth = match &contact.press {
            Press::Constant { .. } => still(rates.d),
            Press::Coupled(measure) => {
                let moved = self.moved((measure, &rates.depth), at);
                Moved { value: rates.d + moved.value, ..moved }
            }
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) if rates.presses => {
                let d = |other: &Model| other.contacts[c].pressed(sampled(other, *w, at), None).0;
                still(self.beside.rate(d))
            }
            // As it goes with its waveform it moves with that.
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) if rates.follows => {
                let moved = Sample { rate: self.sample(*w, at).value, ..at.own(*w) };
                still(contact.pressed(moved, None).1)
            }
            Press::Force(_) | Press::Indentation(_) | Press::Radius(_) => Moved::default(),
        };
        Shift {
            u: rates.u + slide.value,
            d: depth.value,
            du: slide.rate,
            driven: [slide.driven, depth.driven],
        }
    }

    /// How far a contact is moved, (u, d) in m, at the moment of a state.
    pub(crate) fn moves(&self, contact: &Contact, model: &Model, state: &State) -> (f64, f64) {
        let at = Moment::of(model, state);
        let shift = self.shift(contact, at);
        (shift.u, shift.d)
    }

    /// How far its lines of force lie elsewhere: by coordinate the change of its levers, of F_x and of F_N.
    pub(in crate::variation) fn levers(&self, c: usize) -> [&[(usize, f64)]; 2] {
        let rates = &self.contacts[c];
        [&rates.slide, &rates.depth].map(|levers| &levers.free[..])
    }

    /// How κ of a contact moves.
    pub(crate) fn slope(&self, c: usize) -> f64 {
        self.contacts[c].slope
    }

    /// How F_x (N) of one contact moves where its springs are anchored as they are: d, the height of its slip front (m) and the slope
    /// σκ of its edge at hand.
    ///
    /// F_x = G\*[Σ p'ΔM + σκ(M(d) - M(h))], the sum up to the front h, which lies where both are the same.
    pub(in crate::variation) fn pull(
        &self,
        contact: &Contact,
        memory: &Memory,
        force: f64,
        [d, front, edge]: [f64; 3],
    ) -> f64 {
        let (rates, law) = (&self.contacts[contact.place], &contact.interface);
        let mut pull = rates.tangential * force;
        if rates.slope != 0.0 {
            let swept = law.reduced_force(d)
                - law.reduced_force(front)
                - (d - front) * law.profile().reduced_stiffness(front);
            pull += edge.signum() * rates.slope * law.tangential_modulus() * swept;
        }
        if rates.profile {
            let reduced = |h: f64| self.reduced_force(contact.place, h);
            pull += law.tangential_modulus() * pulled(memory, [d, front, edge], reduced);
        }
        pull
    }

    /// How G\*m(d) moves, N/m.
    pub(in crate::variation) fn stick_stiffness(&self, contact: &Contact, d: f64) -> f64 {
        let c = contact.place;
        if self.contacts[c].profile {
            return self.beside.rate(|other| other.contacts[c].interface.stick_stiffness(d));
        }
        self.contacts[c].tangential * contact.interface.stick_stiffness(d)
    }

    /// How F_N of one contact moves at the depth d, N.
    pub(in crate::variation) fn press(&self, contact: &Contact, d: f64) -> f64 {
        let c = contact.place;
        if self.contacts[c].profile {
            return self.beside.rate(|other| other.contacts[c].interface.normal_force(d));
        }
        self.contacts[c].normal * contact.interface.normal_force(d)
    }

    /// How the energy of pressing moves at the depth d, J.
    pub(in crate::variation) fn normal_energy(&self, contact: &Contact, d: f64) -> f64 {
        let c = contact.place;
        if self.contacts[c].profile {
            return self.beside.rate(|other| other.contacts[c].interface.normal_energy(d));
        }
        self.contacts[c].normal * contact.interface.normal_energy(d)
    }

    /// G\*, as a share of it.
    pub(in crate::variation) fn tangential(&self, c: usize) -> f64 {
        self.contacts[c].tangential
    }

    /// Whether the profile moves.
    pub(in crate::variation) fn shapes(&self, c: usize) -> bool {
        self.contacts[c].profile
    }

    /// m(h), M(h) and N(h) of the profile; none where it stays as it is.
    pub(in crate::variation) fn sums(&self, c: usize, h: f64) -> Option<[f64; 3]> {
        let rate = |of: fn(&Profile, f64) -> f64| {
            self.beside.rate(|other| of(other.contacts[c].interface.profile(), h))
        };
        let sums: [fn(&Profile, f64) -> f64; 3] =
            [Profile::reduced_stiffness, Profile::reduced_force, Profile::reduced_energy];
        self.contacts[c].profile.then(|| sums.map(rate))
    }

    /// M(h) of a profile that moves, m².
    pub(in crate::variation) fn reduced(&self, c: usize, h: f64) -> f64 {
        if self.contacts[c].profile { self.reduced_force(c, h) } else { 0.0 }
    }

    fn reduced_force(&self, c: usize, h: f64) -> f64 {
        self.beside.rate(|other| other.contacts[c].interface.reduced_force(h))
    }

    /// Whether the force of contact `c` is another one where its bodies and anchors are where they are.
    pub(in crate::variation) fn touches(&self, c: usize) -> bool {
        self.contacts[c].any
    }
}

/// Σ p'ΔM below a slip front, and of the edge above it.
fn pulled(memory: &Memory, [d, front, edge]: [f64; 3], reduced: impl Fn(f64) -> f64) -> f64 {
    let Memory::Curve(curve) = memory else { return 0.0 };
    let (legs, middle) = (curve.legs(), reduced(front));
    let mut sum = edge * (reduced(d) - middle);
    let heights = curve.knots().map(|(h, _)| h);
    let mut low: Option<f64> = None;
    for (piece, h) in heights.enumerate() {
        if let (Some(below), Some(k)) = (low, piece.checked_sub(1)) {
            let end = if h < front { reduced(h) } else { middle };
            sum += (legs.slopes[k] + legs.bends[k]) * (end - below);
            low = Some(end);
        } else {
            low = Some(reduced(h));
        }
        if h >= front {
            break;
        }
    }
    sum
}

/// The edge of a contact that slips: where its front is and how steep.
pub(in crate::variation) fn edge(contact: &Contact, sense: f64, front: f64, motion: &Motion) -> [f64; 3] {
    [motion.d, front.clamp(0.0, motion.d.max(0.0)), sense * contact.interface.stick_slope()]
}
