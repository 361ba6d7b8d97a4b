//! Turns of u that end no law.
//!
//! Under a constant normal force u turns at events: reversals and ends of gross slip. Where the indentation varies, edges of
//! slip and not u decide what the law is: u turns in full stick without any event, and while the contact shrinks the edge that
//! drags turns later than u. A record that watches a body is told of these turns, too; the run does not know of them.
//! They are looked for by the sign of u̇ at both ends of a step: two turns within one step are not seen. At a tolerance of 1e-5 a
//! slider of the tests has such a pair, at 1e-7 none.

use crate::contact::{Contact, Guard};
use crate::equations::Equations;
use crate::model::{Binding, Model};
use crate::scene::Axis;
use stickslip_contact::Engine;
use stickslip_stepper::{Bracket, Point, root};

/// How near to its turn the moment told lies, in parts of the step.
const NEAR: f64 = 1e-12;

/// The contacts of a watched body that turn unseen, and their turns within a step.
#[derive(Debug, Default)]
pub(in crate::run) struct Turns {
    contacts: Vec<usize>,
    /// Rates of u before a corner, m/s, in the order of the contacts.
    before: Vec<f64>,
    /// Moments, s, and contacts, in the order of time; moments are not known before they are located.
    found: Vec<(f64, usize)>,
    next: usize,
}

impl Contact {
    /// Whether u may turn without an event: slip spreads on the curve, under a normal that varies.
    pub(crate) fn turns_unseen(&self) -> bool {
        !self.inert && !self.is_constant() && matches!(self.engine, Engine::Curve)
    }
}

impl Turns {
    /// The same room with nothing to watch.
    pub(in crate::run) fn renewed(mut self) -> Self {
        self.contacts.clear();
        self.forget();
        self
    }

    /// Watches the contacts of a body, by its place in the scene.
    pub(super) fn begin(&mut self, model: &Model, body: Option<usize>) {
        self.contacts.clear();
        self.forget();
        let binding = body.and_then(|body| Some(model.bodies.get(body)?.bindings[Axis::X as usize]));
        let Some(Binding::Free(i)) = binding else { return };
        let touches = |contact: &&Contact| contact.u.free.iter().any(|(k, _)| *k == i);
        let watched = model.contacts.iter().filter(|contact| contact.turns_unseen()).filter(touches);
        self.contacts.extend(watched.map(|contact| contact.place));
        self.before.reserve(self.contacts.len());
        self.found.reserve(self.contacts.len());
    }

    /// Whether any contact is watched.
    #[inline(always)]
    pub(in crate::run) fn watches(&self) -> bool {
        !self.contacts.is_empty()
    }

    fn forget(&mut self) {
        self.found.clear();
        self.next = 0;
    }

    /// Whether some u turns between two moments, at each of which `y` reads the components.
    pub(in crate::run) fn notice(
        &mut self,
        eq: &Equations<'_>,
        [from, to]: [(f64, &dyn Fn(usize) -> f64); 2],
        tolerance: f64,
    ) -> bool {
        self.forget();
        for &c in &self.contacts {
            let contact = &eq.model.contacts[c];
            let [start, end] = [from, to].map(|(t, y)| eq.motion(contact, t, y));
            let (_, near) = Guard::Drag.bands(contact, tolerance, end.u);
            if turns([start.du, end.du], near) {
                self.found.push((f64::NAN, c));
            }
        }
        !self.found.is_empty()
    }

    /// Finds the moments of those just noticed between two moments; `y` reads a component at a moment.
    pub(in crate::run) fn locate(
        &mut self,
        eq: &Equations<'_>,
        [from, to]: [f64; 2],
        y: impl Fn(usize, f64) -> f64,
    ) {
        for (moment, c) in &mut self.found {
            let contact = &eq.model.contacts[*c];
            let rate = |t: f64| eq.motion(contact, t, |i| y(i, t)).du;
            let bracket =
                Bracket { from: Point { x: from, y: rate(from) }, to: Point { x: to, y: rate(to) } };
            *moment = root(rate, bracket, NEAR * (to - from));
        }
        self.found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// The next turn up to a moment, s, and its contact.
    pub(in crate::run) fn take(&mut self, until: f64) -> Option<(f64, usize)> {
        let found = self.found.get(self.next).copied().filter(|(t, _)| *t <= until)?;
        self.next += 1;
        Some(found)
    }

    /// Before a corner at t, s.
    pub(in crate::run) fn near_corner(&mut self, eq: &Equations<'_>, t: f64, y: &[f64]) {
        self.before.clear();
        let rate = |c: &usize| eq.motion(&eq.model.contacts[*c], t, |i| y[i]).du;
        self.before.extend(self.contacts.iter().map(rate));
    }

    /// After it: those that turned there.
    pub(in crate::run) fn pass_corner(&mut self, eq: &Equations<'_>, (t, y): (f64, &[f64]), tolerance: f64) {
        self.forget();
        for (&c, before) in self.contacts.iter().zip(&self.before) {
            let contact = &eq.model.contacts[c];
            let motion = eq.motion(contact, t, |i| y[i]);
            let (_, near) = Guard::Drag.bands(contact, tolerance, motion.u);
            if turns([*before, motion.du], near) {
                self.found.push((t, c));
            }
        }
    }
}

/// Whether a rate changes its sign by more than rounding; what stands still has the sign of what rises, so that a turn at the
/// very end of a step counts once.
fn turns([before, after]: [f64; 2], near: f64) -> bool {
    (before >= 0.0) != (after >= 0.0) && before.abs().max(after.abs()) > near
}
