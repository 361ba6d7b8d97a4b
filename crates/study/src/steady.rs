//! Periodic orbits of a drive, found by shooting, and their stability.
//!
//! On a periodic orbit, one period of the waveforms returns the drive to the same state, displaced by one step length. A state s of the
//! orbit is a fixed point of the Poincaré map P, P(s) = s. A few simulated periods give a start value; Newton's method then solves P(s) - s
//! = 0, also for unstable orbits. The eigenvalues of the Jacobian of P are the Floquet multipliers, which give the growth or decay of a
//! disturbance per period.
//!
//! Modules in reading order:
//! * `endless`: continuation of waveforms without end, and their common period; `moment`: instant of the Poincaré section; `tally`: event
//!   counts of a period.
//! * `map`: Poincaré map and its Jacobian; `newton`: fixed point; `multiplier`: Floquet multipliers; `bound`: error of the step length.
//! * `orbit`: time histories over one period; `aftermath`: motion after leaving an unstable orbit.
//! * `report`: output; `outlook`: search at limited cost, for the summary of a run.
//! * [`continuation`]: branches of periodic orbits over a parameter.

mod aftermath;
mod bound;
pub mod continuation;
mod endless;
mod error;
mod map;
mod moment;
mod multiplier;
mod newton;
mod orbit;
mod outlook;
mod report;
mod tally;

pub use aftermath::{Aftermath, Ending};
pub use error::SteadyError;
pub use multiplier::{Kind, Multiplier};
pub use newton::{Defect, Way};
pub use orbit::Orbit;
pub use outlook::outlook;
pub use report::Report;

use crate::grip::{Grip, Loose};
use endless::Endless;
use map::Map;
use newton::Fixed;
use stickslip_drive::scene::Axis;
use stickslip_drive::section::Section;
use stickslip_drive::{Model, State};
use stickslip_run::Job;

/// Options of the search for a periodic orbit.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Tolerance of the local error per time step, relative to natural scales: 1e-13 to 1e-6, default 1e-12. This tolerance replaces that
    /// of the scenario's integrator.
    pub tolerance: f64,
    /// Number of simulated periods before Newton's method starts, at least 2; default 4.
    pub settling: u32,
    /// Maximum number of periods in total; default 4000.
    pub periods: u32,
    /// Maximum number of accepted and rejected time steps in total; default unlimited.
    pub steps: u64,
    /// Called before every period; `false` interrupts the search.
    pub goes_on: &'a dyn Fn() -> bool,
    /// Receives the number of simulated periods, including the period that begins.
    pub told: &'a dyn Fn(u32),
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            tolerance: 1e-12,
            settling: 4,
            periods: 4_000,
            steps: u64::MAX,
            goes_on: &|| true,
            told: &|_| (),
        }
    }
}

/// A periodic orbit.
#[derive(Debug, Clone)]
pub struct Steady {
    /// Period, s: common period of all waveforms.
    pub period: f64,
    /// Displacement of the body named in `figures` along x per period, m. `None` if no body is named or the body is not free.
    pub step: Option<f64>,
    /// Time after which all waveforms are periodic, s: after all delays and after the end of waveforms that run once.
    pub begins: f64,
    /// Tolerance of the local error per time step.
    pub tolerance: f64,
    /// Error estimate of the step length, m: first order, doubled, without the rounding error of a long run.
    pub bound: f64,
    /// Model of the drive with endless waveforms.
    pub model: Model,
    /// State at the fixed point; a run that starts in this state is periodic.
    pub state: State,
    /// Floquet multipliers in descending order of modulus, without the multipliers of drifts. Empty if [`Self::holding`] returns contacts.
    pub multipliers: Vec<Multiplier>,
    /// Number of drifts: directions along which only positions change. Each drift would have a multiplier of 1.
    pub drifts: usize,
    /// Names of the unknowns of the Poincaré map.
    pub unknowns: Vec<String>,
    /// Names of the unknowns without a multiplier, because a disturbance of them changes the number of breakpoints of a slip memory.
    pub untold: Vec<String>,
    /// Indices of contacts whose slip memory is simulated but is not an unknown of the map. The multipliers do not include this memory.
    pub carried: Vec<usize>,
    /// Indices of contacts that never slip grossly in a period and keep the central part of their slip memory for ever. Such orbits form a
    /// family (shakedown); the search returns the nearest member.
    pub shaken_down: Vec<usize>,
    /// True if the body named in `figures` slips on all its contacts during the whole period, so that it is dragged along without steps.
    pub is_dragged: bool,
    /// Largest defect P(s) - s in each period of the search, in natural scales, with the method that led to this period.
    pub defects: Vec<Defect>,
    /// Number of simulated periods.
    pub work: u32,
}

