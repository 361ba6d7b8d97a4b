//! Checks that the files of a results folder are consistent.
//!
//! A comparison of damaged results could miss differences. The checks do not rely on the checksums of the tables, because a checksum can be
//! changed together with its table.

use super::results::ResultsError;
use serde_json::Value;
use std::path::PathBuf;
use stickslip_drive::WALK_TOLERANCE;
use stickslip_run::files::{EVENTS, SCENARIO, TRACE};
use stickslip_run::frame::Frame;
use stickslip_run::guard;
use stickslip_run::hash;
use stickslip_run::synopsis::Synopsis;

/// Tolerance for row times relative to the interval, and relative tolerance for durations. Both tolerances only allow for rounding.
const ROUNDING: f64 = 1e-9;

/// Part of a run that the tables of a results folder contain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// The whole run.
    Whole,
    /// The beginning of the run; the rest could not be written.
    Cut,
    /// Selected rows, stored for comparisons.
    Excerpt,
}

impl Extent {
    pub(super) fn of(synopsis: &Synopsis) -> Self {
        match (synopsis.says("excerpt"), synopsis.says("cut")) {
            (true, _) => Self::Excerpt,
            (false, true) => Self::Cut,
            (false, false) => Self::Whole,
        }
    }
}

/// A results folder that is being checked.
pub(super) struct Soundness<'a> {
    pub(super) folder: PathBuf,
    pub(super) synopsis: &'a Synopsis,
    pub(super) extent: Extent,
    /// Simulated time at the end of the run, s.
    pub(super) end: f64,
}

