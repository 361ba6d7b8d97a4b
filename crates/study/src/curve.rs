//! The curves of a machine: what its steady motion makes of a number that is varied.
//!
//! A [`Curve`] is of a scenario and a [`Kind`]; its points are variants of it, each by what `--set` would put into it.
//! What is wrong with one of them stands in its [`Point`], and the others go on.
//!
//! In reading order: `kind`, the curves that have a name; `variation`, what they vary; `range`, where their points lie; `motion`,
//! the steady motion of a point, `waiting`, that of a run; `point`, all of them on all cores; `edge` and `peak`, how a place between them is closed in on, `ahead`, how on several cores,
//! `landmark`, which places have a name; `table`, what is told of them; [`holding`], what the drive holds at rest.

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

/// How exactly the stall is known that a range ends beyond, and how far beyond.
const ROUGHLY: f64 = 0.05;
const BEYOND: f64 = 1.1;
/// Halvings on the way to the last place of a range that makes a scenario.
const HALVINGS: u32 = 8;

/// Which way round the waveforms run, where a drive is asked for both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// As in the scenario.
    Forward,
    /// Reversed in time, so that a drive steps the other way.
    Backward,
}

/// A curve of a scenario.
pub struct Curve {
    /// What reverses the waveforms of the backward sense; points are told with it.
    reversal: Vec<(String, String)>,
    /// Which way round, where both are asked for.
    pub sense: Option<Sense>,
    /// Which one.
    pub kind: Kind,
    /// What is varied.
    pub variation: Variation,
    /// The scenario without it.
    pub job: Job,
    /// Where motions are looked up and written down.
    pub journal: Arc<Journal>,
}

/// The points of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Traced {
    /// Sense of the steps without load, 1 or -1 along x, that loads act against; 1 where there are none.
    pub direction: f64,
    /// Whether the unloaded drive, whose sense that is, could be computed: else loads act against +x.
    pub is_known: bool,
    /// In the order of the values.
    pub points: Vec<Point>,
    /// Places with a name, where they were looked for.
    pub landmarks: Vec<Landmark>,
}

impl Curve {
    /// The curve of a scenario.
    ///
    /// # Errors
    /// A scenario that has no such curve.
    pub fn new(job: Job, kind: Kind) -> Result<Self, CurveError> {
        let variation = Variation::of(&kind, &job)?;
        let journal = Arc::default();
        Ok(Self { reversal: Vec::new(), sense: None, kind, variation, job, journal })
    }

    /// The curves of a scenario in both senses: forward, as it is, and backward, the waveforms of the steps' period reversed in time.
    ///
    /// # Errors
    /// As of one; a waveform that cannot be reversed, as one that jumps.
    pub fn both(job: Job, kind: &Kind) -> Result<[Self; 2], CurveError> {
        let reversal = Variation::reversal(&job, kind)?;
        let backward = Self::new(job.with(&reversal)?, kind.clone())?;
        let forward = Self { sense: Some(Sense::Forward), ..Self::new(job, kind.clone())? };
        Ok([forward, Self { reversal, sense: Some(Sense::Backward), ..backward }])
    }

    /// A range worth looking at, SI: about what the scenario has, and of loads up to a little more than it takes to stall the
    /// drive. None where nobody knows.
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

    /// About where a drive stalls that makes a step without load.
    fn stall(&self, unloaded: &Motion, [from, to]: [f64; 2], watcher: &dyn Watcher) -> Option<Bracket> {
        let sense = unloaded.sense();
        // What is dragged away is stalled as well.
        let try_at = |load, _: f64| -> Result<Option<f64>, Infallible> {
            let motion = self.motion_at(load, sense, watcher).ok().filter(|motion| motion.steps(sense));
            Ok(motion.map(|motion| sense * motion.step))
        };
        Bracket::narrow(vec![(from, sense * unloaded.step)], to, ROUGHLY, try_at).ok().flatten()
    }

    /// A little more than what a drive holds that makes no step by itself, where it has a motion there still; nothing above `most`.
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

    /// An end of a range, or the place nearest to it that makes a scenario: a frequency may leave a waveform's rise no room, and a load
    /// a start no equilibrium. The end where there is none.
    fn allowed(&self, end: f64, direction: f64) -> f64 {
        let makes = |at: f64| self.variant(&self.overrides(at, direction)).is_ok();
        let Some(present) = self.variation.present.filter(|_| !makes(end)) else { return end };
        let nearest = (0..HALVINGS).fold([present, end], |[good, bad], _| {
            let middle = 0.5 * (good + bad);
            if makes(middle) { [middle, bad] } else { [good, middle] }
        })[0];
        if nearest == present { end } else { nearest }
    }

    /// A range whose larger end is at most where a stack's command meets the window of its driver or the nominal voltage of its data
    /// sheet; commands are straight lines over what is varied. The range itself where the smaller end lies beyond these already.
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
            // How far the command may go of how far it would.
            Some([(ceiling - most) / (higher - most), (floor - least) / (lower - least)])
        });
        let share = shares.flatten().filter(|share| *share > 0.0).fold(1.0, f64::min);
        let end = if share < 1.0 { from + share * (to - from) } else { to };
        if is_mirrored { [end, from] } else { [from, end] }
    }

    /// Why there is no range by default.
    #[must_use]
    pub fn no_range(&self) -> CurveError {
        self.variation.no_range(&self.job)
    }

    /// The points at some values, on so many cores; the same for any number. The watcher is told how many are done; where it wants
    /// an end, those not yet done are [`Motionless::NotRun`].
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

    /// The steady motion at a value; loads act against a direction.
    fn motion_at(&self, value: f64, direction: f64, watcher: &dyn Watcher) -> Result<Motion, Motionless> {
        self.motion_with(&self.overrides(value, direction), watcher)
    }

    /// What makes a point of it: its sense, and a value; loads act against a direction.
    fn overrides(&self, value: f64, direction: f64) -> Vec<(String, String)> {
        let varied = self.variation.overrides(value, direction);
        self.reversal.iter().cloned().chain(varied).collect()
    }

    fn motion_with(&self, set: &[(String, String)], watcher: &dyn Watcher) -> Result<Motion, Motionless> {
        // What is read and built before a period is computed takes its time, too.
        if !watcher.goes_on() {
            return Err(Motionless::NotRun);
        }
        let compute = || Motion::of(&self.variant(set)?, watcher);
        self.journal.found(&set, compute, Motionless::is_no_end)
    }

    /// The motion of the scenario as it stands.
    fn unloaded(&self, watcher: &dyn Watcher) -> Result<Motion, Motionless> {
        let compute = || Motion::of(&self.job, watcher);
        self.journal.found(&("unloaded", &self.reversal), compute, Motionless::is_no_end)
    }

    /// The scenario with something set, as a run would have it, without what a run would write.
    fn variant(&self, set: &[(String, String)]) -> Result<Job, ScenarioError> {
        let mut scenario = self.job.scenario.with(set)?;
        scenario.plan.every = None;
        (scenario.springs, scenario.memory, scenario.fields) = (None, None, None);
        Job::new(scenario, self.job.name.clone(), PathBuf::new())
    }
}

impl Sense {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        }
    }
}

/// What `check` warns of in a scenario with overrides; nothing of one that is refused.
fn warnings(job: &Job, set: &[(String, String)]) -> Vec<Warning> {
    job.with(set).map(|job| stickslip_run::warning::of_check(&job)).unwrap_or_default()
}