impl Steady {
    /// Returns whether the step length exceeds its error.
    #[must_use]
    pub fn steps(&self) -> bool {
        self.step.is_some_and(|step| step.abs() > self.bound)
    }

    /// Returns the names of contacts with the given indices.
    #[must_use]
    pub fn named(&self, contacts: &[usize]) -> Vec<String> {
        named(&self.model, contacts)
    }

    /// Returns the mean velocity, m/s: step length divided by period.
    #[must_use]
    pub fn speed(&self) -> Option<f64> {
        self.step.map(|step| step / self.period)
    }

    /// Returns the largest modulus of a Floquet multiplier. Returns 0 without multipliers, NaN if the multipliers are unknown.
    #[must_use]
    pub fn radius(&self) -> f64 {
        let none = if self.lacks_multipliers() { f64::NAN } else { 0.0 };
        self.multipliers.first().map_or(none, Multiplier::modulus)
    }

    /// Returns whether multipliers are missing: the map has unknowns, or the state includes memories outside of the map, but there are no
    /// multipliers.
    fn lacks_multipliers(&self) -> bool {
        self.multipliers.is_empty() && !self.unknowns.is_empty() || !self.holding().is_empty()
    }

    /// Returns the contacts that never slip grossly and whose slip memory is not an unknown of the map.
    ///
    /// A body on such contacts oscillates about a position that depends on the slip memory. The map represents only a part of this
    /// oscillation, so no multipliers are given.
    #[must_use]
    pub fn holding(&self) -> Vec<usize> {
        self.carried.iter().copied().filter(|c| self.shaken_down.contains(c)).collect()
    }

    /// Returns the reason why stability is unknown, or `None` if stability is known.
    #[must_use]
    pub fn doubt(&self) -> Option<String> {
        let holding = self.named(&self.holding());
        let led = if holding.len() == 1 { "its memory is" } else { "their memories are" };
        match holding.is_empty() {
            true if self.lacks_multipliers() => {
                Some("the multipliers were not found; a smaller tolerance may find them".to_owned())
            }
            true => None,
            false => Some(format!("{}, and {led} not in the map", never_slip(&holding))),
        }
    }

    /// Returns a phrase with the names of the unknowns without a multiplier.
    #[must_use]
    pub fn names_untold(&self) -> Option<String> {
        let first = self.untold.first()?;
        Some(match self.untold.len() {
            1 => first.clone(),
            count => format!("{first} and {} more unknowns", count - 1),
        })
    }

    /// Returns the common period of all waveforms divided by the period of one waveform, s.
    pub(crate) fn periods_of(&self, waveform: f64) -> f64 {
        (self.period / waveform).round().max(1.0)
    }

    /// Returns whether no disturbance grows. A multiplier of 1 due to shakedown counts as stable.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|multiplier| multiplier.kind() != Kind::Grows)
    }

    /// Returns whether a multiplier is 1. The orbit then belongs to a family of periodic orbits with different step lengths.
    #[must_use]
    pub fn is_one_of_many(&self) -> bool {
        let is_one = |multiplier: &Multiplier| {
            multiplier.kind() == Kind::Stays && multiplier.beat().is_none() && !multiplier.alternates()
        };
        self.multipliers.iter().any(is_one)
    }

    /// Returns whether the orbit is stable. Returns `None` if a disturbance neither grows nor decays or its effect is unknown. In a
    /// shakedown, for example, a disturbed run may end in another orbit of the family.
    #[must_use]
    pub fn comes_back(&self) -> Option<bool> {
        let stays = self.multipliers.iter().any(|multiplier| multiplier.kind() == Kind::Stays);
        let may_stay = stays || !self.shaken_down.is_empty();
        if self.is_stable() && (may_stay || !self.untold.is_empty()) || self.lacks_multipliers() {
            None
        } else {
            Some(self.is_stable())
        }
    }
}

