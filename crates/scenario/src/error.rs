//! Error reports of scenarios as plain values.

use crate::excerpt::Excerpt;
use std::fmt;
use std::ops::Deref;

/// All errors of a scenario in the order of the file, without follow-on errors. The error dereferences to its first [`Report`];
/// [`ScenarioError::reports`] returns all reports.
#[derive(Debug, Clone, PartialEq)]
pub struct ScenarioError(Box<Reports>);

#[derive(Debug, Clone, PartialEq)]
struct Reports {
    first: Report,
    rest: Vec<Report>,
    beyond: Beyond,
}

/// Completeness of the reports.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Beyond {
    /// Whether more errors are known than reported.
    pub(crate) more: bool,
    /// Whether the check was incomplete, so that more errors are possible.
    pub(crate) not_checked: bool,
    /// Stages of the check that were omitted or not completed.
    pub(crate) left_out: Vec<Stage>,
}

/// Stage of the check of a scenario, in the order of execution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Keys, units and ranges of each value.
    Form,
    /// Relations between values, and tables in files.
    Meaning,
    /// Existence of the equilibrium from which a run starts, if requested.
    Equilibrium,
    /// Rows, lines and memory of a run.
    Limits,
}

impl Stage {
    /// All stages in their order.
    pub const ALL: [Self; 4] = [Self::Form, Self::Meaning, Self::Equilibrium, Self::Limits];

    /// Returns the name of the stage.
    pub fn word(self) -> &'static str {
        match self {
            Self::Form => "form",
            Self::Meaning => "meaning",
            Self::Equilibrium => "equilibrium",
            Self::Limits => "limits",
        }
    }
}

/// Message about a position in a scenario: part of a [`ScenarioError`], or a warning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// Name of the file or table, or the argument of `--set`.
    pub file: String,
    /// Whether the message concerns an argument of `--set`.
    pub is_override: bool,
    /// Name of overrides in messages, such as `--set`; may be empty.
    pub word: &'static str,
    /// Position in the file; `None` for the whole file.
    pub excerpt: Option<Excerpt>,
    /// Key path such as `contacts.ball.friction`; empty for the whole scenario.
    pub path: String,
    /// Expected and given value.
    pub message: String,
    /// Suggested correction.
    pub help: Option<String>,
}

/// Warning about a value that is allowed but implausible, with its position.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// Category as one word for programs, such as `unused`. The meaning of a word never changes.
    pub kind: &'static str,
    /// Position, reason and suggestion.
    pub report: Report,
}

impl Warning {
    /// Category of warnings about the wording of the file. A resolved scenario causes no warnings of this category.
    pub const WORDING: &'static str = "wording";
}

impl Deref for Warning {
    type Target = Report;

    fn deref(&self) -> &Report {
        &self.report
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.report.fmt(f)
    }
}

impl From<Report> for ScenarioError {
    fn from(first: Report) -> Self {
        Self(Box::new(Reports { first, rest: Vec::new(), beyond: Beyond::default() }))
    }
}

impl ScenarioError {
    /// Returns an error of several reports.
    pub(crate) fn several(first: Report, rest: Vec<Report>, beyond: Beyond) -> Self {
        Self(Box::new(Reports { first, rest, beyond }))
    }

    /// Returns all reports in the order of the file; at least one.
    pub fn reports(&self) -> impl Iterator<Item = &Report> {
        std::iter::once(&self.0.first).chain(&self.0.rest)
    }

    /// Marks all stages as omitted, because the file could not be read.
    pub(crate) fn unread(self) -> Self {
        self.without(&Stage::ALL)
    }

    /// Adds omitted stages.
    #[must_use]
    pub fn without(mut self, stages: &[Stage]) -> Self {
        let left_out = &mut self.0.beyond.left_out;
        left_out.extend_from_slice(stages);
        left_out.sort_unstable();
        left_out.dedup();
        self
    }

    /// Joins independent errors in the order of the file. Returns `None` for an empty list. Stages omitted by one error are omitted in
    /// the result.
    pub fn joined(errors: impl IntoIterator<Item = Self>) -> Option<Self> {
        let (mut reports, mut beyond) = (Vec::new(), Beyond::default());
        for Self(one) in errors {
            for report in std::iter::once(one.first).chain(one.rest) {
                if !reports.contains(&report) {
                    reports.push(report);
                }
            }
            beyond.more |= one.beyond.more;
            beyond.not_checked |= one.beyond.not_checked;
            beyond.left_out.extend(one.beyond.left_out);
        }
        let place = |report: &Report| report.excerpt.as_ref().map(|excerpt| (excerpt.line, excerpt.column));
        reports.sort_by_key(|report| (report.is_override, place(report)));
        let mut reports = reports.into_iter();
        reports.next().map(|first| Self::several(first, reports.collect(), beyond).without(&[]))
    }

    /// Returns the stages that the errors prevented, in the order of the check.
    pub fn left_out(&self) -> &[Stage] {
        &self.0.beyond.left_out
    }

    /// Returns whether more errors are known than reported.
    pub fn has_more(&self) -> bool {
        self.0.beyond.more
    }

    /// Returns whether the check was incomplete, so that more errors are possible.
    pub fn may_have_more(&self) -> bool {
        self.0.beyond.not_checked
    }

    /// Returns the first report.
    pub(crate) fn into_first(self) -> Report {
        self.0.first
    }
}

impl Deref for ScenarioError {
    type Target = Report;

    fn deref(&self) -> &Report {
        &self.0.first
    }
}

impl std::error::Error for ScenarioError {}

/// Formats all reports, separated by empty lines.
impl fmt::Display for ScenarioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.first.fmt(f)?;
        for report in &self.0.rest {
            write!(f, "\n\n{report}")?;
        }
        if self.0.beyond.more {
            write!(f, "\n\nand more faults: the first are {}", self.reports().count())?;
        }
        if self.0.beyond.not_checked {
            f.write_str("\n\nand possibly more: the rest was not checked")?;
        }
        Ok(())
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.excerpt {
            _ if self.is_override && self.word.is_empty() => write!(f, "{}  ", self.file)?,
            _ if self.is_override => write!(f, "{} {}  ", self.word, self.file)?,
            Some(excerpt) if self.file.is_empty() => {
                write!(f, "line {}, column {}  ", excerpt.line, excerpt.column)?;
            }
            None if self.file.is_empty() => {}
            Some(excerpt) => write!(f, "{}:{}:{}  ", self.file, excerpt.line, excerpt.column)?,
            None => write!(f, "{}: ", self.file)?,
        }
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        write!(f, "{}", self.message)?;
        if let Some(excerpt) = &self.excerpt {
            let (shown, marker) = excerpt.window();
            let number = if self.is_override { String::new() } else { excerpt.line.to_string() };
            // Indents the marker by the gutter: five digits, a blank, the bar and a blank.
            let indent = number.len().max(5) + 3 + marker.start;
            write!(f, "\n{number:>5} | {shown}\n{:indent$}{}", "", "^".repeat(marker.len()))?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n   help: {help}")?;
        }
        Ok(())
    }
}
