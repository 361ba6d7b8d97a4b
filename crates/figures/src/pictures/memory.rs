//! Plot of the slip memory of the contacts at several times.

use super::{Kind, Sources, Undrawn, of_all, written};
use crate::look::{Pen, Picture};
use stickslip_plot::{MemoryMoment, memory_figure};
use stickslip_run::apart;
use stickslip_run::curves::{self, MemoryCurve};
use stickslip_run::files::MEMORY;
use stickslip_scenario::PlotName;

/// Maximum number of memory curves.
const MOST_CURVES: usize = 24;

pub(super) const KIND: Kind = Kind {
    shows: "slip memory of a contact: reversal displacements over depth, at several times",
    needs: |_| Vec::new(),
    draw,
};

/// Draws one panel per memory curve.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let job = sources.job;
    let table = written(&sources.insides.memory, MEMORY)?;
    let (curves, all) = (curves::read(table, MOST_CURVES)?, curves::count(table)?);
    let slope = |name: &str| {
        let law = job.model.contacts().find(|(contact, _)| *contact == name);
        law.map_or(f64::NAN, |(_, law)| law.stick_slope())
    };
    let times = apart(&curves.iter().map(|curve| curve.time).collect::<Vec<f64>>(), "s");
    let moments = curves.iter().zip(&times).map(|(MemoryCurve { contact, apex, h, p, .. }, time)| {
        MemoryMoment { contact, time, d: apex.0, u: apex.1, slope: slope(contact), h, p }
    });
    let moments: Vec<MemoryMoment<'_>> = moments.collect();
    let title = of_all(job.title(), "", (moments.len(), all));
    Ok(pen.draw(PlotName::Memory, memory_figure(&title, &moments))?)
}