/// Finds the periodic orbit of a drive, with waveforms continued without end.
///
/// Memory of drivers and materials outside of the state vector is simulated and is not an unknown of the map. The largest stroke of a
/// period resets the play operators of a ceramic. The search may take long if a drive with hysteresis never slips grossly; in this case
/// [`Options::periods`] should be limited.
///
/// # Errors
///
/// Fails if no waveform is periodic, no body is free, a calling program commands a waveform, or waveforms have no common period. Fails if
/// a run stops with an error. Fails if there is no fixed point within the allowed periods; the error gives the smallest defect.
pub fn find(job: &Job, options: &Options<'_>) -> Result<Steady, SteadyError> {
    let endless = Endless::of(job)?;
    let model = &endless.model;
    let figures = job.scenario.figures.body;
    let mut map = Map::new(model, endless.period, job, options);
    let fixed = fixed_point(&mut map, &endless)?;
    let bound = bound::bound(&mut map, &fixed, figures)?;
    let grip = figures.map(|body| Grip::new(job, body));
    let (never_gave_way, loose) = moment::twice(&mut map, &fixed, grip)?;
    let body = figures.and_then(|body| job.scenario.scene.bodies.get(body));
    if let (Some(Loose::Flies), Some(body)) = (loose, body) {
        return Err(SteadyError::Flies { body: body.name.clone(), periods: map.work() });
    }
    let holds = |section: &Section<'_>| section.carried().iter().any(|c| never_gave_way.contains(c));
    let (holding, carries) =
        map.section().map_or((false, false), |section| (holds(section), !section.carried().is_empty()));
    let multipliers = match holding {
        true => Vec::new(),
        false => multiplier::of(&bound.gradient, (options.tolerance, fixed.defect.amax())),
    };
    // Additional simulated periods are useless near an unstable orbit, because they leave it.
    let fades = multipliers.iter().all(|it| matches!(it.kind(), Kind::Fades | Kind::Forgotten));
    let creeps = if carries && fades { moment::creep(&mut map, (&fixed, holding), figures)? } else { 0.0 };
    let Some(section) = map.section() else { return Err(SteadyError::NoPeriod) };
    // A contact without gross slip under constant normal force has no mean displacement per period. A remaining displacement shows a change
    // of a slip memory outside of the map.
    let slides = |c: usize| section.slides(&fixed.image.way, c).abs();
    let slid = never_gave_way.iter().map(|c| slides(*c)).fold(0.0, f64::max);
    let names: Vec<String> = section.unknowns().iter().map(|unknown| section.name(*unknown)).collect();
    let found = Steady {
        period: endless.period,
        begins: endless.begins,
        tolerance: options.tolerance,
        step: figures.and_then(|body| section.of_body(&fixed.image.way, body, Axis::X)),
        bound: bound.step + slid.max(creeps),
        multipliers,
        drifts: section.drifts(),
        unknowns: names.clone(),
        untold: bound.gradient.unknown.iter().filter_map(|j| names.get(*j).cloned()).collect(),
        carried: section.carried().to_vec(),
        shaken_down: never_gave_way,
        is_dragged: loose == Some(Loose::Slides),
        defects: fixed.defects,
        work: map.work(),
        model: model.clone(),
        state: fixed.state,
    };
    Ok(found)
}

/// Returns a phrase which states that contacts never slip grossly.
fn never_slip(names: &[String]) -> String {
    let verb = if names.len() == 1 { "is" } else { "are" };
    format!("{} {verb} never in gross slip", names.join(", "))
}

/// Returns the names of contacts with the given indices.
fn named(model: &Model, contacts: &[usize]) -> Vec<String> {
    let names: Vec<&str> = model.contacts().map(|(name, _)| name).collect();
    contacts.iter().filter_map(|c| names.get(*c)).map(|name| (*name).to_owned()).collect()
}

/// Finds the fixed point, starting from the initial state of the drive.
fn fixed_point<'m>(map: &mut Map<'m>, endless: &'m Endless) -> Result<Fixed, SteadyError> {
    let model = &endless.model;
    let settled = moment::settle(map, endless.begins, endless.start.clone(), map.settling())?;
    let section = Section::new(model, settled.state);
    if let Some((body, axis)) = section.drifts_away() {
        return Err(SteadyError::Drifts { body, axis });
    }
    let from = section.base().clone();
    map.set(section);
    newton::fixed_point(map, &from).map_err(|error| match error {
        SteadyError::NoConvergence { best, periods } if !settled.never_gave_way.is_empty() => {
            SteadyError::Shakedown { contacts: named(model, &settled.never_gave_way), best, periods }
        }
        error => error,
    })
}
