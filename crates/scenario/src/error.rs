//! The reports of what is wrong with a scenario, as plain values.

use crate::excerpt::Excerpt;
use std::fmt;
use std::ops::Deref;

/// What is wrong with a scenario, where, and what would be right: everything that is no consequence of something else, in the
/// order of the file. It stands for the first [`Report`], [`ScenarioError::reports`] are all.
#[derive(Debug, Clone, PartialEq)]
pub struct ScenarioError(Box<Reports>);

#[derive(Debug, Clone, PartialEq)]
struct Reports {
    first: Report,
    rest: Vec<Report>,
    beyond: Beyond,
}

/// What is beyond the reports.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Beyond {
    /// More is known to be wrong.
    pub(crate) more: bool,
    /// Not everything was judged: more may be wrong.
    pub(crate) not_checked: bool,
    /// Stages that were left out, or not gone through to their ends.
    pub(crate) left_out: Vec<Stage>,
}

/// What a scenario is judged by, one after the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Keys, units and ranges of each value by itself.
    Form,
    /// What parts are to each other, and the tables in files.
    Meaning,
    /// Whether there is an equilibrium to start from, where one is asked for.
    Equilibrium,
    /// Rows, lines and memory of a run.
    Limits,
}

impl Stage {
    /// All of them, in their order.
    pub const ALL: [Self; 4] = [Self::Form, Self::Meaning, Self::Equilibrium, Self::Limits];

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Form => "form",
            Self::Meaning => "meaning",
            Self::Equilibrium => "equilibrium",
            Self::Limits => "limits",
        }
    }
}

/// What there is to say about a place of a scenario: the parts of a [`ScenarioError`], or a warning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// The file as it was named, the table that it names, or the argument of `--set` that is to blame.
    pub file: String,
    /// Whether an argument of `--set` is to blame, not a file.
    pub is_override: bool,
    /// What the caller calls an override, such as `--set`; may be empty.
    pub word: &'static str,
    /// Where in the file; none when the file as a whole is meant.
    pub excerpt: Option<Excerpt>,
    /// Key path such as `contacts.ball.friction`; empty for the whole scenario.
    pub path: String,
    /// What was expected and what came.
    pub message: String,
    /// What to try.
    pub help: Option<String>,
}

/// What is allowed and probably not meant, with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// What it is about, as one word for machines, such as `unused`; it never changes its meaning.
    pub kind: &'static str,
    /// Where, why and what to try.
    pub report: Report,
}

impl Warning {
    /// The word of what is said about the wording of the file alone: a scenario written out in full says it no more.
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
    /// Several at once: the first, the others, and what is beyond these.
    pub(crate) fn several(first: Report, rest: Vec<Report>, beyond: Beyond) -> Self {
        Self(Box::new(Reports { first, rest, beyond }))
    }

    /// Everything that is told, in the order of the file; at least one.
    pub fn reports(&self) -> impl Iterator<Item = &Report> {
        std::iter::once(&self.0.first).chain(&self.0.rest)
    }

    /// Nobody could read what it is about: nothing else was judged.
    pub(crate) fn unread(self) -> Self {
        self.without(&Stage::ALL)
    }

    /// The same, told that these stages were left out, too.
    #[must_use]
    pub fn without(mut self, stages: &[Stage]) -> Self {
        let left_out = &mut self.0.beyond.left_out;
        left_out.extend_from_slice(stages);
        left_out.sort_unstable();
        left_out.dedup();
        self
    }

    /// Several that have nothing to do with each other as one, in the order of the file; none of none. What one of them left out
    /// was left out.
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

    /// What was not judged, or not all of it, because of what is wrong: in the order of judging.
    pub fn left_out(&self) -> &[Stage] {
        &self.0.beyond.left_out
    }

    /// Whether there is more wrong than is told.
    pub fn has_more(&self) -> bool {
        self.0.beyond.more
    }

    /// Whether not everything could be judged, so that there may be more wrong than is told.
    pub fn may_have_more(&self) -> bool {
        self.0.beyond.not_checked
    }

    /// The first report by itself.
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

/// Reports with a blank line between them.
impl fmt::Display for ScenarioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.first.fmt(f)?;
        for report in &self.0.rest {
            write!(f, "\n\n{report}")?;
        }
        if self.0.beyond.more {
            write!(f, "\n\nand more: these are {}", self.reports().count())?;
        }
        if self.0.beyond.not_checked {
            f.write_str("\n\nand maybe more: the rest was not judged")?;
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
            // The marker is set off by the gutter: five digits, a blank, the bar and a blank.
            let indent = number.len().max(5) + 3 + marker.start;
            write!(f, "\n{number:>5} | {shown}\n{:indent$}{}", "", "^".repeat(marker.len()))?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n   help: {help}")?;
        }
        Ok(())
    }
}
