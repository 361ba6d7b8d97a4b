//! The regime of a contact in one case: from the waveforms that prescribe its motion, or from a run.

use super::{Axis, Map};
use crate::journal::Journal;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_drive::facts::{Prescribed, common_period};
use stickslip_drive::{Event, EventKind, Limits, Plan, Record, RunError, Source};
use stickslip_run::{Job, Watcher};

/// Moments of the last period of a run at which a contact is looked at, besides all events.
const MOMENTS: usize = 64;
/// What stands for a margin that is not known but for its sign.
const LITTLE: f64 = 1e-3;
/// Times within this share of the run's of each other are one.
const SAME: f64 = 1e-9;

/// How a contact slips over a period; each has more of it than the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Regime {
    /// Never in contact.
    Open,
    /// No spring slips.
    Stick,
    /// Some springs slip, at no time all of them.
    Partial,
    /// All springs slip at some time.
    Gross,
}

impl Regime {
    /// All of them, by their codes.
    pub const ALL: [Self; 4] = [Self::Open, Self::Stick, Self::Partial, Self::Gross];

    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Partial => "partial",
            Self::Gross => "gross",
        }
    }
}

/// A regime, and by how much each of those from stick on is reached: above 0 where it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Seen {
    pub(super) regime: Regime,
    pub(super) margins: [f64; 3],
}

/// Why a case has no regime.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Unseen {
    /// Somebody interrupted it.
    Interrupted,
    /// Its numbers make no scenario, or its run stopped.
    Failed(String),
}

/// Looks at the regime of a contact, case by case.
pub(super) struct Looks<'m> {
    job: &'m Job,
    axes: &'m [Axis; 2],
    /// The contact's place.
    contact: usize,
    by_runs: bool,
    /// Where runs are looked up and written down.
    journal: &'m Journal,
    watcher: &'m (dyn Watcher + Sync),
    /// Looks and runs so far.
    looks: AtomicUsize,
    runs: AtomicUsize,
}

impl<'m> Looks<'m> {
    pub(super) fn new(
        map: &'m Map,
        contact: usize,
        by_runs: bool,
        watcher: &'m (dyn Watcher + Sync),
    ) -> Self {
        let (looks, runs) = (AtomicUsize::new(0), AtomicUsize::new(0));
        Self { job: &map.job, axes: &map.axes, contact, by_runs, journal: &map.journal, watcher, looks, runs }
    }

    /// Runs so far.
    pub(super) fn runs(&self) -> usize {
        self.runs.load(Ordering::Relaxed)
    }

    /// The scenario at a place, in shares of the axes.
    fn case(&self, place: [f64; 2]) -> Result<Job, Unseen> {
        let set = [0, 1].map(|axis| self.axes[axis].set(self.axes[axis].at(place[axis])));
        self.job.with(&set).map_err(|error| {
            let message = error.message.lines().next().unwrap_or_default().to_owned();
            Unseen::Failed(if error.path.is_empty() { message } else { format!("{}: {message}", error.path) })
        })
    }

    /// Whether waveforms alone tell the regime at a place.
    pub(super) fn is_prescribed(&self, place: [f64; 2]) -> bool {
        self.case(place).is_ok_and(|job| Prescribed::of(&job.model, self.contact).is_some())
    }

    /// The regime at a place, in shares of the axes.
    pub(super) fn look(&self, place: [f64; 2]) -> Result<Seen, Unseen> {
        if !self.watcher.goes_on() {
            return Err(Unseen::Interrupted);
        }
        let job = self.case(place)?;
        let seen = match Prescribed::of(&job.model, self.contact).filter(|_| !self.by_runs) {
            Some(path) => Ok(prescribed(&path)),
            None => {
                self.runs.fetch_add(1, Ordering::Relaxed);
                let compute = || run(&job, self.contact, self.watcher);
                self.journal.found(&place, compute, |seen| !matches!(seen, Err(Unseen::Interrupted)))
            }
        };
        self.watcher.reached((self.looks.fetch_add(1, Ordering::Relaxed) + 1) as f64);
        seen
    }
}

impl Seen {
    /// Without more than whether a regime is reached.
    fn of(regime: Regime) -> Self {
        let reached = |least: Regime| if regime >= least { 1.0 } else { -1.0 };
        Self { regime, margins: [Regime::Stick, Regime::Partial, Regime::Gross].map(reached) }
    }
}

/// The regime of a path that waveforms prescribe.
fn prescribed(path: &Prescribed<'_>) -> Seen {
    if path.deepest() <= 0.0 {
        return Seen::of(Regime::Open);
    }
    let gross = path.gross_margin();
    let slip = path.slip_margin().max(gross);
    let regime = match () {
        () if gross > 0.0 => Regime::Gross,
        () if slip > 0.0 => Regime::Partial,
        () => Regime::Stick,
    };
    Seen { regime, margins: [1.0, slip, gross] }
}

