//! What the springs of each contact did over time.

use crate::look::{Pen, Picture};
use stickslip_contact::SpringState;
use stickslip_plot::{PlotError, SpringCondition, SpringMap, state_figure};
use stickslip_results::Job;
use stickslip_results::springs::Springs;
use stickslip_scenario::PlotName;

/// One panel for each contact.
pub(crate) fn draw(job: &Job, contacts: Vec<Springs>, pen: &Pen<'_>) -> Result<Vec<Picture>, PlotError> {
    let contacts: Vec<(Springs, Vec<SpringCondition>)> = contacts
        .into_iter()
        .map(|mut springs| {
            let conditions = std::mem::take(&mut springs.states).into_iter().map(condition).collect();
            (springs, conditions)
        })
        .collect();
    let maps = contacts.iter().map(|(Springs { contact, time, x, .. }, conditions)| SpringMap {
        name: contact,
        time,
        x,
        conditions,
    });
    let maps: Vec<SpringMap<'_>> = maps.collect();
    pen.draw(PlotName::State, state_figure(job.title(), &maps))
}

/// A state as pictures name it.
fn condition(state: SpringState) -> SpringCondition {
    match state {
        SpringState::Open => SpringCondition::Open,
        SpringState::Stick => SpringCondition::Stick,
        SpringState::SlipForward => SpringCondition::SlipForward,
        SpringState::SlipBackward => SpringCondition::SlipBackward,
    }
}
