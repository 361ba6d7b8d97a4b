//! The holding force: the largest load along x on the still drive that does not slide it away.
//!
//! Waveforms rest at their values of t = 0 and nothing moves, so a load is held where it has a static equilibrium: with its
//! contacts crept, but not slipping as a whole. That is what a start in equilibrium looks for, all loads put on in proportion
//! (`stickslip_drive::Model::start`); where there is none, it names the body that gives way. The largest load is closed in on
//! by halving, for a drive tells no more than whether it holds.

mod held;
mod table;

pub use held::{Held, Holdless, Lost};
pub(crate) use table::definitions;
pub use table::{csv, json, write};

use super::variation::{Overrides, body, not_here};
use super::{Bracket, CurveError, Variation};
use crate::each::each;
use held::Still;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_run::{Job, Warning, Watcher};

/// Its name as a curve.
pub const NAME: &str = "holding-force";

/// Holding forces of a scenario over something that is varied.
pub struct Holding {
    body: usize,
    /// What is varied.
    pub variation: Variation,
    /// The scenario without it.
    pub job: Job,
}

/// What the drive holds at a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What is varied, SI.
    pub value: f64,
    /// What sets it in the scenario: pairs of key path and value, as `--set` takes them.
    pub set: Overrides,
    /// What `check` warns of there.
    pub warnings: Vec<Warning>,
    /// Loads along x, and against it.
    pub ways: [Result<Held, Holdless>; 2],
}

impl Holding {
    /// Over the number at a path, or else over what presses the contacts of the figures' body.
    ///
    /// # Errors
    /// A scenario that has no body to be loaded or no friction, or nothing that is varied so.
    pub fn new(job: Job, over: Option<&str>) -> Result<Self, CurveError> {
        let body = body(&job, "no body is free along x, to be loaded")?;
        let variation = match over {
            Some(path) => Variation::at(&job, path)?,
            None => Variation::preload(&job, body).map_err(|why| {
                let help = "say over which number, such as --vary contacts.NAME.friction=0.1..0.5";
                not_here(&job, NAME, why, help)
            })?,
        };
        let scene = &job.scenario.scene;
        let rubs = scene.contacts.iter().any(|contact| contact.part.interface.friction() > 0.0);
        if !rubs && !variation.name.ends_with(".friction") {
            let help = "give a contact of it a \"friction\" above 0";
            let why = format!("nothing that could hold \"{}\" has friction", scene.bodies[body].name);
            return Err(not_here(&job, NAME, why, help));
        }
        Ok(Self { body, variation, job })
    }

    /// Name of the body that is loaded.
    #[must_use]
    pub fn on(&self) -> &str {
        &self.job.scenario.scene.bodies[self.body].name
    }

    /// A range worth looking at, SI.
    ///
    /// # Errors
    /// Where nobody knows: of a number by its path.
    pub fn range(&self) -> Result<[f64; 2], CurveError> {
        self.variation.range.ok_or_else(|| self.variation.no_range(&self.job))
    }

    /// The holding forces at some values, to a share of their size, on so many cores; the same for any number. The watcher is told
    /// how many points are done; where it wants an end, those not yet done are [`Holdless::NotRun`].
    ///
    /// # Errors
    /// A tolerance out of its range, 1e-9 to 0.1.
    pub fn trace(
        &self,
        values: &[f64],
        tolerance: f64,
        cores: usize,
        watcher: &(dyn Watcher + Sync),
    ) -> Result<Vec<Point>, CurveError> {
        Bracket::check(tolerance)?;
        let done = AtomicUsize::new(0);
        Ok(each(values.len(), cores, |place| {
            let value = values[place];
            let set = self.variation.overrides(value, 1.0);
            let ways = match self.still(&set, watcher) {
                Ok(still) => [1.0, -1.0].map(|sense| still.held(sense, tolerance, watcher)),
                Err(why) => [Err(why.clone()), Err(why)],
            };
            watcher.reached((done.fetch_add(1, Ordering::Relaxed) + 1) as f64);
            let warnings = super::warnings(&self.job, &set);
            Point { value, set, warnings, ways }
        }))
    }

    /// The drive at rest with something set.
    fn still(&self, set: &[(String, String)], watcher: &dyn Watcher) -> Result<Still, Holdless> {
        if !watcher.goes_on() {
            return Err(Holdless::NotRun);
        }
        Ok(Still::new(self.job.scenario.with(set)?, self.body))
    }
}

impl Point {
    /// Whether both ways are done, found or not.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.ways.iter().all(|way| *way != Err(Holdless::NotRun))
    }

    /// Whether it holds as much both ways, for what is known of it.
    #[must_use]
    pub fn is_alike(&self) -> bool {
        match &self.ways {
            [Ok(along), Ok(against)] => {
                (along.force - against.force).abs() <= along.half_width + against.half_width
            }
            [along, against] => along.is_err() == against.is_err(),
        }
    }
}
