//! What is stepped a frame at a time.

mod channels;
mod commanded;
mod drive;

#[cfg(test)]
pub(crate) use channels::Feed;
pub use channels::{ChannelError, Input, Output, Takes, inputs, outputs};
pub use drive::Drive;

use stickslip_drive::{CommandError, InputError, Run, RunError};
use thiserror::Error;

/// What of the work of a frame is counted, by name.
pub const WORK: [&str; 7] = ["steps", "rejected", "evaluations", "events", "detours", "knots", "merges"];

/// Work of a frame, in the order of [`WORK`].
pub type Work = [u64; WORK.len()];

/// Place of the steps in them.
pub(crate) const STEPS: usize = 0;

/// What was counted under a name of [`WORK`] in a frame.
pub fn counted(work: &Work, name: &str) -> u64 {
    WORK.iter().position(|known| *known == name).map_or(0, |place| work[place])
}

/// Why a plant stops.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlantError {
    /// Its run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An input that was checked and still is not taken.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A command, the same.
    #[error(transparent)]
    Command(#[from] CommandError),
}

/// Something that goes on by frames of one length.
pub trait Plant {
    /// Goes on by one frame under these inputs, and says where it stands then and what it took. Nothing is allocated, locked,
    /// logged or asked of the system.
    ///
    /// # Errors
    /// What stops it; it stands where it came to.
    fn frame(&mut self, inputs: &[f64], outputs: &mut [f64]) -> Result<Work, PlantError>;
}

/// Nothing at all: the loop beside it shows what the machine alone does.
#[derive(Debug, Clone, Copy, Default)]
pub struct Empty;

impl Plant for Empty {
    #[inline]
    fn frame(&mut self, _: &[f64], _: &mut [f64]) -> Result<Work, PlantError> {
        Ok(Work::default())
    }
}

/// Work that a run has done so far: steps, evaluations and events, and turning points of contacts, those that came or went and those
/// that found no room.
fn done(run: &Run<'_>) -> Work {
    let (counts, state) = (run.state().counts(), run.state());
    let merges = state.memories().iter().map(|memory| memory.merged().knots).sum();
    [counts.steps, counts.rejected, counts.evaluations, counts.events, counts.detours, run.touched(), merges]
}

/// Work done between two moments of a run.
fn between(before: &Work, after: &Work) -> Work {
    std::array::from_fn(|k| after[k] - before[k])
}
