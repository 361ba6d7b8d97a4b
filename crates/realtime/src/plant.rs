//! Simulated system that is advanced frame by frame.

mod channels;
mod commanded;
mod drive;

#[cfg(test)]
pub(crate) use channels::Feed;
pub use channels::{ChannelError, Input, Output, Takes, inputs, outputs};
pub use drive::Drive;

use stickslip_drive::{CommandError, InputError, Run, RunError};
use thiserror::Error;

/// Names of the counted work of a frame.
pub const WORK: [&str; 7] = ["steps", "rejected", "evaluations", "events", "detours", "knots", "merges"];

/// Work of a frame, in the order of [`WORK`].
pub type Work = [u64; WORK.len()];

/// Index of the time steps in [`WORK`].
pub(crate) const STEPS: usize = 0;

/// Returns the count with a name of [`WORK`]; 0 for unknown names.
pub fn counted(work: &Work, name: &str) -> u64 {
    WORK.iter().position(|known| *known == name).map_or(0, |place| work[place])
}

/// Reason why a plant stops.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlantError {
    /// The run failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An input was rejected.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A command was rejected.
    #[error(transparent)]
    Command(#[from] CommandError),
}

/// A simulated system that advances in frames of equal length.
pub trait Plant {
    /// Advances by one frame with the given inputs. Writes the outputs at its end and returns the work done.
    ///
    /// It allocates no memory, takes no lock, writes no log and makes no system calls.
    ///
    /// # Errors
    /// The reason for a stop. The plant remains at the time reached.
    fn frame(&mut self, inputs: &[f64], outputs: &mut [f64]) -> Result<Work, PlantError>;
}

/// Plant without any work, for measuring the timing of the machine alone.
#[derive(Debug, Clone, Copy, Default)]
pub struct Empty;

impl Plant for Empty {
    #[inline]
    fn frame(&mut self, _: &[f64], _: &mut [f64]) -> Result<Work, PlantError> {
        Ok(Work::default())
    }
}

/// Returns the work of a run so far: time steps, evaluations, events, detours, changed knots and merged knots of the slip memories.
fn done(run: &Run<'_>) -> Work {
    let (counts, state) = (run.state().counts(), run.state());
    let merges = state.memories().iter().map(|memory| memory.merged().knots).sum();
    [counts.steps, counts.rejected, counts.evaluations, counts.events, counts.detours, run.touched(), merges]
}

/// Returns the work between two times.
fn between(before: &Work, after: &Work) -> Work {
    std::array::from_fn(|k| after[k] - before[k])
}
