//! Slip regime of a contact in one case: from prescribed waveforms or from a run.

use super::{Axis, Map};
use crate::journal::Journal;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_drive::facts::{Prescribed, common_period};
use stickslip_drive::{Due, Entry, EventKind, Limits, Plan, Record, RunError, Source};
use stickslip_run::{Job, Watcher};

/// Number of samples in the last period of a run, in addition to events.
const MOMENTS: usize = 64;
/// Factor on a margin of gross slip of which only the sign is known.
const LITTLE: f64 = 1e-3;
/// Relative tolerance for equal times.
const SAME: f64 = 1e-9;

/// Slip regime of a contact over a period, in order of increasing slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Regime {
    /// Never in contact.
    Open,
    /// No spring slips.
    Stick,
    /// Some springs slip, but never all at the same time.
    Partial,
    /// All springs slip at some time.
    Gross,
}

impl Regime {
    /// All regimes in the order of their codes.
    pub const ALL: [Self; 4] = [Self::Open, Self::Stick, Self::Partial, Self::Gross];

    /// Returns the name.
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

/// Slip regime with a margin for stick, partial slip and gross slip; a margin is positive if this regime is reached.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Seen {
    pub(super) regime: Regime,
    pub(super) margins: [f64; 3],
}

/// Reason why a case has no regime.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Unseen {
    /// The watcher interrupted.
    Interrupted,
    /// The scenario is invalid or its run stopped.
    Failed(String),
}

/// Determines the regime of a contact for single cases.
pub(super) struct Looks<'m> {
    job: &'m Job,
    axes: &'m [Axis; 2],
    /// Index of the contact.
    contact: usize,
    by_runs: bool,
    /// Journal of the runs.
    journal: &'m Journal,
    watcher: &'m (dyn Watcher + Sync),
    /// Numbers of evaluated cases and of runs.
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

    /// Returns the number of runs.
    pub(super) fn runs(&self) -> usize {
        self.runs.load(Ordering::Relaxed)
    }

    /// Returns the scenario at a point of the map, given as fractions of both axes.
    fn case(&self, place: [f64; 2]) -> Result<Job, Unseen> {
        let set = [0, 1].map(|axis| self.axes[axis].set(self.axes[axis].at(place[axis])));
        self.job.with(&set).map_err(|error| {
            let message = error.message.lines().next().unwrap_or_default().to_owned();
            Unseen::Failed(if error.path.is_empty() { message } else { format!("{}: {message}", error.path) })
        })
    }

    /// Returns whether waveforms alone determine the regime at a point.
    pub(super) fn is_prescribed(&self, place: [f64; 2]) -> bool {
        self.case(place).is_ok_and(|job| Prescribed::of(&job.model, self.contact).is_some())
    }

    /// Returns the slip regime at a point of the map, given as fractions of both axes.
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
    /// Creates it from a regime without margins.
    fn of(regime: Regime) -> Self {
        let reached = |least: Regime| if regime >= least { 1.0 } else { -1.0 };
        Self { regime, margins: [Regime::Stick, Regime::Partial, Regime::Gross].map(reached) }
    }
}

/// Returns the regime of a motion prescribed by waveforms.
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

/// Returns the regime over the last period of a run, from the states of the contact.
///
/// The margin of gross slip is computed from displacements at sampled instants, which may miss extremes slightly. The search for a border
/// uses this margin as a guess only.
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
    // If the margin contradicts the sampled states, it is replaced by a small margin with the sign of the states.
    if margin * seen.margins[2] > 0.0 {
        seen.margins[2] = margin;
    } else {
        seen.margins[2] *= LITTLE;
    }
    Ok(seen)
}

/// Record of a contact's states in the last period of a run.
struct Last<'w> {
    contact: usize,
    /// Indices of state, u and d in a row.
    places: [usize; 3],
    /// Ratio κ = μE*/G*.
    slope: f64,
    /// Start and end of the observed time, s.
    span: [f64; 2],
    next: usize,
    /// Whether each contact state occurred, by state code. The codes of states equal the codes of regimes.
    seen: [bool; 4],
    /// Time and state of the last sample.
    last: [f64; 2],
    /// Largest u-κd, smallest u+κd and largest κd, m.
    reach: [f64; 3],
    watcher: &'w dyn Watcher,
}

impl Last<'_> {
    fn read(&mut self, values: &[f64]) {
        let at = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
        if at(0) < self.span[0] - SAME * self.span[1] {
            return;
        }
        let [state, u, d] = self.places.map(at);
        // A state counts if it persists between two instants. A spring that only reaches its friction limit has not slipped.
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

    /// Returns the margin of gross slip, [max(u-κd) - min(u+κd)]/κd, over the recorded instants.
    fn margin(&self) -> f64 {
        let [low, high, most] = self.reach;
        if most > 0.0 { (low - high) / most } else { 0.0 }
    }
}

impl Record for Last<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) | Entry::Mark(values) => self.read(values),
            Entry::Event(event, values) => {
                self.read(values);
                // Due to rounding, the last spring may not have reached its limit at the gross slip event.
                let begins = matches!(event.kind, EventKind::GrossSlip | EventKind::BreaksLoose);
                if event.source == Source::Contact(self.contact) && begins {
                    self.last[1] = f64::from(Regime::Gross as u8);
                }
            }
            _ => {}
        }
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => None,
            Due::Mark => {
                let [start, end] = self.span;
                let mark = start + (end - start) * (self.next as f64 / MOMENTS as f64);
                self.next += 1;
                (self.next <= MOMENTS).then_some(mark)
            }
        }
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}
