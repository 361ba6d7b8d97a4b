//! Forces of a contact under its law.
//!
//! The module computes elastic and friction force, viscous force of sticking springs, and the state derivatives of a contact that grows in
//! full stick. All values are for one contact; the caller multiplies by the number of contacts. The slip memory is read only.

use super::{Form, Law, Site};
use crate::{Apex, Branch, Dragged, Memory, Motion, Move, Since};

/// Time derivatives of the states and integrals of a contact that may grow in full stick.
#[derive(Debug, Clone, Copy, Default)]
pub struct GrowthRates {
    /// Ḟ = G\*m(d)u̇ in full stick, N/s.
    pub force: f64,
    /// Ė = Fu̇ in full stick, W.
    pub elastic: f64,
    /// Friction power at a slipping edge, W.
    pub friction: f64,
}

impl Law {
    /// Returns F_x of one contact under its law, N. `grown` returns the force of a contact that grows in full stick, which is a state.
    ///
    /// A branch of the slip memory is not valid where slip crosses a part of the memory that formed during growth of the contact. The slip
    /// memory itself computes the force there, so that the law is smooth up to the event that ends the step.
    #[inline(always)]
    pub fn force(
        &self,
        (site, memory): (&impl Site, &Memory),
        motion: &Motion,
        grown: impl FnOnce() -> f64,
    ) -> f64 {
        match &self.0 {
            Form::Slip(branch, _) if !branch.covers(motion.d, motion.u) => {
                dragged((site, memory), branch, motion).force
            }
            Form::Slip(branch, _) => {
                let reduced_force = site.load().reduced_force(site.interface(), motion.d);
                branch.force(site.interface(), motion.d, motion.u, reduced_force)
            }
            // Without friction the force is zero.
            Form::Whole { .. } if site.is_inert() => 0.0,
            Form::Whole { .. } => whole((site, memory), motion),
            Form::Lull { lull, .. } => lull.force(site.interface(), motion.apex()),
            Form::Grow => grown(),
            Form::Open => 0.0,
        }
    }

    /// Returns the tangential force F_x of one contact under its present law, N, with the derivatives ∂F_x/∂u and ∂F_x/∂d, N/m.
    ///
    /// Beyond gross slip a branch continues with the stiffness of full stick. Every force then has a displacement, and the
    /// beginning of gross slip is an ordinary event. `grown` as in [`Self::force`].
    pub fn tangents(
        &self,
        (site, memory): (&impl Site, &Memory),
        motion: &Motion,
        grown: impl FnOnce() -> f64,
    ) -> [f64; 3] {
        let (d, u, law) = (motion.d, motion.u, site.interface());
        match &self.0 {
            Form::Open => [0.0; 3],
            Form::Grow => [grown(), law.stick_stiffness(d), 0.0],
            Form::Slip(branch, _) if branch.covers(d, u) => {
                let force = branch.force(law, d, u, law.reduced_force(d));
                let [stiffness, coupling] = branch.tangents(law, d, u);
                let beyond = branch.beyond(law, d, u);
                if beyond > 0.0 {
                    let (sense, whole) = (branch.sense(), law.stick_stiffness(d));
                    let along = coupling - sense * whole * law.stick_slope();
                    return [force + sense * whole * beyond, stiffness + whole, along];
                }
                [force, stiffness, coupling]
            }
            Form::Slip(branch, _) => {
                let Dragged { force, front } = dragged((site, memory), branch, motion);
                let stiffness = law.stick_stiffness(front.clamp(0.0, d.max(0.0)));
                let edge = branch.sense() * law.stick_slope();
                [force, stiffness, edge * (law.stick_stiffness(d) - stiffness)]
            }
            Form::Whole { .. } if site.is_inert() => [0.0; 3],
            Form::Whole { .. } => {
                let response = memory.trial(law, Move::Chord(motion.apex()));
                [response.force, response.stiffness, response.coupling]
            }
            Form::Lull { lull, .. } => {
                let force = |d: f64| lull.force(law, Apex { d, u });
                // Linear in d: any difference gives the slope.
                let step = site.scale().depth;
                [force(d), lull.stiffness(law), (force(d + step) - force(d)) / step]
            }
        }
    }

