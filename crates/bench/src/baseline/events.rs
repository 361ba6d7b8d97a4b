//! Integrator `Dopri5` of the crate ode_solvers with the exact contact law and event location, as a user of that crate would write it.
//!
//! Between events every contact follows one smooth branch. After each accepted step, the callback `solout` checks whether a contact has
//! reversed or reached the end of its piece of memory. If so, it stops the solver. The event is located on the dense output, the memories
//! are updated, and a new solver starts with the last step size. Corners of waveforms end steps exactly. Bodies move along the slide
//! under constant normal load.

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

/// Integrator `Dopri5` of ode_solvers with event location.
pub(crate) struct Outside {
    mechanism: Mechanism,
    duration: f64,
    /// Natural length, m, and velocity, m/s, of each free coordinate. Tolerances are relative to these units.
    scales: Vec<(f64, f64)>,
}

impl Outside {
    pub(crate) fn new(mechanism: Mechanism, duration: f64, scales: Vec<(f64, f64)>) -> Result<Self, String> {
        if !mechanism.has_constant_loads() {
            return Err("contacts under varying normal load".to_owned());
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

/// Output of a run, and its time limit.
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
