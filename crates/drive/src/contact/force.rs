//! Tangential force of a contact under its present law.
//!
//! The module computes elastic and friction force, viscous force of sticking springs, and the state derivatives of a contact that grows in
//! full stick. All values are for one contact; the caller multiplies by the number of contacts. The slip memory is read only.

use super::{Contact, Mode, Motion, Press};
use stickslip_contact::{Apex, Branch, Dragged, Memory, Move};

/// Time step of the trial displacement that shows which springs stick, in radians of the contact's natural oscillation.
const AHEAD: f64 = 1e-6;

/// Time derivatives of the states and integrals of a contact that may grow in full stick.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct GrowthRates {
    /// Derivative of the tangential force, Ḟ = G\*m(d)u̇ in full stick, N/s.
    pub(crate) force: f64,
    /// Derivative of the elastic energy, Ė = Fu̇ in full stick, W.
    pub(crate) elastic: f64,
    /// Friction power of the springs that slip at the contact edge, W.
    pub(crate) friction: f64,
}

impl Contact {
    /// Returns the tangential force F_x of one contact under its present law, N. In full stick `grown` returns F_x.
    ///
    /// A branch of the slip memory is not valid where slip crosses a part of the memory that formed during growth of the contact. The slip
    /// memory itself computes the force there, so that the law is smooth up to the event that ends the step.
    #[inline(always)]
    pub(crate) fn force(
        &self,
        (memory, mode): (&Memory, &Mode),
        motion: &Motion,
        grown: impl FnOnce() -> f64,
    ) -> f64 {
        match mode {
            Mode::Slip(branch) if !branch.covers(motion.d, motion.u) => {
                self.dragged(memory, branch, motion).force
            }
            Mode::Slip(branch) => {
                // At constant indentation M(d) is precomputed.
                let reduced_force = match &self.press {
                    Press::Constant { reduced_force, .. } => *reduced_force,
                    _ => self.interface.reduced_force(motion.d),
                };
                branch.force(&self.interface, motion.d, motion.u, reduced_force)
            }
            // Without friction the force is zero.
            Mode::Whole { .. } if self.inert => 0.0,
            Mode::Whole { .. } => self.whole(memory, motion),
            Mode::Lull { lull, .. } => lull.force(&self.interface, motion.apex()),
            Mode::Grow => grown(),
            Mode::Open => 0.0,
        }
    }

    /// Returns the tangential force F_x of one contact under its present law, N, with the derivatives ∂F_x/∂u and ∂F_x/∂d, N/m.
    ///
    /// Beyond the beginning of gross slip the force is extrapolated with the stiffness of full stick. Every force then has a displacement,
    /// and the beginning of gross slip is an ordinary event. In full stick the function `grown` returns the force.
    pub(crate) fn tangents(
        &self,
        (memory, mode): (&Memory, &Mode),
        motion: &Motion,
        grown: impl FnOnce() -> f64,
    ) -> [f64; 3] {
        let (d, u, law) = (motion.d, motion.u, &self.interface);
        match mode {
            Mode::Open => [0.0; 3],
            Mode::Grow => [grown(), law.stick_stiffness(d), 0.0],
            Mode::Slip(branch) if branch.covers(d, u) => {
                let force = branch.force(law, d, u, law.reduced_force(d));
                let [stiffness, coupling] = branch.tangents(law, d, u);
                let beyond = branch.beyond(d, u);
                if beyond > 0.0 {
                    let (sense, whole) = (branch.sense(), law.stick_stiffness(d));
                    let along = coupling - sense * whole * law.stick_slope();
                    return [force + sense * whole * beyond, stiffness + whole, along];
                }
                [force, stiffness, coupling]
            }
            Mode::Slip(branch) => {
                let Dragged { force, front } = self.dragged(memory, branch, motion);
                let stiffness = law.stick_stiffness(front.clamp(0.0, d.max(0.0)));
                let edge = branch.sense() * law.stick_slope();
                [force, stiffness, edge * (law.stick_stiffness(d) - stiffness)]
            }
            Mode::Whole { .. } if self.inert => [0.0; 3],
            Mode::Whole { .. } => {
                let response = memory.trial(law, Move::Chord(motion.apex()));
                [response.force, response.stiffness, response.coupling]
            }
            Mode::Lull { lull, .. } => {
                let force = |d: f64| lull.force(law, Apex { d, u });
                // Linear in d: any difference gives the slope.
                let step = self.natural.depth;
                [force(d), lull.stiffness(law), (force(d + step) - force(d)) / step]
            }
        }
    }

