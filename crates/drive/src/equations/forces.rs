//! Forces of contacts and links.
//!
//! Contacts of closed form and all others go two ways: on nearly every evaluation of a drive a contact is a
//! branch under constant load, and one closed form of u, F_x = F₀ + αM(h), spares it the rare cases. Kept
//! apart, a run took a tenth fewer instructions. The forces of both are the same law, and so are their signs:
//! F_x opposes u, and acts on the coordinates by -count·F_x along the row of u.

use super::sum::{Sum, View};
use super::{Equations, Sample};
use crate::contact::{Mode, Motion, Press};
use crate::model::{Link, Stroke};

impl Equations<'_> {
    /// Forces of all contacts, and the slopes of their extra components.
    ///
    /// Without an interval every contact goes by the general law. Contacts that are apart, and those never
    /// pressed, are in neither list of an interval.
    #[inline(always)]
    pub(super) fn contacts(&self, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let Some(interval) = self.interval else {
            (0..self.model.contacts.len()).for_each(|c| self.contact(c, at, sum, extra));
            return;
        };
        for steady in &interval.closed {
            let followed = steady.followed(at.time());
            // The slider's way and the followers' apart: the latter has a rate, which is the power put in.
            let force = steady.force(steady.own(|i| at.component(i)) + followed.value);
            sum.apply(&steady.contact.u.free, followed.rate, force);
        }
        for &c in &interval.others {
            self.contact(c, at, sum, extra);
        }
    }

    /// Any contact in any mode: its forces, and the slopes of its extra components.
    ///
    /// Normal: -count·E\*M(d) along d, where the bodies press it. Tangential: -count·(F_x + βG\*m u̇) along
    /// u, the second term of the springs that stick.
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
                // Apart by its law, it is so beyond the touch that will end the step.
                if self.modes[c] != Mode::Open {
                    // M(d) is asked for once, for normal force and branch alike.
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
        // Runs by chords carry no extra components, whatever slots the model has; on a straight path the memory has all.
        let straight = contact.goes_straight(self.pieces);
        let slot = contact.slot.filter(|_| self.layout.growing > 0 && !straight);
        let mut force = match (&self.modes[c], slot) {
            // Force and friction power of one slip front, found once; beyond what the branch covers the
            // memory is asked.
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
            // A power of its own, not friction: it is lost where springs stick.
            sum.damping += contact.count * damping * motion.du * motion.du;
            force += damping * motion.du;
        }
        sum.apply(&contact.u.free, u.driven, -contact.count * force);
    }

    /// Slopes of the extra components of a growing contact. `extra` begins after the velocities.
    ///
    /// Ḟ in N/s, elastic and friction power in W, each of one contact.
    fn grow(&self, (c, slot): (usize, usize), motion: &Motion, force: f64, extra: &mut [f64]) {
        let rates = self.model.contacts[c].growth_rates(self.law(c), motion, force);
        let from = 2 * self.layout.free;
        extra[self.layout.force(slot) - from] = rates.force;
        extra[self.layout.elastic(slot) - from] = rates.elastic;
        extra[self.layout.friction(slot) - from] = rates.friction;
    }

    /// Springs, dampers and actuators: k(s - e) + c(ṡ - ė) + preload along the elongation e, with the free
    /// stroke s.
    ///
    /// The stroke puts in (k(s - e) + c(ṡ - ė))ṡ; the preload's work is read off the length, as potential
    /// energy.
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

    /// Free stroke of a link.
    pub(crate) fn stroke(&self, link: &Link, at: &impl View) -> Sample {
        match link.stroke {
            Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
            Stroke::Driven(w) => self.signal(w, at),
        }
    }
}
