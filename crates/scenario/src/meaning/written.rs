//! Selection and format of written rows and events.

use super::{Builder, Figures, names, range, run};
use crate::fault::Fault;
use crate::form::{EventsOutputForm, KindForm, StatesForm};
use crate::guide::Help;
use crate::path::At;
use stickslip_drive::{Plan, Waveform};

/// Range of the number of digits. 17 digits represent a number exactly.
const DIGITS: (u64, u64) = (1, 17);

/// Maximum number of events written without thinning, and maximum product of events and contacts, because each event has numbers of all
/// contacts.
const MOST: u64 = 100_000;
const MOST_OF_ALL: u64 = 5_000_000;
/// Minimum of the number of events before thinning. Events are thinned in blocks of a hundredth of this number.
const LEAST: u64 = 100;

/// Selection and format of written rows and events.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Selection of events.
    pub events: WrittenEvents,
    /// Whether the steps of a drive are written.
    pub steps: bool,
    /// Start and end time, s, both included. The first and the last row of a run are always written.
    pub window: [f64; 2],
    /// Whether the window is defined relative to the end of the run.
    pub goes_by_end: bool,
    /// Number of significant digits; `None` for exact numbers.
    pub digits: Option<usize>,
    /// Whether contact states are written as numbers instead of words.
    pub state_numbers: bool,
}

/// Selection of events.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenEvents {
    /// Kinds of events; `None` for all.
    pub kinds: Option<Vec<&'static str>>,
    /// Indices of the contacts whose events are written; `None` for all events.
    pub contacts: Option<Vec<usize>>,
    /// Maximum number of events before thinning; 0 for none, the largest number for no thinning.
    pub most: u64,
}

impl Written {
    /// Returns whether all events of the run are written.
    pub fn has_all_events(&self) -> bool {
        let WrittenEvents { kinds, contacts, most } = &self.events;
        kinds.is_none() && contacts.is_none() && *most > 0 && self.window == [0.0, f64::INFINITY]
    }
}

impl Builder<'_> {
    /// Returns the selection and format of rows and events.
    pub(super) fn written(&self, plan: Plan, figures: Figures) -> Result<Written, Fault> {
        let root = At::ROOT;
        let (at, form) = (root.key("output"), &self.form.output);
        let digits = |digits: crate::form::Count| {
            range::count_between(&at.key("float"), digits.0, DIGITS.0, DIGITS.1).map(|digits| digits as usize)
        };
        Ok(Written {
            events: self.written_events(&at.key("events"))?,
            steps: form.steps.is_all(),
            window: self.window(&at, plan, figures)?,
            goes_by_end: form.last.is_some(),
            digits: form.float.map(digits).transpose()?.filter(|digits| *digits < DIGITS.1 as usize),
            state_numbers: form.states == StatesForm::Numbers,
        })
    }

    fn written_events(&self, at: &At<'_>) -> Result<WrittenEvents, Fault> {
        let all = |most: u64| WrittenEvents { kinds: None, contacts: None, most };
        let some = match &self.form.output.events {
            None => return Ok(all(self.most_events())),
            Some(EventsOutputForm::All) => return Ok(all(u64::MAX)),
            Some(EventsOutputForm::Off) => return Ok(all(0)),
            Some(EventsOutputForm::Some(some)) => some,
        };
        let asked = some.most.map(|most| range::count_between(&at.key("most"), most.0, LEAST, u64::MAX));
        let most = asked.transpose()?.unwrap_or_else(|| self.most_events());
        let kinds = some.kinds.as_ref().map(|kinds| kinds.iter().copied().map(KindForm::name).collect());
        let places = |names: &Vec<String>| {
            let list = at.key("contacts");
            names.iter().enumerate().map(|(i, name)| self.written_contact(&list.index(i), name)).collect()
        };
        let contacts: Option<Result<Vec<usize>, Fault>> = some.contacts.as_ref().map(places);
        Ok(WrittenEvents { kinds, contacts: contacts.transpose()?, most })
    }

    /// Returns the default number of events before thinning.
    fn most_events(&self) -> u64 {
        let contacts = self.form.contacts.0.len().max(1) as u64;
        MOST.min(MOST_OF_ALL / contacts).max(LEAST)
    }

    /// Returns the index of a contact.
    fn written_contact(&self, at: &At<'_>, name: &str) -> Result<usize, Fault> {
        let contacts = &self.form.contacts;
        contacts.find(name).ok_or_else(|| names::unknown(at, ("contact", "contacts"), name, contacts))
    }

    /// Returns start and end time of written rows and events, s.
    fn window(&self, at: &At<'_>, plan: Plan, figures: Figures) -> Result<[f64; 2], Fault> {
        let form = &self.form.output;
        if let Some(periods) = form.last {
            let at = at.key("last");
            if form.window.is_some() {
                let fault = at.fault("the window is already given").on_key();
                return Err(fault.against(["output.window"]).help("keep one of them"));
            }
            return self.last_periods(&at, periods, plan, figures);
        }
        let (at, Some(window)) = (at.key("window"), form.window) else { return Ok([0.0, f64::INFINITY]) };
        if window.from.is_none() && window.to.is_none() {
            return Err(at.fault("expected \"from\", \"to\" or both").ask(Help::Shape));
        }
        let from = window.from.map_or(Ok(0.0), |from| range::at_least_zero(&at.key("from"), from))?;
        let to = window.to.map_or(Ok(f64::INFINITY), |to| range::at_least_zero(&at.key("to"), to))?;
        if to < from {
            let fault = at.key("to").expected(format_args!("a time of at least {} s", range::short(from)));
            return Err(fault.against_path(at.key("from").path()));
        }
        if from > plan.duration {
            let end = range::short(plan.duration);
            let wanted = format_args!("a time within the run, which ends at {end} s");
            return Err(at.key("from").expected(wanted).against(run::duration(self.form).iter().copied()));
        }
        Ok([from, to])
    }

    /// Returns the time range of the last periods of a run.
    fn last_periods(
        &self,
        at: &At<'_>,
        periods: f64,
        plan: Plan,
        figures: Figures,
    ) -> Result<[f64; 2], Fault> {
        let periods = range::number_above_zero(at, periods)?;
        let waveform = figures.waveform.and_then(|place| self.scene.waveforms.get(place));
        let Some(period) = waveform.and_then(|waveform| Waveform::period(&waveform.part)) else {
            let fault = at
                .fault("there is no single waveform with a period that determines the last periods")
                .on_key();
            let fault = fault.against(["figures", "waveforms"]);
            return Err(fault.help("name one with a period in figures.waveform, or give output.window"));
        };
        if plan.until_steady.is_some() {
            let fault =
                at.fault("the last periods of a run that may end early are not known in advance").on_key();
            let fault = fault.against(["run.until_steady"]);
            return Err(fault.help("give output.window, or leave out run.until_steady"));
        }
        Ok([(plan.duration - periods * period).max(0.0), f64::INFINITY])
    }
}
