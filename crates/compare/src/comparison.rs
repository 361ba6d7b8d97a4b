//! Result of a comparison of two runs.

use super::allowance::Allowance;
use super::channels::{self, ChannelDifference, CommonRows};
use super::coverage::{Coverage, extents};
use super::error::CompareError;
use super::events::{self, EventDifferences};
use super::figures::{self, FigureDifferences};
use super::results::Results;
use super::terms::Terms;
use serde::Serialize;
use stickslip_run::Real;

/// Comparison of two runs, in the form that `--json` prints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Overall result.
    pub verdict: Verdict,
    /// The reference run A.
    pub a: Side,
    /// The run B, which is compared with the reference.
    pub b: Side,
    /// Tolerances that apply to all channels.
    pub tolerance: Tolerance,
    /// End of the compared time, s.
    #[serde(rename = "until_s")]
    pub until: Real,
    /// Numbers of rows.
    pub rows: Rows,
    /// Compared fraction of run A.
    pub coverage: Coverage,
    /// Channels that both runs have, in the order of run A.
    pub channels: Vec<ChannelDifference>,
    /// Channels of run A that run B lacks.
    pub channels_missing: Vec<String>,
    /// Channels of run B that run A lacks.
    pub channels_extra: Vec<String>,
    /// Differences of the events.
    pub events: EventDifferences,
    /// Differences of the summary values.
    pub figures: FigureDifferences,
    /// First difference of the two runs in time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first: Option<First>,
    /// Notes, for example on different scenarios and on contents that were not compared.
    pub notes: Vec<String>,
}

/// Agreement of two runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The rows and events are byte-identical, and no summary value differs.
    Identical,
    /// No difference exceeds the allowed difference.
    Equal,
    /// At least one difference exceeds the allowed difference.
    Differs,
}

impl Verdict {
    /// Returns the agreement as one word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Identical => "identical",
            Self::Equal => "equal",
            Self::Differs => "differs",
        }
    }
}

/// One of the two runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Side {
    /// Folder of the results.
    pub folder: String,
    /// Status at the end: "done", "stopped" or "interrupted".
    pub status: String,
    /// Simulated time at the end of the run, s.
    #[serde(rename = "simulated_s")]
    pub end: Real,
    /// Integrator with its tolerance or step, as text.
    pub stepper: String,
    /// Version of the program that computed the run.
    pub version: String,
    /// SHA-256 of the resolved scenario.
    pub scenario_sha256: String,
}

/// Tolerances that apply to all channels and events.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tolerance {
    /// Tolerance relative to the largest magnitude of a channel.
    pub relative: Real,
    /// Tolerance of event times, s.
    #[serde(rename = "time_s")]
    pub time: Real,
    /// Whether both runs used the same integrator with the same tolerance or step.
    pub same_stepper: bool,
}

/// Numbers of rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rows {
    /// Rows of A.
    pub a: usize,
    /// Rows of B.
    pub b: usize,
    /// Number of compared rows: rows at common times.
    pub common: usize,
    /// Number of rows of A that B lacks. Counted only if A is an excerpt, because B must have all rows of an excerpt.
    #[serde(skip_serializing_if = "is_none")]
    pub missing: usize,
}

/// Returns whether a count is zero.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "the serialiser asks by reference")]
fn is_none(count: &usize) -> bool {
    *count == 0
}

/// First difference of two runs in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct First {
    /// Time, s.
    #[serde(rename = "time_s")]
    pub time: Real,
    /// Description of the difference.
    pub what: String,
}

