//! Output of a run: what a record receives and wants.

mod extent;
mod row;
mod trace;

pub use extent::Extent;
pub use row::{Channel, state_code, state_name};
pub(crate) use row::{balance, fill, link_energy};
pub use trace::Trace;

use crate::event::Event;
use crate::state::State;
use stickslip_contact::{Memory, Segment};

/// Receiver of a run's output. Recording does not affect the trajectory.
pub trait Record {
    /// Receives one entry. Entries come in order of time.
    fn take(&mut self, entry: Entry<'_>);

    /// Returns what the record wants. Asked when a run begins, and for `events` at every event.
    fn wants(&self) -> Wants {
        Wants::default()
    }

    /// Returns the next time of an entry of this kind, s; none to request no further one. Called before the run and after every such entry.
    /// Times must ascend; times before the start of the run are skipped.
    fn next(&mut self, due: Due) -> Option<f64> {
        let _ = due;
        None
    }

    /// Receives the time reached (s) at irregular intervals; returning `false` interrupts the run.
    fn goes_on(&mut self, t: f64) -> bool {
        let _ = t;
        true
    }
}

/// Piece of a run's output. Rows have one value per [`Model::channels`](crate::Model::channels).
#[derive(Debug, Clone, Copy)]
pub enum Entry<'a> {
    /// Row at the plan's interval, including the first and the last of the run.
    Row(&'a [f64]),
    /// Event and the row immediately after it, which is empty without [`EventDetail::Rows`].
    Event(&'a Event, &'a [f64]),
    /// Slip memories of the contacts at a requested time (s), in order, as if a step ended there. Omitted if a contact leaves the range of
    /// its spring row or is not finite.
    Look(f64, &'a [Memory]),
    /// Row at a requested time, independently of the plan's interval. A requested time within four units in the last place of the end of a
    /// step is replaced by that end.
    Mark(&'a [f64]),
    /// Path that the slip memory of a contact (index) has committed. All paths of a step precede the next look.
    ///
    /// Displacements are relative to the initial positions. A path not committed at the end of a run appears in its last look only.
    Path(usize, Segment),
    /// Extents of the [watched](Wants::watched) bodies along x since the last such entry, before every mark and whenever a run pauses. Within
    /// a step, x is the cubic Hermite interpolant of positions and velocities.
    Extents([Extent; 2]),
    /// State at the end of an interval between two located events, still with the laws of the interval. Slip memories that are committed
    /// only at a later event are not updated.
    Leaves(&'a State),
    /// State, with its laws, at the start of an interval between events: when a run begins, and after every located event.
    Enters(&'a State),
}

/// Kinds of entries at times that a record requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Due {
    /// [`Entry::Look`].
    Look,
    /// [`Entry::Mark`].
    Mark,
}

/// What a record wants of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wants {
    /// Events, and their rows.
    pub events: EventDetail,
    /// Whether the record receives every committed path of a contact.
    pub paths: bool,
    /// Indices of the bodies whose extent along x is requested: the moving body and its drive. With such bodies every step is evaluated.
    pub watched: [Option<usize>; 2],
    /// Time range of the rows at the plan's interval, s, both ends included. The first and the last row of the run are always written.
    pub rows_within: [f64; 2],
}

/// What a record wants of events.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventDetail {
    /// No events.
    None,
    /// Events without rows, which need no evaluation.
    Kinds,
    /// Events with the rows after them.
    Rows,
}

impl Default for Wants {
    fn default() -> Self {
        Self {
            events: EventDetail::Rows,
            paths: false,
            watched: [None; 2],
            rows_within: [0.0, f64::INFINITY],
        }
    }
}

impl Wants {
    /// Rows without events.
    #[must_use]
    pub fn no_events() -> Self {
        Self { events: EventDetail::None, ..Self::default() }
    }

    /// Events without their rows.
    #[must_use]
    pub fn bare_events() -> Self {
        Self { events: EventDetail::Kinds, ..Self::default() }
    }
}

/// Discards all output.
impl Record for () {
    fn take(&mut self, _: Entry<'_>) {}

    fn wants(&self) -> Wants {
        Wants::no_events()
    }
}

/// Returns whether a record wants events.
#[inline]
pub(crate) fn wants_events(record: &dyn Record) -> bool {
    record.wants().events != EventDetail::None
}
