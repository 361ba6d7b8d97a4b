//! Cost of the event stepper at common tolerances, in time and instructions.

use crate::contestant::Stepping;
use crate::family::{Family, Measured, Method};
use crate::instructions::Counted;
use crate::problem::Problem;
use crate::request::Request;
use std::fmt::Write;
use std::path::Path;

/// Tolerances: coarse, default and fine.
pub(crate) const TOLERANCES: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Cost of the event stepper with exact contacts, and of the minimal code if it applies.
pub(crate) struct Work {
    /// Simulated time, s.
    pub(crate) duration: f64,
    pub(crate) runs: Vec<Effort>,
    /// Cost of the minimal code with 4, 10 and 16 nodes.
    floor: Vec<Effort>,
}

/// Cost of a run at a tolerance; for the minimal code the tolerance is the number of nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) tolerance: f64,
    pub(crate) measured: Measured,
    pub(crate) instructions: Option<u64>,
}

impl Work {
    pub(crate) fn of(problem: &Problem, families: &[Family<'_>], file: &Path, request: &Request) -> Self {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        let (mut runs, mut floor) = (Vec::new(), Vec::new());
        for (family, (run, measured)) in
            families.iter().flat_map(|family| family.measured().map(move |run| (family, run)))
        {
            let tolerance = TOLERANCES.into_iter().find(|tolerance| near(*tolerance, run.value));
            let (all, what) = match (family.method, tolerance) {
                (Method::Own { stepping: Stepping::Event, springs: None }, Some(tolerance)) => {
                    (&mut runs, Counted::Event(tolerance))
                }
                (Method::Floor { nodes }, _) => (&mut floor, Counted::Floor(nodes)),
                _ => continue,
            };
            let count = || what.instructions(file, &request.set);
            let instructions = request.instructions.then(count).flatten();
            all.push(Effort { tolerance: run.value, measured: *measured, instructions });
        }
        Self { duration: problem.duration, runs, floor }
    }

    /// Returns the number of instructions per simulated second at a tolerance, if they were counted.
    pub(crate) fn pace(&self, tolerance: f64) -> Option<f64> {
        let run = self.runs.iter().find(|run| run.tolerance == tolerance)?;
        run.instructions.map(|count| count as f64 / self.duration)
    }

    /// Returns the lines of the table of all scenarios. `first` is the scenario to which the others are relative.
    pub(crate) fn lines(&self, name: &str, first: Option<&Self>, digits: impl Fn(f64) -> String) -> String {
        let mut lines = String::new();
        for Effort { tolerance, measured, instructions } in &self.runs {
            let millions = instructions.map_or("–".to_owned(), |count| digits(1e-6 * count as f64));
            let times = self.pace(*tolerance).zip(first.and_then(|first| first.pace(*tolerance)));
            let ratio = times.map_or("–".to_owned(), |(own, first)| digits(own / first));
            // Writing to a string cannot fail.
            let _ = writeln!(
                lines,
                "| `{name}` | {tolerance:e} | {:.1e} | {:.1e} | {millions} | {ratio} | {} | {} | {} |",
                measured.errors.end,
                measured.errors.trajectory,
                digits(1e3 * measured.cost.processor / self.duration),
                measured.counts.steps,
                measured.counts.events,
            );
        }
        lines
    }

    /// Returns the table that compares the minimal code with the event stepper.
    pub(crate) fn against_floor(&self, digits: impl Fn(f64) -> String) -> String {
        if self.floor.is_empty() {
            return String::new();
        }
        let mut text = FLOOR.to_owned();
        for (Effort { tolerance: nodes, measured, instructions }, run) in self.floor.iter().zip(&self.runs) {
            let (error, time) = (measured.errors.end, measured.cost.processor);
            let counts = instructions.zip(run.instructions);
            let by_count = counts.map_or("–".to_owned(), |(floor, own)| digits(own as f64 / floor as f64));
            let millions = instructions.map_or("–".to_owned(), |count| digits(1e-6 * count as f64));
            let _ = writeln!(
                text,
                "| {nodes} | {error:.1e} | {millions} | {} | {:e} | {:.1e} | {by_count} | {} |",
                digits(1e3 * time / self.duration),
                run.tolerance,
                run.measured.errors.end,
                digits(run.measured.cost.processor / time),
            );
        }
        text
    }
}

const FLOOR: &str = "
The minimal code simulates this drive only. It moves from event to event by the energy integral and computes the time by Gauss–Legendre
quadrature with the given number of nodes. It has no error estimate, friction work or rows. The columns from `tolerance` on
show the event stepper; the last two are relative to the minimal code.

| nodes | end error | million instructions | ms per simulated second | tolerance | end error | × instructions | × time |
| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
";
