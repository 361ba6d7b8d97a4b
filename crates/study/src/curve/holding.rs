//! Holding force: the largest load along x that the drive at rest holds.
//!
//! All waveforms keep their values at t = 0. A load is held if the drive has a static equilibrium in which contacts may slip partially but
//! not grossly. [`stickslip_drive::Model::start`] searches for the equilibrium with all loads increased in proportion. Without an
//! equilibrium, this search reports the body that moves. The largest load is found by bisection, because the search only reports whether a
//! load is held.

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

/// Name of the curve.
pub const NAME: &str = "holding-force";

/// Holding force of a scenario versus a parameter.
pub struct Holding {
    body: usize,
    /// The varied parameter.
    pub variation: Variation,
    /// The scenario without the variation.
    pub job: Job,
}

/// Holding forces at one value of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Value of the parameter, SI.
    pub value: f64,
    /// Arguments of `--set` that give this point: pairs of key path and value.
    pub set: Overrides,
    /// Warnings of `check` at this point.
    pub warnings: Vec<Warning>,
    /// Holding forces against loads along +x and -x.
    pub ways: [Result<Held, Holdless>; 2],
}

impl Holding {
    /// Creates the curve over the parameter at a key path, or by default over the preload of the body named in `figures`.
    ///
    /// # Errors
    /// Fails if no body can be loaded, nothing has friction, or the parameter does not exist.
    pub fn new(job: Job, over: Option<&str>) -> Result<Self, CurveError> {
        let body = body(&job, "no body is free along x")?;
        let variation = match over {
            Some(path) => Variation::at(&job, path)?,
            None => Variation::preload(&job, body).map_err(|why| {
                let help = "name a parameter, such as --vary contacts.NAME.friction=0.1..0.5";
                not_here(&job, NAME, why, help)
            })?,
        };
        let scene = &job.scenario.scene;
        let rubs = scene.contacts.iter().any(|contact| contact.part.interface.friction() > 0.0);
        if !rubs && !variation.name.ends_with(".friction") {
            let help = "give one of its contacts a \"friction\" above 0";
            let why = format!("no contact of \"{}\" has friction", scene.bodies[body].name);
            return Err(not_here(&job, NAME, why, help));
        }
        Ok(Self { body, variation, job })
    }

    /// Returns the name of the loaded body.
    #[must_use]
    pub fn on(&self) -> &str {
        &self.job.scenario.scene.bodies[self.body].name
    }

    /// Returns the default range of the parameter, SI.
    ///
    /// # Errors
    /// Fails if no default is known, as for a parameter given by its path.
    pub fn range(&self) -> Result<[f64; 2], CurveError> {
        self.variation.range.ok_or_else(|| self.variation.no_range(&self.job))
    }

    /// Computes the holding forces at the given values to a relative tolerance, on `cores` threads. The result does not
    /// depend on the number of threads.
    ///
    /// The watcher receives the number of finished points. If the watcher interrupts, the remaining points are [`Holdless::NotRun`].
    ///
    /// # Errors
    /// Fails if the tolerance is outside 1e-9 to 0.1.
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

    /// Returns the drive at rest with overrides applied.
    fn still(&self, set: &[(String, String)], watcher: &dyn Watcher) -> Result<Still, Holdless> {
        if !watcher.goes_on() {
            return Err(Holdless::NotRun);
        }
        Ok(Still::new(self.job.scenario.with(set)?, self.body))
    }
}

impl Point {
    /// Returns whether the computation is finished in both directions, with or without a result.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.ways.iter().all(|way| *way != Err(Holdless::NotRun))
    }

    /// Returns whether the holding forces in both directions agree within their uncertainties. A direction without result agrees only with
    /// an opposite direction without result.
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
