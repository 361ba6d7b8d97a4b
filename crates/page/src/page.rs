//! What the exports do.

use crate::contact::{Frame, Hand};
use serde_json::{Value, json};
use std::sync::Arc;
use stickslip_contact::Memory;
use stickslip_drive::{Due, Entry, Event, Record, Wants};
use stickslip_run::theory::{Sheet, Subject};
use stickslip_run::{Job, Outcome, PartedRun, Simulation, Summary, Table};
use stickslip_scenario::Scenario;
use stickslip_study::steady::{self, Options};

/// Largest number of breakpoints and springs in all snapshots of a run.
const MOST_KEPT: usize = 4_000_000;
/// Number of points of the curves of a contact.
const POINTS: usize = 41;

/// A scenario with its run, a motion by hand and a contact by hand.
#[derive(Default)]
pub struct Page {
    job: Option<Arc<Job>>,
    going: Option<PartedRun>,
    ran: Option<Ran>,
    live: Option<Live>,
    hand: Option<Hand>,
}

/// A motion by hand.
struct Live {
    simulation: Simulation,
    look: Look,
    /// Positions at which each contact is shown.
    frames: Vec<Frame>,
}

/// The slip memories at the end of an advance.
#[derive(Default)]
struct Look {
    until: f64,
    at: f64,
    memories: Vec<Memory>,
}

impl Record for Look {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Look(t, memories) = entry {
            (self.at, self.memories) = (t, memories.to_vec());
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => {
                // The time after this advance is not known yet: at its beginning there is another look.
                Some(if self.at < self.until { self.until } else { self.until * (1.0 + 1e-9) })
            }
            Due::Mark => None,
        }
    }
}

/// A finished run.
struct Ran {
    outcome: Outcome,
    /// Columns of the trace with the rows after events, if there are snapshots.
    merged: Vec<Vec<f64>>,
    /// Positions at which each contact is shown.
    frames: Vec<Frame>,
}

impl Page {
    fn job(&self) -> Result<&Arc<Job>, String> {
        self.job.as_ref().ok_or_else(|| "no scenario is loaded".to_owned())
    }

    /// Reads a scenario, which may not name files, and returns the names of its columns. The last run is forgotten.
    ///
    /// # Errors
    /// All errors of the scenario as `stickslip check` prints them; the last scenario stays.
    pub fn load(&mut self, text: &str) -> Result<String, String> {
        let scenario = Scenario::from_str_alone(text, "scenario.json").map_err(|error| error.to_string())?;
        let job = Job::new(scenario, "scenario".to_owned(), "".into()).map_err(|error| error.to_string())?;
        let names: Vec<String> = job.columns.channels().into_iter().map(|channel| channel.name).collect();
        *self = Self { job: Some(Arc::new(job)), hand: self.hand.take(), ..Self::default() };
        Ok(names.join("\n"))
    }

    /// Begins a run with a number of snapshots of the slip memories.
    ///
    /// # Errors
    /// No scenario is loaded, or the run cannot begin.
    pub fn begin(&mut self, snapshots: usize) -> Result<(), String> {
        let job = Arc::clone(self.job()?);
        (self.ran, self.going) = (None, None);
        let size: usize = job.start.memories().iter().map(size_of_memory).sum();
        let count = snapshots.min(MOST_KEPT / size.max(1));
        let span = job.scenario.plan.duration;
        let times = (0..count).map(|k| span * k as f64 / count.saturating_sub(1).max(1) as f64).collect();
        match PartedRun::new(Arc::clone(&job), times) {
            Ok(going) => self.going = Some(going),
            // The stepper without pauses runs at once.
            Err(stickslip_drive::RunError::NotHeld { .. }) => self.keep(&job, job.run_with_table(&())),
            Err(error) => return Err(format!("{error}\n   help: {}", error.advice())),
        }
        Ok(())
    }

    /// Continues the run for a number of looks, and returns the part of the duration that is done: 1 at the end.
    pub fn go(&mut self, looks: u64) -> f64 {
        let Some(mut going) = self.going.take() else { return 1.0 };
        if going.go(looks) {
            if let Some(job) = self.job.clone() {
                self.keep(&job, going.into_outcome());
            }
            return 1.0;
        }
        let duration = self.job.as_ref().map_or(1.0, |job| job.scenario.plan.duration);
        let done = going.time() / duration;
        self.going = Some(going);
        done.clamp(0.0, 1.0 - f64::EPSILON)
    }

