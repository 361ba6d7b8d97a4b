//! Methods of a benchmark, each with runs from coarse to fine.

use crate::baseline::{Fixed, Mechanism, Outside};
use crate::clock::Times;
use crate::contestant::{Contestant, Own, Stepping, with_engine};
use crate::floor::{Floor, Ground, Rule};
use crate::norm::Errors;
use crate::problem::Problem;
use crate::steps;
use stickslip_drive::{Counts, Model, Stepper};

/// Numbers of springs of a row.
pub(crate) const ROWS: [usize; 3] = [64, 256, 1024];
/// Numbers of springs of a row in the fixed-step loops, which are fast enough for longer rows.
pub(crate) const LOOPS: [usize; 4] = [64, 256, 1024, 4096];

/// Method of solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// Time integrator of the program with the exact memory curve, or with rows of `springs` springs.
    Own { stepping: Stepping, springs: Option<usize> },
    /// Fixed-step loop over rows of `springs` springs, or with the exact contact law. `staged`: Runge–Kutta of order 4, otherwise
    /// velocity Verlet.
    Loop { springs: Option<usize>, staged: bool },
    /// Minimal code for the benchmark drive, with this number of quadrature nodes.
    Floor { nodes: u32 },
    /// External integrator with the exact contact law and event location.
    Outside,
}

/// Parameter that is varied between the runs of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Setting {
    /// Tolerance.
    Tolerance,
    /// Step, s.
    Step,
    /// No parameter, because there is a single run.
    Nothing,
}

/// Method with its runs, from coarse to fine.
pub(crate) struct Family<'p> {
    pub(crate) method: Method,
    pub(crate) contestant: Box<dyn Contestant + 'p>,
    pub(crate) runs: Vec<Run>,
}

/// Run of a method at one tolerance or step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    /// Tolerance, or step in s; without meaning for a method with a single run.
    pub(crate) value: f64,
    /// Result; `None` if the run was omitted or failed.
    pub(crate) result: Option<Measured>,
    /// Reason why there is no result.
    pub(crate) note: String,
}

/// Result of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Measured {
    pub(crate) errors: Errors,
    /// Error at the end relative to a known value.
    pub(crate) known: Option<f64>,
    pub(crate) counts: Counts,
    /// Times of one run: the minimum of all rounds.
    pub(crate) cost: Times,
    /// Number of rounds of the time measurement, and of runs in each round.
    pub(crate) turns: u32,
    pub(crate) times: u32,
}

impl Method {
    /// Returns the name of the method.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Own { stepping, .. } => stepping.name(),
            Self::Loop { springs: Some(_), staged: false } => "loop",
            Self::Loop { springs: Some(_), staged: true } => "loop-rk4",
            Self::Loop { springs: None, staged: false } => "exact-verlet",
            Self::Loop { springs: None, staged: true } => "exact-rk4",
            Self::Floor { nodes: 4 } => "floor-4",
            Self::Floor { nodes: 10 } => "floor-10",
            Self::Floor { .. } => "floor-16",
            Self::Outside => "ode_solvers",
        }
    }

    /// Returns the name of the contact engine.
    pub(crate) fn engine(self) -> &'static str {
        if self.springs().is_some() { "springs" } else { "curve" }
    }

    /// Returns the number of springs of a row.
    pub(crate) fn springs(self) -> Option<usize> {
        match self {
            Self::Own { springs, .. } | Self::Loop { springs, .. } => springs,
            Self::Floor { .. } | Self::Outside => None,
        }
    }

    /// Returns the parameter that is varied between runs.
    pub(crate) fn setting(self) -> Setting {
        match self {
            Self::Own { stepping, .. } if stepping.is_fixed() => Setting::Step,
            Self::Own { .. } | Self::Outside => Setting::Tolerance,
            Self::Loop { .. } => Setting::Step,
            Self::Floor { .. } => Setting::Nothing,
        }
    }
}

impl<'p> Family<'p> {
    fn new(method: Method, contestant: Box<dyn Contestant + 'p>, values: &[f64]) -> Self {
        let run = |value: &f64| Run { value: *value, result: None, note: String::new() };
        Self { method, contestant, runs: values.iter().map(run).collect() }
    }

    /// Returns the runs that have a result.
    pub(crate) fn measured(&self) -> impl Iterator<Item = (&Run, &Measured)> {
        self.runs.iter().filter_map(|run| run.result.as_ref().map(|result| (run, result)))
    }
}

/// Returns all methods for a problem.
pub(crate) fn families(problem: &Problem) -> Vec<Family<'_>> {
    let longest = problem.model.longest_step(Stepper::Verlet { step: 0.0 }).unwrap_or(f64::INFINITY);
    let tolerances = steps::tolerances();
    let steps = steps::fixed(&problem.scene, problem.duration, longest);
    let mut families = Vec::new();
    for springs in [None].into_iter().chain(ROWS.map(Some)) {
        let scene = with_engine(&problem.scene, springs.map(|count| (count, problem.spans.as_slice())));
        // The exact model is valid, and a row of springs needs only a count and a length.
        let Ok(model) = Model::new(&scene) else { continue };
        for stepping in Stepping::ALL {
            let contestant = Box::new(Own::new(problem, model.clone(), stepping));
            let values = if stepping.is_fixed() { &steps } else { &tolerances };
            families.push(Family::new(Method::Own { stepping, springs }, contestant, values));
        }
    }
    families.extend(baselines(problem, &steps, &tolerances));
    families
}

/// Returns the reference implementations that support the model.
fn baselines<'p>(problem: &'p Problem, steps: &[f64], tolerances: &[f64]) -> Vec<Family<'p>> {
    let Ok(mechanism) = &problem.mechanism else { return Vec::new() };
    let mut families = Vec::new();
    for staged in [false, true] {
        let rows = LOOPS.into_iter().map(|springs| (Some(springs), mechanism.rows(springs, &problem.spans)));
        families.extend(rows.filter_map(|(springs, rows)| {
            let contestant = Fixed::new(mechanism.clone(), rows, (problem.duration, staged)).ok()?;
            Some(Family::new(Method::Loop { springs, staged }, Box::new(contestant), steps))
        }));
        families.extend(exact(mechanism, (problem.duration, staged), steps));
    }
    let outside = Outside::new(mechanism.clone(), problem.duration, problem.scales());
    families.extend(outside.ok().map(|c| Family::new(Method::Outside, Box::new(c), tolerances)));
    if let Some(floor) = Floor::of(&problem.scene, &problem.model, problem.duration) {
        families.extend([ground::<4>(floor), ground::<10>(floor), ground::<16>(floor)]);
    }
    families
}

/// Returns the fixed-step loop with the exact contact law.
fn exact<'p>(mechanism: &Mechanism, (duration, staged): (f64, bool), steps: &[f64]) -> Option<Family<'p>> {
    let contacts = mechanism.exact().ok()?;
    let contestant = Fixed::new(mechanism.clone(), contacts, (duration, staged)).ok()?;
    Some(Family::new(Method::Loop { springs: None, staged }, Box::new(contestant), steps))
}

/// Returns the minimal code with N quadrature nodes.
fn ground<'p, const N: usize>((floor, periods): (Floor, u32)) -> Family<'p> {
    let contestant = Ground { floor, periods, rule: Rule::<N>::default() };
    Family::new(Method::Floor { nodes: N as u32 }, Box::new(contestant), &[N as f64])
}
