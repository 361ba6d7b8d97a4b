//! Steady motion, found without waiting for it.
//!
//! A drive is steady where one period of its waveform brings it back to the same state, one step further. That state is the
//! fixed point of the map of a period, P(s) = s: a few plain periods lead near it, Newton's method on the defect P(s) - s leads
//! into it, whether or not a run would ever stay there. The eigenvalues of P's gradient, its Floquet multipliers, say how a
//! disturbance comes back after a period: it fades, grows, beats.
//!
//! In reading order: `endless`, the drive without an end to its waveforms and its period; `moment`, at which moment of the
//! period the map is taken; `tally`, what happens in it; `map`, the map and its gradient by differences; `newton`, its fixed
//! point; `multiplier`, what the gradient means; `bound`, how far the step may be off; `orbit`, the motion from the beginning of a period on, from which a run goes on; `aftermath`, what a run ends on that
//! leaves it; `report`, what is told of it; `outlook`, the same at a glance, for whoever is about to run the drive;
//! [`continuation`], steady motions one after another, as a number of the scenario changes.

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

/// How steady motion is looked for.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Local error per step, relative to natural scales, whatever the scenario's own stepper is: 1e-13 to 1e-6; default 1e-12.
    pub tolerance: f64,
    /// Plain periods before the map is looked at, at least 2; default 4.
    pub settling: u32,
    /// Most periods altogether; default 4 000.
    pub periods: u32,
    /// Most accepted and rejected steps altogether; by default as many as it takes.
    pub steps: u64,
    /// Asked before every period; `false` gives up.
    pub goes_on: &'a dyn Fn() -> bool,
    /// Told how many periods have been computed, the one that begins included.
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

/// A motion that repeats itself every period.
#[derive(Debug, Clone)]
pub struct Steady {
    /// Period, s: common to all waveforms.
    pub period: f64,
    /// Way of the figures' body along x in a period, m; none where no body is named or it is not free.
    pub step: Option<f64>,
    /// From when on everything repeats itself, s: delays are over, and waveforms that come once.
    pub begins: f64,
    /// Local error per step of the runs that it was found by.
    pub tolerance: f64,
    /// By how much the step may be off, m: an estimate of first order, doubled, that knows nothing of rounding.
    pub bound: f64,
    /// The drive, its waveforms without end.
    pub model: Model,
    /// The fixed point: a run from here repeats itself.
    pub state: State,
    /// Floquet multipliers, the largest first. Drifts have none. None are told where contacts are [`Self::holding`].
    pub multipliers: Vec<Multiplier>,
    /// Ways along which nothing changes but the place: each would have a multiplier of 1.
    pub drifts: usize,
    /// Names of the numbers that the map is of.
    pub unknowns: Vec<String>,
    /// Names of those of which it is not known what becomes of a disturbance: memories come back with other knots.
    pub untold: Vec<String>,
    /// Contacts whose memories are no numbers of the map, but are carried along: multipliers do not know of them.
    pub carried: Vec<usize>,
    /// Contacts that never slip grossly in a period: what their springs near the centre hold, they hold for ever. Of such
    /// motions there is a whole family, and this one is the one that was nearest: a shakedown.
    pub shaken_down: Vec<usize>,
    /// Whether the figures' body slips on all its contacts all through the period: it is dragged along, and makes no step.
    pub is_dragged: bool,
    /// Largest defect of every period on the way, in natural scales, and how the one before was left.
    pub defects: Vec<Defect>,
    /// Periods that were computed.
    pub work: u32,
}

impl Steady {
    /// Whether there is a step, farther than it may be off.
    #[must_use]
    pub fn steps(&self) -> bool {
        self.step.is_some_and(|step| step.abs() > self.bound)
    }

    /// Names of contacts by their places.
    #[must_use]
    pub fn named(&self, contacts: &[usize]) -> Vec<String> {
        named(&self.model, contacts)
    }

    /// Speed, m/s: step over period.
    #[must_use]
    pub fn speed(&self) -> Option<f64> {
        self.step.map(|step| step / self.period)
    }

    /// Largest magnitude of a multiplier; 0 without any, NaN where they are not known.
    #[must_use]
    pub fn radius(&self) -> f64 {
        let none = if self.lacks_multipliers() { f64::NAN } else { 0.0 };
        self.multipliers.first().map_or(none, Multiplier::modulus)
    }

