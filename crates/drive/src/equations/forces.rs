//! Forces of contacts and links.

use super::sum::{Sum, View};
use super::{Equations, Sample};
use crate::model::{Link, Motion, Press, Stroke};
use crate::state::Mode;
use stickslip_contact::{Branch, Dragged, Move};

impl Equations<'_> {
    /// F_x of one contact, N, under its decreed law.
    #[inline(always)]
    pub(crate) fn force(&self, c: usize, motion: &Motion, y: impl Fn(usize) -> f64) -> f64 {
        let contact = &self.model.contacts[c];
        match &self.modes[c] {
            Mode::Slip(branch) if !branch.covers(motion.d, motion.u) => self.dragged(c, branch, motion).force,
            Mode::Slip(branch) => {
                let reduced_force = match &contact.press {
                    Press::Constant { reduced_force, .. } => *reduced_force,
                    _ => contact.law.profile().reduced_force(motion.d),
                };
                branch.force(&contact.law, motion.d, motion.u, reduced_force)
            }
            Mode::Whole { .. } if contact.inert => 0.0,
            Mode::Whole { .. } => self.whole(c, motion),
            Mode::Grow => contact.slot.map_or(0.0, |slot| y(self.layout.force(slot))),
            Mode::Open => 0.0,
        }
    }

    /// Force by the whole law on the committed memory.
    #[inline(never)]
    fn whole(&self, c: usize, motion: &Motion) -> f64 {
        self.memories[c].force(&self.model.contacts[c].law, motion.apex())
    }

    /// Force and slip front where the edge cuts through a path of growth, found on the committed memory.
    #[inline(never)]
    fn dragged(&self, c: usize, branch: &Branch, motion: &Motion) -> Dragged {
        let branching = self.memories[c].branching();
        let law = &self.model.contacts[c].law;
        branching.map(|it| it.dragged(law, branch.sense(), motion.apex())).unwrap_or_default()
    }

    /// Height of the slip front, m.
    pub(crate) fn front(&self, c: usize, branch: &Branch, motion: &Motion) -> f64 {
        if branch.covers(motion.d, motion.u) {
            branch.front(motion.d, motion.u)
        } else {
            self.dragged(c, branch, motion).front
        }
    }

    /// Stiffness of the springs that stick, N/m: what carries a contact's own damping.
    pub(crate) fn stuck_stiffness(&self, c: usize, motion: &Motion) -> f64 {
        let law = &self.model.contacts[c].law;
        match &self.modes[c] {
            Mode::Open => 0.0,
            Mode::Grow => law.stick_stiffness(motion.d),
            Mode::Slip(branch) if branch.is_gross() => 0.0,
            Mode::Slip(branch) => {
                law.stick_stiffness(self.front(c, branch, motion).clamp(0.0, motion.d.max(0.0)))
            }
            Mode::Whole { .. } => self.memories[c].trial(law, Move::Chord(motion.apex())).stiffness,
        }
    }

    /// Slopes of the extra components of a growing contact: Ḟ = G\*m(d)u̇ and Ė = Fu̇ in full stick, friction power
    /// where an edge drags. `extra` begins after the velocities.
    #[inline(never)]
    fn grow(&self, c: usize, slot: usize, motion: &Motion, force: f64, extra: &mut [f64]) {
        let contact = &self.model.contacts[c];
        let (mut rate, mut elastic, mut friction) = (0.0, 0.0, 0.0);
        match &self.modes[c] {
            Mode::Grow => {
                rate = contact.law.stick_stiffness(motion.d) * motion.du;
                elastic = force * motion.du;
            }
            Mode::Slip(branch) => {
                let front = self.front(c, branch, motion);
                friction = branch.friction_power(&contact.law, front, motion);
            }
            Mode::Open | Mode::Whole { .. } => {}
        }
        let from = 2 * self.layout.free;
        extra[self.layout.force(slot) - from] = rate;
        extra[self.layout.elastic(slot) - from] = elastic;
        extra[self.layout.friction(slot) - from] = friction;
    }

    /// Forces of all contacts, and the slopes of their extra components.
    #[inline(always)]
    pub(super) fn contacts(&self, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let Some(interval) = self.interval else {
            (0..self.model.contacts.len()).for_each(|c| self.contact(c, at, sum, extra));
            return;
        };
        for steady in &interval.steady {
            let followed = steady.followed(at.time());
            let force = steady.force(steady.own(|i| at.component(i)) + followed.value);
            sum.apply(&steady.contact.u.free, followed.rate, force);
        }
        for &c in &interval.others {
            self.contact(c, at, sum, extra);
        }
    }

    /// Any contact in any mode: its forces, and the slopes of its extra components.
    #[inline(never)]
    fn contact(&self, c: usize, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let contact = &self.model.contacts[c];
        let u = self.read(&contact.u, at);
        let (d, dd, reduced_force) = match &contact.press {
            Press::Coupled(measure) => {
                let d = self.read(measure, at);
                let reduced_force = contact.law.profile().reduced_force(d.value);
                // Decreed apart, it is so beyond the touch that will end the step.
                if self.modes[c] != Mode::Open {
                    let press = contact.count * (contact.law.normal_modulus() * reduced_force);
                    sum.apply(&measure.free, d.driven, -press);
                }
                (d.value, d.rate, reduced_force)
            }
            _ => {
                let (d, dd) = self.pressed(contact, at.time());
                (d, dd, contact.law.profile().reduced_force(d))
            }
        };
        let motion = Motion { d, u: u.value, dd, du: u.rate };
        let mut force = match (&self.modes[c], contact.slot.filter(|_| self.layout.growing > 0)) {
            (Mode::Slip(branch), Some(slot)) if branch.covers(d, u.value) => {
                let [force, friction] = branch.drag(&contact.law, &motion, reduced_force);
                extra[self.layout.friction(slot) - 2 * self.layout.free] = friction;
                force
            }
            (_, slot) => {
                let force = self.force(c, &motion, |i| at.component(i));
                if let Some(slot) = slot {
                    self.grow(c, slot, &motion, force, extra);
                }
                force
            }
        };
        if contact.damping > 0.0 {
            let damping = contact.damping * self.stuck_stiffness(c, &motion);
            sum.damping += contact.count * damping * motion.du * motion.du;
            force += damping * motion.du;
        }
        sum.apply(&contact.u.free, u.driven, -contact.count * force);
    }

    #[inline(never)]
    pub(super) fn links(&self, at: &impl View, sum: &mut Sum<'_>) {
        for link in &self.model.links {
            let elongation = self.read(&link.elongation, at);
            let stroke = self.stroke(link, at.time());
            let (stretch, rate) = (stroke.value - elongation.value, stroke.rate - elongation.rate);
            let force = link.stiffness * stretch + link.damping * rate;
            sum.apply(&link.elongation.free, elongation.driven, force + link.preload);
            sum.input += force * stroke.rate;
            sum.damping += link.damping * rate * rate;
        }
    }

    /// Free stroke of a link.
    pub(crate) fn stroke(&self, link: &Link, t: f64) -> Sample {
        match link.stroke {
            Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
            Stroke::Driven(w) => self.sample(w, t),
        }
    }
}
