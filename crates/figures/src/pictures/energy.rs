//! Plot of the energy balance.

use super::period::LastPeriod;
use super::{Kind, Sources, Undrawn};
use crate::look::{Pen, Picture};
use stickslip_plot::{EnergyBook, energy_figure, enlarged_beside};
use stickslip_run::{ENERGY, Series};
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "input work, friction work, damping, stored energy; for a long run also the last period",
    needs: |_| COLUMNS.map(|quantity| format!("{ENERGY}.{quantity}")).to_vec(),
    draw,
};

/// Quantities of the energy balance.
const COLUMNS: [&str; 6] = ["input_J", "kinetic_J", "elastic_J", "friction_J", "damping_J", "error_J"];

/// Draws the energy balance. For a long run, a second column enlarges the last period, with work and losses since its start.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let broken = kept.series.broken(job.scenario.written.window);
    let figure = energy_figure(job.title(), &book(&broken));
    let Some((period, rows)) = LastPeriod::with_rows(job, kept) else {
        return Ok(pen.draw(PlotName::Energy, figure)?);
    };
    let whole = book(&rows);
    let [input, friction, damping, error] =
        [whole.input, whole.friction, whole.damping, whole.error].map(since_start);
    let part = EnergyBook { input: &input, friction: &friction, damping: &damping, error: &error, ..whole };
    let words = format!("period {}, from 0", period.number);
    let figure = enlarged_beside(figure, energy_figure("", &part), period.span, &words);
    Ok(pen.draw(PlotName::Energy, figure)?)
}

fn book(series: &Series) -> EnergyBook<'_> {
    let [input, kinetic, elastic, friction, damping, error] =
        COLUMNS.map(|quantity| series.column(ENERGY, quantity));
    EnergyBook { time: series.time(), input, kinetic, elastic, friction, damping, error }
}

fn since_start(values: &[f64]) -> Vec<f64> {
    let start = values.first().copied().unwrap_or(0.0);
    values.iter().map(|value| value - start).collect()
}
