//! Forces of contacts and links.
//!
//! Contacts under constant load whose force has the closed form F_x = F₀ + αM(h) have a separate fast path. Both paths have the same law
//! and sign: F_x opposes u, and the coordinates receive -count·F_x along u.

use super::sum::{Sum, View};
use super::{Equations, Sample};
use crate::contact::{Contact, Motion, Press};
use crate::model::{Link, Stroke};

impl Equations<'_> {
    /// Adds the forces of all contacts and the derivatives of their state components.
    ///
    /// Without precomputed data of an interval, every contact uses the general law. Contacts that are open or never pressed are in no list.
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

    /// Adds the forces of a contact under any law, and the derivatives of its state components.
    ///
    /// The normal force is -count·E\*M(d) along d, if bodies press the contact. The tangential force is -count·F_x along u, with the damping
    /// force ([`Law::damped`](stickslip_contact::Law::damped)).
    #[inline(never)]
    pub(crate) fn contact(&self, c: usize, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let (contact, law) = (&self.model.contacts[c], &self.modes[c]);
        let u = self.read(&contact.u, at);
        let (d, dd, reduced_force) = self.press(contact, at, sum);
        let motion = Motion { d, u: u.value, dd, du: u.rate };
        // On a straight path the slip memory gives all quantities; the state components are not used.
        let straight = contact.goes_straight(self.pieces);
        let slot = contact.slot.filter(|_| self.layout.growing > 0 && !straight);
        let mut force = match (law.branch(), slot) {
            // Force and friction power share one slip front; the memory computes them where the branch does not apply.
            (Some(branch), Some(slot)) if branch.covers(d, u.value) => {
                let [force, friction] = branch.drag(&contact.interface, &motion, reduced_force);
                extra[self.layout.friction(slot) - 2 * self.layout.free] = friction;
                force
            }
            (None, None) if law.grows() => self.memories[c].force(&contact.interface, motion.apex()),
            (_, slot) => {
                let grown = || slot.map_or(0.0, |slot| at.component(self.layout.force(slot)));
                let force = law.force((contact, &self.memories[c]), &motion, grown);
                if let Some(slot) = slot {
                    self.grow((c, slot), &motion, force, extra);
                }
                force
            }
        };
        if contact.interface.damping() > 0.0 {
            // The rate of a damped indentation is unknown here; the mean slope of the path then replaces that at its end.
            let dd = if contact.normal_damping > 0.0 { 0.0 } else { dd };
            let motion = Motion { dd, ..motion };
            let [damped, damping] = law.damped((contact, &self.memories[c]), &motion, force);
            // Dissipated in sticking springs, separate from friction. Steps of fixed length integrate it along their paths.
            if self.layout.located {
                sum.damping += contact.count * damping * motion.du;
            }
            force = damped;
        }
        sum.apply(&contact.u.free, u.driven, -contact.count * force);
    }

    /// Adds the normal force of a contact and the power of its damping; returns the indentation d (m), its rate (m/s) and M(d), m².
    #[inline]
    fn press(&self, contact: &Contact, at: &impl View, sum: &mut Sum<'_>) -> (f64, f64, f64) {
        let law = &self.modes[contact.place];
        match &contact.press {
            Press::Coupled(measure) => {
                let d = self.read(measure, at);
                let depth = contact.damped([d.value, d.rate], (&self.memories[contact.place], law));
                let reduced_force = match law.lull() {
                    Some(lull) => lull.reduced_force(depth),
                    None => contact.interface.reduced_force(depth),
                };
                // An open contact exerts no force, even beyond the touch that ends the step.
                let mut press = 0.0;
                if !law.is_open() {
                    // M(d) serves both normal force and branch.
                    press = contact.count * (contact.interface.normal_modulus() * reduced_force);
                    sum.apply(&measure.free, d.driven, -press);
                }
                if contact.normal_damping > 0.0 && !law.is_open() {
                    // The elastic energy is that at d.
                    sum.damping += (press - contact.count * contact.interface.normal_force(d.value)) * d.rate;
                }
                (depth, d.rate, reduced_force)
            }
            press => {
                let (d, dd) = self.pressed(contact, at.time());
                let reduced_force = contact.interface.reduced_force(d);
                if let (Press::Indentation(w), true) = (press, contact.normal_damping > 0.0 && !law.is_open())
                {
                    let Sample { value, rate, .. } = self.sample(*w, at.time());
                    let elastic = contact.interface.normal_force(value);
                    let force = contact.interface.normal_modulus() * reduced_force - elastic;
                    // The source of the motion does this work, too.
                    sum.damping += contact.count * force * rate;
                    sum.input += contact.count * force * rate;
                }
                (d, dd, reduced_force)
            }
        }
    }

    /// Writes the slopes of the additional components of a growing contact with damping along the normal.
    ///
    /// The rate of its indentation needs the accelerations `dv`, which the forces give first. `extra` are the slopes after the velocities.
    pub(super) fn grow_damped(&self, contact: &Contact, at: &impl View, dv: &[f64], extra: &mut [f64]) {
        let (c, law) = (contact.place, &self.modes[contact.place]);
        let Some(slot) = contact.slot.filter(|_| self.layout.growing > 0) else { return };
        let Some(measure) = contact.coupling().filter(|_| !contact.goes_straight(self.pieces)) else {
            return;
        };
        let (d, u) = (self.read(measure, at), self.read(&contact.u, at));
        let bend = self.acceleration(measure, at, |i| dv[i]);
        let depth = contact.damped([d.value, d.rate], self.law(c));
        let dd = d.rate + contact.normal_damping * bend;
        let motion = Motion { d: depth, u: u.value, dd, du: u.rate };
        let force =
            law.force((contact, &self.memories[c]), &motion, || at.component(self.layout.force(slot)));
        self.grow((c, slot), &motion, force, extra);
    }

    /// Writes the slopes of the additional components of a growing contact; `extra` begins after the velocities.
    ///
    /// The derivatives are Ḟ in N/s, elastic and friction power in W, for one contact. `extra` are the slopes after the velocities.
    fn grow(&self, (c, slot): (usize, usize), motion: &Motion, force: f64, extra: &mut [f64]) {
        let site = (&self.model.contacts[c], &self.memories[c]);
        let rates = self.modes[c].growth_rates(site, motion, force);
        let from = 2 * self.layout.free;
        extra[self.layout.force(slot) - from] = rates.force;
        extra[self.layout.elastic(slot) - from] = rates.elastic;
        extra[self.layout.friction(slot) - from] = rates.friction;
    }

    /// Adds the force k(s - e) + c(ṡ - ė) + preload of a spring, damper or actuator with elongation e and free stroke s.
    ///
    /// An actuator's input power is (k(s - e) + c(ṡ - ė))ṡ. The work of the preload counts as potential energy.
    #[inline(never)]
    pub(crate) fn link(&self, link: &Link, at: &impl View, sum: &mut Sum<'_>) {
        let elongation = self.read(&link.elongation, at);
        let stroke = self.stroke(link, at);
        let (stretch, rate) = (stroke.value - elongation.value, stroke.rate - elongation.rate);
        let force = link.stiffness * stretch + link.damping * rate;
        sum.apply(&link.elongation.free, elongation.driven, force + link.preload);
        sum.input += force * stroke.rate;
        sum.damping += link.damping * rate * rate;
    }

    /// Adds varying loads and their input power; `v` are the velocities of the free coordinates.
    #[inline(always)]
    pub(crate) fn loads(&self, t: f64, v: &[f64], sum: &mut Sum<'_>) {
        for load in &self.model.loads {
            let force = load.arm * self.sample(load.waveform, t).value;
            sum.dv[load.free] += force;
            sum.input += force * v[load.free];
        }
    }

    /// Returns the free stroke of a spring or actuator, m.
    pub(crate) fn stroke(&self, link: &Link, at: &impl View) -> Sample {
        match link.stroke {
            Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
            Stroke::Driven(w) => self.signal(w, at),
        }
    }
}
