//! Whether the files of a folder fit together: a comparison of damaged results would find no difference in what is not there.
//!
//! The seals tell what was changed since the run. These tests do not rely on them: whoever changes a table may well change
//! its seal.

use super::results::ResultsError;
use serde_json::Value;
use std::path::PathBuf;
use stickslip_drive::WALK_TOLERANCE;
use stickslip_run::files::{EVENTS, SCENARIO, TRACE};
use stickslip_run::frame::Frame;
use stickslip_run::guard;
use stickslip_run::hash;
use stickslip_run::synopsis::Synopsis;

/// How far a row may lie from its place on the grid, in intervals, and a duration from another, of itself: rounding.
const ROUNDING: f64 = 1e-9;

/// What the tables of a run are to its summary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// All of it.
    Whole,
    /// Its beginning: no more could be written.
    Cut,
    /// Some of its rows, kept to be compared with.
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

/// A folder under test.
pub(super) struct Soundness<'a> {
    pub(super) folder: PathBuf,
    pub(super) synopsis: &'a Synopsis,
    pub(super) extent: Extent,
    /// Time reached, s.
    pub(super) end: f64,
}

impl Soundness<'_> {
    /// Tests the tables against the summary and the scenario beside them.
    pub(super) fn check(&self, trace: &Frame, events: &Frame) -> Result<(), ResultsError> {
        if self.end < 0.0 {
            return Err(self.summary(format!("simulated_s: expected a time of 0 or more, got {}", self.end)));
        }
        if self.extent == Extent::Cut && self.synopsis.text("/status") != "stopped" {
            return Err(
                self.summary("cut: only a run that was stopped has tables that end before it".to_owned())
            );
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

    /// Rows and events against those that the run counted.
    fn check_counts(&self, rows: usize, events: usize) -> Result<(), ResultsError> {
        let count = |pointer, key| self.synopsis.count(pointer).ok_or_else(|| self.synopsis.lacks(key));
        let counted = count("/counts/rows", "counts.rows")?;
        let is_whole = self.extent == Extent::Whole;
        if if is_whole { rows as u64 != counted } else { rows as u64 > counted } {
            return Err(self.summary(format!("counts.rows is {counted}, and {TRACE} has {rows} rows")));
        }
        // Steppers of fixed steps count none of those that they do not look for.
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

    /// Times of a table: numbers, none before the one above it, none after the end.
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
                    "expected a time until {:?}, where summary.json says that the run ends, got {time:?}",
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

    /// No two rows are of one time, but where a run stands on a row of the grid: it writes how it stands as well.
    fn check_rising(&self, rows: &[f64]) -> Result<(), ResultsError> {
        let stands = self.synopsis.text("/status") != "done";
        let last = rows.len() - usize::from(stands).min(rows.len());
        let repeated = (1..last).find(|&row| rows[row] == rows[row - 1]);
        repeated.map_or(Ok(()), |row| {
            Err(self.table(TRACE, row, format!("time_s: {:?} stands in the row before as well", rows[row])))
        })
    }

    /// The first and the last row are those of the run.
    fn check_end(&self, rows: &[f64]) -> Result<(), ResultsError> {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
            return Err(ResultsError::Unsound {
                path: self.folder.join(TRACE),
                line: None,
                message: "has no rows".to_owned(),
            });
        };
        if *first != 0.0 {
            return Err(self.table(TRACE, 0, format!("time_s: expected 0, where runs begin, got {first:?}")));
        }
        if self.extent != Extent::Cut && *last != self.end {
            let message = format!(
                "time_s: the last row is at {last:?}, and summary.json says that the run ends at {:?}",
                self.end
            );
            return Err(self.table(TRACE, rows.len() - 1, message));
        }
        Ok(())
    }

    /// The scenario is the sealed one, and the rows are those that it asks for.
    fn check_scenario(&self, rows: &[f64]) -> Result<(), ResultsError> {
        let path = self.folder.join(SCENARIO);
        let read = |source| ResultsError::Read { path: path.clone(), source };
        if hash(&guard::text(&path).map_err(read)?) != self.synopsis.text("/scenario_sha256") {
            return Err(ResultsError::Unsound {
                path,
                line: None,
                message: "is not the scenario of the run: its SHA-256 is not that in summary.json".to_owned(),
            });
        }
        let scenario = guard::json(&path).map_err(read)?;
        self.check_plan(&scenario).map_err(|message| ResultsError::Unsound { path, line: None, message })?;
        // Keys to come may ask for rows at other moments.
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

    /// The summary is of a run of this scenario: its end, its contacts, and the stepper that says what may differ.
    fn check_plan(&self, scenario: &Value) -> Result<(), String> {
        let number = |pointer: &str| scenario.pointer(pointer).and_then(Value::as_f64);
        let status = self.synopsis.text("/status");
        let ends_early = self.synopsis.summary.get("steady_after_periods").is_some();
        if ends_early && scenario.pointer("/run/until_steady").is_none() {
            return Err("has no run.until_steady, and summary.json says that the run ended by it".to_owned());
        }
        if let Some(planned) = planned(scenario)
            && status == "done"
            && !ends_early
            && (planned - self.end).abs() > ROUNDING * planned
        {
            let end = self.end;
            return Err(format!(
                "the run ends at {planned:?} s, and summary.json says that it was done at {end:?} s"
            ));
        }
        if keys(scenario.get("contacts")) != keys(self.synopsis.summary.get("contacts")) {
            return Err("its contacts are not those of summary.json".to_owned());
        }
        let name = self.synopsis.text("/stepper/name");
        let taken = ["/stepper/tolerance", "/stepper/step_s"].map(|pointer| self.synopsis.number(pointer));
        let asked = match scenario.pointer("/run/stepper").and_then(|stepper| stepper.get(name)) {
            Some(_) => ["tolerance", "step"].map(|key| number(&format!("/run/stepper/{name}/{key}"))),
            // Where nothing is free the other steppers leave the contacts to this one.
            None if name == "event" => [Some(WALK_TOLERANCE), None],
            None => [None; 2],
        };
        // Places without mass are solved for, whatever tolerance the run was asked for.
        let asked = match asked {
            [Some(tolerance), None] if name == "event" && has_balanced(scenario) => {
                [Some(tolerance.min(WALK_TOLERANCE)), None]
            }
            asked => asked,
        };
        if asked != taken {
            return Err("run.stepper is not the stepper of summary.json".to_owned());
        }
        Ok(())
    }

    /// A row at every multiple of the interval, and one at the end.
    fn check_grid(&self, rows: &[f64], every: Option<f64>) -> Result<(), ResultsError> {
        let every = every.unwrap_or(f64::INFINITY);
        let place = |row: usize| if row == 0 { 0.0 } else { row as f64 * every };
        let Some((last, others)) = rows.split_last() else { return Ok(()) };
        for (row, &time) in others.iter().enumerate() {
            if (time - place(row)).abs() > ROUNDING * every {
                let message = format!(
                    "time_s: expected a row at {:?}, as output.every asks for, got {time:?}",
                    place(row)
                );
                return Err(self.table(TRACE, row, message));
            }
        }
        let next = place(others.len());
        // A run that stands on the grid has written the row of that moment before.
        if *last > next + ROUNDING * every {
            let message =
                format!("time_s: expected a row at {next:?}, as output.every asks for, got {last:?}");
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

/// When a run was to end, s, as the resolved scenario has it; none where that does not follow from a number or two.
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

/// Whether a body of a scenario has a place that is solved for.
fn has_balanced(scenario: &Value) -> bool {
    let bodies = scenario.get("bodies").and_then(Value::as_object).into_iter().flatten();
    let is_balanced = |body: &Value, axis: &str| body.get(axis).and_then(Value::as_str) == Some("balanced");
    bodies.into_iter().any(|(_, body)| ["x", "z"].iter().any(|axis| is_balanced(body, axis)))
}

/// Names of the parts of an object, sorted.
fn keys(value: Option<&Value>) -> Vec<String> {
    let entries = value.and_then(Value::as_object).into_iter().flatten();
    let mut keys: Vec<String> = entries.map(|(key, _)| key.clone()).collect();
    keys.sort_unstable();
    keys
}
