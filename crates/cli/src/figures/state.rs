//! What the springs of each contact did over time.

use crate::job::Job;
use crate::look::{Pen, Picture};
use crate::springs::Springs;
use stickslip_plot::{PlotError, SpringMap, state_figure};
use stickslip_scenario::PlotName;

/// One panel for each contact.
pub(super) fn draw(job: &Job, contacts: &[Springs], pen: &Pen<'_>) -> Result<Vec<Picture>, PlotError> {
    let maps = contacts.iter().map(|Springs { contact, time, x, conditions }| SpringMap {
        name: contact,
        time,
        x,
        conditions,
    });
    let maps: Vec<SpringMap<'_>> = maps.collect();
    pen.draw(PlotName::State, state_figure(job.title(), &maps))
}
