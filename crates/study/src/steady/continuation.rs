//! Continuation of periodic orbits over a parameter of the scenario.
//!
//! Periodic orbits solve P(s, q) - s = 0. With the parameter q, the solutions form a branch. The branch is followed from the orbit of the
//! scenario to both ends of a range of q, also around folds and along unstable orbits. The method is pseudo-arclength continuation (Keller
//! 1977): a step along the tangent, then Newton's method for s and q together. Folds, period doublings, Neimark–Sacker bifurcations and
//! events that appear or vanish (corners of P) are located.
//!
//! Modules in reading order:
//! * `place`: a state and its image at a parameter value; `corrector`: Newton's method; `happened`: events of a period.
//! * `standing`: an orbit of the branch with its tangent; `written`: storage of an orbit in the journal; `bifurcation`: special points.
//! * `arm`: the branch in one direction; `passage`: special points between two orbits; `beyond`: continuation after a failed step.
//! * `table`: output.

mod arm;
mod beyond;
mod bifurcation;
mod corrector;
mod error;
mod happened;
mod passage;
mod place;
mod standing;
mod table;
mod written;

pub use arm::End;
pub use bifurcation::{Bifurcation, Mark};
pub use error::ContinuationError;
pub use happened::Change;
pub use standing::Point;
pub(crate) use table::definitions;
pub use table::{all_files, csv, json, write};

use super::{Options, SteadyError, moment, named};
use crate::journal::Journal;
use arm::{Arm, Walk};
use error::Trouble;
use happened::Period;
use place::Bench;
use standing::{Measure, Standing, by_value};
use stickslip_run::Job;

/// Options of a continuation.
#[derive(Clone, Copy)]
pub struct Course<'a> {
    /// Options of the search for each orbit; `periods` applies only to the search for the first orbit.
    pub steady: Options<'a>,
    /// Maximum number of points on each side of the start; default 1000.
    pub points: usize,
    /// Accuracy of special points, as a fraction of the parameter range: 1e-12 to 1e-3; default 1e-9.
    pub accuracy: f64,
    /// Receives the number of orbits in one direction of the branch.
    pub told: &'a dyn Fn(usize),
}

impl Default for Course<'_> {
    fn default() -> Self {
        Self { steady: Options::default(), points: 1_000, accuracy: 1e-9, told: &|_| () }
    }
}

/// Continuation of a scenario over a range of one parameter.
pub struct Continuation {
    /// Scenario at the start of the branch.
    pub job: Job,
    /// Key path of the parameter.
    pub path: String,
    /// SI unit of the parameter; empty for a plain number.
    pub unit: &'static str,
    /// Value of the parameter at the start of the branch, SI.
    pub present: f64,
    /// Ends of the parameter range, SI.
    pub range: [f64; 2],
    /// Journal with the steps along the branch.
    pub journal: Journal,
}

/// A branch of periodic orbits.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Points in order along the branch, starting at the end in the direction of decreasing values.
    pub points: Vec<Point>,
    /// Special points between the points of the branch, in the same order.
    pub marks: Vec<Mark>,
    /// Index of the start among the points.
    pub start: usize,
    /// Reasons why the branch ends at its first and at its last point.
    pub ends: [End; 2],
}

impl Continuation {
    /// Creates a continuation over the parameter at a key path, with a range in SI units.
    ///
    /// # Errors
    /// Fails if the path does not name a number, the range is empty, or the value of the scenario is outside the range.
    pub fn new(job: Job, path: &str, [from, to]: [f64; 2]) -> Result<Self, ContinuationError> {
        let found = job.scenario.parameter(path)?;
        let (unit, path) = (found.unit, path.to_owned());
        let rises = from.is_finite() && to.is_finite() && from < to;
        if !rises {
            return Err(ContinuationError::Range { path, from, to });
        }
        let Some(present) = found.value else { return Err(ContinuationError::Absent(path)) };
        if !(from..=to).contains(&present) {
            return Err(ContinuationError::Outside { path, present, unit, from, to });
        }
        Ok(Self { job, path, unit, present, range: [from, to], journal: Journal::default() })
    }

