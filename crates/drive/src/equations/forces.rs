//! Forces of contacts and links.
//!
//! Closed-form contacts, with F_x = F₀ + αM(h) under constant load, have a separate fast path. Both paths have the same law and
//! sign: F_x opposes u, and the coordinates receive -count·F_x along u.

use super::sum::{Sum, View};
use super::{Equations, Sample};
use crate::contact::{Mode, Motion, Press};
use crate::model::{Link, Stroke};

impl Equations<'_> {
    /// Adds forces of all contacts and the slopes of their additional components.
    ///
    /// Without an interval every contact uses the general law. Open contacts and those never pressed are in neither list of an interval.
    #[inline(always)]
    pub(super) fn contacts(&self, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let Some(interval) = self.interval else {
            (0..self.model.contacts.len()).for_each(|c| self.contact(c, at, sum, extra));
            return;
        };
        for steady in &interval.closed {
            let followed = steady.followed(at.time());
            // Free and prescribed displacements are separate: the rate of the prescribed ones gives the input power.
            let force = steady.force(steady.own(|i| at.component(i)) + followed.value);
            sum.apply(&steady.contact.u.free, followed.rate, force);
        }
        for &c in &interval.others {
            self.contact(c, at, sum, extra);
        }
    }

    /// Adds the forces of a contact under any law, and the slopes of its additional components.
    ///
    /// The normal force is -count·E\*M(d) along d, if bodies press the contact. The tangential force is -count·(F_x + βG\*m u̇)
    /// along u; its second term is the damping of sticking springs.
    #[inline(never)]
    fn contact(&self, c: usize, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let contact = &self.model.contacts[c];
        let u = self.read(&contact.u, at);
        let (d, dd, reduced_force) = match &contact.press {
            Press::Coupled(measure) => {
                let d = self.read(measure, at);
                let reduced_force = match &self.modes[c] {
                    Mode::Lull { lull, .. } => lull.reduced_force(d.value),
                    _ => contact.interface.reduced_force(d.value),
                };
                // An open contact exerts no force, even beyond the touch that ends the step.
                if self.modes[c] != Mode::Open {
                    // M(d) serves both normal force and branch.
                    let press = contact.count * (contact.interface.normal_modulus() * reduced_force);
                    sum.apply(&measure.free, d.driven, -press);
                }
                (d.value, d.rate, reduced_force)
            }
            _ => {
                let (d, dd) = self.pressed(contact, at.time());
                (d, dd, contact.interface.reduced_force(d))
            }
        };
        let motion = Motion { d, u: u.value, dd, du: u.rate };
        // On a straight path the memory has all quantities; additional components are not used.
        let straight = contact.goes_straight(self.pieces);
        let slot = contact.slot.filter(|_| self.layout.growing > 0 && !straight);
        let mut force = match (&self.modes[c], slot) {
            // Force and friction power share one slip front; the memory computes them where the branch does not apply.
            (Mode::Slip(branch), Some(slot)) if branch.covers(d, u.value) => {
                let [force, friction, _] = branch.drag(&contact.interface, &motion, reduced_force);
                extra[self.layout.friction(slot) - 2 * self.layout.free] = friction;
                force
            }
            (Mode::Grow, None) => self.memories[c].force(&contact.interface, motion.apex()),
            (_, slot) => {
                let grown = || slot.map_or(0.0, |slot| at.component(self.layout.force(slot)));
                let force = contact.force(self.law(c), &motion, grown);
                if let Some(slot) = slot {
                    self.grow((c, slot), &motion, force, extra);
                }
                force
            }
        };
        if contact.interface.damping() > 0.0 {
            let damping = contact.viscosity(self.law(c), &motion);
            // Dissipated in sticking springs, separate from friction.
            sum.damping += contact.count * damping * motion.du * motion.du;
            force += damping * motion.du;
        }
        sum.apply(&contact.u.free, u.driven, -contact.count * force);
    }

    /// Writes the slopes of the additional components of a growing contact; `extra` begins after the velocities.
    ///
    /// They are Ḟ in N/s, elastic and friction power in W, each of one contact.
    fn grow(&self, (c, slot): (usize, usize), motion: &Motion, force: f64, extra: &mut [f64]) {
        let rates = self.model.contacts[c].growth_rates(self.law(c), motion, force);
        let from = 2 * self.layout.free;
        extra[self.layout.force(slot) - from] = rates.force;
        extra[self.layout.elastic(slot) - from] = rates.elastic;
        extra[self.layout.friction(slot) - from] = rates.friction;
    }

    /// Adds the forces of springs, dampers and actuators: k(s - e) + c(ṡ - ė) + preload along the elongation e, with the free stroke s.
    ///
    /// The input power of the stroke is (k(s - e) + c(ṡ - ė))ṡ. The work of the preload is a potential energy.
    #[inline(never)]
    pub(super) fn links(&self, at: &impl View, sum: &mut Sum<'_>) {
        for link in &self.model.links {
            let elongation = self.read(&link.elongation, at);
            let stroke = self.stroke(link, at);
            let (stretch, rate) = (stroke.value - elongation.value, stroke.rate - elongation.rate);
            let force = link.stiffness * stretch + link.damping * rate;
            sum.apply(&link.elongation.free, elongation.driven, force + link.preload);
            sum.input += force * stroke.rate;
            sum.damping += link.damping * rate * rate;
        }
    }

    /// Returns the free stroke of a link, m.
    pub(crate) fn stroke(&self, link: &Link, at: &impl View) -> Sample {
        match link.stroke {
            Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
            Stroke::Driven(w) => self.signal(w, at),
        }
    }
}
