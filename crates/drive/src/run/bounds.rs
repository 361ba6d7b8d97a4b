//! Limits that stop a run: attempts, events, wall-clock time, accumulating events and lack of progress.
//!
//! [`Bounds`] is checked after every attempt and after every event of a contact or block. A check returns a [`RunError`] if a limit is
//! exceeded. Checks do not change the state.

use crate::Wall;
use crate::record::Record;
use crate::state::{Crawl, Window};
use crate::{EventKind, Limits, Model, RunError, Source, State, Waveform};

/// Largest number of events of a component in one of its natural periods; more events count as accumulation.
const ZENO_COUNT: u32 = 64;
/// Number of events per component and waveform corner that do not count towards accumulation.
const PER_CORNER: u32 = 4;
/// Upper limit of the accumulation window, in periods of the fastest sine of any waveform.
const SINES: f64 = 8.0;
/// Largest number of closed hysteresis loops of a contact in one natural period.
///
/// Loops that were stored at the start of the period are allowed in addition.
const LOOPS: u32 = 4096;
/// Offset of the loop counters. The offset keeps a counter non-negative after the stored loops have been subtracted.
const HELD: u32 = 1 << 24;
/// Number of attempts between two checks of the wall clock in a model without spring rows.
const STRIDE: u64 = 1024;
/// Number of springs whose evaluation takes about as long as one attempt.
const SPRINGS_PER_STEP: usize = 1000;

/// Accumulation window without events.
const QUIET: Window = Window { start: f64::NEG_INFINITY, count: 0 };
/// Number of attempts after which a run with too little progress is stopped.
const CRAWLING: u64 = 100_000;
/// Required progress of [`CRAWLING`] attempts, as a fraction of the period of the fastest oscillation.
const PROGRESS: f64 = 0.01;

/// Checks of a run's limits and of accumulating events.
pub(super) struct Bounds {
    /// Limits of the plan.
    limits: Limits,
    /// Wall-clock time at the start of the run.
    begun: Wall,
    /// Number of attempts between two checks of the wall clock; a power of two.
    stride: u64,
    /// Accumulation windows: one per contact, one per block, then one per contact for closed loops.
    pub(super) windows: Vec<Window>,
    pub(super) crawl: Crawl,
    /// Period of the fastest oscillation, s; 0 disables the progress check.
    period: f64,
    /// Longest accumulation window, s.
    longest: f64,
}

impl Bounds {
    /// Creates the checks of a run and reuses the storage of `windows`.
    ///
    /// The number of attempts between two checks of the wall clock decreases with the number of springs.
    pub(super) fn new(model: &Model, limits: Limits, period: f64, mut windows: Vec<Window>) -> Self {
        let springs: usize = model.contacts.iter().map(|contact| contact.engine.springs()).sum();
        let stride = (STRIDE / (1 + springs / SPRINGS_PER_STEP) as u64).max(1).next_power_of_two();
        windows.clear();
        windows.resize(Window::count(model), QUIET);
        let crawl = Crawl { since: 0.0, attempts: 0 };
        let sines = model.waveforms.iter().filter_map(Waveform::fastest_sine);
        let longest = SINES * sines.fold(f64::INFINITY, f64::min);
        Self { limits, begun: Wall::begin(limits.wall.is_some()), stride, windows, crawl, period, longest }
    }

    /// Returns the number of attempts so far, accepted and rejected.
    ///
    /// Fails if that number has reached the limit of the plan.
    #[inline(always)]
    pub(super) fn tried(&self, state: &State) -> Result<u64, RunError> {
        let tried = state.counts.steps + state.counts.rejected;
        if tried >= self.limits.steps {
            return Err(RunError::TooManySteps { t: state.t, limit: self.limits.steps });
        }
        Ok(tried)
    }

