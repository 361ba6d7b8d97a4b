//! Accepted motion over a piece of time in which no law changes, and the output inside it.
//!
//! Every method of a run yields such a stretch: a step of an integrator, a closed-form motion, a half step of step doubling, a step of
//! fixed length. Rows, samples, turning points, snapshots and period ends are read from it in one place.

use super::horizon::Horizon;
use super::output::{Output, Point};
use crate::contact::Motion;
use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::record::{self, Entry, Record};
use crate::state::State;
use stickslip_contact::{ContactError, Memory, Segment};

/// Accepted motion over a piece of time in which no law changes. The motion begins at the state of the run.
pub(super) trait Stretch {
    /// Whether the displacement of a contact may turn inside the stretch without an event that is reported.
    const TURNS: bool = false;

    /// Writes all components of the state at time t inside the stretch, s.
    fn fill(&mut self, t: f64, y: &mut [f64]);

    /// Passes points near the turning points of a free coordinate between two times, s. By default the cubic through both ends has them.
    fn extremes(&mut self, span: [f64; 2], pass: &mut dyn FnMut(Point)) {
        let _ = (span, pass);
    }

    /// Passes the path of contact `c` to the motion at time t, s: by default a straight one.
    fn trace(&self, (c, t): (usize, f64), to: &Motion, push: &mut dyn FnMut(Segment)) {
        let _ = (c, t);
        push(Segment::Straight(to.apex()));
    }
}

impl Output {
    /// Writes the output that is due inside a stretch up to time t, s. Output does not change the trajectory.
    pub(super) fn take<S: Stretch>(
        &mut self,
        (eq, state): (&Equations<'_>, &State),
        stretch: &mut S,
        (t, tolerance): (f64, f64),
        record: &mut dyn Record,
    ) {
        let mut y = std::mem::take(&mut self.components);
        while let Some(due) = self.grid.due(t) {
            stretch.fill(due, &mut y);
            self.grid.write(eq, state, due, &|i| y[i], record);
        }
        if S::TURNS && self.turns.watches() {
            stretch.fill(t, &mut y);
            if self.turns.notice(eq, (state.t, &state.y), (t, |i| y[i]), tolerance) {
                self.turns.locate(eq, [state.t, t], |t, contact| {
                    stretch.fill(t, &mut y);
                    eq.slide(contact, t, |i| y[i]).rate
                });
            }
        }
        let mut last = state.t;
        while let Some(due) = self.marks.due(t) {
            self.pass(state, stretch, [last, due]);
            self.tell_turns_within((eq, state), stretch, due, (&mut y, record));
            stretch.fill(due, &mut y);
            self.marks.write(eq, state, due, &|i| y[i], record);
            last = due;
        }
        self.tell_turns_within((eq, state), stretch, t, (&mut y, record));
        if self.marks.watches() {
            self.pass(state, stretch, [last, t]);
            stretch.fill(t, &mut y);
            self.marks.pass(state, |i| [t, state.shifts[i] + y[i], y[eq.layout.velocity(i)]]);
            self.marks.end_step();
        }
        while let Some(due) = self.looks.due(t) {
            stretch.fill(due, &mut y);
            let memories = memories_at(eq, state, stretch, (due, &y));
            self.looks.show(eq.model, memories.as_deref().ok(), record);
        }
        self.components = y;
    }

    /// Extends the extents of watched bodies by turning points between two times, s.
    fn pass(&mut self, state: &State, stretch: &mut impl Stretch, span: [f64; 2]) {
        if self.marks.watches() {
            stretch.extremes(span, &mut |point| self.marks.pass(state, |_| point));
        }
    }

    /// Reports the turning points of u up to time `until`, s.
    fn tell_turns_within(
        &mut self,
        (eq, state): (&Equations<'_>, &State),
        stretch: &mut impl Stretch,
        until: f64,
        (y, record): (&mut [f64], &mut dyn Record),
    ) {
        while let Some((t, c)) = self.turns.take(until) {
            stretch.fill(t, y);
            record::fill(eq, state, t, &|i| y[i], &mut self.row);
            let event = Event { t, source: Source::Contact(c), kind: EventKind::Turn };
            record.take(Entry::Event(&event, &self.row));
        }
    }
}

impl Horizon {
    /// Evaluates the step length of the drive at all period ends in a stretch up to time t, s. Returns the period end at which the step
    /// length has become steady, which ends the run. `y` is scratch.
    #[inline(never)]
    pub(super) fn take_periods(
        &mut self,
        state: &State,
        stretch: &mut impl Stretch,
        (t, y): (f64, &mut [f64]),
    ) -> Option<f64> {
        let i = self.steps.coordinate;
        while let Some(due) = self.steps.due(t) {
            stretch.fill(due, y);
            if self.steps.take(state.shifts[i], y[i]) {
                return Some(due);
            }
        }
        None
    }
}

/// Returns copies of the slip memories at time t inside a stretch with components y, as if a step ended there.
///
/// Displacements are relative to the initial positions. Fails if a contact leaves its spring row up to that time or is not finite; the
/// snapshot is then omitted.
#[inline(never)]
fn memories_at(
    eq: &Equations<'_>,
    state: &State,
    stretch: &impl Stretch,
    (t, y): (f64, &[f64]),
) -> Result<Vec<Memory>, ContactError> {
    let mut path = Vec::new();
    let contacts = eq.model.contacts.iter().zip(&state.memories).enumerate();
    let memories = contacts.map(|(c, (contact, memory))| {
        stretch.trace((c, t), &eq.motion(contact, t, |i| y[i]), &mut |piece| path.push(piece));
        let mut memory = memory.clone();
        path.drain(..).try_for_each(|piece| memory.commit(&contact.interface, piece).map(drop))?;
        memory.shift(state.shift(contact));
        Ok(memory)
    });
    memories.collect()
}
