//! `Dopri5` of the crate ode_solvers with the exact contact and events by hand, as a user of that crate would have it.
//!
//! Between events every contact follows one smooth branch. After every accepted step the routine `solout` looks whether a
//! contact has turned round or used up its piece of memory; if one has, it stops the solver, the moment is found on the
//! crate's dense output, the contacts remember, and a new solver starts there with the last step. Corners end steps exactly.
//! Bodies free along the slide, contacts under constant load.

mod stretch;
mod trip;

use super::Mechanism;
use crate::clock::{Stopwatch, Times};
use crate::contestant::{Contestant, Stop};
use crate::samples::Samples;
use std::time::{Duration, Instant};
use stickslip_drive::Counts;
use stickslip_run::Watcher;
use trip::Trip;

/// ode_solvers' Dopri5 with events by hand.
pub(crate) struct Outside {
    mechanism: Mechanism,
    duration: f64,
    /// Natural length (m) and velocity (m/s) of each free coordinate: tolerances are relative to them.
    scales: Vec<(f64, f64)>,
}

impl Outside {
    pub(crate) fn new(mechanism: Mechanism, duration: f64, scales: Vec<(f64, f64)>) -> Result<Self, String> {
        if !mechanism.has_constant_loads() {
            return Err("contacts that bodies press".to_owned());
        }
        if mechanism.free.len() > 3 {
            return Err("more than three free coordinates".to_owned());
        }
        Ok(Self { mechanism, duration, scales })
    }

    fn go(&self, tolerance: f64, output: &mut Output<'_>) -> Result<Counts, Stop> {
        match self.mechanism.free.len() {
            1 => Trip::<2>::new(self).run(tolerance, output),
            2 => Trip::<4>::new(self).run(tolerance, output),
            _ => Trip::<6>::new(self).run(tolerance, output),
        }
    }
}

/// What a run hands over, and when it has to stop.
struct Output<'a> {
    samples: Option<Samples>,
    until: Option<Instant>,
    watcher: &'a dyn Watcher,
}

impl Contestant for Outside {
    fn sample(&self, tolerance: f64, wall: f64, watcher: &dyn Watcher) -> Result<(Samples, Counts), Stop> {
        let until = Instant::now().checked_add(Duration::from_secs_f64(wall.max(0.0)));
        let samples = Some(Samples::new(self.mechanism.free.len()));
        let mut output = Output { samples, until, watcher };
        let counts = self.go(tolerance, &mut output)?;
        Ok((output.samples.unwrap_or_default(), counts))
    }

    fn time(&self, tolerance: f64, times: u32, watcher: &dyn Watcher) -> Result<Times, Stop> {
        let watch = Stopwatch::start();
        for _ in 0..times {
            self.go(tolerance, &mut Output { samples: None, until: None, watcher })?;
        }
        Ok(watch.each(times))
    }
}
