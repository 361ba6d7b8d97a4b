//! The pictures of results, drawn alike from a run that has just ended and from its folder.

mod hysteresis;
mod trajectory;

use crate::job::Job;
use crate::kept::Kept;
use crate::look::{Look, Pen, Picture};
use crate::provenance::provenance;
use stickslip_drive::scene::Freedom;
use stickslip_plot::PlotError;
use stickslip_scenario::PlotName;
use thiserror::Error;

/// Why a picture is not drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub(crate) enum FigureError {
    /// Columns that the tables do not have.
    #[error("{plot} was not drawn: it needs {}, which output.channels left out", .columns.join(", "))]
    Missing { plot: &'static str, columns: Vec<String> },
    /// Drawing failed.
    #[error("{plot} was not drawn: {source}")]
    Plot { plot: &'static str, source: PlotError },
}

/// Draws pictures, each once, in the order of their names' list.
pub(crate) fn draw(
    job: &Job,
    kept: &Kept,
    plots: &[PlotName],
    look: &Look,
) -> Vec<Result<Vec<Picture>, FigureError>> {
    let mut plots = plots.to_vec();
    plots.sort_by_key(|plot| *plot as u8);
    plots.dedup();
    let pen = Pen { look, provenance: provenance(job, kept) };
    plots.into_iter().map(|plot| picture(job, kept, plot, &pen)).collect()
}

fn picture(job: &Job, kept: &Kept, plot: PlotName, pen: &Pen<'_>) -> Result<Vec<Picture>, FigureError> {
    let columns: Vec<String> = needs(job, plot).into_iter().filter(|name| !kept.series.has(name)).collect();
    if !columns.is_empty() {
        return Err(FigureError::Missing { plot: plot.name(), columns });
    }
    let pictures = match plot {
        PlotName::Loop => hysteresis::draw(job, kept, pen),
        PlotName::Trajectory => trajectory::draw(job, kept, pen),
        // Not drawn yet.
        _ => Ok(Vec::new()),
    };
    pictures.map_err(|source| FigureError::Plot { plot: plot.name(), source })
}

/// Columns that a picture is drawn from.
fn needs(job: &Job, plot: PlotName) -> Vec<String> {
    let contacts = |quantities: &[&str]| -> Vec<String> {
        let names = job.model.contacts().map(|(name, _)| name);
        names.flat_map(|name| quantities.iter().map(move |quantity| format!("{name}.{quantity}"))).collect()
    };
    match plot {
        PlotName::Loop => contacts(&["u_m", "d_m", "fx_N"]),
        PlotName::Trajectory => {
            let moving = job.scenario.scene.bodies.iter().filter(|body| body.part.x != Freedom::Fixed);
            moving.map(|body| format!("{}.x_m", body.name)).chain(contacts(&["u_m"])).collect()
        }
        _ => Vec::new(),
    }
}