/// The regime over the last period of a run: that of the contact's states. How far gross slip is reached is told by its path at the same
/// moments, which may miss the extremes by little; a search for a border takes that for a guess, and the states for the truth.
fn run(job: &Job, contact: usize, watcher: &dyn Watcher) -> Result<Seen, Unseen> {
    let duration = job.scenario.plan.duration;
    let periods = job.scenario.scene.waveforms.iter().filter_map(|named| named.part.period());
    let periods: Vec<f64> = periods.collect();
    let longest = periods.iter().copied().fold(0.0, f64::max);
    let period = common_period(&periods).filter(|period| *period <= duration).unwrap_or(longest);
    let start = if period > 0.0 && period < duration { duration - period } else { 0.0 };
    let Some((name, law)) = job.model.contacts().nth(contact) else { return Ok(Seen::of(Regime::Open)) };
    let channels = job.model.channels();
    let place = |quantity: &str| {
        let name = format!("{name}.{quantity}");
        channels.iter().position(|channel| channel.name == name).unwrap_or(0)
    };
    let mut record = Last {
        contact,
        places: ["state", "u_m", "d_m"].map(place),
        slope: law.stick_slope(),
        span: [start, duration],
        next: 0,
        seen: [false; 4],
        last: [f64::INFINITY, 0.0],
        reach: [f64::NEG_INFINITY, f64::INFINITY, 0.0],
        watcher,
    };
    let limits = Limits { wall: None, ..job.scenario.plan.limits };
    let plan = Plan { every: None, limits, ..job.scenario.plan };
    let mut end = job.start.clone();
    match stickslip_drive::run(&job.model, &plan, &mut end, &mut record) {
        Ok(_) => {}
        Err(RunError::Interrupted { .. }) => return Err(Unseen::Interrupted),
        Err(error) => return Err(Unseen::Failed(format!("stopped: {error}"))),
    }
    let found = Regime::ALL.into_iter().rev().find(|regime| record.seen[*regime as usize]);
    let mut seen = Seen::of(found.unwrap_or(Regime::Open));
    let margin = record.margin();
    // Where both do not agree there is no guess.
    if margin * seen.margins[2] > 0.0 {
        seen.margins[2] = margin;
    } else {
        seen.margins[2] *= LITTLE;
    }
    Ok(seen)
}

/// The states that a contact has in the last period of a run.
struct Last<'w> {
    contact: usize,
    /// Places of its state, u and d in a row.
    places: [usize; 3],
    /// κ.
    slope: f64,
    /// From when to when it is looked at, s.
    span: [f64; 2],
    next: usize,
    /// Whether it has been in each state, by the codes of states, which are those of regimes.
    seen: [bool; 4],
    /// Time and state of the last moment.
    last: [f64; 2],
    /// Largest u-κd, smallest u+κd and largest κd, m.
    reach: [f64; 3],
    watcher: &'w dyn Watcher,
}

impl Last<'_> {
    fn take(&mut self, values: &[f64]) {
        let at = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
        if at(0) < self.span[0] - SAME * self.span[1] {
            return;
        }
        let [state, u, d] = self.places.map(at);
        // A spring that only just comes to its limit has not slipped: a state counts that lasts from one moment to the next.
        if at(0) > self.last[0] + SAME * self.span[1]
            && let Some(seen) = self.seen.get_mut(state.min(self.last[1]) as usize)
        {
            *seen = true;
        }
        self.last = [at(0), state];
        let depth = self.slope * d.max(0.0);
        let [low, high, most] = self.reach;
        self.reach = [low.max(u - depth), high.min(u + depth), most.max(depth)];
    }

    /// [max(u-κd) - min(u+κd)]/κd at the moments taken.
    fn margin(&self) -> f64 {
        let [low, high, most] = self.reach;
        if most > 0.0 { (low - high) / most } else { 0.0 }
    }
}

impl Record for Last<'_> {
    fn row(&mut self, values: &[f64]) {
        self.take(values);
    }

    fn event(&mut self, event: &Event, values: &[f64]) {
        self.take(values);
        // Rounding may leave the last spring short of its limit where gross slip begins.
        if event.source == Source::Contact(self.contact) && event.kind == EventKind::GrossSlip {
            self.last[1] = f64::from(Regime::Gross as u8);
        }
    }

    fn next_mark(&mut self) -> Option<f64> {
        let [start, end] = self.span;
        let mark = start + (end - start) * (self.next as f64 / MOMENTS as f64);
        self.next += 1;
        (self.next <= MOMENTS).then_some(mark)
    }

    fn mark(&mut self, values: &[f64]) {
        self.take(values);
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}