impl Comparison {
    /// Compares two runs and returns the comparison with the rows that were compared.
    ///
    /// # Errors
    /// Fails if the runs have no row at a common time, B is an excerpt, or `terms` contains an unknown name or an invalid tolerance.
    pub fn new(a: &Results, b: &Results, terms: &Terms) -> Result<(Self, CommonRows), CompareError> {
        if b.is_excerpt() {
            return Err(CompareError::JudgedExcerpt(b.folder.clone()));
        }
        let until = a.end.min(b.end);
        let mut allowance = Allowance::new(a, b, until, terms);
        allowance.refine(terms, &known(a, b))?;
        let rows = common_rows(a, b, until, &allowance);
        if rows.pairs.is_empty() && rows.at_events == 0 {
            return Err(CompareError::NoCommonRow);
        }
        let channels = channels::compare(a, b, &rows, &allowance);
        let wanted = |names: Vec<String>| names.into_iter().filter(|name| !allowance.ignores(name)).collect();
        let mut comparison = Self {
            verdict: Verdict::Differs,
            a: Side::of(a),
            b: Side::of(b),
            tolerance: Tolerance {
                relative: Real(allowance.relative),
                time: Real(allowance.time),
                same_stepper: allowance.is_same_run,
            },
            until: Real(until),
            rows: Rows {
                a: a.trace.rows(),
                b: b.trace.rows(),
                common: rows.pairs.len(),
                missing: if a.is_excerpt() { rows.lone(a.time(), until) } else { 0 },
            },
            coverage: Coverage::new(a, &rows),
            channels,
            channels_missing: wanted(channels::missing(a, b)),
            channels_extra: wanted(channels::missing(b, a)),
            events: events::compare(a, b, until, &allowance),
            figures: figures::compare(a, b, &allowance),
            first: None,
            notes: Vec::new(),
        };
        comparison.conclude((a, b), &rows, (&allowance, terms.exact));
        Ok((comparison, rows))
    }

    fn conclude(
        &mut self,
        (a, b): (&Results, &Results),
        rows: &CommonRows,
        (allowance, exact): (&Allowance, bool),
    ) {
        let has_same_values =
            self.channels.iter().all(ChannelDifference::is_same) && self.channels_missing.is_empty();
        let has_same_figures = self.figures.differ.is_empty() && self.figures.missing.is_empty();
        let has_same_rows = self.rows.missing == 0;
        let is_same = has_same_values
            && has_same_rows
            && self.events.is_same()
            && has_same_figures
            && !self.one_stopped();
        self.verdict = match (is_same, a.has_tables_of(b)) {
            (true, true) => Verdict::Identical,
            (true, false) if !exact => Verdict::Equal,
            _ => Verdict::Differs,
        };
        self.first = self.first_difference();
        self.notes = extents(a, b);
        self.notes.extend(self.notes(rows, allowance));
    }

    /// Returns the main finding as one line of text.
    pub fn finding(&self) -> String {
        match (&self.first, self.verdict) {
            (_, Verdict::Identical) => "rows and events are byte-identical".to_owned(),
            (_, Verdict::Equal) => self.farthest(),
            (Some(first), Verdict::Differs) => {
                format!("first difference at t = {} s: {}", time(first.time.0), first.what)
            }
            (None, Verdict::Differs) => match (self.figures.differ.first(), self.figures.missing.first()) {
                (Some(figure), _) => {
                    format!("summary value {}: {} in A, {} in B", figure.name, figure.a, figure.b)
                }
                (None, Some(name)) => format!("summary value {name} is missing in B"),
                (None, None) => {
                    "the files are not byte-identical, or values without a time differ".to_owned()
                }
            },
        }
    }

    /// Returns a line about the channel with the largest ratio of difference to allowed difference.
    fn farthest(&self) -> String {
        let farthest = self.channels.iter().max_by(|p, q| p.excess().total_cmp(&q.excess()));
        match farthest.and_then(|channel| Some((channel, channel.worst?, channel.allowed?, channel.at?))) {
            Some((channel, worst, allowed, at)) => format!(
                "largest difference: {}, {:.1e} of {:.1e} {} allowed, at t = {} s",
                channel.name,
                worst.0,
                allowed.0,
                channel.unit,
                time(at.0)
            ),
            None => "no channel differs; the files differ in content that is not compared".to_owned(),
        }
    }

    /// Returns whether exactly one of the two runs stopped early by itself.
    pub fn one_stopped(&self) -> bool {
        (self.a.status == "stopped") != (self.b.status == "stopped")
    }

    fn first_difference(&self) -> Option<First> {
        let channel = |c: &ChannelDifference| Some(First { time: c.first?, what: c.name.clone() });
        let event = self.events.first().map(|(event, how)| First {
            time: event.time,
            what: format!("the event \"{}\" of {} {how}", event.kind, event.source),
        });
        // An event precedes channels at the same time, because the channels differ as a result of the event.
        let all = event.into_iter().chain(self.channels.iter().filter_map(channel));
        all.min_by(|p, q| p.time.0.total_cmp(&q.time.0))
    }

