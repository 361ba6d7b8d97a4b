//! What a batch tells: a line of each variant.

use crate::figure::Figure;
use crate::number::ValueError;
use std::fmt;
use stickslip_drive::{Counts, RunError, SceneError, WaveformError};
use thiserror::Error;

/// The lines of a batch, in the order of its variants.
#[derive(Debug, Clone, PartialEq)]
pub struct Lines {
    heads: Vec<String>,
    pub(crate) ends: Vec<Result<Ended, LineFault>>,
    /// Line after line.
    pub(crate) values: Vec<f64>,
}

/// How a variant came to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ended {
    /// When, s: the end of the plan, or earlier where steps are to be steady.
    pub time: f64,
    /// Steps, events and evaluations.
    pub counts: Counts,
}

/// Why a variant has no figures.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LineFault {
    /// It was not run: the batch was stopped before.
    #[error("not run")]
    NotRun,
    /// A number that its part refuses.
    #[error("number {place}: {why}")]
    Number {
        /// Which of the numbers that vary.
        place: usize,
        /// Why.
        why: ValueError,
    },
    /// Numbers that make no waveform.
    #[error("waveform {place}: {why}")]
    Waveform {
        /// Its place in the scene.
        place: usize,
        /// Why.
        why: WaveformError,
    },
    /// A scene that makes no model, or no start.
    #[error(transparent)]
    Scene(Box<SceneError>),
    /// A run that stopped itself, or was stopped.
    #[error(transparent)]
    Run(Box<RunError>),
}

/// One line.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a> {
    /// How the variant ended.
    pub end: &'a Result<Ended, LineFault>,
    /// The figures in the order in which they were asked for; NaN without an end.
    pub figures: &'a [f64],
}

impl Lines {
    /// Lines of variants that have not been run.
    pub(crate) fn new(count: usize, figures: &[Figure]) -> Self {
        Self {
            heads: figures.iter().map(Figure::head).collect(),
            ends: vec![Err(LineFault::NotRun); count],
            values: vec![f64::NAN; count * figures.len()],
        }
    }

    pub(crate) fn width(&self) -> usize {
        self.heads.len()
    }

    /// Number of variants.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    /// What variant `place` came to.
    #[must_use]
    pub fn get(&self, place: usize) -> Option<Line<'_>> {
        let (end, width) = (self.ends.get(place)?, self.width());
        Some(Line { end, figures: self.values.get(place * width..(place + 1) * width)? })
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = Line<'_>> {
        (0..self.count()).filter_map(|place| self.get(place))
    }
}

/// As CSV: a head, then the figures of each variant, its steps and events, and what is wrong with it. Numbers have as many digits as
/// it takes to read the same bits back.
impl fmt::Display for Lines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "variant")?;
        self.heads.iter().try_for_each(|head| write!(f, ",{head}"))?;
        writeln!(f, ",steps,events,fault")?;
        for (place, line) in self.iter().enumerate() {
            write!(f, "{place}")?;
            line.figures.iter().try_for_each(|figure| write!(f, ",{figure:e}"))?;
            match line.end {
                Ok(Ended { counts, .. }) => writeln!(f, ",{},{},", counts.steps, counts.events)?,
                Err(fault) => writeln!(f, ",,,\"{}\"", fault.to_string().replace('"', "\"\""))?,
            }
        }
        Ok(())
    }
}
