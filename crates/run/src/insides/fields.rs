//! Stresses and displacements in the contacts, and their friction work: `fields.csv` and `friction.csv`.

use super::state_name;
use crate::folder::Folder;
use crate::job::Job;
use crate::sheet::{Sheet, Written};
use crate::theory::BEYOND;
use std::io;
use stickslip_contact::{Fields, FrictionMap, Interface, Memory, Segment};
use stickslip_quantity::Columns;
use stickslip_quantity::columns::{FIELDS, FRICTION};
use stickslip_scenario::FieldsOutput;

/// Writer of `fields.csv` and `friction.csv`.
pub(super) struct FieldTables<'a> {
    contacts: Vec<Followed<'a>>,
    fields: Sheet,
    friction: Sheet,
}

/// A contact with its friction history.
struct Followed<'a> {
    name: &'a str,
    law: &'a Interface,
    /// Slip memory at the end of the last reported path.
    memory: Memory,
    /// Friction work per area up to the end of this path. `None` for a contact without fields.
    map: Option<FrictionMap>,
}

impl<'a> FieldTables<'a> {
    /// Opens the tables.
    pub(super) fn new(job: &'a Job, asked: &FieldsOutput, folder: &Folder) -> io::Result<Self> {
        let open = |table: Columns| {
            Ok::<_, io::Error>(Sheet::new(folder.draft(table.file)?, table.names.iter().copied()))
        };
        let contacts = job.model.contacts().zip(job.start.memories()).enumerate();
        let follow = |(c, ((name, law), memory)): (usize, ((&'a str, &'a Interface), &Memory))| {
            // A contact without width is never pressed. Lists of springs and prescribed normal laws have no shape.
            let width = job.model.contact_width(c).filter(|_| law.profile().has_shape());
            let radii = width.map(|width| radii(asked, asked.extent.unwrap_or(BEYOND * 0.5 * width)));
            Followed { name, law, memory: memory.clone(), map: radii.map(FrictionMap::new) }
        };
        let contacts = contacts.map(follow).collect();
        Ok(Self { contacts, fields: open(FIELDS)?, friction: open(FRICTION)? })
    }

    /// Adds a section of the path of contact `c` in the (d, u) plane.
    pub(super) fn path(&mut self, c: usize, segment: Segment) {
        let Some(contact) = self.contacts.get_mut(c) else { return };
        let Some(map) = &mut contact.map else { return };
        map.follow(contact.law, &contact.memory, segment);
        // The run has accepted this path, so the commit cannot fail.
        let _ = contact.memory.commit(contact.law, segment);
    }

    /// Writes stresses, displacements and friction work of all contacts at time `t`, s.
    pub(super) fn look(&mut self, t: f64, memories: &[Memory]) {
        for (contact, memory) in self.contacts.iter().zip(memories) {
            let Followed { name, law, memory: before, map: Some(map) } = contact else { continue };
            let Some(fields) = Fields::of(law, memory) else { continue };
            for &r in map.radii() {
                let field = fields.at(r);
                self.fields.number(t);
                self.fields.text(name);
                let values =
                    [r, field.pressure, field.shear, field.displacement, field.slip, field.deflection];
                values.into_iter().for_each(|value| self.fields.number(value));
                self.fields.word(state_name(field.state));
                field.error.into_iter().for_each(|error| self.fields.number(error));
                self.fields.end_line();
            }
            // A path is reported at its end only. Its part before this time is added here.
            let mut map = map.clone();
            map.follow(law, before, Segment::Straight(memory.apex()));
            for ((r, work), way) in map.radii().iter().zip(map.work()).zip(map.way()) {
                self.friction.number(t);
                self.friction.text(name);
                [*r, *work, *way].into_iter().for_each(|value| self.friction.number(value));
                self.friction.end_line();
            }
        }
    }

    /// Returns whether a write has failed.
    pub(super) fn has_failed(&self) -> bool {
        self.fields.has_failed() || self.friction.has_failed()
    }

    /// Closes the tables.
    pub(super) fn finish(self) -> io::Result<[(&'static str, Written); 2]> {
        Ok([(FIELDS.file, self.fields.finish()?), (FRICTION.file, self.friction.finish()?)])
    }
}

/// Returns equally spaced radii from 0 to `extent`, m.
fn radii(asked: &FieldsOutput, extent: f64) -> Vec<f64> {
    let last = asked.radii.saturating_sub(1).max(1);
    (0..asked.radii).map(|k| extent * k as f64 / last as f64).collect()
}
