//! Preparation of a drive for a real-time loop.

use super::failure::Failure;
use super::stepper::chosen;
use crate::arguments::RealtimeArguments;
use stickslip_console::answer::complain;
use stickslip_drive::{Accuracy, Model, Plan, State, Stepper};
use stickslip_realtime::plant::{ChannelError, Input, Output, inputs, outputs};
use stickslip_realtime::probe::{Probe, RowsProbe, probe, rows};
use stickslip_realtime::session::Order;
use stickslip_realtime::wire::MOST_VALUES;
use stickslip_realtime::{Drive, Pace};
use stickslip_run::Watcher;
use stickslip_run::checkpoint::model_key;
use stickslip_run::{Job, Real, quantity};
use stickslip_scenario::Warning;

/// Number of frames computed before the start to measure the computing time.
const PROBED: u64 = 500;
/// The same for contacts modelled as rows of springs.
const ROWS_PROBED: u64 = 1000;
/// Maximum number of time steps per frame, if known in advance.
const MOST_STEPS: f64 = 1e5;
/// Maximum number of frames: two years at 20 kHz.
const MOST_FRAMES: f64 = 1.4e12;

/// A drive prepared for a real-time loop.
pub(super) struct Stage<'a> {
    pub(super) arguments: &'a RealtimeArguments,
    pub(super) job: &'a Job,
    /// Identification number of the scenario in packets.
    pub(super) number: u64,
    pub(super) inputs: Vec<Input>,
    pub(super) outputs: Vec<Output>,
    plan: Plan,
    start: State,
}

/// Rejects a frame with too many time steps.
fn check_steps(model: &Model, stepper: Stepper, arguments: &RealtimeArguments) -> Result<(), Failure> {
    let period = arguments.period;
    let (steps, longer) = match model.effective(stepper).accuracy() {
        // Rounding must not increase an integer ratio.
        Accuracy::Step(step) => ((period / step * (1.0 - 1e-12)).ceil(), true),
        Accuracy::Frame { length, error } => (model.substeps(length, error), false),
        Accuracy::Tolerance(_) => return Ok(()),
    };
    if steps <= MOST_STEPS {
        return Ok(());
    }
    let told = |time| quantity(Real(time), "s");
    let shorter = format!("a period of {} or less", told(MOST_STEPS * period / steps));
    let help = if longer {
        format!("a step of {} or more, or {shorter}", told(period / MOST_STEPS))
    } else {
        shorter
    };
    Err(Failure::TooManySteps {
        stepper: arguments.stepper.clone().unwrap_or_else(|| stepper.name().to_owned()),
        step: told(period / steps),
        steps,
        period: told(period),
        most: MOST_STEPS,
        help,
    })
}

impl<'a> Stage<'a> {
    pub(super) fn new(arguments: &'a RealtimeArguments, job: &'a Job) -> Result<Self, Failure> {
        let own = job.scenario.plan;
        let asked = arguments.stepper.as_deref();
        let plan = Plan { stepper: chosen(asked, own.stepper, &job.model, arguments.period)?, ..own };
        let start = job.model.start(&plan).map_err(|error| Failure::Unfit {
            stepper: asked.unwrap_or(plan.stepper.name()).to_owned(),
            message: job.scenario.refusal_of(plan, &error).message.clone(),
        })?;
        check_steps(&job.model, plan.stepper, arguments)?;
        let mut number = [0; 8];
        number.copy_from_slice(&model_key(&job.scenario)[..8]);
        let mut inputs = inputs(&job.scenario.scene)?;
        let wires = &arguments.wires;
        let asked =
            [("--inputs", wires.inputs.is_some()), ("--record-inputs", wires.record_inputs.is_some())];
        if let Some((option, _)) = asked.into_iter().find(|(_, is)| *is && inputs.is_empty()) {
            return Err(Failure::NoInputs(option));
        }
        inputs.extend(arguments.wires.notes.iter().map(|name| Input::note(name)));
        if inputs.len() > MOST_VALUES {
            return Err(ChannelError::TooMany(inputs.len(), "inputs").into());
        }
        let outputs = outputs(&job.model, arguments.wires.channels.as_deref())?;
        Ok(Self { arguments, job, number: u64::from_le_bytes(number), inputs, outputs, plan, start })
    }

