//! Turning points of the contact displacement u at which no contact law ends.
//!
//! Under a constant normal force, u turns at events: reversals and ends of gross slip. Under a varying normal force, the velocities of the
//! slip edges determine the law. In full stick, u then turns without an event. In a shrinking contact, u turns before the slip edge does.
//!
//! These turning points are reported to a record that watches a body; the run does not use them. Turning points are detected by the sign of
//! u̇ at both ends of a step. A pair of turning points within one step is missed.

use crate::contact::Contact;
use crate::equations::Equations;
use crate::model::{Binding, Model};
use crate::scene::Axis;
use stickslip_contact::{Engine, Guard};
use stickslip_stepper::{Bracket, Point, root};

/// Error of the time of a turning point, as a fraction of the step.
const NEAR: f64 = 1e-12;

/// Contacts of a watched body whose displacement u may turn without an event, and their turning points in a step.
#[derive(Debug, Default)]
pub(in crate::run) struct Turns {
    contacts: Vec<usize>,
    /// Velocities u̇ of the contacts at time `at`, m/s: at the end of the last step or before a corner.
    rates: Vec<f64>,
    /// Time of `rates`, s.
    at: f64,
    /// Times (s) and contacts of the turning points, sorted by time; times are NaN until they are located.
    found: Vec<(f64, usize)>,
    next: usize,
}

impl Contact {
    /// Whether u may turn without an event, which happens for a contact with a memory curve under a varying normal force.
    pub(crate) fn turns_unseen(&self) -> bool {
        !self.inert && !self.is_constant() && matches!(self.engine, Engine::Curve)
    }
}

impl Turns {
    /// Returns an empty list in the same storage.
    pub(in crate::run) fn renewed(mut self) -> Self {
        self.contacts.clear();
        self.at = f64::NAN;
        self.forget();
        self
    }

    /// Selects the contacts of a body, given by its index in the model.
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

    /// Removes all turning points found.
    fn forget(&mut self) {
        self.found.clear();
        self.next = 0;
    }

    /// Finds the contacts whose u turns between two times with given components. Returns whether any such contact exists.
    pub(in crate::run) fn notice(
        &mut self,
        eq: &Equations<'_>,
        (from, before): (f64, &[f64]),
        to: (f64, impl Fn(usize) -> f64),
        tolerance: f64,
    ) -> bool {
        self.forget();
        // Usually the step begins where the last one ended.
        if self.at != from {
            self.stand(eq, from, before);
        }
        self.compare(eq, to, tolerance);
        !self.found.is_empty()
    }

    /// Finds the contacts whose u̇ has changed sign up to time t, and stores the velocities u̇ at t.
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

    /// Stores the velocities u̇ at time t.
    fn stand(&mut self, eq: &Equations<'_>, t: f64, y: &[f64]) {
        self.rates.clear();
        self.rates.extend(self.contacts.iter().map(|c| eq.slide(&eq.model.contacts[*c], t, |i| y[i]).rate));
        self.at = t;
    }

    /// Computes the times of the turning points found between two times. `rate` returns u̇ of a contact at a given time, m/s.
    pub(in crate::run) fn locate(
        &mut self,
        eq: &Equations<'_>,
        [from, to]: [f64; 2],
        mut rate: impl FnMut(f64, &Contact) -> f64,
    ) {
        for (moment, c) in &mut self.found {
            let contact = &eq.model.contacts[*c];
            let mut rate = |t: f64| rate(t, contact);
            let bracket =
                Bracket { from: Point { x: from, y: rate(from) }, to: Point { x: to, y: rate(to) } };
            *moment = root(rate, bracket, NEAR * (to - from));
        }
        self.found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// Returns time and contact of the next turning point up to time `until`, s.
    pub(in crate::run) fn take(&mut self, until: f64) -> Option<(f64, usize)> {
        let found = self.found.get(self.next).copied().filter(|(t, _)| *t <= until)?;
        self.next += 1;
        Some(found)
    }

    /// Stores the velocities u̇ before a corner at time t, s.
    pub(in crate::run) fn near_corner(&mut self, eq: &Equations<'_>, t: f64, y: &[f64]) {
        self.stand(eq, t, y);
    }

    /// Finds the contacts whose u̇ has changed sign at a corner at time t, s.
    pub(in crate::run) fn pass_corner(&mut self, eq: &Equations<'_>, (t, y): (f64, &[f64]), tolerance: f64) {
        self.forget();
        self.compare(eq, (t, |i| y[i]), tolerance);
        self.found.iter_mut().for_each(|(moment, _)| *moment = t);
    }
}

/// Whether a velocity changes sign. Zero counts as positive, so that a turning point at a step end counts once.
fn turns([before, after]: [f64; 2]) -> bool {
    (before >= 0.0) != (after >= 0.0)
}
