//! Curves of a drive: step length, velocity or power of the steady motion versus one parameter.
//!
//! A [`Curve`] belongs to a scenario and has a type ([`Kind`]). Each [`Point`] is a variant of the scenario, given by arguments of `--set`.
//! A point that cannot be computed contains the reason; the other points are still computed.
//!
//! Modules in reading order:
//! * `kind`: types of curves; `variation`: the varied parameter; `range`: the values of the points.
//! * `motion`: steady motion at a point by shooting; `waiting`: steady motion by simulation; `point`: results at a point.
//! * `edge`: bracketing of the value with zero step length; `peak`: golden section search for a maximum; `ahead`: parallel computation of
//!   both searches; `landmark`: special points.
//! * `table`: output files. [`holding`]: holding force of the drive at rest.

mod ahead;
mod edge;
mod error;
pub mod holding;
mod kind;
mod landmark;
mod motion;
mod peak;
mod point;
mod range;
mod table;
mod variation;
mod waiting;

pub use edge::Bracket;
pub use error::CurveError;
pub use kind::Kind;
pub use landmark::{Beyond, Landmark, Unfound};
pub use motion::{Course, Motion, Motionless};
pub use peak::{Peak, Seen};
pub use point::Point;
pub use range::Range;
pub(crate) use table::definitions;
pub use table::{Way, all_files, csv, json, write};
pub use variation::Variation;

use crate::each::each;
use crate::journal::Journal;
use std::convert::Infallible;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_run::{Job, Warning, Watcher};
use stickslip_scenario::ScenarioError;

/// Relative tolerance of the stall force for the default range of loads, and ratio of the end of this range to the stall force.
const ROUGHLY: f64 = 0.05;
const BEYOND: f64 = 1.1;
/// Number of bisections to find the last value of a range that gives a valid scenario.
const HALVINGS: u32 = 8;

/// Direction of the waveforms in time, for curves with both directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// Forward in time, as in the scenario.
    Forward,
    /// Reversed in time, so that the drive steps in the opposite direction.
    Backward,
}

/// A curve of a scenario.
pub struct Curve {
    /// Overrides that reverse the waveforms in time, as part of the overrides of every point.
    reversal: Vec<(String, String)>,
    /// Direction of the waveforms. `None` if only one direction is computed.
    pub sense: Option<Sense>,
    /// Type of the curve.
    pub kind: Kind,
    /// The varied parameter.
    pub variation: Variation,
    /// The scenario without the variation.
    pub job: Job,
    /// Journal that stores the motions at points.
    pub journal: Arc<Journal>,
}

/// Points of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Traced {
    /// Direction of the steps without load along x, 1 or -1; loads act in the opposite direction. 1 for curves without loads.
    pub direction: f64,
    /// False if the motion without load could not be computed; loads then act along -x.
    pub is_known: bool,
    /// Points in the order of their parameter values.
    pub points: Vec<Point>,
    /// Special points such as the stall force; empty before their computation.
    pub landmarks: Vec<Landmark>,
}

impl Curve {
    /// Creates a curve of a scenario.
    ///
    /// # Errors
    /// Fails if the scenario does not have this curve.
    pub fn new(job: Job, kind: Kind) -> Result<Self, CurveError> {
        let variation = Variation::of(&kind, &job)?;
        let journal = Arc::default();
        Ok(Self { reversal: Vec::new(), sense: None, kind, variation, job, journal })
    }

    /// Returns the curves for both directions of the waveforms: as in the scenario, and with all waveforms that have the period of the
    /// steps reversed in time.
    ///
    /// # Errors
    /// Fails as [`Self::new`] does, or if a waveform cannot be reversed, such as one with a jump.
    pub fn both(job: Job, kind: &Kind) -> Result<[Self; 2], CurveError> {
        let reversal = Variation::reversal(&job, kind)?;
        let backward = Self::new(job.with(&reversal)?, kind.clone())?;
        let forward = Self { sense: Some(Sense::Forward), ..Self::new(job, kind.clone())? };
        Ok([forward, Self { reversal, sense: Some(Sense::Backward), ..backward }])
    }

