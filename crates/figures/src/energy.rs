//! The energy book of the whole.

use crate::look::{Pen, Picture};
use stickslip_plot::{EnergyBook, PlotError, energy_figure};
use stickslip_results::ENERGY;
use stickslip_results::Job;
use stickslip_results::Kept;
use stickslip_scenario::PlotName;

/// Quantities of the book.
pub(crate) const COLUMNS: [&str; 6] =
    ["input_J", "kinetic_J", "elastic_J", "friction_J", "damping_J", "error_J"];

/// Where the work that went in has gone.
pub(crate) fn draw(job: &Job, kept: &Kept, pen: &Pen<'_>) -> Result<Vec<Picture>, PlotError> {
    let [input, kinetic, elastic, friction, damping, error] =
        COLUMNS.map(|quantity| kept.series.column(ENERGY, quantity));
    let book = EnergyBook { time: kept.series.time(), input, kinetic, elastic, friction, damping, error };
    pen.draw(PlotName::Energy, energy_figure(job.title(), &book))
}
