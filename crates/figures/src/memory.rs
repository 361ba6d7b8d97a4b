//! The memory curves of the contacts at some moments, each in its wedge.

use crate::look::{Pen, Picture};
use stickslip_plot::{MemoryMoment, PlotError, memory_figure};
use stickslip_results::Job;
use stickslip_results::curves::MemoryCurve;
use stickslip_scenario::PlotName;

/// One panel for each curve.
pub(crate) fn draw(job: &Job, curves: &[MemoryCurve], pen: &Pen<'_>) -> Result<Vec<Picture>, PlotError> {
    let slope = |name: &str| {
        let law = job.model.contacts().find(|(contact, _)| *contact == name);
        law.map_or(f64::NAN, |(_, law)| law.stick_slope())
    };
    let moments = curves.iter().map(|MemoryCurve { contact, time, apex, h, p }| MemoryMoment {
        contact,
        time: *time,
        d: apex.0,
        u: apex.1,
        slope: slope(contact),
        h,
        p,
    });
    let moments: Vec<MemoryMoment<'_>> = moments.collect();
    pen.draw(PlotName::Memory, memory_figure(job.title(), &moments))
}