    /// Returns the normal force F_N of one contact under its present law, N, and ∂F_N/∂d, N/m. Beyond lift-off the law of a pressed contact
    /// is extrapolated linearly as a tensile force until the event.
    pub(crate) fn press(&self, mode: &Mode, d: f64) -> [f64; 2] {
        let modulus = self.interface.normal_modulus();
        match mode {
            Mode::Lull { lull, .. } => {
                let reduced = lull.reduced_force(d);
                [modulus * reduced, modulus / lull.depth(reduced).1]
            }
            // An open contact exerts no force until it touches; another contact holds the body.
            Mode::Open | Mode::Whole { .. } if d <= 0.0 => [0.0; 2],
            _ if d > 0.0 => [self.interface.normal_force(d), self.interface.normal_stiffness(d)],
            _ => {
                let stiffness = self.interface.normal_stiffness(self.natural.depth);
                [stiffness * d, stiffness]
            }
        }
    }

    /// Returns the indentation of one contact under a normal force (N), m: the inverse of [`Self::press`].
    pub(crate) fn depth(&self, mode: &Mode, force: f64) -> f64 {
        match mode {
            Mode::Lull { lull, .. } => lull.depth(force / self.interface.normal_modulus()).0,
            _ if force > 0.0 => self.interface.indentation(force),
            _ => force / self.interface.normal_stiffness(self.natural.depth),
        }
    }

    /// Returns the tangential force by the full force law for the stored slip memory, N.
    #[inline(never)]
    fn whole(&self, memory: &Memory, motion: &Motion) -> f64 {
        memory.force(&self.interface, motion.apex())
    }

    /// Returns tangential force and slip front where slip crosses a part of the slip memory that formed during growth of the contact.
    #[inline(never)]
    fn dragged(&self, memory: &Memory, branch: &Branch, motion: &Motion) -> Dragged {
        let branching = memory.branching();
        branching.map(|it| it.dragged(&self.interface, branch.sense(), motion.apex())).unwrap_or_default()
    }

    /// Returns the height of the slip front in the profile, m. Springs below this height stick, others slip.
    pub(crate) fn front(&self, memory: &Memory, branch: &Branch, motion: &Motion) -> f64 {
        if branch.covers(motion.d, motion.u) {
            branch.front(motion.d, motion.u)
        } else {
            self.dragged(memory, branch, motion).front
        }
    }

    /// Returns the viscosity of the sticking springs, N s/m.
    ///
    /// The viscosity is β times the stiffness of the sticking springs, with the damping time β of the contact, s. The stiffness is G\*m(d)
    /// in full stick, G\*m(h) below a slip front at height h, and 0 in gross slip or without contact.
    pub(crate) fn viscosity(&self, (memory, mode): (&Memory, &Mode), motion: &Motion) -> f64 {
        let stuck = match mode {
            Mode::Open => 0.0,
            Mode::Grow => self.interface.stick_stiffness(motion.d),
            // All springs slip: no damping.
            Mode::Slip(branch) if branch.is_gross() => 0.0,
            // The front may lie above d where a shrinking contact has crossed its slip memory, or below the centre. Limiting it avoids a
            // kink in a step beyond an event.
            Mode::Slip(branch) => {
                self.interface.stick_stiffness(self.front(memory, branch, motion).max(Branch::CENTRE))
            }
            Mode::Lull { lull, .. } => lull.stiffness(&self.interface),
            // The full force law finds the sticking springs by a trial displacement; a trial of zero length would find all of them
            // sticking.
            Mode::Whole { .. } => {
                let ahead = |times: f64| {
                    let ahead = times * AHEAD / self.natural.frequency;
                    let to = Apex { d: motion.d + ahead * motion.dd, u: motion.u + ahead * motion.du };
                    memory.trial(&self.interface, Move::Chord(to)).stiffness
                };
                // Extrapolation to zero time removes the springs that begin to slip within the trial.
                2.0 * ahead(1.0) - ahead(2.0)
            }
        };
        self.interface.viscosity(stuck)
    }

    /// Returns the friction work (J) that [`Self::growth_rates`] omits: of a straight path that erases slip memory formed during growth.
    pub(crate) fn beside_growth(&self, memory: &Memory, to: Apex) -> f64 {
        memory.branching().map_or(0.0, |branching| branching.beside_growth(&self.interface, to))
    }

    /// Returns the time derivatives of the states of a contact that may grow in full stick.
    ///
    /// In full stick the derivatives are G\*m(d)u̇ and F_x u̇, without friction. During slip only the friction power is nonzero.
    #[inline(never)]
    pub(crate) fn growth_rates(
        &self,
        (memory, mode): (&Memory, &Mode),
        motion: &Motion,
        force: f64,
    ) -> GrowthRates {
        match mode {
            Mode::Grow => GrowthRates {
                force: self.interface.stick_stiffness(motion.d) * motion.du,
                elastic: force * motion.du,
                friction: 0.0,
            },
            Mode::Slip(branch) => {
                let front = self.front(memory, branch, motion);
                let friction = branch.friction_power(&self.interface, front, motion);
                GrowthRates { friction, ..GrowthRates::default() }
            }
            Mode::Lull { lull, .. } => GrowthRates {
                friction: lull.friction_power(&self.interface, motion),
                ..GrowthRates::default()
            },
            Mode::Open | Mode::Whole { .. } => GrowthRates::default(),
        }
    }
}
