//! A run by one of the methods, advanced from goal to goal.

use super::horizon::Goal;
use super::output::Opening;
use crate::RunError;
use crate::record::Record;
use crate::state::State;

/// Workspace of a run by one of the methods. Between two calls the [`State`] contains everything that the future of the run depends on.
pub(super) trait Advance: Send {
    /// Starts or continues the run from a state.
    fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record);

    /// Advances the state to a goal and saves in it everything that the next step depends on.
    ///
    /// After an error the state is that of the last accepted step.
    fn go(&mut self, state: &mut State, goal: Goal, record: &mut dyn Record) -> Result<(), RunError>;

    /// Writes the current state as a row.
    fn write_now(&mut self, state: &State, record: &mut dyn Record);

    /// Passes the extents of the watched bodies since the last sample row to the record and resets them.
    fn hand_over(&mut self, record: &mut dyn Record);

    /// Commits the slip memories that wait for an event. Needed at the end of a run, where they may be read.
    fn settle_books(&mut self, state: &mut State);

    /// Returns the number of reversals added to or removed from slip memories.
    fn touched(&self) -> u64;

    /// Returns the largest number of reversals that a slip memory keeps.
    fn remembers(&self) -> usize;
}
