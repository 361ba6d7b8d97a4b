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
use schemars::JsonSchema;
use serde::Serialize;

/// What a loop came to.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Report {
    /// name of the scenario
    pub scenario: String,
    /// its number in packets, in hexadecimal digits
    pub scenario_number: String,
    /// the stepper, in words
    pub stepper: String,
    /// length of a frame
    pub period_s: f64,
    /// frames asked for
    pub frames_asked: u64,
    /// frames computed
    pub frames: u64,
    /// simulated time
    pub simulated_s: f64,
    /// on the wall from the first deadline on
    pub wall_s: f64,
    /// whether frames waited for their deadlines
    pub paced: bool,
    /// how long before each deadline the loop watched the clock
    pub spin_s: f64,
    /// what was done about overruns, `skip` (deadlines that had passed were left out) or `stop`; null without a clock
    pub overrun_policy: Option<&'static str>,
    /// how it ended: `complete`, `interrupted`, `overrun`, `silence`, `memory` (another process made the shared memory
    /// shorter), `stopped` or `no_input`
    pub ended: &'static str,
    /// why the drive stopped itself, or what became of the shared memory; null where neither was
    pub error: Option<String>,
    /// whether it is complete and no frame ended after the next deadline
    pub kept: bool,
    /// frames that ended after the next deadline
    pub overruns: u64,
    /// deadlines that had passed and were left out
    pub deadlines_skipped: u64,
    /// most of them in a row
    pub longest_skip: u64,
    /// From waking until the outputs were out.
    pub execution: Times,
    /// From the deadline until the loop woke.
    pub latency: Option<Times>,
    /// The same two of the empty loop of the same period.
    pub empty_execution: Option<Times>,
    /// Wake-up latency of the empty loop.
    pub empty_latency: Option<Times>,
    /// its frames
    pub empty_frames: u64,
    /// names of inputs, in the order of packets
    pub inputs: Vec<String>,
    /// names of outputs, in the order of packets
    pub outputs: Vec<String>,
    /// What came in.
    pub received: Received,
    /// outputs that did not go out
    pub outputs_unsent: u64,
    /// frames for which the log had no room
    pub log_lost: u64,
    /// frames for which the recording of inputs had no room
    pub recording_lost: u64,
    /// what the system did not grant, in words
    pub denied: Vec<String>,
    /// What frames took before the start, unpaced.
    pub probe: Option<ProbeTimes>,
    /// The same on rows of springs.
    pub rows: Option<RowTimes>,
}

/// A histogram in a few numbers, µs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Times {
    /// median, µs: half were no longer. Of `execution` from waking until the outputs were out, of `latency` from the deadline until the
    /// loop woke, null without a clock; `empty_execution` and `empty_latency` are those of an empty loop of the same period before the
    /// start, null where none was run
    pub median_us: f64,
    /// µs, 999 of 1 000 were no longer
    pub p99_9_us: f64,
    /// µs, 9 999 of 10 000 were no longer
    pub p99_99_us: f64,
    /// the longest, µs
    pub worst_us: f64,
    /// mean, µs
    pub mean_us: f64,
}

/// What frames took before the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ProbeTimes {
    /// frames that were tried before the start, without a clock; null where none were
    pub frames: u64,
    /// half of them took no longer
    pub median_us: f64,
    /// 99 of 100 took no longer
    pub p99_us: f64,
    /// the longest
    pub worst_us: f64,
}

/// What frames took on rows of springs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RowTimes {
    /// springs of the rows that were tried in place of the contacts; null where none were
    pub springs: Vec<usize>,
    /// 99 of 100 frames on each took no longer
    pub p99_us: Vec<f64>,
    /// number of springs at which a straight line through these reaches the period; null where that is not to be seen from them
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
        let Timing { latency, execution, overruns, left_out, longest_skip, wall, .. } = &ended.timing;
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
            deadlines_skipped: *left_out,
            longest_skip: *longest_skip,
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
