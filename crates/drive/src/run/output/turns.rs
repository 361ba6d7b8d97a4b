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
    /// Rates of u, m/s, in the order of the contacts: at the end of the last step, or before a corner.
    rates: Vec<f64>,
    /// When that was, s.
    at: f64,
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
        self.at = f64::NAN;
        self.forget();
        self
    }

    /// Watches the contacts of a body, by its place in the scene.
    pub(super) fn begin(&mut self, model: &Model, body: Option<usize>) {
        self.contacts.clear();
        self.at = f64::NAN;
        self.forget();
        let binding = body.and_then(|body| Some(model.bodies.get(body)?.bindings[Axis::X as usize]));
        let Some(Binding::Free(i)) = binding else { return };
        let touches = |contact: &&Contact| contact.u.free.iter().any(|(k, _)| *k == i);
        let watched = model.contacts.iter().filter(|contact| contact.turns_unseen()).filter(touches);
        self.contacts.extend(watched.map(|contact| contact.place));
        self.rates.reserve(self.contacts.len());
        self.found.reserve(self.contacts.len());
    }

    /// Whether any contact is watched.
    #[inline(always)]
    pub(in crate::run) fn watches(&self) -> bool {
        !self.contacts.is_empty()
    }

    /// Forgets what was found.
    fn forget(&mut self) {
        self.found.clear();
        self.next = 0;
    }

    /// Whether some u turns between two moments, with the components there.
    pub(in crate::run) fn notice(
        &mut self,
        eq: &Equations<'_>,
        (from, before): (f64, &[f64]),
        to: (f64, impl Fn(usize) -> f64),
        tolerance: f64,
    ) -> bool {
        self.forget();
        // A step begins where the last one ended.
        if self.at != from {
            self.stand(eq, from, before);
        }
        self.compare(eq, to, tolerance);
        !self.found.is_empty()
    }

    /// Finds those that turn until a moment; their rates there are the next to compare with.
    fn compare(&mut self, eq: &Equations<'_>, (t, y): (f64, impl Fn(usize) -> f64), tolerance: f64) {
        for (&c, rate) in self.contacts.iter().zip(&mut self.rates) {
            let contact = &eq.model.contacts[c];
            let slide = eq.slide(contact, t, &y);
            let before = std::mem::replace(rate, slide.rate);
            if turns([before, slide.rate]) {
                let (_, near) = Guard::Drag.bands(contact, tolerance, slide.value);
                if before.abs().max(slide.rate.abs()) > near {
                    self.found.push((f64::NAN, c));
                }
            }
        }
        self.at = t;
    }

    /// Rates at a moment, to compare with.
    fn stand(&mut self, eq: &Equations<'_>, t: f64, y: &[f64]) {
        self.rates.clear();
        self.rates.extend(self.contacts.iter().map(|c| eq.slide(&eq.model.contacts[*c], t, |i| y[i]).rate));
        self.at = t;
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
            let rate = |t: f64| eq.slide(contact, t, |i| y(i, t)).rate;
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
        self.stand(eq, t, y);
    }

    /// After it: those that turned there.
    pub(in crate::run) fn pass_corner(&mut self, eq: &Equations<'_>, (t, y): (f64, &[f64]), tolerance: f64) {
        self.forget();
        self.compare(eq, (t, |i| y[i]), tolerance);
        self.found.iter_mut().for_each(|(moment, _)| *moment = t);
    }
}

/// Whether a rate changes its sign; what stands still has the sign of what rises, so that a turn at the very end of a step
/// counts once.
fn turns([before, after]: [f64; 2]) -> bool {
    (before >= 0.0) != (after >= 0.0)
}
