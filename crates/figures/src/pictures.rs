//! Plots of a run, drawn equally from a finished run and from its result folder; one module per plot.

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

/// Data from which plots are drawn.
pub struct Sources<'a> {
    /// The run.
    pub job: &'a Job,
    /// Data kept from the run.
    pub kept: &'a Kept,
    /// Paths of the tables of springs, memory, fields and friction work, if they were written.
    pub insides: InsideTables,
}

/// Reason why a plot is not drawn.
#[derive(Debug, Error)]
pub enum FigureError {
    /// The tables lack columns.
    #[error("{plot} was not drawn: output.channels leaves out {}", .columns.join(", "))]
    Missing {
        /// Name of the plot.
        plot: &'static str,
        /// Missing columns.
        columns: Vec<String>,
    },
    /// The scenario selects no channels for the plot.
    #[error(
        "{plot} was not drawn: the scenario names no channels for it\n   help: name some in the key \"plots\", such as {{\"x\": \"ball.u_m\", \"y\": \"ball.fx_N\"}}"
    )]
    Unnamed {
        /// Name of the plot.
        plot: &'static str,
    },
    /// The results have different panels, or no curves.
    #[error("{plot} was not drawn: {unlike}")]
    Unlike {
        /// Name of the plot.
        plot: &'static str,
        /// Description of the differing panels.
        unlike: String,
    },
    /// The run did not write a table.
    #[error("{plot} was not drawn: the run did not write {file}")]
    Absent {
        /// Name of the plot.
        plot: &'static str,
        /// Name of the missing file.
        file: &'static str,
    },
    /// A table is damaged.
    #[error("{plot} was not drawn: {source}")]
    Table {
        /// Name of the plot.
        plot: &'static str,
        /// Error of the table.
        source: FrameError,
    },
    /// Drawing failed.
    #[error("{plot} was not drawn: {source}")]
    Plot {
        /// Name of the plot.
        plot: &'static str,
        /// Error of drawing.
        source: PlotError,
    },
}

/// Draws each plot that the scenario selects once, in the order of [`PlotName`]. Each plot has its own result; an error does not affect the
/// other plots.
pub fn draw(sources: &Sources<'_>, look: &Look) -> Vec<Result<Vec<Picture>, FigureError>> {
    let mut plots = sources.job.scenario.plots.clone();
    plots.sort_by_key(|plot| *plot as u8);
    plots.dedup();
    let pen = Pen { look, provenance: provenance(sources.job, sources.kept), kept: None };
    let (sources, pen) = (&sources, &pen);
    let one = |plot| move || picture(sources, plot, pen);
    // One thread per plot.
    thread::scope(|scope| {
        let drawing: Vec<_> = plots.into_iter().map(|plot| scope.spawn(one(plot))).collect();
        drawing
            .into_iter()
            .map(|picture| picture.join().unwrap_or_else(|panic| resume_unwind(panic)))
            .collect()
    })
}

/// Draws one plot.
///
/// # Errors
/// If the plot cannot be drawn, see [`FigureError`].
pub fn draw_one(sources: &Sources<'_>, plot: PlotName, look: &Look) -> Result<Vec<Picture>, FigureError> {
    picture(sources, plot, &Pen { look, provenance: provenance(sources.job, sources.kept), kept: None })
}

/// Returns the description of a plot.
pub(crate) fn shows(plot: PlotName) -> &'static str {
    kind(plot).shows
}

/// Type of plot.
struct Kind {
    /// Description for the gallery.
    shows: &'static str,
    /// Columns that the plot requires.
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

/// Reason why a plot is not drawn, without its name.
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

/// Returns the table, or an error if the run did not write it.
fn written<'a>(table: &'a SealedTable, file: &'static str) -> Result<&'a SealedTable, Undrawn> {
    if table.path.exists() { Ok(table) } else { Err(Undrawn::Absent(file)) }
}

/// Adds the number of shown contacts or times to a title if some are left out.
fn of_all(title: &str, which: &str, (shown, all): (usize, usize)) -> String {
    let which = if which.is_empty() { String::new() } else { format!("the {which} ") };
    if shown < all { format!("{title} ({which}{shown} of {all} in the table)") } else { title.to_owned() }
}

/// Returns the title of a plot of all events, with the time range in which all events are available if shorter than the run.
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

/// Returns the columns of given quantities of all contacts.
fn of_contacts(job: &Job, quantities: &[&str]) -> Vec<String> {
    let names = job.model.contacts().map(|(name, _)| name);
    names.flat_map(|name| quantities.iter().map(move |quantity| format!("{name}.{quantity}"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The title gives the number of times that are left out.
    #[test]
    fn what_is_left_out_is_said() {
        assert_eq!(of_all("Ball", "last", (6, 9)), "Ball (the last 6 of 9 in the table)");
        assert_eq!(of_all("Ball", "", (6, 15)), "Ball (6 of 15 in the table)");
        assert_eq!(of_all("Ball", "last", (6, 6)), "Ball");
    }
}
