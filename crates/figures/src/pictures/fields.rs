//! Plot of stresses and displacements in the contacts at several times.

use super::{Kind, Sources, Undrawn, of_all, written};
use crate::look::{Pen, Picture};
use crate::theory::moments::condition;
use stickslip_contact::SpringState;
use stickslip_plot::{FieldsMoment, FieldsZone, fields_figure};
use stickslip_run::apart;
use stickslip_run::files::FIELDS;
use stickslip_run::moments::{self, OverRadius};
use stickslip_scenario::PlotName;

/// Maximum number of times.
const MOST: usize = 6;

pub(super) const KIND: Kind = Kind {
    shows: "pressure, shear stress, displacement and slip in a contact; stick and slip zones are shaded",
    needs: |_| Vec::new(),
    draw,
};

/// Draws two panels per time of each contact.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let job = sources.job;
    let mut moments = moments::fields(written(&sources.insides.fields, FIELDS)?)?;
    let all = moments.len();
    // The last times are kept: they show the final state.
    moments.drain(..moments.len().saturating_sub(MOST));
    let several = moments.iter().any(|moment| moment.contact != moments[0].contact);
    let times = apart(&moments.iter().map(|moment| moment.time).collect::<Vec<f64>>(), "s");
    let parts: Vec<(String, Vec<FieldsZone>, f64)> = moments
        .iter()
        .zip(times)
        .map(|(moment, time)| {
            let time = format!("t = {time}");
            let heading = if several { format!("{}, {time}", moment.contact) } else { time };
            let law = job.model.contacts().find(|(name, _)| *name == moment.contact);
            (heading, zones(moment), law.map_or(0.0, |(_, law)| law.friction()))
        })
        .collect();
    let moments = moments.iter().zip(&parts).map(|(moment, (heading, zones, friction))| FieldsMoment {
        heading,
        r: &moment.columns[0],
        pressure: &moment.columns[1],
        shear: &moment.columns[2],
        displacement: &moment.columns[3],
        slip: &moment.columns[4],
        friction: *friction,
        zones,
    });
    let moments: Vec<FieldsMoment<'_>> = moments.collect();
    let title = of_all(job.title(), "last", (moments.len(), all));
    Ok(pen.draw(PlotName::Fields, fields_figure(&title, &moments))?)
}

/// Returns the rings of equal state; their edges are midpoints between radii.
fn zones(moment: &OverRadius) -> Vec<FieldsZone> {
    let r = &moment.columns[0];
    let mut zones: Vec<FieldsZone> = Vec::new();
    for (k, state) in moment.states.iter().enumerate().filter(|(_, state)| **state != SpringState::Open) {
        let between = |i: usize, j: usize| 0.5 * (r[i] + r[j]);
        let from = if k == 0 { 0.0 } else { between(k - 1, k) };
        let to = if k + 1 == r.len() { r[k] } else { between(k, k + 1) };
        let condition = condition(*state);
        match zones.last_mut() {
            Some(last) if last.condition == condition && last.radii[1] == from => last.radii[1] = to,
            _ => zones.push(FieldsZone { radii: [from, to], condition, frozen: false }),
        }
    }
    zones
}
