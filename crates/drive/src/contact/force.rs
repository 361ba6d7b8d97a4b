//! What a contact exerts along the slide under its law.
//!
//! Elastic and friction force by the mode's law, viscous resistance of the springs that stick, and the rates
//! of what a growing contact carries as states. All of one contact; whoever adds them up multiplies by the
//! count. Nothing is remembered: the memory is read as committed last.

use super::{Contact, Mode, Motion, Press};
use stickslip_contact::{Apex, Branch, Dragged, Memory, Move};

/// How far ahead the whole law is asked which springs stick, in radians of the contact's own swing.
// With 1e-8 or 1e-4 a damped flat punch under a falling load ends at the same place to the error of its steps.
const AHEAD: f64 = 1e-6;

/// Slopes of the states of a contact that grows, and of the integrals beside them.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct GrowthRates {
    /// Ḟ = G\*m(d)u̇ in full stick, N/s.
    pub(crate) force: f64,
    /// Ė = Fu̇ in full stick, W.
    pub(crate) elastic: f64,
    /// Friction power where an edge drags, W.
    pub(crate) friction: f64,
}

impl Contact {
    /// F_x of one contact, N, under its law; `grown` is what a contact that grows in full stick carries as a state.
    ///
    /// A branch is asked beyond the height that it covers only where it cuts through a path of growth; the
    /// memory then answers, so that the law goes on smoothly to the event that ends the step.
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
                // At a constant indentation M(d) is known since the model was built.
                let reduced_force = match &self.press {
                    Press::Constant { reduced_force, .. } => *reduced_force,
                    _ => self.interface.reduced_force(motion.d),
                };
                branch.force(&self.interface, motion.d, motion.u, reduced_force)
            }
            // Without friction the memory need not be asked.
            Mode::Whole { .. } if self.inert => 0.0,
            Mode::Whole { .. } => self.whole(memory, motion),
            Mode::Lull { lull, .. } => lull.force(&self.interface, motion.apex()),
            Mode::Grow => grown(),
            Mode::Open => 0.0,
        }
    }

    /// F_x of one contact, N, with ∂F_x/∂u and ∂F_x/∂d, N/m, under its law, for whoever solves for u.
    ///
    /// Beyond gross slip a branch goes on with the stiffness of full stick, so that every force has its place and the moment
    /// at which the contact gives way is found as any event is. `grown` as in [`Self::force`].
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
                // Straight in d: any difference is its slope.
                let step = self.natural.depth;
                [force(d), lull.stiffness(law), (force(d + step) - force(d)) / step]
            }
        }
    }

    /// F_N of one contact, N, and ∂F_N/∂d, N/m, under its law; that of a pressed contact goes on straight, as a pull, beyond
    /// the moment at which it parts.
    pub(crate) fn press(&self, mode: &Mode, d: f64) -> [f64; 2] {
        let modulus = self.interface.normal_modulus();
        match mode {
            Mode::Lull { lull, .. } => {
                let reduced = lull.reduced_force(d);
                [modulus * reduced, modulus / lull.depth(reduced).1]
            }
            // What is apart pulls at nothing, and presses from where it touches: another holds the body until then.
            Mode::Open | Mode::Whole { .. } if d <= 0.0 => [0.0; 2],
            _ if d > 0.0 => [self.interface.normal_force(d), self.interface.normal_stiffness(d)],
            _ => {
                let stiffness = self.interface.normal_stiffness(self.natural.depth);
                [stiffness * d, stiffness]
            }
        }
    }

    /// d at which one contact presses with a force (N), the inverse of [`Self::press`], m.
    pub(crate) fn depth(&self, mode: &Mode, force: f64) -> f64 {
        match mode {
            Mode::Lull { lull, .. } => lull.depth(force / self.interface.normal_modulus()).0,
            _ if force > 0.0 => self.interface.indentation(force),
            _ => force / self.interface.normal_stiffness(self.natural.depth),
        }
    }

    /// Force by the whole law on the committed memory.
    #[inline(never)]
    fn whole(&self, memory: &Memory, motion: &Motion) -> f64 {
        memory.force(&self.interface, motion.apex())
    }

    /// Force and slip front where the edge cuts through a path of growth, found on the committed memory.
    #[inline(never)]
    fn dragged(&self, memory: &Memory, branch: &Branch, motion: &Motion) -> Dragged {
        let branching = memory.branching();
        branching.map(|it| it.dragged(&self.interface, branch.sense(), motion.apex())).unwrap_or_default()
    }

    /// Height of the slip front, m.
    ///
    /// Springs of heights below it stick, those above slip.
    pub(crate) fn front(&self, memory: &Memory, branch: &Branch, motion: &Motion) -> f64 {
        if branch.covers(motion.d, motion.u) {
            branch.front(motion.d, motion.u)
        } else {
            self.dragged(memory, branch, motion).front
        }
    }

    /// What the springs that stick oppose to u̇, N s/m.
    ///
    /// β times the stiffness of the springs that stick: G\*m(d) in full stick, G\*m(h) below a slip front at
    /// height h, nothing in gross slip or apart. β is the contact's damping time, s.
    pub(crate) fn viscosity(&self, (memory, mode): (&Memory, &Mode), motion: &Motion) -> f64 {
        let stuck = match mode {
            Mode::Open => 0.0,
            Mode::Grow => self.interface.stick_stiffness(motion.d),
            // All springs slip: none is left to resist.
            Mode::Slip(branch) if branch.is_gross() => 0.0,
            // Above d, too, where a shrinking apex has crossed the old curve, and below the centre: a step that oversteps an event
            // meets no kink. That of a flat punch would be a jump.
            Mode::Slip(branch) => {
                self.interface.stick_stiffness(self.front(memory, branch, motion).max(Branch::CENTRE))
            }
            Mode::Lull { lull, .. } => lull.stiffness(&self.interface),
            // The whole law knows only from a trial which springs stick, and a trial that goes nowhere slips nowhere: at the
            // start of a step a sliding contact would resist with all its springs.
            Mode::Whole { .. } => {
                let ahead = |times: f64| {
                    let ahead = times * AHEAD / self.natural.frequency;
                    let to = Apex { d: motion.d + ahead * motion.dd, u: motion.u + ahead * motion.du };
                    memory.trial(&self.interface, Move::Chord(to)).stiffness
                };
                // What has begun to slip on that way is none of this moment: forces of fixed steps were 1e-8 of βω off by it.
                2.0 * ahead(1.0) - ahead(2.0)
            }
        };
        self.interface.viscosity(stuck)
    }

    /// Friction work of a chord, J, besides what [`Self::growth_rates`] add up to, where it gives up a path of growth.
    pub(crate) fn beside_growth(&self, memory: &Memory, to: Apex) -> f64 {
        memory.branching().map_or(0.0, |branching| branching.beside_growth(&self.interface, to))
    }

    /// Slopes of what a growing contact carries beside its motion.
    ///
    /// In full stick G\*m(d)u̇ and F_x u̇, without friction; along a branch only the friction power, by the
    /// position of its front; nothing otherwise.
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
