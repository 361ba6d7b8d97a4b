//! Simulated system that is advanced frame by frame.

mod channels;
mod drive;

pub use channels::{ChannelError, Output, inputs, outputs};
pub use drive::Drive;
#[cfg(test)]
pub(crate) use stickslip_drive::inputs::Feed;
pub use stickslip_drive::inputs::{Input, Takes};

use stickslip_drive::{CommandError, InputError, Run, RunError};
use thiserror::Error;

/// Names of the kinds of work that are counted in a frame. Knots are breakpoints of the slip memory.
pub const WORK: [&str; 7] = ["steps", "rejected", "evaluations", "events", "detours", "knots", "merges"];

/// Counts of the work in a frame, in the order of [`WORK`].
pub type Work = [u64; WORK.len()];

/// Index of the time steps in [`WORK`].
pub(crate) const STEPS: usize = 0;

/// Returns the count with a name of [`WORK`], or 0 for an unknown name.
pub fn counted(work: &Work, name: &str) -> u64 {
    WORK.iter().position(|known| *known == name).map_or(0, |place| work[place])
}

/// Reason why a plant (simulated system) stops.
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
    /// Advances the simulation by one frame with the given inputs. Writes the outputs at the end of the frame and returns the work done.
    ///
    /// The method allocates no memory, takes no lock, writes no log and makes no system calls.
    ///
    /// # Errors
    /// The reason for a stop. The plant then remains at the time reached.
    fn frame(&mut self, inputs: &[f64], outputs: &mut [f64]) -> Result<Work, PlantError>;
}

/// Plant that computes nothing, for measuring the timing of the machine alone.
#[derive(Debug, Clone, Copy, Default)]
pub struct Empty;

impl Plant for Empty {
    #[inline]
    fn frame(&mut self, _: &[f64], _: &mut [f64]) -> Result<Work, PlantError> {
        Ok(Work::default())
    }
}

/// Returns the work of a run so far, in the order of [`WORK`].
fn done(run: &Run<'_>) -> Work {
    let (counts, state) = (run.state().counts(), run.state());
    let merges = state.memories().iter().map(|memory| memory.merged().knots).sum();
    [counts.steps, counts.rejected, counts.evaluations, counts.events, counts.detours, run.touched(), merges]
}

/// Returns the difference of the work at two times of a run.
fn between(before: &Work, after: &Work) -> Work {
    std::array::from_fn(|k| after[k] - before[k])
}
