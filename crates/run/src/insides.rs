//! Tables about the interior of contacts: `springs.csv`, `memory.csv`, `fields.csv` and `friction.csv`.

mod fields;

use crate::folder::Folder;
use crate::job::Job;
use crate::sheet::{Sheet, Written};
use fields::FieldTables;
use std::io;
use stickslip_contact::{Memory, Segment, SpringState};
use stickslip_drive::{Moments, Schedule};
use stickslip_quantity::Columns;
use stickslip_quantity::columns::{MEMORY, SPRINGS};

/// Writer of the tables that the scenario requests.
pub(crate) struct Insides<'a> {
    job: &'a Job,
    springs: Option<Looks>,
    memory: Option<Looks>,
    fields: Option<(FieldTables<'a>, Schedule)>,
    /// Time of the last requested snapshot, s.
    now: f64,
}

/// A table with the schedule of its snapshots.
struct Looks {
    sheet: Sheet,
    schedule: Schedule,
}

impl<'a> Insides<'a> {
    /// Opens the requested tables.
    pub(crate) fn new(job: &'a Job, folder: &Folder) -> io::Result<Self> {
        let schedule =
            |moments: &Moments| Schedule::new(moments.clone(), job.start.time(), job.scenario.plan.duration);
        let open = |table: Columns, moments: &Moments| {
            let sheet = Sheet::new(folder.draft(table.file)?, table.names.iter().copied());
            Ok::<_, io::Error>(Looks { sheet, schedule: schedule(moments) })
        };
        let springs = job.scenario.springs.as_ref().map(|asked| open(SPRINGS, &asked.moments));
        let memory = job.scenario.memory.as_ref().map(|asked| open(MEMORY, &asked.moments));
        let fields = job.scenario.fields.as_ref().map(|asked| {
            Ok::<_, io::Error>((FieldTables::new(job, asked, folder)?, schedule(&asked.moments)))
        });
        Ok(Self {
            job,
            springs: springs.transpose()?,
            memory: memory.transpose()?,
            fields: fields.transpose()?,
            now: f64::NEG_INFINITY,
        })
    }

    /// Returns the time of the next snapshot of any table, s.
    pub(crate) fn next_look(&mut self) -> Option<f64> {
        let mut next = f64::INFINITY;
        let looks = [&mut self.springs, &mut self.memory].into_iter().flatten();
        let fields = self.fields.iter_mut().map(|(_, schedule)| schedule);
        for schedule in looks.map(|looks| &mut looks.schedule).chain(fields) {
            if schedule.due() <= self.now {
                schedule.advance();
            }
            next = next.min(schedule.due());
        }
        self.now = next;
        next.is_finite().then_some(next)
    }

    /// Writes the states of the contacts at the last requested time.
    pub(crate) fn look(&mut self, memories: &[Memory]) {
        let now = self.now;
        if let Some(looks) = self.springs.as_mut().filter(|looks| looks.schedule.due() <= now) {
            springs(&mut looks.sheet, self.job, now, memories);
        }
        if let Some(looks) = self.memory.as_mut().filter(|looks| looks.schedule.due() <= now) {
            curves(&mut looks.sheet, self.job, now, memories);
        }
        if let Some((tables, _)) = self.fields.as_mut().filter(|(_, schedule)| schedule.due() <= now) {
            tables.look(now, memories);
        }
    }

    /// Returns whether a table needs the paths of the contacts in the (d, u) plane.
    pub(crate) fn follows(&self) -> bool {
        self.fields.is_some()
    }

    /// Adds a section of the path of contact `c` in the (d, u) plane.
    pub(crate) fn path(&mut self, c: usize, segment: Segment) {
        if let Some((tables, _)) = &mut self.fields {
            tables.path(c, segment);
        }
    }

    /// Returns whether a write has failed.
    pub(crate) fn has_failed(&self) -> bool {
        let looks = [&self.springs, &self.memory].into_iter().flatten();
        looks.map(|looks| &looks.sheet).any(Sheet::has_failed)
            || self.fields.as_ref().is_some_and(|(tables, _)| tables.has_failed())
    }

    /// Closes the tables.
    pub(crate) fn finish(self) -> io::Result<Vec<(&'static str, Written)>> {
        let looks = [(SPRINGS.file, self.springs), (MEMORY.file, self.memory)];
        let looks = looks.into_iter().filter_map(|(name, looks)| Some((name, looks?)));
        let mut written =
            looks.map(|(name, looks)| Ok((name, looks.sheet.finish()?))).collect::<io::Result<Vec<_>>>()?;
        if let Some((tables, _)) = self.fields {
            written.extend(tables.finish()?);
        }
        Ok(written)
    }
}

/// Writes one line per spring. A contact that is never pressed has no springs.
fn springs(sheet: &mut Sheet, job: &Job, t: f64, memories: &[Memory]) {
    for (((name, law), memory), grid) in job.model.contacts().zip(memories).zip(&job.grids) {
        let d = memory.apex().d;
        for spring in grid.iter().flat_map(|grid| memory.springs(law, grid)) {
            sheet.number(t);
            sheet.text(name);
            sheet.number(spring.x);
            sheet.number(spring.stretch);
            sheet.word(state_name(spring.state));
            let normal = spring.normal_force(law, d);
            let forces = [spring.tangential_force(law), normal, law.friction() * normal];
            [spring.height].into_iter().chain(forces).for_each(|value| sheet.number(value));
            sheet.end_line();
        }
    }
}

/// Writes one line per breakpoint of each slip memory curve, from the centre to the edge. An open contact has no breakpoints.
fn curves(sheet: &mut Sheet, job: &Job, t: f64, memories: &[Memory]) {
    for ((name, _), memory) in job.model.contacts().zip(memories) {
        let Memory::Curve(curve) = memory else { continue };
        let apex = curve.apex();
        for (h, p) in curve.knots() {
            sheet.number(t);
            sheet.text(name);
            [apex.d, apex.u, h, p].into_iter().for_each(|value| sheet.number(value));
            sheet.end_line();
        }
    }
}

/// Returns the word for the state of a spring in all tables.
pub(crate) fn state_name(state: SpringState) -> &'static str {
    match state {
        SpringState::Open => "open",
        SpringState::Stick => "stick",
        SpringState::SlipForward => "slip+",
        SpringState::SlipBackward => "slip-",
    }
}
