//! Steady motions one after another, as a number of the scenario changes.
//!
//! A steady motion is a solution of P(s, q) - s = 0, and with q it traces a curve, its branch. It is followed from the motion of the
//! scenario as it stands to both ends of a range of q, also where it turns back, whether or not a run would stay there: a step along
//! the tangent, then Newton's method on s and q together (pseudo-arclength continuation; Keller 1977). What happens on the way is told at its
//! place: folds, period doublings, Neimark–Sacker bifurcations, and events of a period that appear or vanish, where P has a corner.
//!
//! In reading order: `place`, a state at a value and where a period leads it; `corrector`, Newton's method; `happened`, what happens in a
//! period; `standing`, a motion of the branch with its tangent, `written`, as it stands in the journal; `bifurcation`, what may lie between two of them; `arm`, the way in one
//! sense; `passage`, what lies between two of its motions; `beyond`, what lies beyond its end; `table`, what is told of it all.

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

/// How a branch is followed.
#[derive(Clone, Copy)]
pub struct Course<'a> {
    /// How each of its motions is looked for; `periods` is the most for the first one.
    pub steady: Options<'a>,
    /// Most points on either side of the start; default 1 000.
    pub points: usize,
    /// How exactly places are told, as a share of the range: 1e-12 to 1e-3; default 1e-9.
    pub accuracy: f64,
    /// Told how many motions there are on a side.
    pub told: &'a dyn Fn(usize),
}

impl Default for Course<'_> {
    fn default() -> Self {
        Self { steady: Options::default(), points: 1_000, accuracy: 1e-9, told: &|_| () }
    }
}

/// A number of a scenario and the range in which the steady motion is to be followed.
pub struct Continuation {
    /// The scenario, where the branch starts.
    pub job: Job,
    /// Key path of what is varied.
    pub path: String,
    /// Its SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Where the branch starts, SI.
    pub present: f64,
    /// Ends of the range, SI.
    pub range: [f64; 2],
    /// Where steps along the branch are looked up and written down.
    pub journal: Journal,
}

/// A branch of steady motions.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Along it, from the end that was come to against the sense of growing values.
    pub points: Vec<Point>,
    /// What lies between them, likewise.
    pub marks: Vec<Mark>,
    /// Place of the start among the points.
    pub start: usize,
    /// Why it ends, at its first point and its last.
    pub ends: [End; 2],
}

impl Continuation {
    /// A number of a job, by its key path, and its range, SI.
    ///
    /// # Errors
    /// A path to nothing that can be varied, a range that is none or does not contain the start.
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
    /// No steady motion to start with, or a whole family of them.
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

    /// Name of what heads its column, with the unit as in other tables: `contacts.ball.normal.force_N`.
    #[must_use]
    pub fn head(&self) -> String {
        stickslip_quantity::names::with_unit(&self.path, self.unit)
    }

    fn span(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    /// The motion of the scenario as it stands.
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
            // Here they have one.
            Trouble::Steady(SteadyError::Incommensurate { first, second, .. }) => {
                ContinuationError::Apart { path: path.clone(), first, second }
            }
            other => none(other),
        })?;
        // Of (dx/dq, 1) only the direction has been kept.
        let measure = Measure::of(&start.tangent);
        start.tangent /= measure.length(&start.tangent);
        Ok((start, measure))
    }
}

impl Point {
    /// Speed, m/s: step over period.
    #[must_use]
    pub fn speed(&self) -> Option<f64> {
        self.step.map(|step| step / self.period)
    }

    /// Largest magnitude of a multiplier; 0 without any.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.multipliers.first().map_or(0.0, super::Multiplier::modulus)
    }

    /// Whether a run that is disturbed a little comes back.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|multiplier| multiplier.kind() != super::Kind::Grows)
    }
}

impl Branch {
    /// Whether it was interrupted.
    #[must_use]
    pub fn is_cut(&self) -> bool {
        self.ends.contains(&End::Interrupted)
    }
}

/// Two arms about a start.
fn joined(start: Point, [mut back, mut ahead]: [Arm; 2]) -> Branch {
    // Pieces are counted along the branch.
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