    /// Returns a default range of the parameter in SI units, around its value in the scenario. Ranges of loads end slightly above the
    /// stall force. Returns `None` if no default is known.
    #[must_use]
    pub fn range(&self, watcher: &dyn Watcher) -> Option<[f64; 2]> {
        let [from, most] = self.variation.range?;
        let unloaded = if self.kind.is_of_load() { self.unloaded(watcher).ok() } else { None };
        let Some(unloaded) = unloaded else {
            return Some(self.within_data_sheets([from, most]).map(|end| self.allowed(end, 1.0)));
        };
        let sense = unloaded.sense();
        let to = match unloaded.steps(sense) {
            true => self.stall(&unloaded, [from, most], watcher).map(|stall| BEYOND * stall.still),
            false => self.held(most, sense, watcher),
        };
        Some([from, self.allowed(to.unwrap_or(most), sense)])
    }

    /// Returns a bracket of the stall force of a drive that makes steps without load.
    fn stall(&self, unloaded: &Motion, [from, to]: [f64; 2], watcher: &dyn Watcher) -> Option<Bracket> {
        let sense = unloaded.sense();
        // A drive that is dragged away counts as stalled.
        let try_at = |load, _: f64| -> Result<Option<f64>, Infallible> {
            let motion = self.motion_at(load, sense, watcher).ok().filter(|motion| motion.steps(sense));
            Ok(motion.map(|motion| sense * motion.step))
        };
        Bracket::narrow(vec![(from, sense * unloaded.step)], to, ROUGHLY, try_at).ok().flatten()
    }

    /// Returns a load slightly above the largest load that a drive without steps of its own withstands. At the returned load, which is at
    /// most `most`, the drive still has a steady motion.
    fn held(&self, most: f64, sense: f64, watcher: &dyn Watcher) -> Option<f64> {
        let try_at = |load, _: f64| -> Result<Option<f64>, Infallible> {
            let motion = self.motion_at(load, sense, watcher).ok();
            Ok(motion.and_then(|motion| (!motion.steps(-sense)).then_some(1.0)))
        };
        if try_at(most, 0.0).ok().flatten().is_some() {
            return Some(most);
        }
        let held = Bracket::narrow(vec![(0.0, 1.0)], most, ROUGHLY, try_at).ok().flatten()?;
        let beyond = most.min(BEYOND * held.still);
        Some(if self.motion_at(beyond, sense, watcher).is_ok() { beyond } else { held.steps })
    }

    /// Returns an end of a range, or the nearest value that gives a valid scenario. Returns the end unchanged if no value is valid.
    ///
    /// Invalid values are, for example, a frequency that leaves no time for the rise of a waveform, or a load without initial equilibrium.
    fn allowed(&self, end: f64, direction: f64) -> f64 {
        let makes = |at: f64| self.variant(&self.overrides(at, direction)).is_ok();
        let Some(present) = self.variation.present.filter(|_| !makes(end)) else { return end };
        let nearest = (0..HALVINGS).fold([present, end], |[good, bad], _| {
            let middle = 0.5 * (good + bad);
            if makes(middle) { [middle, bad] } else { [good, middle] }
        })[0];
        if nearest == present { end } else { nearest }
    }

