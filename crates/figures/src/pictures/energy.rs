//! The energy book of the whole.

use super::{Kind, Sources, Undrawn};
use crate::look::{Pen, Picture};
use stickslip_plot::{EnergyBook, energy_figure};
use stickslip_results::ENERGY;
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "the work that went in and what became of it, what is stored, what the book misses",
    needs: |_| COLUMNS.map(|quantity| format!("{ENERGY}.{quantity}")).to_vec(),
    draw,
};

/// Quantities of the book.
const COLUMNS: [&str; 6] = ["input_J", "kinetic_J", "elastic_J", "friction_J", "damping_J", "error_J"];

/// Where the work that went in has gone.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let [input, kinetic, elastic, friction, damping, error] =
        COLUMNS.map(|quantity| kept.series.column(ENERGY, quantity));
    let book = EnergyBook { time: kept.series.time(), input, kinetic, elastic, friction, damping, error };
    Ok(pen.draw(PlotName::Energy, energy_figure(job.title(), &book))?)
}
