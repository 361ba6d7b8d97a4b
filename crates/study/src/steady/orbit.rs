//! Steady motion over one period, from the moment at which a period of the figures' waveform begins.

use super::{Steady, SteadyError, endless};
use std::path::PathBuf;
use stickslip_drive::section::Section;
use stickslip_drive::{Event, Limits, Model, Plan, Record, Run, State, Stepper};
use stickslip_run::{Job, Series};

/// Last places by which a moment is passed that corners of waveforms are at: they are rounded sums.
const BEYOND: f64 = 4.0 * f64::EPSILON;

/// A period of a steady motion.
#[derive(Debug, Clone)]
pub struct Orbit {
    /// The state at its beginning: as early as everything repeats itself, bodies where a run from the start would have them but
    /// for the way that is theirs in the motion, its books of energies just opened.
    pub start: State,
    /// Rows and moments after events.
    pub series: Series,
}

/// Keeps rows and moments after events.
struct Rows(Series);

impl Record for Rows {
    fn row(&mut self, values: &[f64]) {
        self.0.push(values);
    }
    fn event(&mut self, _: &Event, values: &[f64]) {
        self.row(values);
    }
}

impl Steady {
    /// One period of the motion, in so many rows.
    ///
    /// # Errors
    ///
    /// A run that stops itself.
    pub fn orbit(&self, job: &Job, rows: u32) -> Result<Orbit, SteadyError> {
        let start = self.start(job)?;
        let mut record = Rows(Series::new(&self.model.channels(), &[]));
        let (from, every) = (start.time(), self.period / f64::from(rows.max(1)));
        let plan = Plan { every: Some(every), duration: from + self.period, ..self.plan(job) };
        let mut run = Run::new(&self.model, &plan, start.clone())?;
        run.finish(&mut record)?;
        Ok(Orbit { start, series: record.0 })
    }

    /// A job of the same drive with waveforms that never end, whose results go into a folder: what the motion is a motion of. A
    /// run of it may begin with the state at the beginning of an orbit.
    ///
    /// # Errors
    ///
    /// A scenario that is none with waveforms without an end.
    pub fn job(&self, job: &Job, folder: PathBuf) -> Result<Job, SteadyError> {
        endless::job(job, self.beginning(job), folder)
    }

    /// When the first period of the figures' waveform begins from which on everything repeats itself, s.
    fn beginning(&self, job: &Job) -> f64 {
        let waveform = job.scenario.figures.waveform.and_then(|w| job.scenario.scene.waveforms.get(w));
        let delay = waveform.map_or(0.0, |waveform| waveform.part.timing().delay);
        delay + ((self.begins.max(0.0) - delay) / self.period).ceil() * self.period
    }

    /// The motion at that moment.
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

/// A state led on to a time, s, its memories where it stands.
fn led(model: &Model, plan: &Plan, state: State, until: f64) -> Result<State, SteadyError> {
    let mut run = Run::new(model, plan, state)?;
    run.advance(until, &mut ())?;
    run.stop(&mut ());
    Ok(run.into_state())
}