    /// Whether a disturbance may do anything, for what is known: there are numbers, or memories beside them, and no multipliers.
    fn lacks_multipliers(&self) -> bool {
        self.multipliers.is_empty() && !self.unknowns.is_empty() || !self.holding().is_empty()
    }

    /// Contacts that hold all through and whose memories are no numbers of the map. A body that they hold swings about what they
    /// remember: of that swing the map knows half at most, so with any of them there are no multipliers.
    #[must_use]
    pub fn holding(&self) -> Vec<usize> {
        self.carried.iter().copied().filter(|c| self.shaken_down.contains(c)).collect()
    }

    /// Why it is not known how a disturbance fades, where that is so.
    #[must_use]
    pub fn doubt(&self) -> Option<String> {
        let holding = self.named(&self.holding());
        let led = if holding.len() == 1 { "its memory is" } else { "their memories are" };
        match holding.is_empty() {
            true if self.lacks_multipliers() => {
                Some("its multipliers are not found; by a tighter tolerance they may be".to_owned())
            }
            true => None,
            false => Some(format!("{}, and {led} led along", never_slip(&holding))),
        }
    }

    /// The numbers of which no multiplier is told, in words.
    #[must_use]
    pub fn names_untold(&self) -> Option<String> {
        let first = self.untold.first()?;
        Some(match self.untold.len() {
            1 => first.clone(),
            count => format!("{first} and {} more numbers", count - 1),
        })
    }

    /// How many periods of a waveform, s, there are in one of the motion, the common one of all waveforms.
    pub(crate) fn periods_of(&self, waveform: f64) -> f64 {
        (self.period / waveform).round().max(1.0)
    }

    /// Whether a run that is disturbed a little comes back. A multiplier of 1 of a shakedown neither fades nor grows.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|multiplier| multiplier.kind() != Kind::Grows)
    }

    /// Whether there are motions beside it that repeat themselves as well, so that its step is that of one of many: a multiplier is 1.
    #[must_use]
    pub fn is_one_of_many(&self) -> bool {
        let is_one = |multiplier: &Multiplier| {
            multiplier.kind() == Kind::Stays && multiplier.beat().is_none() && !multiplier.alternates()
        };
        self.multipliers.iter().any(is_one)
    }

    /// Whether a run that is disturbed a little comes back; none where a disturbance neither fades nor grows, or where that is not
    /// known: a shakedown is one of a family, and a run that is disturbed may end in another of it.
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

/// Finds the steady motion of a job's drive, as it would be if its waveforms never ended.
///
/// What drivers and materials remember beside their states is led along and no number of the map: the plays of a ceramic are wiped by
/// the largest stroke of a period. Of `piezo_hysteresis`, whose slider never slips grossly, there was no answer in a minute. Bound
/// [`Options::periods`] there.
///
/// # Errors
///
/// A scene without a period or without free bodies, waveforms that a caller commands or that have no common period, a run that
/// stops itself, and no fixed point within the periods allowed, with the best that was found.
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
    // Of a motion that a run leaves plain periods tell nothing.
    let fades = multipliers.iter().all(|it| matches!(it.kind(), Kind::Fades | Kind::Forgotten));
    let creeps = if carries && fades { moment::creep(&mut map, (&fixed, holding), figures)? } else { 0.0 };
    let Some(section) = map.section() else { return Err(SteadyError::NoPeriod) };
    // Where nothing slips grossly a contact that is pressed evenly goes nowhere in the long run: what it has gone is what its memory, that was led
    // along, has still to come.
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

/// That contacts never slip grossly, in words.
fn never_slip(names: &[String]) -> String {
    let verb = if names.len() == 1 { "slips" } else { "slip" };
    format!("{} never {verb} grossly", names.join(", "))
}

/// Names of contacts by their places.
fn named(model: &Model, contacts: &[usize]) -> Vec<String> {
    let names: Vec<&str> = model.contacts().map(|(name, _)| name).collect();
    contacts.iter().filter_map(|c| names.get(*c)).map(|name| (*name).to_owned()).collect()
}

/// The fixed point that the start of a drive leads to.
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