    /// Checks all limits after an attempt.
    ///
    /// Fails if the attempts, the wall-clock time or the progress violate a limit, or if the record interrupts the run.
    pub(super) fn step(&mut self, state: &State, record: &mut dyn Record) -> Result<(), RunError> {
        let tried = self.tried(state)?;
        // The stride is a power of two, so a bit mask replaces the division.
        if tried & (self.stride - 1) != 0 {
            return Ok(());
        }
        // Checked first, so that this error does not depend on wall-clock time.
        self.watch_progress(state.t)?;
        if let Some(limit) = self.limits.wall.filter(|limit| self.begun.elapsed() > *limit) {
            return Err(RunError::OutOfTime { t: state.t, limit });
        }
        if !record.goes_on(state.t) {
            return Err(RunError::Interrupted { t: state.t });
        }
        Ok(())
    }

    /// Fails if more than [`CRAWLING`] attempts have advanced the time by less than [`PROGRESS`] periods.
    fn watch_progress(&mut self, t: f64) -> Result<(), RunError> {
        if t - self.crawl.since >= PROGRESS * self.period {
            self.crawl = Crawl { since: t, attempts: 0 };
            return Ok(());
        }
        self.crawl.attempts += self.stride;
        if self.crawl.attempts <= CRAWLING {
            return Ok(());
        }
        let (attempts, since) = (self.crawl.attempts, self.crawl.since);
        Err(RunError::Crawl { t, attempts, advance: t - since })
    }

    /// Resets the accumulation windows and the attempt counter of the progress check.
    pub(super) fn forget(&mut self) {
        self.windows.fill(QUIET);
        self.crawl.attempts = 0;
    }

    /// Resets all counters to the state before the first attempt.
    pub(super) fn begin_anew(&mut self) {
        self.windows.fill(QUIET);
        self.crawl = Crawl { since: 0.0, attempts: 0 };
    }

    /// Reduces the event counts at a waveform corner by [`PER_CORNER`].
    pub(super) fn corner(&mut self) {
        self.windows.iter_mut().for_each(|window| window.count = window.count.saturating_sub(PER_CORNER));
    }

    /// Counts an event of a component; closed loops are counted separately.
    ///
    /// Fails at the limit of events in the plan, or if the events exceed [`ZENO_COUNT`] or [`LOOPS`] within the window.
    pub(super) fn event(
        &mut self,
        model: &Model,
        state: &State,
        (source, kind): (Source, EventKind),
    ) -> Result<(), RunError> {
        if state.counts.events >= self.limits.events {
            return Err(RunError::TooManyEvents { t: state.t, limit: self.limits.events });
        }
        let (name, place, frequency, at_once) = match source {
            Source::Contact(c) => (&model.contacts[c].name, c, model.contacts[c].natural.frequency, 1),
            Source::Block(k) => {
                let (wired, place) = (&model.blocks[k], model.contacts.len() + k);
                (&wired.name, place, wired.block().rate(), wired.block().events_per_turn().max(1))
            }
            // The waveform determines its corners; they cannot accumulate.
            Source::Waveform(_) => return Ok(()),
        };
        // The window is the component's own natural period: events that are dense for one contact are rare for another.
        let period = (std::f64::consts::TAU / frequency).min(self.longest);
        let (place, base, held, most) = match kind {
            EventKind::LoopClosed => {
                let held = u32::try_from(state.memories[place].knot_count()).unwrap_or(HELD);
                (model.contacts.len() + model.blocks.len() + place, HELD, held.min(HELD), LOOPS)
            }
            _ => (place, 0, 0, ZENO_COUNT.saturating_mul(at_once)),
        };
        let Window { start, count } = &mut self.windows[place];
        if state.t - *start > period {
            (*start, *count) = (state.t, base - held);
        }
        *count += 1;
        if count.saturating_sub(base) > most {
            let (t, name, count, window) = (state.t, name.clone(), *count - base, period);
            return Err(match source {
                Source::Block(_) => RunError::Chatter { t, block: name, count, window },
                _ => RunError::Zeno { t, contact: name, count, window },
            });
        }
        Ok(())
    }
}
