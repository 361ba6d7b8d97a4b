//! The pictures of results, drawn alike from a run that has just ended and from its folder.

use crate::look::{Look, Pen, Picture};
use crate::{energy, events, hysteresis, layout, memory, phase, state, trajectory};
use std::path::{Path, PathBuf};
use stickslip_plot::PlotError;
use stickslip_results::ENERGY;
use stickslip_results::Job;
use stickslip_results::Kept;
use stickslip_results::curves;
use stickslip_results::files::{MEMORY, SPRINGS};
use stickslip_results::frame::FrameError;
use stickslip_results::provenance::provenance;
use stickslip_results::springs;
use stickslip_scenario::PlotName;
use thiserror::Error;

/// Most memory curves in one picture.
const MOST_CURVES: usize = 24;

/// What pictures are drawn from.
pub struct Sources<'a> {
    /// What was run.
    pub job: &'a Job,
    /// What was kept of it.
    pub kept: &'a Kept,
    /// Where `springs.csv` lies, if it was written.
    pub springs: PathBuf,
    /// Where `memory.csv` lies, if it was written.
    pub memory: PathBuf,
}

/// Why a picture is not drawn.
#[derive(Debug, Error)]
pub enum FigureError {
    /// Columns that the tables do not have.
    #[error("{plot} was not drawn: it needs {}, which output.channels left out", .columns.join(", "))]
    Missing {
        /// Which picture.
        plot: &'static str,
        /// What it lacks.
        columns: Vec<String>,
    },
    /// A table that the run did not write.
    #[error("{plot} was not drawn: it needs {file}, which the run did not write")]
    Absent {
        /// Which picture.
        plot: &'static str,
        /// What it lacks.
        file: &'static str,
    },
    /// A damaged table.
    #[error("{plot} was not drawn: {source}")]
    Table {
        /// Which picture.
        plot: &'static str,
        /// What is wrong with the table.
        source: FrameError,
    },
    /// Drawing failed.
    #[error("{plot} was not drawn: {source}")]
    Plot {
        /// Which picture.
        plot: &'static str,
        /// What cannot be drawn.
        source: PlotError,
    },
}

/// Draws the pictures that the job's scenario names, each once, in the order of all names. What is
/// wrong with one does not keep the others from being drawn.
pub fn draw(sources: &Sources<'_>, look: &Look) -> Vec<Result<Vec<Picture>, FigureError>> {
    let mut plots = sources.job.scenario.plots.clone();
    plots.sort_by_key(|plot| *plot as u8);
    plots.dedup();
    let pen = Pen { look, provenance: provenance(sources.job, sources.kept) };
    plots.into_iter().map(|plot| picture(sources, plot, &pen)).collect()
}

fn picture(sources: &Sources<'_>, plot: PlotName, pen: &Pen<'_>) -> Result<Vec<Picture>, FigureError> {
    let (job, kept) = (sources.job, sources.kept);
    let columns: Vec<String> = needs(job, plot).into_iter().filter(|name| !kept.series.has(name)).collect();
    if !columns.is_empty() {
        return Err(FigureError::Missing { plot: plot.name(), columns });
    }
    let table = |source| FigureError::Table { plot: plot.name(), source };
    let pictures = match plot {
        PlotName::Layout => layout::draw(job, pen),
        PlotName::Loop => hysteresis::draw(job, kept, pen),
        PlotName::Trajectory => trajectory::draw(job, kept, pen),
        PlotName::Energy => energy::draw(job, kept, pen),
        PlotName::Phase => phase::draw(job, kept, pen),
        PlotName::Events => events::draw(job, kept, pen),
        PlotName::State => {
            check_written(plot, SPRINGS, &sources.springs)?;
            state::draw(job, springs::read(&sources.springs).map_err(table)?, pen)
        }
        PlotName::Memory => {
            check_written(plot, MEMORY, &sources.memory)?;
            memory::draw(job, &curves::read(&sources.memory, MOST_CURVES).map_err(table)?, pen)
        }
    };
    pictures.map_err(|source| FigureError::Plot { plot: plot.name(), source })
}

fn check_written(plot: PlotName, file: &'static str, path: &Path) -> Result<(), FigureError> {
    if path.exists() { Ok(()) } else { Err(FigureError::Absent { plot: plot.name(), file }) }
}

/// Columns that a picture is drawn from.
fn needs(job: &Job, plot: PlotName) -> Vec<String> {
    let contacts = |quantities: &[&str]| -> Vec<String> {
        let names = job.model.contacts().map(|(name, _)| name);
        names.flat_map(|name| quantities.iter().map(move |quantity| format!("{name}.{quantity}"))).collect()
    };
    match plot {
        PlotName::Loop => contacts(&["u_m", "d_m", "fx_N"]),
        PlotName::Trajectory => [trajectory::needs(job), contacts(&["u_m"])].concat(),
        PlotName::Energy => energy::COLUMNS.map(|quantity| format!("{ENERGY}.{quantity}")).to_vec(),
        PlotName::Phase => phase::needs(job),
        PlotName::Layout | PlotName::Events | PlotName::State | PlotName::Memory => Vec::new(),
    }
}