    /// Returns the text with inputs and outputs for clients.
    pub(super) fn introduction(&self) -> String {
        let inputs: Vec<&str> = self.inputs.iter().map(|input| input.name.as_str()).collect();
        let inputs = if inputs.is_empty() { "none".to_owned() } else { inputs.join(", ") };
        let outputs: Vec<&str> = self.outputs.iter().map(|output| output.name.as_str()).collect();
        let (name, number) = (&self.job.name, self.number);
        format!(
            "{name}: scenario number {number:016x}\n  inputs: {inputs}\n  outputs: {}",
            outputs.join(", ")
        )
    }

    /// Returns warnings of the scenario for a frame integrator that replaces its own.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let is_own = matches!(self.job.scenario.plan.stepper, Stepper::Frames { .. });
        if is_own { Vec::new() } else { self.job.warnings_of_frames(self.plan.stepper) }
    }

    /// Describes the integrator.
    pub(super) fn stepper(&self) -> String {
        let stepper = self.job.model.effective(self.plan.stepper);
        match stepper.accuracy() {
            Accuracy::Tolerance(tolerance) => format!("{}, tolerance {tolerance:e}", stepper.name()),
            Accuracy::Step(step) => format!("{}, step {}", stepper.name(), quantity(Real(step), "s")),
            Accuracy::Frame { length, error } => {
                let steps = self.job.model.substeps(length, error);
                format!(
                    "{}, accuracy {error:e}, {steps} time steps each, more at corners and contact events",
                    stepper.name()
                )
            }
        }
    }

    /// Returns the settings of the loop. `recorded` is the number of frames of a recording to be replayed.
    pub(super) fn order(&self, recorded: Option<u64>) -> Result<Order, Failure> {
        let arguments = self.arguments;
        let asked = arguments.duration.map(|duration| duration / arguments.period);
        let asked = match (asked, recorded) {
            (None, Some(recorded)) => recorded as f64,
            (None, None) => self.plan.duration / arguments.period,
            (Some(asked), _) => asked,
        };
        let asked = asked.round();
        if !(1.0..=MOST_FRAMES).contains(&asked) {
            return Err(Failure::Frames(asked));
        }
        let frames = asked as u64;
        if let Some(recorded) = recorded.filter(|recorded| *recorded < frames) {
            return Err(Failure::Short { recorded, asked: frames });
        }
        let overrun = arguments.clock.overrun();
        let floor = if overrun.is_some() { (arguments.clock.floor / arguments.period) as u64 } else { 0 };
        Ok(Order {
            pace: Pace { period: arguments.period, overrun, spin: arguments.clock.spin },
            frames,
            favours: arguments.clock.favours(),
            floor: floor.min(frames),
            wait: arguments.wires.wait,
        })
    }

    /// Returns the drive at t = 0. The observer may interrupt it within a frame.
    pub(super) fn drive<'d>(&'d self, observer: &'d (dyn Watcher + Sync)) -> Result<Drive<'d>, Failure> {
        let channels = (&self.inputs[..], &self.outputs[..]);
        let start = (self.start.clone(), 0);
        let drive = Drive::new(&self.job.model, &self.plan, start, self.arguments.period, channels)?;
        Ok(drive.heeding(observer))
    }

    /// Measures the computing time of frames, on a copy, and that of a model with rows of springs. Returns `None` if
    /// the observer interrupts.
    pub(super) fn measure(
        &self,
        tells: bool,
        observer: &(dyn Watcher + Sync),
    ) -> Result<(Option<Probe>, Option<RowsProbe>), Failure> {
        let initial: Vec<f64> = self.inputs.iter().map(|input| input.initial).collect();
        let found = probe(&mut self.drive(observer)?, &initial, self.outputs.len(), PROBED, observer);
        let (clock, period) = (&self.arguments.clock, self.arguments.period);
        let Some(probe) = found else { return Ok((None, None)) };
        let [median, most, worst] = [probe.median, probe.most, probe.worst].map(|time| time as f64 / 1e3);
        let (frames, short) = (probe.frames, 1e6 * period);
        if clock.overrun().is_some() && !clock.force && median > short {
            let help = (2.0 * most).ceil();
            return Err(Failure::TooShort { period: short, frames, median, worst, help });
        }
        if tells {
            complain(format_args!(
                "{}: {frames} frames, computed without waiting: median {median:.2} µs, 99 % within {most:.2} µs, longest {worst:.2} µs",
                self.job.name
            ));
        }
        let channels = (&self.inputs[..], &self.outputs[..]);
        let rows = rows(&self.job.scenario.scene, &self.plan, period, channels, ROWS_PROBED, observer);
        Ok((Some(probe), rows))
    }
}