    /// Returns F_N of one contact under its law, N, and ∂F_N/∂d, N/m. Beyond lift-off the law of a pressed contact continues
    /// linearly as a tensile force until the event.
    pub fn press(&self, site: &impl Site, d: f64) -> [f64; 2] {
        let modulus = site.interface().normal_modulus();
        match &self.0 {
            Form::Lull { lull, .. } => {
                let reduced = lull.reduced_force(d);
                [modulus * reduced, modulus / lull.depth(reduced).1]
            }
            // An open contact exerts no force until it touches; another contact holds the body.
            Form::Open | Form::Whole { .. } if d <= 0.0 => [0.0; 2],
            _ if d > 0.0 => [site.interface().normal_force(d), site.interface().normal_stiffness(d)],
            _ => {
                let stiffness = site.interface().normal_stiffness(site.scale().depth);
                [stiffness * d, stiffness]
            }
        }
    }

    /// Returns the indentation of one contact under a normal force (N), m: the inverse of [`Self::press`].
    pub fn depth(&self, site: &impl Site, force: f64) -> f64 {
        match &self.0 {
            Form::Lull { lull, .. } => lull.depth(force / site.interface().normal_modulus()).0,
            _ if force > 0.0 => site.interface().indentation(force),
            _ => force / site.interface().normal_stiffness(site.scale().depth),
        }
    }

    /// Returns the force F_x of one contact with damping, and the damping force in it, N; `elastic` is its force without damping. See
    /// [`Memory::damped`].
    pub fn damped(&self, (site, memory): (&impl Site, &Memory), motion: &Motion, elastic: f64) -> [f64; 2] {
        let still = motion.d <= 0.0 || motion.du == 0.0;
        if let Form::Slip(branch, lead) = &self.0 {
            let law = site.interface();
            let at = (motion.d, motion.u);
            let reduced_force = || site.load().reduced_force(law, motion.d);
            if let Some(damped) =
                lead.force(law, branch, (at, law.damping() * motion.du), (elastic, reduced_force))
            {
                return [damped, damped - elastic];
            }
        }
        let (since, known) = match &self.0 {
            Form::Open => return [elastic, 0.0],
            _ if still => return [elastic, 0.0],
            // Beyond its end a law continues smoothly, and its force is not the elastic one.
            Form::Slip(branch, _) => {
                let holds = branch.covers(motion.d, motion.u) && branch.margin(motion.d, motion.u) >= 0.0;
                (Since::Slip(branch.sense()), holds)
            }
            Form::Lull { .. } => (Since::Chord, false),
            Form::Grow => (Since::Growth(elastic), true),
            Form::Whole { .. } => (Since::Chord, true),
        };
        memory.damped(site.interface(), since, motion, (elastic, known))
    }

    /// Returns the time derivatives of the states of a contact that may grow in full stick.
    ///
    /// In full stick the derivatives are G\*m(d)u̇ and F_x u̇, without friction. During slip only the friction power is nonzero.
    #[inline(never)]
    pub fn growth_rates(
        &self,
        (site, memory): (&impl Site, &Memory),
        motion: &Motion,
        force: f64,
    ) -> GrowthRates {
        match &self.0 {
            Form::Grow => GrowthRates {
                force: site.interface().stick_stiffness(motion.d) * motion.du,
                elastic: force * motion.du,
                friction: 0.0,
            },
            Form::Slip(branch, _) => {
                let front = front((site, memory), branch, motion);
                let friction = branch.friction_power(site.interface(), front, motion);
                GrowthRates { friction, ..GrowthRates::default() }
            }
            Form::Lull { lull, .. } => GrowthRates {
                friction: lull.friction_power(site.interface(), motion),
                ..GrowthRates::default()
            },
            Form::Open | Form::Whole { .. } => GrowthRates::default(),
        }
    }
}

/// Returns the force by the full force law on the committed memory, N.
#[inline(never)]
fn whole((site, memory): (&impl Site, &Memory), motion: &Motion) -> f64 {
    memory.force(site.interface(), motion.apex())
}

/// Returns force and slip front where the edge crosses a path of growth, from the committed memory.
#[inline(never)]
fn dragged((site, memory): (&impl Site, &Memory), branch: &Branch, motion: &Motion) -> Dragged {
    let branching = memory.branching();
    branching
        .map(|it| it.dragged(memory.law(site.interface()), branch.sense(), motion.apex()))
        .unwrap_or_default()
}

/// Returns the height of the slip front, m. Springs of smaller height stick, others slip.
fn front((site, memory): (&impl Site, &Memory), branch: &Branch, motion: &Motion) -> f64 {
    if branch.covers(motion.d, motion.u) {
        branch.front(motion.d, motion.u)
    } else {
        dragged((site, memory), branch, motion).front
    }
}
