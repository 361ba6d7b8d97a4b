//! What goes on inside the contacts: `springs.csv` and `memory.csv`.

use crate::files::{MEMORY, MEMORY_HEAD, SPRING_HEAD, SPRINGS};
use crate::folder::Folder;
use crate::job::Job;
use crate::sheet::{Sheet, Written};
use std::io;
use stickslip_contact::{Memory, SpringState};
use stickslip_drive::{Moments, Schedule};

/// Writes what the scenario asks for.
pub(crate) struct Insides<'a> {
    job: &'a Job,
    springs: Option<Looks>,
    memory: Option<Looks>,
    /// The moment asked for last, s.
    now: f64,
}

/// A table and its moments.
struct Looks {
    sheet: Sheet,
    schedule: Schedule,
}

impl<'a> Insides<'a> {
    /// Opens the tables that the scenario asks for.
    pub(crate) fn new(job: &'a Job, folder: &Folder) -> io::Result<Self> {
        let open = |name: &str, moments: &Moments, head: &[&str]| {
            let sheet = Sheet::new(folder.draft(name)?, head.iter().copied());
            let schedule = Schedule::new(moments.clone(), job.start.time(), job.scenario.plan.duration);
            Ok::<_, io::Error>(Looks { sheet, schedule })
        };
        let springs = job.scenario.springs.as_ref().map(|asked| open(SPRINGS, &asked.moments, SPRING_HEAD));
        let memory = job.scenario.memory.as_ref().map(|asked| open(MEMORY, &asked.moments, MEMORY_HEAD));
        Ok(Self { job, springs: springs.transpose()?, memory: memory.transpose()?, now: f64::NEG_INFINITY })
    }

    /// The next moment that one of the tables wants, s.
    pub(crate) fn next_look(&mut self) -> Option<f64> {
        let mut next = f64::INFINITY;
        for looks in [&mut self.springs, &mut self.memory].into_iter().flatten() {
            if looks.schedule.due() <= self.now {
                looks.schedule.advance();
            }
            next = next.min(looks.schedule.due());
        }
        self.now = next;
        next.is_finite().then_some(next)
    }

    /// Writes down the contacts at the moment asked for last.
    pub(crate) fn look(&mut self, memories: &[Memory]) {
        let now = self.now;
        if let Some(looks) = self.springs.as_mut().filter(|looks| looks.schedule.due() <= now) {
            springs(&mut looks.sheet, self.job, now, memories);
        }
        if let Some(looks) = self.memory.as_mut().filter(|looks| looks.schedule.due() <= now) {
            curves(&mut looks.sheet, self.job, now, memories);
        }
    }

    /// Whether one of the files takes no more.
    pub(crate) fn has_failed(&self) -> bool {
        [&self.springs, &self.memory].into_iter().flatten().any(|looks| looks.sheet.has_failed())
    }

    /// Closes the tables.
    pub(crate) fn finish(self) -> io::Result<Vec<(&'static str, Written)>> {
        let looks = [(SPRINGS, self.springs), (MEMORY, self.memory)];
        let looks = looks.into_iter().filter_map(|(name, looks)| Some((name, looks?)));
        looks.map(|(name, looks)| Ok((name, looks.sheet.finish()?))).collect()
    }
}

/// One line per spring. A contact that is never pressed has none.
fn springs(sheet: &mut Sheet, job: &Job, t: f64, memories: &[Memory]) {
    for (((name, law), memory), grid) in job.model.contacts().zip(memories).zip(&job.grids) {
        for spring in grid.iter().flat_map(|grid| memory.springs(law, grid)) {
            sheet.number(t);
            sheet.text(name);
            sheet.number(spring.x);
            sheet.number(spring.stretch);
            sheet.word(state_name(spring.state));
            sheet.end_line();
        }
    }
}

/// One line per corner of the curve, from the centre to the edge. An open contact has none.
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

/// Word for the state of a spring in `springs.csv`.
fn state_name(state: SpringState) -> &'static str {
    match state {
        SpringState::Open => "open",
        SpringState::Stick => "stick",
        SpringState::SlipForward => "slip+",
        SpringState::SlipBackward => "slip-",
    }
}