    fn notes(&self, rows: &CommonRows, allowance: &Allowance) -> Vec<String> {
        let mut notes = self.origins();
        for (name, side) in [("A", &self.a), ("B", &self.b)] {
            if side.status != "done" {
                notes.push(format!("{name}: the run was {} at t = {:?} s", side.status, side.end.0));
            }
        }
        if self.a.end != self.b.end {
            let until = self.until.0;
            notes.push(format!(
                "compared until t = {until:?} s, the end of the shorter run; summary values of whole runs are not compared"
            ));
        }
        let Rows { a, b, common, missing } = self.rows;
        if a != common || b != common {
            let at_events = match rows.at_events {
                0 => String::new(),
                count => format!(" ({count} more are at events)"),
            };
            notes.push(format!(
                "rows: {a} in A and {b} in B, compared at {common} common times{at_events}; nothing is interpolated"
            ));
        }
        if missing > 0 {
            notes.push(format!("rows: {missing} of A are missing in B"));
        }
        if !self.channels_extra.is_empty() {
            notes.push(format!("only in B: {}", self.channels_extra.join(", ")));
        }
        if !self.figures.extra.is_empty() {
            notes.push(format!("only in B: {}", self.figures.extra.join(", ")));
        }
        notes.extend(self.rounding(allowance));
        notes
    }

    /// Returns notes on different scenarios and different program versions.
    fn origins(&self) -> Vec<String> {
        let differ = |what: &str, a: &str, b: &str| {
            (a != b && !a.is_empty() && !b.is_empty()).then(|| format!("{what}: {a} and {b}"))
        };
        let short = |side: &Side| side.scenario_sha256.chars().take(12).collect::<String>();
        let scenarios = differ("the scenarios differ, SHA-256", &short(&self.a), &short(&self.b));
        let versions = differ("written by versions", &self.a.version, &self.b.version);
        scenarios.into_iter().chain(versions).collect()
    }

    /// Returns advice if different rounding alone can explain the differences.
    fn rounding(&self, allowance: &Allowance) -> Option<String> {
        let (relative, promised) = (allowance.relative, allowance.promised);
        let excess = self.channels.iter().map(ChannelDifference::excess).fold(0.0, f64::max);
        let is_small = allowance.is_same_run && excess > 1.0 && excess * relative <= promised;
        let has_same_words = self.channels.iter().all(|c| c.worst.is_some() || c.is_same());
        (is_small && has_same_words && self.channels_missing.is_empty()).then(|| {
            format!(
                "the channels agree within the accuracy of the stepper: different rounding alone can cause \
                 such differences; --tolerance {promised:e} allows them"
            )
        })
    }
}

impl Side {
    fn of(results: &Results) -> Self {
        Self {
            folder: results.folder.display().to_string(),
            status: results.status().to_owned(),
            end: Real(results.end),
            stepper: results.stepper.words(),
            version: results.text("/program/version").to_owned(),
            scenario_sha256: results.text("/scenario_sha256").to_owned(),
        }
    }
}

/// Returns the common rows of two runs, without rows at which the runs may show the states before and after an event.
///
/// Ambiguous rows at events occur if the integrators or the row times differ, and at the end of the shorter run.
fn common_rows(a: &Results, b: &Results, until: f64, allowance: &Allowance) -> CommonRows {
    let events = a.events().chain(b.events()).map(|event| event.time).collect();
    let rows = CommonRows::new(a.time(), b.time(), until);
    let goes_on = |t: f64| t < until || a.end == b.end;
    let is_sure = |s: f64, t: f64| allowance.is_same_run && s == t && goes_on(t);
    rows.told_from_events((a.time(), b.time()), events, allowance.time, is_sure)
}

/// Returns the sorted names of all channels, summary values and event sources of both runs.
fn known(a: &Results, b: &Results) -> Vec<String> {
    let mut names = Vec::new();
    for results in [a, b] {
        names.extend(results.trace.columns().iter().map(|column| column.name.clone()));
        names.extend(figures::names(results));
        names.extend(results.events().map(|event| event.source.to_owned()));
    }
    names.sort_unstable();
    names.dedup();
    names
}

/// Returns a time, s, as text with nine significant digits.
pub fn time(t: f64) -> String {
    format!("{t:.8e}").parse::<f64>().map_or_else(|_| t.to_string(), |t| format!("{t:?}"))
}