    fn keep(&mut self, job: &Job, outcome: Outcome) {
        let contacts = job.model.contacts().enumerate();
        let frames = contacts.map(|(c, (_, law))| {
            let memories = outcome.snapshots.iter().filter_map(|(_, memories)| memories.get(c));
            let memories = memories.chain(job.start.memories().get(c));
            Frame::new(law, memories.map(|memory| memory.apex().d).fold(0.0, f64::max))
        });
        let frames = frames.collect();
        let table = outcome.table.as_ref().filter(|_| !outcome.snapshots.is_empty());
        let merged = table.map_or_else(Vec::new, Table::merged);
        self.ran = Some(Ran { outcome, merged, frames });
    }

    /// Returns the number of rows of the last run.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.column(0).map_or(0, <[f64]>::len)
    }

    /// Returns a column of the last run, with the rows after events if the run had snapshots. Words are numbers: open 0, stick 1, partial 2, slip 3.
    #[must_use]
    pub fn column(&self, index: usize) -> Option<&[f64]> {
        let Ran { outcome, merged, .. } = self.ran.as_ref()?;
        let table = outcome.table.as_ref()?;
        let merged = merged.get(index).map(Vec::as_slice);
        merged.or_else(|| table.column(&table.channels().get(index)?.name))
    }

    /// Returns `summary.json` of the last run; empty without one.
    #[must_use]
    pub fn summary(&self) -> String {
        let (Some(job), Some(ran)) = (&self.job, &self.ran) else { return String::new() };
        Summary::new(job, &ran.outcome).line().unwrap_or_default()
    }

    /// Returns the events of the last run, a line `time_s,source,kind` each.
    #[must_use]
    pub fn events(&self) -> String {
        let (Some(job), Some(ran)) = (&self.job, &self.ran) else { return String::new() };
        let waveform = |w: usize| job.scenario.scene.waveforms.get(w).map(|it| it.name.clone());
        let line = |event: &Event| {
            let source = job.model.source_name(event.source, |w| waveform(w).unwrap_or_default());
            format!("{},{source},{}", event.t, event.kind.name())
        };
        let events = ran.outcome.table.iter().flat_map(|table| table.events());
        events.map(line).collect::<Vec<_>>().join("\n")
    }

    /// Returns the SHA-256 of `trace.csv` of the last run; empty without one.
    #[must_use]
    pub fn hash(&self) -> String {
        let (Some(job), Some(ran)) = (&self.job, &self.ran) else { return String::new() };
        let table = ran.outcome.table.as_ref();
        let seal = table.and_then(|table| table.seal(job.scenario.written.state_numbers));
        seal.map_or_else(String::new, |seal| seal.sha256)
    }

    /// Returns what the page shows of the scenario, as JSON.
    #[must_use]
    pub fn about(&self) -> String {
        let Ok(job) = self.job() else { return String::new() };
        let numbers = job.scenario.parameters().into_iter().map(|it| {
            let range = it.range.map(|end| Some(end).filter(|end| end.is_finite()));
            json!({ "path": it.path, "value": it.value, "unit": it.unit, "range": range, "text": it.text })
        });
        let columns = job.columns.channels().into_iter().map(|channel| channel.name);
        let contacts = job.model.contacts().map(|(name, _)| name);
        let scenario: Value = serde_json::from_str(&job.resolved).unwrap_or_default();
        json!({
            "title": job.title(), "scenario": scenario, "numbers": numbers.collect::<Vec<_>>(),
            "columns": columns.collect::<Vec<_>>(), "contacts": contacts.collect::<Vec<_>>(),
        })
        .to_string()
    }

    /// Returns the inside of a contact: of snapshot `index`, of the motion by hand (-1), or of the contact by hand (-2). Empty if there is
    /// none. The numbers are described at `Frame::inside`.
    #[must_use]
    pub fn inside(&self, contact: usize, index: i32) -> Vec<f64> {
        let shown = || {
            if index == -2 {
                return self.hand.as_ref().map(Hand::inside);
            }
            let (_, law) = self.job.as_ref()?.model.contacts().nth(contact)?;
            let inside = |frames: &[Frame], t: f64, memories: &[Memory]| {
                Some(frames.get(contact)?.inside(law, memories.get(contact)?, [t, f64::NAN]))
            };
            let Ok(index) = usize::try_from(index) else {
                let Live { look, frames, .. } = self.live.as_ref()?;
                return inside(frames, look.at, &look.memories);
            };
            let ran = self.ran.as_ref()?;
            let (t, memories) = ran.outcome.snapshots.get(index)?;
            inside(&ran.frames, *t, memories)
        };
        shown().unwrap_or_default()
    }

    /// Searches the periodic orbit and returns its report.
    ///
    /// # Errors
    /// There is no periodic orbit, or it has not been found.
    pub fn steady(&self) -> Result<String, String> {
        let job = self.job()?;
        let found = steady::find(job, &Options::default()).map_err(|error| error.to_string())?;
        Ok(steady::Report::of(job, &found, None).line())
    }

    /// Takes a contact in the hand, untouched, and returns its constants and curves at an indentation, m; that of the scenario at the
    /// start, if it is not positive.
    ///
    /// # Errors
    /// There is no such contact, or it does not reach the indentation.
    pub fn hold(&mut self, contact: usize, indentation: f64) -> Result<String, String> {
        let job = Arc::clone(self.job()?);
        let (name, _) = job.model.contacts().nth(contact).ok_or("there is no such contact")?;
        let subject = Subject::find(&job, Some(name)).map_err(|error| error.to_string())?;
        let normal = match indentation {
            d if d > 0.0 => stickslip_contact::NormalGiven::Indentation(d),
            _ => subject.pressed(),
        };
        let sheet = Sheet::of(&subject, normal, None, POINTS).map_err(|error| error.to_string())?;
        self.hand = Some(Hand::new(subject.law, 1.5 * sheet.pressed.d.0));
        serde_json::to_string(&sheet).map_err(|error| error.to_string())
    }

    /// Moves the contact in the hand.
    ///
    /// # Errors
    /// No contact is in the hand, or it cannot be moved there.
    pub fn press(&mut self, d: f64, u: f64) -> Result<(), String> {
        self.hand.as_mut().ok_or("no contact is in the hand")?.press(d, u)
    }

    /// Begins a motion by hand and returns the names of its inputs, one per line.
    ///
    /// # Errors
    /// No scenario is loaded, or the run cannot begin.
    pub fn live(&mut self) -> Result<String, String> {
        let job = self.job()?;
        let simulation = Simulation::new(Arc::clone(job)).map_err(|error| error.to_string())?;
        let names: Vec<&str> = simulation.inputs().iter().map(|input| input.name.as_str()).collect();
        let names = names.join("\n");
        let contacts = job.model.contacts().zip(job.start.memories());
        let frames = contacts.map(|((_, law), memory)| Frame::new(law, memory.apex().d.max(0.0))).collect();
        self.live = Some(Live { simulation, look: Look::default(), frames });
        Ok(names)
    }

    /// Advances the motion by hand with a value of an input, and returns the values of the columns.
    ///
    /// # Errors
    /// There is no such motion, the value is refused, or the run stops.
    pub fn step(&mut self, until: f64, input: usize, value: f64) -> Result<Vec<f64>, String> {
        let Live { simulation, look, .. } = self.live.as_mut().ok_or("no motion by hand has begun")?;
        let values: &[(usize, f64)] = if value.is_nan() { &[] } else { &[(input, value)] };
        look.until = until;
        simulation.advance(until, values, look).map_err(|error| error.to_string())?;
        let held = simulation.held();
        Ok(held.job().columns.of(&held.row()).map(|(value, _)| value).collect())
    }
}

/// Returns the number of values that a slip memory stores.
fn size_of_memory(memory: &Memory) -> usize {
    match memory {
        Memory::Curve(_) => 64,
        Memory::Row(row) => row.springs.count(),
    }
}
