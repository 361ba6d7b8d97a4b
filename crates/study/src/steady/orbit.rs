//! Time histories of a periodic orbit over one period of the waveform named in `figures`.

use super::{Steady, SteadyError, endless};
use std::path::PathBuf;
use stickslip_drive::section::Section;
use stickslip_drive::{Entry, Limits, Model, Plan, Record, Run, State, Stepper};
use stickslip_run::{Job, Series};

/// Relative margin added to an instant with waveform corners, because the instant is a rounded sum.
const BEYOND: f64 = 4.0 * f64::EPSILON;

/// One period of a periodic orbit.
#[derive(Debug, Clone)]
pub struct Orbit {
    /// State at the earliest time at which all waveforms are periodic. Apart from their motion in the orbit, bodies have the positions of a
    /// run from the start. The energy balance starts at zero.
    pub start: State,
    /// Samples at regular times and after events.
    pub series: Series,
}

/// Recorder of samples at regular times and after events.
struct Rows(Series);

impl Record for Rows {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Row(values) | Entry::Event(_, values) = entry {
            self.0.push(values);
        }
    }
}

impl Steady {
    /// Simulates one period with `rows` samples.
    ///
    /// # Errors
    ///
    /// Fails if the run stops with an error.
    pub fn orbit(&self, job: &Job, rows: u32) -> Result<Orbit, SteadyError> {
        let start = self.start(job)?;
        let mut record = Rows(Series::new(&self.model.channels(), &[]));
        let (from, every) = (start.time(), self.period / f64::from(rows.max(1)));
        let plan = Plan { every: Some(every), duration: from + self.period, ..self.plan(job) };
        let mut run = Run::new(&self.model, &plan, start.clone())?;
        run.finish(&mut record)?;
        Ok(Orbit { start, series: record.0 })
    }

    /// Returns a runnable scenario of the same drive with endless waveforms, with results in `folder`. A run of this scenario may start
    /// with the state at the start of an orbit.
    ///
    /// # Errors
    ///
    /// Fails if the scenario is invalid with endless waveforms.
    pub fn job(&self, job: &Job, folder: PathBuf) -> Result<Job, SteadyError> {
        endless::job(job, self.beginning(job), folder)
    }

    /// Returns the first start of a period of the waveform named in `figures` after which all waveforms are periodic, s.
    fn beginning(&self, job: &Job) -> f64 {
        let waveform = job.scenario.figures.waveform.and_then(|w| job.scenario.scene.waveforms.get(w));
        let delay = waveform.map_or(0.0, |waveform| waveform.part.timing().delay);
        delay + ((self.begins.max(0.0) - delay) / self.period).ceil() * self.period
    }

    /// Returns the state of the orbit at the start of this period.
    pub(super) fn start(&self, job: &Job) -> Result<State, SteadyError> {
        let plan = self.plan(job);
        let begins = self.beginning(job);
        let mut first = self.model.start(&plan)?;
        if begins > 0.0 {
            first = led(&self.model, &plan, first, begins * (1.0 + BEYOND))?;
        }
        let section = Section::new(&self.model, first);
        let periods = ((self.state.time() - begins) / self.period).ceil().max(1.0);
        let until = (begins + periods * self.period) * (1.0 + BEYOND);
        let (state, _) = section.back(led(&self.model, &plan, self.state.clone(), until)?);
        Ok(section.begun(&state))
    }

    fn plan(&self, job: &Job) -> Plan {
        let limits = Limits { wall: None, ..job.scenario.plan.limits };
        let stepper = Stepper::Event { tolerance: self.tolerance };
        Plan { duration: f64::MAX, stepper, limits, every: None, until_steady: None }
    }
}

/// Simulates a state until a time, s, and then commits the slip memories.
fn led(model: &Model, plan: &Plan, state: State, until: f64) -> Result<State, SteadyError> {
    let mut run = Run::new(model, plan, state)?;
    run.advance(until, &mut ())?;
    run.stop(&mut ());
    Ok(run.into_state())
}
