//! Report of a real-time loop as JSON and as text.

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

/// Report of a real-time loop.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Report {
    /// name of the scenario
    pub scenario: String,
    /// number of the scenario in packets, in hexadecimal digits
    pub scenario_number: String,
    /// time integrator, in words
    pub stepper: String,
    /// duration of a frame
    pub period_s: f64,
    /// number of requested frames
    pub frames_asked: u64,
    /// number of computed frames
    pub frames: u64,
    /// simulated time
    pub simulated_s: f64,
    /// wall-clock time from the first deadline to the end
    pub wall_s: f64,
    /// whether frames waited for their deadlines. false with `--unpaced`.
    pub paced: bool,
    /// time before each deadline during which the loop polls the clock (`--spin`)
    pub spin_s: f64,
    /// reaction to overruns: `skip` (missed deadlines are skipped) or `stop`. null with `--unpaced`.
    pub overrun_policy: Option<&'static str>,
    /// end of the loop: `complete`, `interrupted` (by the user), `overrun` (with the policy `stop`), `silence` (no
    /// valid input for too long), `memory` (another process shortened the shared memory), `stopped` (error of the run,
    /// see error) or `no_input` (no first input)
    pub ended: &'static str,
    /// error that ended the loop, of the run or of the shared memory. null if there was none.
    pub error: Option<String>,
    /// whether all deadlines were met: the loop is complete, and no frame ended after the next deadline
    pub kept: bool,
    /// number of overruns: frames that ended after the next deadline
    pub overruns: u64,
    /// number of deadlines that were skipped after overruns
    pub deadlines_skipped: u64,
    /// largest number of deadlines skipped in succession
    pub longest_skip: u64,
    /// Execution times: from waking until the outputs are sent.
    pub execution: Times,
    /// Latencies: from the deadline until waking.
    pub latency: Option<Times>,
    /// Execution times of an empty loop with the same period.
    pub empty_execution: Option<Times>,
    /// Latencies of an empty loop with the same period.
    pub empty_latency: Option<Times>,
    /// number of frames of the empty loop that ran before the start. 0 if none did.
    pub empty_frames: u64,
    /// names of inputs in the order of packets
    pub inputs: Vec<String>,
    /// names of outputs in the order of packets
    pub outputs: Vec<String>,
    /// Accepted and refused inputs.
    pub received: Received,
    /// number of outputs that could not be sent
    pub outputs_unsent: u64,
    /// number of frames missing in the log because its buffer was full
    pub log_lost: u64,
    /// number of frames missing in the recording of inputs because its buffer was full
    pub recording_lost: u64,
    /// settings that the operating system refused, in words
    pub denied: Vec<String>,
    /// Times of frames before the start, without a clock.
    pub probe: Option<ProbeTimes>,
    /// Times of frames with rows of springs instead of the contacts.
    pub rows: Option<RowTimes>,
}

/// Distribution of times, µs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Times {
    /// median, µs, of the times of all frames. `execution`: from waking until the outputs are sent. `latency`: from the
    /// deadline until waking. `empty_execution`, `empty_latency`: the same of an empty loop with this period before the
    /// start. null without a clock or an empty loop.
    pub median_us: f64,
    /// 99.9 % quantile, µs, of the times described at median_us
    pub p99_9_us: f64,
    /// 99.99 % quantile, µs, of the times described at median_us
    pub p99_99_us: f64,
    /// maximum, µs, of the times described at median_us
    pub worst_us: f64,
    /// mean, µs, of the times described at median_us
    pub mean_us: f64,
}

/// Times of frames before the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ProbeTimes {
    /// number of frames computed before the start without a clock. `probe` is null if there were none.
    pub frames: u64,
    /// median computing time of the frames before the start, µs
    pub median_us: f64,
    /// 99 % quantile of the computing time of the frames before the start, µs
    pub p99_us: f64,
    /// largest computing time of the frames before the start, µs
    pub worst_us: f64,
}

/// Times of frames with rows of springs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RowTimes {
    /// numbers of springs of the rows that replaced the contacts in a measurement before the start. `rows` is null if
    /// there was none.
    pub springs: Vec<usize>,
    /// 99 % quantile of the computing time of a frame with each row, µs
    pub p99_us: Vec<f64>,
    /// number of springs for which p99_us equals the period, by linear extrapolation. null if it cannot be
    /// extrapolated.
    pub fit_in_period: Option<u64>,
}

/// Names and measurements that are known before a loop begins.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Name of the scenario.
    pub scenario: String,
    /// Scenario number in packets.
    pub number: u64,
    /// Description of the time integrator.
    pub stepper: String,
    /// Names of inputs.
    pub inputs: Vec<String>,
    /// Names of outputs.
    pub outputs: Vec<String>,
    /// Times of frames before the start.
    pub probe: Option<Probe>,
    /// Times of frames with rows of springs.
    pub rows: Option<RowsProbe>,
}

impl Report {
    /// Creates the report of a loop.
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

    /// Returns the report as indented JSON.
    ///
    /// # Errors
    /// No error occurs, because all keys are strings and all numbers are finite.
    pub fn pretty(&self) -> serde_json::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Returns the report as one line of JSON.
    ///
    /// # Errors
    /// The same errors as for [`Self::pretty`].
    pub fn line(&self) -> serde_json::Result<String> {
        serde_json::to_string(self)
    }
}

/// Returns a word for the reason why a loop ended, and the error message if there was an error.
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
