//! What a loop came to, for machines and for people.

mod tables;
mod words;

pub use tables::{frames_csv, histogram_csv};
pub use words::{PROMISE, text};

use crate::histogram::Histogram;
use crate::intake::Received;
use crate::memory::MemoryError;
use crate::pace::{Overrun, Pace, Stop, Timing};
use crate::probe::{Probe, RowsProbe};
use crate::session::Ended;
use serde::Serialize;

/// What a loop came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Name of the scenario.
    pub scenario: String,
    /// Its number in packets, in hexadecimal digits.
    pub scenario_number: String,
    /// The stepper, in words.
    pub stepper: String,
    /// Length of a frame, s.
    pub period_s: f64,
    /// Frames asked for.
    pub frames_asked: u64,
    /// Frames computed.
    pub frames: u64,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// On the wall from the first deadline on, s.
    pub wall_s: f64,
    /// Whether frames waited for their deadlines.
    pub paced: bool,
    /// How long before each deadline the loop watched the clock, s.
    pub spin_s: f64,
    /// What was done about overruns.
    pub overrun_policy: Option<&'static str>,
    /// How it ended: `complete`, `interrupted`, `overrun`, `silence`, `memory`, `stopped`, or `no_input`.
    pub ended: &'static str,
    /// Why the drive stopped itself, or what became of the shared memory.
    pub error: Option<String>,
    /// Whether it is complete and no frame overran.
    pub kept: bool,
    /// Frames that ended after the next deadline.
    pub overruns: u64,
    /// Deadlines left out.
    pub deadlines_left_out: u64,
    /// Most in a row.
    pub most_left_out: u64,
    /// From waking until the outputs were out.
    pub execution: Times,
    /// From the deadline until the loop woke.
    pub latency: Option<Times>,
    /// The same two of the empty loop of the same period.
    pub empty_execution: Option<Times>,
    /// Wake-up latency of the empty loop.
    pub empty_latency: Option<Times>,
    /// Frames of the empty loop.
    pub empty_frames: u64,
    /// Names of inputs, in the order of packets.
    pub inputs: Vec<String>,
    /// Names of outputs, in the order of packets.
    pub outputs: Vec<String>,
    /// What came in.
    pub received: Received,
    /// Outputs that did not go out.
    pub outputs_unsent: u64,
    /// Frames for which the log had no room.
    pub log_lost: u64,
    /// Frames for which the recording of inputs had no room.
    pub recording_lost: u64,
    /// What the system did not grant.
    pub denied: Vec<String>,
    /// What frames took before the start, unpaced.
    pub probe: Option<ProbeTimes>,
    /// The same on rows of springs.
    pub rows: Option<RowTimes>,
}

/// A histogram in a few numbers, µs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Times {
    /// Half were no longer.
    pub median_us: f64,
    /// 999 of 1 000 were no longer.
    pub p99_9_us: f64,
    /// 9 999 of 10 000 were no longer.
    pub p99_99_us: f64,
    /// None was longer.
    pub worst_us: f64,
    /// The mean.
    pub mean_us: f64,
}

/// What frames took before the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProbeTimes {
    /// How many.
    pub frames: u64,
    /// Median, µs.
    pub median_us: f64,
    /// 99 of 100 were no longer, µs.
    pub p99_us: f64,
    /// The longest, µs.
    pub worst_us: f64,
}

/// What frames took on rows of springs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RowTimes {
    /// Springs of a row.
    pub springs: Vec<usize>,
    /// 99 of 100 frames were no longer, µs.
    pub p99_us: Vec<f64>,
    /// Springs for which a straight line through these comes to the period; none where that is not to be seen from them.
    pub fit_in_period: Option<u64>,
}

/// What is known before a loop begins.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Name of the scenario.
    pub scenario: String,
    /// Its number in packets.
    pub number: u64,
    /// The stepper, in words.
    pub stepper: String,
    /// Names of inputs.
    pub inputs: Vec<String>,
    /// Names of outputs.
    pub outputs: Vec<String>,
    /// What frames took before the start.
    pub probe: Option<Probe>,
    /// The same on rows of springs.
    pub rows: Option<RowsProbe>,
}

