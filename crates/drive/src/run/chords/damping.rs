//! Damping work of contacts in a step of fixed length.
//!
//! In a flyback the damping force may vanish within a small part of a step, when the last spring begins to slip. The stages of a method
//! do not resolve that. The work is therefore integrated after the step, along its path, up to the point at which the force vanishes.

use super::Chords;
use super::step::Between;
use crate::contact::Contact;
use crate::equations::Equations;
use crate::state::State;
use stickslip_contact::gauss;

/// Number of bisections that find where a damping force vanishes.
const BISECTIONS: u32 = 20;

impl Chords<'_> {
    /// Returns the damping work of all contacts in a step to time t with components y, J. The step is not yet committed.
    pub(in crate::run) fn damping_work(&self, state: &State, to: (f64, &[f64])) -> f64 {
        let damped = self.model.contacts.iter().filter(|contact| contact.is_damped());
        damped.map(|contact| contact.count * self.work(state, contact, to)).sum()
    }

    fn work(&self, state: &State, contact: &Contact, to: (f64, &[f64])) -> f64 {
        let eq = Equations::on(self.model, state, self.layout);
        let step = Between { from: (state.t, &state.y), to, free: self.layout.free };
        let (memory, law) = eq.law(contact.place);
        let duration = to.0 - state.t;
        let power = |share: f64| {
            let t = if share < 1.0 { state.t + share * duration } else { to.0 };
            let motion = eq.motion(contact, t, |i| step.value(i, t));
            let elastic = law.force((contact, memory), &motion, || 0.0);
            law.damped((contact, memory), &motion, elastic)[1] * motion.du
        };
        let [first, middle, last] = [power(0.0), power(0.5), power(1.0)];
        let least = f64::EPSILON.sqrt() * first.abs();
        // Simpson's rule is exact where the force is constant, because velocities are linear in time.
        if first != 0.0 && last.abs() > least || [first, middle, last] == [0.0; 3] {
            return duration / 6.0 * (first + 4.0 * middle + last);
        }
        if first == 0.0 {
            return duration * gauss([0.0, 1.0], power);
        }
        let (mut acts, mut ends) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (acts + ends);
            *(if power(middle).abs() > least { &mut acts } else { &mut ends }) = middle;
        }
        duration * gauss([0.0, ends], power)
    }
}
