//! Plot of stick and slip of the springs of each contact over time.

use super::{Kind, Sources, Undrawn, written};
use crate::look::{Pen, Picture};
use crate::theory::moments::condition;
use stickslip_plot::{SpringCondition, SpringMap, state_figure};
use stickslip_run::files::SPRINGS;
use stickslip_run::springs::{self, Springs};
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind =
    Kind { shows: "stick and slip of each spring of a contact over time", needs: |_| Vec::new(), draw };

/// Draws one panel per contact.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let job = sources.job;
    let contacts = springs::read(written(&sources.insides.springs, SPRINGS)?)?;
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
    Ok(pen.draw(PlotName::State, state_figure(job.title(), &maps))?)
}
