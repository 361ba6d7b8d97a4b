//! `stickslip plot`: draws plots from results on disk.

mod over;

use crate::arguments::PlotArguments;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_figures::{FigureError, Look, Sources};
use stickslip_run::complaint::words;
use stickslip_run::folder::{Folder, sweep};
use stickslip_run::{Results, ResultsError};
use stickslip_scenario::PlotName;
use thiserror::Error;

/// Error that prevents plots of a folder.
#[derive(Debug, Error)]
enum PlotFailure {
    /// The results cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The scenario has no plots.
    #[error("{}: the scenario names no plots\n   help: name some with --plots, such as --plots {}", .0.display(), PlotName::ALL.map(PlotName::name).join(","))]
    NoPlots(PathBuf),
    /// The results or plots cannot be overlaid.
    #[error("--over  {0}")]
    Over(String),
    /// One plot fails; the others are drawn.
    #[error("{}: {source}{}", .folder.display(), advice(.source))]
    Figure { folder: PathBuf, source: Box<FigureError> },
    /// The plots cannot be written.
    #[error("{}: the plots cannot be written: {}", .folder.display(), words(.source))]
    Write { folder: PathBuf, source: io::Error },
}

/// Draws the plots of all folders. An error in one folder does not affect the others.
pub(crate) fn plot(arguments: &PlotArguments) -> Verdict {
    if arguments.over {
        return over::plot(arguments);
    }
    let mut worst = Verdict::Done;
    for folder in &arguments.folders {
        for failure in plot_folder(folder, arguments) {
            complain(format_args!("{failure}"));
            worst = worst.max(failure.verdict());
        }
    }
    worst
}

/// Draws the plots of one folder and returns the errors.
fn plot_folder(folder: &Path, arguments: &PlotArguments) -> Vec<PlotFailure> {
    let results = match Results::read(folder, &arguments.plots) {
        Ok(results) => results,
        Err(error) => return vec![error.into()],
    };
    let Results { job, kept, insides } = &results;
    if job.scenario.plots.is_empty() {
        return vec![PlotFailure::NoPlots(folder.to_owned())];
    }
    if let (Some(program), false) = (results.other_program(), arguments.quiet) {
        complain(format_args!("{}: note: computed by {program}", folder.display()));
    }
    let (mut pictures, mut failures) = (Vec::new(), Vec::new());
    let sources = Sources { job, kept, insides: insides.clone() };
    for drawn in stickslip_figures::draw(&sources, &arguments.look.look()) {
        match drawn {
            Ok(files) => pictures.extend(files),
            Err(source) => failures.push(PlotFailure::figure(folder, source)),
        }
    }
    let out = arguments.out.as_ref().map_or_else(|| folder.to_owned(), |out| out.join(&job.name));
    match write(&out, &pictures) {
        Ok(names) if !arguments.quiet && !names.is_empty() => {
            say(format_args!("{}: {}", out.display(), names.join(", ")));
        }
        Ok(_) => {}
        Err(source) => failures.push(PlotFailure::Write { folder: out, source }),
    }
    failures
}

/// Writes the plots, all or none.
fn write(out: &Path, pictures: &[(String, Vec<u8>)]) -> io::Result<Vec<String>> {
    if pictures.is_empty() {
        return Ok(Vec::new());
    }
    let mut folder = Folder::make(out)?;
    // An interrupted command may have left temporary files.
    let written: Vec<String> = pictures.iter().map(|(name, _)| name.clone()).collect();
    sweep(out, &[Look::all_files(), written].concat());
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
    let names = folder.names();
    folder.publish()?;
    Ok(names)
}

impl PlotFailure {
    fn figure(folder: &Path, source: FigureError) -> Self {
        Self::Figure { folder: folder.to_owned(), source: Box::new(source) }
    }

    fn verdict(&self) -> Verdict {
        match self {
            Self::Write { .. } => Verdict::Stopped,
            Self::Figure { source, .. } if matches!(**source, FigureError::Plot { .. }) => Verdict::Stopped,
            Self::Results(_) | Self::NoPlots(_) | Self::Over(_) | Self::Figure { .. } => Verdict::BadInput,
        }
    }
}

/// Returns advice for an error.
fn advice(error: &FigureError) -> &'static str {
    match error {
        FigureError::Missing { .. } => {
            "\n   help: run the scenario with these channels, or without output.channels, to write all channels"
        }
        FigureError::Absent { .. } => "\n   help: run the scenario with this plot in its key \"plots\"",
        FigureError::Unlike { .. } => {
            "\n   help: overlay plots with the same panels, or give all scenarios a plot of the same two channels"
        }
        FigureError::Unnamed { .. } | FigureError::Table { .. } | FigureError::Plot { .. } => "",
    }
}