impl Report {
    /// What a loop came to.
    pub fn new(subject: Subject, pace: &Pace, frames_asked: u64, ended: &Ended) -> Self {
        let Timing { latency, execution, overruns, left_out, most_left_out, wall, .. } = &ended.timing;
        let (paced, empty) = (pace.overrun.is_some(), &ended.floor);
        let (word, error) = ending(ended);
        let frames = ended.timing.frames();
        let lost = |tape: &Option<crate::tape::Tape>| tape.as_ref().map_or(0, crate::tape::Tape::lost);
        let complete = word == "complete";
        Self {
            scenario: subject.scenario,
            scenario_number: format!("{:016x}", subject.number),
            stepper: subject.stepper,
            period_s: pace.period,
            frames_asked,
            frames,
            simulated_s: frames as f64 * pace.period,
            wall_s: *wall as f64 / 1e9,
            paced,
            spin_s: pace.spin,
            overrun_policy: pace.overrun.map(|overrun| match overrun {
                Overrun::Skip => "skip",
                Overrun::Stop => "stop",
            }),
            ended: word,
            error,
            kept: paced && complete && *overruns == 0,
            overruns: *overruns,
            deadlines_left_out: *left_out,
            most_left_out: *most_left_out,
            execution: Times::of(execution),
            latency: paced.then(|| Times::of(latency)),
            empty_execution: (empty.frames() > 0).then(|| Times::of(&empty.execution)),
            empty_latency: (empty.frames() > 0 && paced).then(|| Times::of(&empty.latency)),
            empty_frames: empty.frames(),
            inputs: subject.inputs,
            outputs: subject.outputs,
            received: *ended.wiring.intake.received(),
            outputs_unsent: ended.unsent,
            log_lost: lost(&ended.wiring.log),
            recording_lost: lost(&ended.wiring.recording),
            denied: ended.denied.iter().map(ToString::to_string).collect(),
            probe: subject.probe.map(|probe| ProbeTimes {
                frames: probe.frames,
                median_us: micro(probe.median),
                p99_us: micro(probe.most),
                worst_us: micro(probe.worst),
            }),
            rows: subject.rows.map(|rows| RowTimes {
                springs: rows.measured.iter().map(|(count, _)| *count).collect(),
                p99_us: rows.measured.iter().map(|(_, time)| micro(*time)).collect(),
                fit_in_period: rows.fits,
            }),
        }
    }

    /// As a file of JSON.
    ///
    /// # Errors
    /// None: all keys are strings, and no number is not finite.
    pub fn pretty(&self) -> serde_json::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// As a line of JSON.
    ///
    /// # Errors
    /// As [`Self::pretty`].
    pub fn line(&self) -> serde_json::Result<String> {
        serde_json::to_string(self)
    }
}

/// How a loop ended, in a word, and why where that says too little.
fn ending(ended: &Ended) -> (&'static str, Option<String>) {
    match &ended.outcome {
        Ok(()) if ended.waited_in_vain => ("no_input", None),
        Ok(()) => ("complete", None),
        Err(Stop::Interrupted) => ("interrupted", None),
        Err(Stop::Overrun) => ("overrun", None),
        Err(Stop::Silence) => ("silence", None),
        Err(Stop::Cut(path)) => ("memory", Some(MemoryError::Cut(path.clone()).to_string())),
        Err(Stop::Plant(error)) => ("stopped", Some(error.to_string())),
    }
}

impl Times {
    fn of(histogram: &Histogram) -> Self {
        Self {
            median_us: micro(histogram.quantile(0.5)),
            p99_9_us: micro(histogram.quantile(0.999)),
            p99_99_us: micro(histogram.quantile(0.9999)),
            worst_us: micro(histogram.worst()),
            mean_us: histogram.mean() / 1e3,
        }
    }
}

fn micro(nanoseconds: u64) -> f64 {
    nanoseconds as f64 / 1e3
}