impl Soundness<'_> {
    /// Checks the tables against the summary and the scenario of the folder.
    ///
    /// # Errors
    /// Fails if the files contradict each other.
    pub(super) fn check(&self, trace: &Frame, events: &Frame) -> Result<(), ResultsError> {
        if self.end < 0.0 {
            return Err(self.summary(format!("simulated_s: expected a time of 0 or more, got {}", self.end)));
        }
        if self.extent == Extent::Cut && self.synopsis.text("/status") != "stopped" {
            return Err(self.summary("cut: only a stopped run has tables that end before the run".to_owned()));
        }
        self.check_counts(trace.rows(), events.rows())?;
        let rows = self.times(TRACE, trace)?;
        self.times(EVENTS, events)?;
        self.check_rising(rows)?;
        self.check_end(rows)?;
        if self.extent != Extent::Excerpt {
            self.check_scenario(rows)?;
        }
        Ok(())
    }

    /// Compares the numbers of rows and events with the counts in the summary.
    fn check_counts(&self, rows: usize, events: usize) -> Result<(), ResultsError> {
        let count = |pointer, key| self.synopsis.count(pointer).ok_or_else(|| self.synopsis.lacks(key));
        let counted = count("/counts/rows", "counts.rows")?;
        let is_whole = self.extent == Extent::Whole;
        if if is_whole { rows as u64 != counted } else { rows as u64 > counted } {
            return Err(self.summary(format!("counts.rows is {counted}, and {TRACE} has {rows} rows")));
        }
        // Integrators with a fixed step do not detect all events, so the number of events is not checked.
        if is_whole && self.synopsis.text("/stepper/name") == "event" {
            let written = self.synopsis.count("/counts/events_written");
            let counted = written.map_or_else(|| count("/counts/events", "counts.events"), Ok)?;
            if events as u64 != counted {
                let message = format!("counts.events is {counted}, and {EVENTS} has {events} events");
                return Err(self.summary(message));
            }
        }
        Ok(())
    }

    /// Returns the times of a table. The times must be finite, ascending and not after the end of the run.
    fn times<'t>(&self, name: &'static str, table: &'t Frame) -> Result<&'t [f64], ResultsError> {
        let lacks = ResultsError::NoColumn { path: self.folder.join(name), column: "time_s" };
        let times = table.numbers("time_s").ok_or(lacks)?;
        let mut before = 0.0;
        for (row, &time) in times.iter().enumerate() {
            let message = if !time.is_finite() {
                format!("expected a finite number, got {time}")
            } else if time < before {
                format!("expected a time after {before:?}, got {time:?}")
            } else if time > self.end {
                format!(
                    "expected a time up to the end of the run in summary.json, {:?}, got {time:?}",
                    self.end
                )
            } else {
                before = time;
                continue;
            };
            return Err(self.table(name, row, format!("time_s: {message}")));
        }
        Ok(times)
    }

    /// Checks that row times are strictly ascending. Only the last row of an unfinished run may repeat a time.
    fn check_rising(&self, rows: &[f64]) -> Result<(), ResultsError> {
        let stands = self.synopsis.text("/status") != "done";
        let last = rows.len() - usize::from(stands).min(rows.len());
        let repeated = (1..last).find(|&row| rows[row] == rows[row - 1]);
        repeated.map_or(Ok(()), |row| {
            Err(self.table(TRACE, row, format!("time_s: {:?} is also in the row before", rows[row])))
        })
    }

    /// Checks that the first row is at time 0 and the last row at the end of the run.
    fn check_end(&self, rows: &[f64]) -> Result<(), ResultsError> {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
            return Err(ResultsError::Unsound {
                path: self.folder.join(TRACE),
                line: None,
                message: "has no rows".to_owned(),
            });
        };
        if *first != 0.0 {
            return Err(self.table(TRACE, 0, format!("time_s: expected 0 in the first row, got {first:?}")));
        }
        if self.extent != Extent::Cut && *last != self.end {
            let message = format!(
                "time_s: the last row is at {last:?}, but summary.json has the end at {:?}",
                self.end
            );
            return Err(self.table(TRACE, rows.len() - 1, message));
        }
        Ok(())
    }

    /// Checks that the scenario has the recorded hash and that the rows have the times requested by the scenario.
    fn check_scenario(&self, rows: &[f64]) -> Result<(), ResultsError> {
        let path = self.folder.join(SCENARIO);
        let read = |source| ResultsError::Read { path: path.clone(), source };
        if hash(&guard::text(&path).map_err(read)?) != self.synopsis.text("/scenario_sha256") {
            return Err(ResultsError::Unsound {
                path,
                line: None,
                message: "is not the scenario of the run: its SHA-256 differs from that in summary.json"
                    .to_owned(),
            });
        }
        let scenario = guard::json(&path).map_err(read)?;
        self.check_plan(&scenario).map_err(|message| ResultsError::Unsound { path, line: None, message })?;
        // Unknown keys of later program versions may change the row times.
        let is_known = |key: &String| {
            const KNOWN: [&str; 8] =
                ["every", "channels", "springs", "memory", "fields", "events", "float", "states"];
            KNOWN.contains(&key.as_str())
        };
        if !keys(scenario.get("output")).iter().all(is_known) {
            return Ok(());
        }
        self.check_grid(rows, scenario.pointer("/output/every").and_then(Value::as_f64))
    }

    /// Checks that the summary belongs to the scenario: end time, contacts and integrator.
    fn check_plan(&self, scenario: &Value) -> Result<(), String> {
        let number = |pointer: &str| scenario.pointer(pointer).and_then(Value::as_f64);
        let status = self.synopsis.text("/status");
        let ends_early = self.synopsis.summary.get("steady_after_periods").is_some();
        if ends_early && scenario.pointer("/run/until_steady").is_none() {
            return Err("has no run.until_steady, but summary.json reports an end by this key".to_owned());
        }
        if let Some(planned) = planned(scenario)
            && status == "done"
            && !ends_early
            && (planned - self.end).abs() > ROUNDING * planned
        {
            let end = self.end;
            return Err(format!("the run ends at {planned:?} s, but summary.json has the end at {end:?} s"));
        }
        if keys(scenario.get("contacts")) != keys(self.synopsis.summary.get("contacts")) {
            return Err("its contacts differ from those of summary.json".to_owned());
        }
        let name = self.synopsis.text("/stepper/name");
        let taken = ["/stepper/tolerance", "/stepper/step_s"].map(|pointer| self.synopsis.number(pointer));
        let asked = match scenario.pointer("/run/stepper").and_then(|stepper| stepper.get(name)) {
            // The summary contains the time step, which is a whole fraction of the frame length and depends on the model.
            Some(frames) if name == "frames" => {
                let length = frames.get("length").and_then(Value::as_f64);
                [None, taken[1].filter(|step| length.is_some_and(|length| is_count(length / step)))]
            }
            Some(_) => ["tolerance", "step"].map(|key| number(&format!("/run/stepper/{name}/{key}"))),
            // If nothing moves freely, the event-driven integrator replaces the other integrators.
            None if name == "event" => [Some(WALK_TOLERANCE), None],
            None => [None; 2],
        };
        // With massless positions solved by force balance, the tolerance is at most `WALK_TOLERANCE`.
        let asked = match asked {
            [Some(tolerance), None] if name == "event" && has_balanced(scenario) => {
                [Some(tolerance.min(WALK_TOLERANCE)), None]
            }
            asked => asked,
        };
        if asked != taken {
            return Err("run.stepper differs from the stepper of summary.json".to_owned());
        }
        Ok(())
    }

    /// Checks that the table has a row at every multiple of the interval and a row at the end.
    fn check_grid(&self, rows: &[f64], every: Option<f64>) -> Result<(), ResultsError> {
        let every = every.unwrap_or(f64::INFINITY);
        let place = |row: usize| if row == 0 { 0.0 } else { row as f64 * every };
        let Some((last, others)) = rows.split_last() else { return Ok(()) };
        for (row, &time) in others.iter().enumerate() {
            if (time - place(row)).abs() > ROUNDING * every {
                let message =
                    format!("time_s: expected a row at {:?} by output.every, got {time:?}", place(row));
                return Err(self.table(TRACE, row, message));
            }
        }
        let next = place(others.len());
        // A run that stopped at a multiple of the interval has already written the row of this multiple.
        if *last > next + ROUNDING * every {
            let message = format!("time_s: expected a row at {next:?} by output.every, got {last:?}");
            return Err(self.table(TRACE, others.len(), message));
        }
        Ok(())
    }

    fn summary(&self, message: String) -> ResultsError {
        ResultsError::Unsound { path: self.synopsis.path(), line: None, message }
    }

    fn table(&self, name: &str, row: usize, message: String) -> ResultsError {
        ResultsError::Unsound { path: self.folder.join(name), line: Some(row + 2), message }
    }
}

