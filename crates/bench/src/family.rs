//! Methods, each with its runs from coarse to fine.

use crate::baseline::{Outside, SpringLoop};
use crate::clock::Times;
use crate::contestant::{Contestant, Own, Stepping, with_engine};
use crate::norm::Errors;
use crate::problem::Problem;
use crate::steps;
use stickslip_drive::{Counts, Model, Stepper};

/// Springs of a row.
pub(crate) const ROWS: [usize; 3] = [64, 256, 1024];
/// Springs of the rows of the loop, whose runs are short enough for more.
pub(crate) const LOOPS: [usize; 4] = [64, 256, 1024, 4096];

/// A way to solve a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// A stepper of the program on the exact curve, or on rows of so many springs.
    Own { stepping: Stepping, springs: Option<usize> },
    /// The loop of a researcher over rows of so many springs.
    Loop { springs: usize },
    /// An outside integrator with the exact contact and events by hand.
    Outside,
}

/// A method with its runs, from coarse to fine.
pub(crate) struct Family<'p> {
    pub(crate) method: Method,
    pub(crate) contestant: Box<dyn Contestant + 'p>,
    pub(crate) runs: Vec<Run>,
}

/// A method at one tolerance or step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    /// Tolerance, or step in s.
    pub(crate) value: f64,
    /// What came of it; none of a run that was left out.
    pub(crate) result: Option<Measured>,
    /// Why there is no result.
    pub(crate) note: String,
}

/// What came of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Measured {
    pub(crate) errors: Errors,
    /// Error at the end against what is known from elsewhere.
    pub(crate) known: Option<f64>,
    pub(crate) counts: Counts,
    /// Times of one run: the shortest of all turns.
    pub(crate) cost: Times,
    /// Turns that the time was measured in, and runs in each.
    pub(crate) turns: u32,
    pub(crate) times: u32,
}

impl Method {
    /// Name of the method proper.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Own { stepping, .. } => stepping.name(),
            Self::Loop { .. } => "loop",
            Self::Outside => "ode_solvers",
        }
    }

    /// How the contact is computed.
    pub(crate) fn engine(self) -> &'static str {
        match self {
            Self::Own { springs: None, .. } | Self::Outside => "curve",
            Self::Own { springs: Some(_), .. } | Self::Loop { .. } => "springs",
        }
    }

    /// Springs of a row.
    pub(crate) fn springs(self) -> Option<usize> {
        match self {
            Self::Own { springs, .. } => springs,
            Self::Loop { springs } => Some(springs),
            Self::Outside => None,
        }
    }

    /// Whether its runs differ by their step; otherwise by their tolerance.
    pub(crate) fn is_fixed(self) -> bool {
        match self {
            Self::Own { stepping, .. } => stepping.is_fixed(),
            Self::Loop { .. } => true,
            Self::Outside => false,
        }
    }
}

impl<'p> Family<'p> {
    fn new(method: Method, contestant: Box<dyn Contestant + 'p>, values: &[f64]) -> Self {
        let run = |value: &f64| Run { value: *value, result: None, note: String::new() };
        Self { method, contestant, runs: values.iter().map(run).collect() }
    }

    /// Name and, where measured, result of each run.
    pub(crate) fn measured(&self) -> impl Iterator<Item = (&Run, &Measured)> {
        self.runs.iter().filter_map(|run| run.result.as_ref().map(|result| (run, result)))
    }
}

/// All families of a problem.
pub(crate) fn families(problem: &Problem) -> Vec<Family<'_>> {
    let longest = problem.model.longest_step(Stepper::Verlet { step: 0.0 }).unwrap_or(f64::INFINITY);
    let tolerances = steps::tolerances();
    let steps = steps::fixed(&problem.scene, problem.duration, longest);
    let mut families = Vec::new();
    for springs in [None].into_iter().chain(ROWS.map(Some)) {
        let scene = with_engine(&problem.scene, springs.map(|count| (count, problem.spans.as_slice())));
        // The exact scene was found good, and a row of springs asks for nothing but a count and a span.
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

/// What others would do, where they know the scene.
fn baselines<'p>(problem: &'p Problem, steps: &[f64], tolerances: &[f64]) -> Vec<Family<'p>> {
    let Ok(mechanism) = &problem.mechanism else { return Vec::new() };
    let mut families = Vec::new();
    for springs in LOOPS {
        let contestant = SpringLoop::new(mechanism.clone(), problem.duration, springs, &problem.spans);
        let contestant = contestant.ok().map(|c| Family::new(Method::Loop { springs }, Box::new(c), steps));
        families.extend(contestant);
    }
    let outside = Outside::new(mechanism.clone(), problem.duration, problem.scales());
    families.extend(outside.ok().map(|c| Family::new(Method::Outside, Box::new(c), tolerances)));
    families
}
