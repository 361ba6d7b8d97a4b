//! The report of what is wrong with a scenario, as plain values.

use std::fmt;
use std::ops::{Deref, Range};

/// What is wrong with a scenario, where, and what would be right. The values are in [`Report`].
#[derive(Debug, Clone, PartialEq)]
pub struct ScenarioError(Box<Report>);

/// The parts of a [`ScenarioError`].
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The file as it was named, or the argument of `--set` that is to blame.
    pub file: String,
    /// Whether an argument of `--set` is to blame, not the file.
    pub is_override: bool,
    /// Where in the file; none when the file as a whole is meant.
    pub excerpt: Option<Excerpt>,
    /// Key path such as `contacts.ball.friction`; empty for the whole scenario.
    pub path: String,
    /// What was expected and what came.
    pub message: String,
    /// What to try.
    pub help: Option<String>,
}

/// The line to blame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Line, from 1.
    pub line: usize,
    /// Column of the marker in characters, from 1.
    pub column: usize,
    /// The whole line without its end.
    pub text: String,
    /// What the marker stands under: characters of [`Self::text`], from 0; never empty.
    pub marker: Range<usize>,
}

impl ScenarioError {
    pub(crate) fn new(report: Report) -> Self {
        Self(Box::new(report))
    }

    /// The path as a later check wrote it, also where it goes deeper than the file.
    pub(crate) fn with_path(mut self, path: &str) -> Self {
        path.clone_into(&mut self.0.path);
        self
    }
}

impl Deref for ScenarioError {
    type Target = Report;

    fn deref(&self) -> &Report {
        &self.0
    }
}

impl std::error::Error for ScenarioError {}

/// Most characters of a line that are shown.
const WIDTH: usize = 100;
/// Characters shown before the marker where the line is cut.
const BEFORE: usize = 40;

impl Excerpt {
    /// The part of the line to show and where its marker stands.
    fn window(&self) -> (String, Range<usize>) {
        let length = self.text.chars().count();
        if length <= WIDTH {
            return (self.text.chars().map(printable).collect(), self.marker.clone());
        }
        let start = self.marker.start.saturating_sub(BEFORE).min(length - WIDTH);
        let end = start + WIDTH;
        let mut shown: String = self.text.chars().skip(start).take(WIDTH).map(printable).collect();
        let mut shift = 0;
        if start > 0 {
            shown.insert(0, '…');
            shift = 1;
        }
        if end < length {
            shown.push('…');
        }
        let marker = self.marker.start - start + shift..self.marker.end.min(end) - start + shift;
        (shown, marker)
    }
}

/// A tab or another control character would move the marker away from its word.
fn printable(c: char) -> char {
    if c.is_control() { ' ' } else { c }
}

impl fmt::Display for ScenarioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.excerpt {
            _ if self.is_override => write!(f, "--set {}  ", self.file)?,
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
            let carets = "^".repeat(marker.len().max(1));
            // The marker is set off by the gutter: five digits, a blank, the bar and a blank.
            write!(
                f,
                "\n{number:>5} | {shown}\n{:indent$}{carets}",
                "",
                indent = gutter(&number) + marker.start
            )?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n   help: {help}")?;
        }
        Ok(())
    }
}

fn gutter(number: &str) -> usize {
    number.len().max(5) + 3
}
