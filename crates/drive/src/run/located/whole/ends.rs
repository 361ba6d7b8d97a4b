//! Start, length and end of an interval of step doubling.

use crate::contact::Contact;
use crate::equations::Equations;
use crate::record::Record;
use crate::run::horizon::Progress;
use crate::run::located::Located;
use crate::state::{Books, Detour, State};
use crate::{RunError, Source};
use std::f64::consts::TAU;
use stickslip_contact::Site;
use stickslip_stepper::Attempt;

/// Length of the first interval of step doubling, in natural periods.
const SHARE: f64 = 1.0 / 64.0;
/// Length of the first step in an interval of step doubling, as a fraction of the interval.
const FIRST: f64 = 1e-3;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Begins step doubling after an error due to accumulating events or to steps that do not advance the time.
    ///
    /// Returns the error `reason` unchanged if step doubling is not possible.
    pub(in crate::run::located) fn depart(
        &mut self,
        state: &mut State,
        reason: RunError,
    ) -> Result<Progress, RunError> {
        let model = self.setting.model;
        let of = |name: &str| model.contacts.iter().find(|contact| contact.name == name);
        let period = match &reason {
            RunError::Zeno { contact, .. } => of(contact).map(|contact| TAU / contact.natural.frequency),
            RunError::StepTooSmall { .. } | RunError::Crawl { .. } => Some(self.pace(state)),
            _ => None,
        };
        // Time must resolve the steps.
        let tells = |period: &f64| period.is_normal() && state.t + 0.01 * FIRST * SHARE * period > state.t;
        let Some(period) = period.filter(tells) else { return Err(reason) };
        if self.detour.is_some() || model.contacts.is_empty() {
            return Err(reason);
        }
        if self.ledger.booked.books == Books::Behind {
            self.settle(state);
            self.ledger.booked.books = Books::Current;
        }
        state.counts.detours += 1;
        // A first interval is short, because most accumulations end soon. It is longer if they continue.
        let goes_on = state.t <= self.last_detour.end + 2.0 * self.last_detour.length;
        let length = if goes_on { f64::min(2.0 * self.last_detour.length, period) } else { SHARE * period };
        let detour = Detour { end: state.t + length, length, step: FIRST * length };
        (self.detour, self.last_detour) = (Some(detour), detour);
        self.bounds.forget();
        self.take_whole(state);
        Ok(Progress::Made)
    }

    /// Returns the period of the fastest oscillation, s. Without oscillation, returns the shortest duration of a waveform.
    fn pace(&self, state: &State) -> f64 {
        let model = self.setting.model;
        if model.fastest > 0.0 {
            return TAU / model.fastest;
        }
        let lengths = model.waveforms.iter().zip(&state.pieces);
        let lengths = lengths.map(|(waveform, piece)| waveform.extent().min(piece.end - piece.start));
        lengths.fold(f64::INFINITY, f64::min)
    }

    /// Selects step doubling for the whole run if a spring row under a varying normal force changes too often.
    ///
    /// The change of each spring would have to end a step, because embedded error estimates do not detect these changes.
    pub(in crate::run::located) fn stay_whole(&mut self, state: &mut State) {
        let model = self.setting.model;
        let dense =
            |contact: &Contact| contact.slot.is_some() && !contact.engine.branches() && !contact.has_lulls();
        // Events of blocks would cut every step. Located events handle them better.
        if model.blocks.is_empty() && model.contacts.iter().any(dense) {
            let period = TAU / model.fastest;
            // Without oscillation, the natural frequencies of contacts limit the step.
            let frequency = model.contacts.iter().map(|c| c.natural.frequency).fold(model.fastest, f64::max);
            self.detour = Some(Detour { end: f64::MAX, length: TAU / frequency, step: FIRST * period });
            self.take_whole(state);
        }
    }

    /// Ends step doubling and returns to located events; the law of every contact is chosen again.
    ///
    /// The beginning of gross slip during step doubling was not located. It is reported at this time, possibly for a second time.
    pub(super) fn arrive(&mut self, state: &mut State, detour: &Detour, record: &mut dyn Record) {
        self.detour = None;
        self.bounds.forget();
        state.step = self.control.after_event(detour.step);
        for c in 0..self.setting.model.contacts.len() {
            self.decide(state, c);
        }
        self.restart(state);
        for c in (0..self.setting.model.contacts.len()).filter(|c| !self.setting.model.contacts[*c].inert) {
            if state.modes[c].is_gross() {
                let [begins, _] = self.setting.model.contacts[c].gross_slip();
                self.note(state, Source::Contact(c), begins, record);
            }
        }
    }
}
