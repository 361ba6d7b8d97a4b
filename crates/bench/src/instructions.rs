//! Number of instructions of a run, which does not depend on the load of the machine.
//!
//! The program starts itself under callgrind of valgrind, which counts only inside [`counted`]: no reading, model building or output.
//! Without valgrind there is no count.

use crate::floor::{Floor, Rule};
use std::env;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::str::FromStr;
use stickslip_drive::{Plan, RunError, Stepper};
use stickslip_run::Job;

/// Argument with which the program starts itself for a counted run.
pub const ARGUMENT: &str = "--counted";

/// Code whose instructions are counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Counted {
    /// Run of the event stepper at a tolerance, with a recorder that discards everything.
    Event(f64),
    /// Minimal code for a model like the benchmark drive, with 4, 10 or 16 nodes.
    Floor(u32),
}

impl FromStr for Counted {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = |_| format!("expected a tolerance or floor:NODES, got \"{text}\"");
        match text.strip_prefix("floor:") {
            Some(nodes) => nodes.parse().map(Self::Floor).map_err(|_| wrong(())),
            None => text.parse().map(Self::Event).map_err(|_| wrong(())),
        }
    }
}

impl Counted {
    fn word(self) -> String {
        match self {
            Self::Event(tolerance) => format!("{tolerance:e}"),
            Self::Floor(nodes) => format!("floor:{nodes}"),
        }
    }

    /// Returns the number of instructions, or `None` if valgrind is not installed or fails.
    pub(crate) fn instructions(self, file: &Path, set: &[(String, String)]) -> Option<u64> {
        // One processor only: with several, contacts would be computed on threads, which callgrind counts separately.
        let mut command = Command::new("taskset");
        command.args(["-c", "0", "valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]);
        command
            .arg("--toggle-collect=*stickslip_bench*instructions*counted_run*")
            .arg(env::current_exe().ok()?);
        command.args(["bench", "--quiet", ARGUMENT, &self.word()]).arg(file);
        for (path, value) in set {
            command.arg("--set").arg(format!("{path}={value}"));
        }
        let output = command.output().ok().filter(|output| output.status.success())?;
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let count = told.lines().filter_map(|line| line.split_once("Collected :")).next()?.1;
        count.trim().parse().ok().filter(|count| *count > 0)
    }
}

/// Executes the counted code once.
///
/// # Errors
/// A run that fails. A model for which there is no minimal code gives `Ok`.
pub fn counted(job: &Job, what: Counted) -> Result<(), RunError> {
    match what {
        Counted::Event(tolerance) => {
            let plan = Plan { stepper: Stepper::Event { tolerance }, every: None, ..job.scenario.plan };
            let mut state = job.start.clone();
            counted_run(&mut || stickslip_drive::run(&job.model, &plan, &mut state, &mut ()))
        }
        Counted::Floor(nodes) => {
            let Some((floor, periods)) =
                Floor::of(&job.scenario.scene, &job.model, job.scenario.plan.duration)
            else {
                return Ok(());
            };
            match nodes {
                4 => of_floor(&floor, periods, &Rule::<4>::default()),
                10 => of_floor(&floor, periods, &Rule::<10>::default()),
                _ => of_floor(&floor, periods, &Rule::<16>::default()),
            }
        }
    }
}

/// Function in which callgrind counts.
#[inline(never)]
fn counted_run(run: &mut dyn FnMut() -> Result<(), RunError>) -> Result<(), RunError> {
    run()
}

/// Runs the minimal code with a given quadrature.
fn of_floor<const N: usize>(floor: &Floor, periods: u32, rule: &Rule<N>) -> Result<(), RunError> {
    counted_run(&mut || {
        black_box(floor.place(black_box(periods), rule));
        Ok(())
    })
}