    /// Follows the branch to both ends of the range.
    ///
    /// # Errors
    /// Fails if the start has no periodic orbit or a family of orbits, or if the search for the first orbit is interrupted.
    pub fn follow(&self, course: &Course<'_>) -> Result<Branch, ContinuationError> {
        let options = Options { periods: u32::MAX, told: &|_| (), ..course.steady };
        let bench = Bench::new((&self.job, &self.path), self.span(), options);
        let (start, measure) = self.start(&bench, &course.steady)?;
        let arms = [-1.0, 1.0].map(|sense| {
            let mut from = start.clone();
            from.tangent *= sense;
            let walk =
                Walk::new((&bench, measure), self.range, (course.points, course.accuracy), course.told);
            walk.go(from, (&self.journal, sense))
        });
        Ok(joined(start.point, arms))
    }

    /// Returns the column name with unit: `contacts.ball.normal.force_N`.
    #[must_use]
    pub fn head(&self) -> String {
        stickslip_quantity::names::with_unit(&self.path, self.unit)
    }

    fn span(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    /// Finds the orbit of the unchanged scenario.
    fn start(
        &self,
        bench: &Bench<'_>,
        options: &Options<'_>,
    ) -> Result<(Standing, Measure), ContinuationError> {
        let (path, present, unit) = (self.path.clone(), self.present, self.unit);
        let none = |trouble: Trouble| match trouble {
            Trouble::Steady(SteadyError::Interrupted(periods)) => ContinuationError::Interrupted(periods),
            Trouble::Steady(error) => {
                ContinuationError::NoStart { path: path.clone(), present, unit, source: Box::new(error) }
            }
            other => {
                ContinuationError::NoBranch { path: path.clone(), present, unit, why: other.to_string() }
            }
        };
        let place =
            bench.variant(present).and_then(|variant| bench.found(&variant, options)).map_err(none)?;
        let still = bench.map_at(&place).and_then(|mut map| Ok(moment::twice(&mut map, &place.fixed, None)?));
        let (still, _) = still.map_err(none)?;
        if !still.is_empty() {
            let contacts = named(&self.job.model, &still);
            return Err(ContinuationError::Shakedown { path: path.clone(), present, unit, contacts });
        }
        let period = Period::of(bench, &place).map_err(none)?;
        let row = by_value(place.fixed.defect.len(), 1.0);
        let start = Standing::of(bench, place, period, (None, &row));
        let mut start = start.map_err(|trouble| match trouble {
            // The waveforms have a common period at the start value, but not at other parameter values.
            Trouble::Steady(SteadyError::Incommensurate { first, second, .. }) => {
                ContinuationError::Apart { path: path.clone(), first, second }
            }
            other => none(other),
        })?;
        // The tangent (dx/dq, 1) has been normalised with another metric, so only its direction is used.
        let measure = Measure::of(&start.tangent);
        start.tangent /= measure.length(&start.tangent);
        Ok((start, measure))
    }
}

impl Point {
    /// Returns the mean velocity, m/s: step length divided by period.
    #[must_use]
    pub fn speed(&self) -> Option<f64> {
        self.step.map(|step| step / self.period)
    }

    /// Returns the largest modulus of a Floquet multiplier; 0 without multipliers.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.multipliers.first().map_or(0.0, super::Multiplier::modulus)
    }

    /// Returns whether no disturbance grows.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|multiplier| multiplier.kind() != super::Kind::Grows)
    }
}

impl Branch {
    /// Returns whether the continuation was interrupted.
    #[must_use]
    pub fn is_cut(&self) -> bool {
        self.ends.contains(&End::Interrupted)
    }
}

/// Joins the parts of the branch in both directions at the start.
fn joined(start: Point, [mut back, mut ahead]: [Arm; 2]) -> Branch {
    // The smooth pieces of the branch are numbered along the whole branch.
    let last = back.points.last().map_or(0, |point| point.piece);
    back.points.iter_mut().for_each(|point| point.piece = last - point.piece);
    ahead.points.iter_mut().for_each(|point| point.piece += last);
    let place = back.points.len();
    back.points.reverse();
    back.marks.reverse();
    for mark in back.marks.iter_mut().filter(|mark| mark.kind == Bifurcation::Fold) {
        mark.stable.reverse();
    }
    let points =
        back.points.into_iter().chain([Point { piece: last, ..start }]).chain(ahead.points).collect();
    let marks = back.marks.into_iter().chain(ahead.marks).collect();
    Branch { points, marks, start: place, ends: [back.end, ahead.end] }
}