    /// Shortens a range so that the stacks' commands stay within the driver window and the nominal voltage of the data sheet. Commands are
    /// linear in the varied parameter. Returns the range unchanged if its smaller end already exceeds the window or the nominal voltage.
    fn within_data_sheets(&self, range: [f64; 2]) -> [f64; 2] {
        let is_mirrored = range[0].abs() > range[1].abs();
        let [from, to] = if is_mirrored { [range[1], range[0]] } else { range };
        let at = |value| self.variant(&self.overrides(value, 1.0)).ok();
        let Some((low, high)) = at(from).zip(at(to)) else { return range };
        let stacks = low.scenario.stacks.iter().zip(&high.scenario.stacks);
        let shares = stacks.filter_map(|(before, after)| {
            let ends = [(before, &low), (after, &high)].map(|(it, job)| it.commanded(&job.scenario.scene));
            let [[least, most], [lower, higher]] = [ends[0]?, ends[1]?];
            let [floor, ceiling] = after.allowed();
            // Allowed fraction of the change of the command.
            Some([(ceiling - most) / (higher - most), (floor - least) / (lower - least)])
        });
        let share = shares.flatten().filter(|share| *share > 0.0).fold(1.0, f64::min);
        let end = if share < 1.0 { from + share * (to - from) } else { to };
        if is_mirrored { [end, from] } else { [from, end] }
    }

    /// Returns the reason why there is no default range.
    #[must_use]
    pub fn no_range(&self) -> CurveError {
        self.variation.no_range(&self.job)
    }

    /// Computes the points at the given values on `cores` threads. The result does not depend on the number of threads.
    ///
    /// The watcher receives the number of finished points. If the watcher interrupts, the remaining points are [`Motionless::NotRun`].
    pub fn trace(&self, values: &[f64], cores: usize, watcher: &(dyn Watcher + Sync)) -> Traced {
        let unloaded = self.kind.is_of_load().then(|| self.unloaded(watcher));
        let is_known = unloaded.as_ref().is_none_or(Result::is_ok);
        let direction = unloaded.and_then(Result::ok).map_or(1.0, |motion| motion.sense());
        let done = AtomicUsize::new(0);
        let points = each(values.len(), cores, |place| {
            let value = values[place];
            let set = self.overrides(value, direction);
            let motion = self.motion_with(&set, watcher);
            let warnings = warnings(&self.job, &set);
            watcher.reached((done.fetch_add(1, Ordering::Relaxed) + 1) as f64);
            Point { value, set, warnings, motion }
        });
        Traced { direction, is_known, points, landmarks: Vec::new() }
    }

    /// Returns the steady motion at a value. Loads act against `direction`.
    fn motion_at(&self, value: f64, direction: f64, watcher: &dyn Watcher) -> Result<Motion, Motionless> {
        self.motion_with(&self.overrides(value, direction), watcher)
    }

    /// Returns the overrides of a point: reversal of the waveforms and parameter value. Loads act against `direction`.
    fn overrides(&self, value: f64, direction: f64) -> Vec<(String, String)> {
        let varied = self.variation.overrides(value, direction);
        self.reversal.iter().cloned().chain(varied).collect()
    }

    fn motion_with(&self, set: &[(String, String)], watcher: &dyn Watcher) -> Result<Motion, Motionless> {
        // Reading and building the scenario takes time before the first period is computed.
        if !watcher.goes_on() {
            return Err(Motionless::NotRun);
        }
        let compute = || Motion::of(&self.variant(set)?, watcher);
        self.journal.found(&set, compute, Motionless::is_no_end)
    }

    /// Returns the steady motion of the unchanged scenario.
    fn unloaded(&self, watcher: &dyn Watcher) -> Result<Motion, Motionless> {
        let compute = || Motion::of(&self.job, watcher);
        self.journal.found(&("unloaded", &self.reversal), compute, Motionless::is_no_end)
    }

    /// Returns the scenario with overrides applied and without output tables.
    fn variant(&self, set: &[(String, String)]) -> Result<Job, ScenarioError> {
        let mut scenario = self.job.scenario.with(set)?;
        scenario.plan.every = None;
        (scenario.springs, scenario.memory, scenario.fields) = (None, None, None);
        Job::new(scenario, self.job.name.clone(), PathBuf::new())
    }
}

impl Sense {
    /// Returns the name in output files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        }
    }
}

/// Returns the warnings of `check` for a scenario with overrides, or no warnings if the scenario is invalid.
fn warnings(job: &Job, set: &[(String, String)]) -> Vec<Warning> {
    job.with(set).map(|job| stickslip_run::warning::of_check(&job)).unwrap_or_default()
}
