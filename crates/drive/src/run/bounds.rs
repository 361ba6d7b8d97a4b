//! Guards against endless work.
//!
//! Asked by both kinds of runs after every attempt and every event of a component; it reads the state and
//! stops a run with an error that says when, and of events whose. It changes nothing.

use crate::Wall;
use crate::record::Record;
use crate::state::{Crawl, Window};
use crate::{EventKind, Limits, Model, RunError, Source, State, Waveform};

/// More events of a component than this in a natural period of its own accumulate, and stop the run or make it take a detour.
// A quarter of it changes none of 3 600 drawn runs; a damped flat punch dragged back under a falling load slides along a line
// on which stick and slip take turns ten thousand times in a period: with 200 events in 1e-4 of a period it took 30 times as long.
const ZENO_COUNT: u32 = 64;
/// Events of a component that a corner of a waveform has for itself: what turns at it, slips and holds again does not accumulate.
// A measured table with noise, a point every 2 µs, turns a contact of 1 ms 400 times in its period: it took nine detours in each.
const PER_CORNER: u32 = 4;
/// Periods of the fastest sine of a waveform in which so many events accumulate, where the component's own is longer.
const SINES: f64 = 8.0;
/// Loops of a contact that close in a natural period before they accumulate, too, beside those that it held when the period began: each
/// of these closes once, and one flyback may sweep up as many as there are.
// A drive at 1 Hz that nothing damps rings four thousand times in a period. Without any bound two balls on one another, whose sideways motion is rounding, close half a million loops in ten milliseconds.
const LOOPS: u32 = 4096;
/// What counts of loops are told from: those held when their window begins are taken off.
const HELD: u32 = 1 << 24;
/// Steps between two looks at the clock, in a scene without rows of springs …
const STRIDE: u64 = 1024;
/// … and springs that take as long as one such step.
const SPRINGS_PER_STEP: usize = 1000;

/// No event yet.
const QUIET: Window = Window { start: f64::NEG_INFINITY, count: 0 };
/// So many attempts …
const CRAWLING: u64 = 100_000;
/// … that together move on by less than this part of a period of the fastest swing are a crawl.
const PROGRESS: f64 = 0.01;

/// Watches limits, the clock, and events that accumulate.
pub(super) struct Bounds {
    /// The user's.
    limits: Limits,
    /// When the run began, by the clock on the wall.
    begun: Wall,
    /// Attempts between two looks at the clock, a power of two.
    stride: u64,
    /// Of each contact, then each block, then of the loops of each contact.
    pub(super) windows: Vec<Window>,
    pub(super) crawl: Crawl,
    /// Of the fastest swing, s; 0 where steps may be as short as they like.
    period: f64,
    /// Longest time in which events accumulate, s: some periods of the fastest sine.
    longest: f64,
}

impl Bounds {
    /// A stride that makes looks at the clock about as frequent for rows of a million springs as for none.
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

    /// Attempts so far. Asked before the first one, too: a run that goes on at its limit stops where it stopped.
    #[inline(always)]
    pub(super) fn tried(&self, state: &State) -> Result<u64, RunError> {
        let tried = state.counts.steps + state.counts.rejected;
        if tried >= self.limits.steps {
            return Err(RunError::TooManySteps { t: state.t, limit: self.limits.steps });
        }
        Ok(tried)
    }

    /// Called after every attempt.
    ///
    /// Fails where steps accepted and rejected reach their limit, time on the wall is over, or the record
    /// wants no more.
    pub(super) fn step(&mut self, state: &State, record: &mut dyn Record) -> Result<(), RunError> {
        let tried = self.tried(state)?;
        // A power of two: a division would be felt.
        if tried & (self.stride - 1) != 0 {
            return Ok(());
        }
        // First: what is found out does not depend on who interrupts.
        self.watch_progress(state.t)?;
        if let Some(limit) = self.limits.wall.filter(|limit| self.begun.elapsed() > *limit) {
            return Err(RunError::OutOfTime { t: state.t, limit });
        }
        if !record.goes_on(state.t) {
            return Err(RunError::Interrupted { t: state.t });
        }
        Ok(())
    }

    /// Fails where very many attempts have moved the run on by next to nothing.
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

    /// What has accumulated so far counts no more.
    pub(super) fn forget(&mut self) {
        self.windows.fill(QUIET);
        self.crawl.attempts = 0;
    }

    /// Knows of no attempt and no event.
    pub(super) fn begin_anew(&mut self) {
        self.windows.fill(QUIET);
        self.crawl = Crawl { since: 0.0, attempts: 0 };
    }

    /// Called at every corner of a waveform.
    pub(super) fn corner(&mut self) {
        self.windows.iter_mut().for_each(|window| window.count = window.count.saturating_sub(PER_CORNER));
    }

    /// Called after every event of a component. Many loops may close at once: they accumulate far later.
    ///
    /// Fails at the limit of events, or where a component has more than [`ZENO_COUNT`] beside those of corners within its natural period.
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
            // Corners of waveforms are where their period puts them.
            Source::Waveform(_) => return Ok(()),
        };
        // In parts of the component's own period: what is dense for one contact is a single event of another.
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
