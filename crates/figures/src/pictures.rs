//! The pictures of results, drawn alike from a run that has just ended and from its folder: the table of their kinds, each
//! in a file of its own.

pub(crate) mod alike;
mod drive;
mod energy;
mod events;
mod fields;
mod friction;
mod hysteresis;
mod layout;
mod memory;
mod own;
mod period;
mod phase;
mod state;
mod substitute;
pub(crate) mod trajectory;
mod waveform;

use crate::look::{Look, Pen, Picture};
use std::panic::resume_unwind;
use std::thread;
use stickslip_plot::PlotError;
use stickslip_run::Job;
use stickslip_run::Kept;
use stickslip_run::SealedTable;
use stickslip_run::files::InsideTables;
use stickslip_run::frame::FrameError;
use stickslip_run::provenance::provenance;
use stickslip_run::{Real, quantity};
use stickslip_scenario::PlotName;
use thiserror::Error;

/// What pictures are drawn from.
pub struct Sources<'a> {
    /// What was run.
    pub job: &'a Job,
    /// What was kept of it.
    pub kept: &'a Kept,
    /// Where the tables of the contacts' insides lie, if they were written.
    pub insides: InsideTables,
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
    /// A picture of channels that the scenario does not name.
    #[error(
        "{plot} was not drawn: the scenario names no channels to draw\n   help: name some in its plots, such as {{\"x\": \"ball.u_m\", \"y\": \"ball.fx_N\"}}"
    )]
    Unnamed {
        /// Which picture.
        plot: &'static str,
    },
    /// Panels of other kinds, or no curves.
    #[error("{plot} was not drawn: {unlike}")]
    Unlike {
        /// Which picture.
        plot: &'static str,
        /// Which results do not have the same panels, and which each has.
        unlike: String,
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
    let pen = Pen { look, provenance: provenance(sources.job, sources.kept), kept: None };
    let (sources, pen) = (&sources, &pen);
    let one = |plot| move || picture(sources, plot, pen);
    // Each on a thread of its own; in what order they end is nobody's business.
    thread::scope(|scope| {
        let drawing: Vec<_> = plots.into_iter().map(|plot| scope.spawn(one(plot))).collect();
        drawing
            .into_iter()
            .map(|picture| picture.join().unwrap_or_else(|panic| resume_unwind(panic)))
            .collect()
    })
}

/// Draws one picture that the job's scenario names.
///
/// # Errors
/// What keeps it from being drawn.
pub fn draw_one(sources: &Sources<'_>, plot: PlotName, look: &Look) -> Result<Vec<Picture>, FigureError> {
    picture(sources, plot, &Pen { look, provenance: provenance(sources.job, sources.kept), kept: None })
}

/// What a kind of picture shows.
pub(crate) fn shows(plot: PlotName) -> &'static str {
    kind(plot).shows
}

/// A kind of picture.
struct Kind {
    /// What it shows, for the gallery.
    shows: &'static str,
    /// Columns that it is drawn from.
    needs: fn(&Job) -> Vec<String>,
    draw: fn(&Sources<'_>, &Pen<'_>) -> Result<Vec<Picture>, Undrawn>,
}

fn kind(plot: PlotName) -> &'static Kind {
    match plot {
        PlotName::Layout => &layout::KIND,
        PlotName::Loop => &hysteresis::KIND,
        PlotName::Trajectory => &trajectory::KIND,
        PlotName::Energy => &energy::KIND,
        PlotName::Phase => &phase::KIND,
        PlotName::Events => &events::KIND,
        PlotName::State => &state::KIND,
        PlotName::Memory => &memory::KIND,
        PlotName::Fields => &fields::KIND,
        PlotName::Substitute => &substitute::KIND,
        PlotName::Friction => &friction::KIND,
        PlotName::Xy => &own::KIND,
        PlotName::Waveform => &waveform::KIND,
        PlotName::Drive => &drive::KIND,
    }
}

/// Why a kind of picture is not drawn, before it is said which.
enum Undrawn {
    Unnamed,
    Absent(&'static str),
    Table(FrameError),
    Plot(PlotError),
}

impl From<FrameError> for Undrawn {
    fn from(source: FrameError) -> Self {
        Self::Table(source)
    }
}

impl From<PlotError> for Undrawn {
    fn from(source: PlotError) -> Self {
        Self::Plot(source)
    }
}

pub(crate) fn picture(
    sources: &Sources<'_>,
    plot: PlotName,
    pen: &Pen<'_>,
) -> Result<Vec<Picture>, FigureError> {
    let (kind, series, plot) = (kind(plot), &sources.kept.series, plot.name());
    let columns: Vec<String> =
        (kind.needs)(sources.job).into_iter().filter(|name| !series.has(name)).collect();
    if !columns.is_empty() {
        return Err(FigureError::Missing { plot, columns });
    }
    (kind.draw)(sources, pen).map_err(|why| match why {
        Undrawn::Unnamed => FigureError::Unnamed { plot },
        Undrawn::Absent(file) => FigureError::Absent { plot, file },
        Undrawn::Table(source) => FigureError::Table { plot, source },
        Undrawn::Plot(source) => FigureError::Plot { plot, source },
    })
}

/// The place of a table that the run may have left out.
fn written<'a>(table: &'a SealedTable, file: &'static str) -> Result<&'a SealedTable, Undrawn> {
    if table.path.exists() { Ok(table) } else { Err(Undrawn::Absent(file)) }
}

/// The title of a picture with room for so many of all contacts and moments: which those are, where they are not all.
fn of_all(title: &str, which: &str, (shown, all): (usize, usize)) -> String {
    let which = if which.is_empty() { String::new() } else { format!("the {which} ") };
    if shown < all { format!("{title} ({which}{shown} of {all} in the table)") } else { title.to_owned() }
}

/// The title of what is drawn from events while they are whole: from when until when that is, where it is not all the way.
fn whole_title(job: &Job, kept: &Kept) -> String {
    let time = |t: f64| quantity(Real(t), "s");
    let (title, until, end) = (job.title(), kept.whole_until(), kept.end());
    let [from, to] = job.scenario.written.window;
    if from > 0.0 || to < end {
        let (from, until) = (time(from), time(to.min(until)));
        let thinned = if kept.whole_until() < to.min(end) { ", events are thinned" } else { "" };
        format!("{title}, {from} to {until} of {} (output.window{thinned})", time(end))
    } else if until < end {
        format!("{title}, until {} of {} (events are thinned)", time(until), time(end))
    } else {
        title.to_owned()
    }
}

/// Columns of these quantities of all contacts.
fn of_contacts(job: &Job, quantities: &[&str]) -> Vec<String> {
    let names = job.model.contacts().map(|(name, _)| name);
    names.flat_map(|name| quantities.iter().map(move |quantity| format!("{name}.{quantity}"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nine were told as six, and nothing said so.
    #[test]
    fn what_is_left_out_is_said() {
        assert_eq!(of_all("Ball", "last", (6, 9)), "Ball (the last 6 of 9 in the table)");
        assert_eq!(of_all("Ball", "", (6, 15)), "Ball (6 of 15 in the table)");
        assert_eq!(of_all("Ball", "last", (6, 6)), "Ball");
    }
}