/// Returns the planned end of a run from its resolved scenario, s. Returns `None` if the end follows neither from the duration nor from the
/// number of cycles.
fn planned(scenario: &Value) -> Option<f64> {
    let number = |value: &Value, key: &str| value.get(key).and_then(Value::as_f64);
    let run = scenario.get("run")?;
    if let Some(duration) = number(run, "duration") {
        return Some(duration);
    }
    let waveforms = scenario.get("waveforms")?.as_object()?;
    let waveform = match scenario.pointer("/figures/waveform").and_then(Value::as_str) {
        Some(name) => waveforms.get(name)?,
        None if waveforms.len() == 1 => waveforms.values().next()?,
        None => return None,
    };
    let waveform = waveform.as_object()?.values().next()?;
    let period = number(waveform, "period").or_else(|| Some(1.0 / number(waveform, "frequency")?))?;
    Some(number(waveform, "delay").unwrap_or(0.0) + number(run, "cycles")? * period)
}

/// Returns whether a number is a whole number of at least 1, except for rounding.
fn is_count(number: f64) -> bool {
    number.round() >= 1.0 && (number - number.round()).abs() <= ROUNDING * number
}

/// Returns whether a body of the scenario has a position that is solved from the force balance.
fn has_balanced(scenario: &Value) -> bool {
    let bodies = scenario.get("bodies").and_then(Value::as_object).into_iter().flatten();
    let is_balanced = |body: &Value, axis: &str| body.get(axis).and_then(Value::as_str) == Some("balanced");
    bodies.into_iter().any(|(_, body)| ["x", "z"].iter().any(|axis| is_balanced(body, axis)))
}

/// Returns the sorted keys of a JSON object.
fn keys(value: Option<&Value>) -> Vec<String> {
    let entries = value.and_then(Value::as_object).into_iter().flatten();
    let mut keys: Vec<String> = entries.map(|(key, _)| key.clone()).collect();
    keys.sort_unstable();
    keys
}
