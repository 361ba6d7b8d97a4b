//! What can be wrong with a scene, and what can stop a run.

mod fault;
mod part;

pub use fault::SceneFault;
pub use part::{Field, Part, SceneError};

use crate::scene::Axis;
use stickslip_contact::ContactError;
use thiserror::Error;

/// Why a run stopped itself: what, where, when. [`RunError::advice`] says what to try.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError {
    /// Step control asks for steps below the resolution of time, or below any that helps.
    #[error("at t = {t:.6e} s even a step of {step:.3e} s misses the tolerance")]
    StepTooSmall {
        /// Time, s.
        t: f64,
        /// Step, s.
        step: f64,
    },
    /// A fixed step too long for the fastest motion of the scene, or for a state of a block.
    #[error("the step of {step:e} s is unstable here: the fastest motion allows less than {limit:.4e} s")]
    Unstable {
        /// Step, s.
        step: f64,
        /// Longest stable step, s.
        limit: f64,
    },
    /// A coordinate is no longer a number.
    #[error("at t = {t:.6e} s the motion of `{body}`, or the work on it, is no longer finite")]
    NotFinite {
        /// Time, s.
        t: f64,
        /// Name of the body.
        body: String,
    },
    /// Too many steps.
    #[error("the limit of {limit} steps was reached at t = {t:.6e} s")]
    TooManySteps {
        /// Time, s.
        t: f64,
        /// The limit.
        limit: u64,
    },
    /// Too many events.
    #[error("the limit of {limit} events was reached at t = {t:.6e} s")]
    TooManyEvents {
        /// Time, s.
        t: f64,
        /// The limit.
        limit: u64,
    },
    /// Events accumulate at one moment.
    #[error("events of contact `{contact}` accumulate at t = {t:.6e} s: {count} within {window:.3e} s")]
    Zeno {
        /// Time, s.
        t: f64,
        /// Name of the contact.
        contact: String,
        /// Number of events.
        count: u32,
        /// Length of the window, s.
        window: f64,
    },
    /// Events of a block accumulate at one moment.
    #[error("events of block `{block}` accumulate at t = {t:.6e} s: {count} within {window:.3e} s")]
    Chatter {
        /// Time, s.
        t: f64,
        /// Name of the block.
        block: String,
        /// Number of events.
        count: u32,
        /// Length of the window, s.
        window: f64,
    },
    /// Steps that do not move on.
    #[error("at t = {t:.6e} s {attempts} steps have moved the run on by {advance:.3e} s")]
    Crawl {
        /// Time, s.
        t: f64,
        /// Number of attempts.
        attempts: u64,
        /// What they came to, s.
        advance: f64,
    },
    /// A contact cannot follow the motion.
    #[error("contact `{contact}` at t = {t:.6e} s: {source}")]
    Contact {
        /// Time, s.
        t: f64,
        /// Name of the contact.
        contact: String,
        /// Why.
        source: ContactError,
    },
    /// Nothing balances the load on a coordinate without mass any more: gross slip, or a contact that has parted.
    #[error(
        "nothing balances {load:.3e} N along {} of `{body}` from t = {t:.15e} s on: {}",
        .axis.key(),
        held(*.load, *.limit)
    )]
    Unbalanced {
        /// Time, s.
        t: f64,
        /// Name of the body.
        body: String,
        /// Its coordinate.
        axis: Axis,
        /// What pulls, N.
        load: f64,
        /// What the contacts hold, N.
        limit: f64,
    },
    /// A block cannot follow its inputs.
    #[error("block `{block}` at t = {t:.6e} s: {why}")]
    Block {
        /// Time, s.
        t: f64,
        /// Name of the block.
        block: String,
        /// Why, in its words.
        why: String,
    },
    /// The wall-clock limit.
    #[error("the limit of {limit} s of wall time was reached at t = {t:.6e} s")]
    OutOfTime {
        /// Time, s.
        t: f64,
        /// The limit, s.
        limit: f64,
    },
    /// A run was to be advanced to a time before the one it has reached.
    #[error("cannot go from t = {t:.6e} s to t = {until:.6e} s: time runs forward")]
    Backwards {
        /// Time, s.
        t: f64,
        /// Where it was to go, s.
        until: f64,
    },
    /// A stepper whose state cannot be held.
    #[error("a run of the stepper `{stepper}` cannot be held")]
    NotHeld {
        /// Its name.
        stepper: &'static str,
    },
    /// An input has no value for the time ahead.
    #[error("input {input} has no value after t = {known:.6e} s, and the run is to go to t = {until:.6e} s")]
    InputMissing {
        /// Place of the waveform in the scene.
        input: usize,
        /// Until when it has one, s.
        known: f64,
        /// Where the run is to go, s.
        until: f64,
    },
    /// Whoever watches the run asked it to stop.
    #[error("interrupted at t = {t:.6e} s")]
    Interrupted {
        /// Time, s.
        t: f64,
    },
}

/// Load and limit that differ by less are told as one number.
const ALIKE: f64 = 1e-3;

/// What contacts hold of a load, N, in words: a load that grows is at their limit where it is too much for them.
fn held(load: f64, limit: f64) -> String {
    if (load.abs() - limit).abs() <= ALIKE * limit {
        "its contacts hold no more".to_owned()
    } else {
        format!("its contacts hold {limit:.3e} N")
    }
}

impl RunError {
    /// Whether the run was halted from outside and stands between two steps, from where it can go on: by whoever watches it,
    /// or by a limit on its steps or its time.
    pub fn is_halt(&self) -> bool {
        matches!(self, Self::Interrupted { .. } | Self::OutOfTime { .. } | Self::TooManySteps { .. })
    }

    /// What to try.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::StepTooSmall { .. } => {
                "loosen the tolerance, or look for a length, mass or stiffness off by orders of magnitude"
            }
            Self::Unstable { .. } => {
                "take a step well below the limit, or the event stepper, which needs none"
            }
            Self::NotFinite { .. } => {
                "look for a number off by orders of magnitude; `stickslip info` tells the longest stable step"
            }
            Self::TooManySteps { .. } => "raise run.limits.steps, loosen the tolerance or shorten the run",
            Self::TooManyEvents { .. } => "raise run.limits.events or shorten the run",
            Self::Zeno { .. } | Self::Chatter { .. } | Self::Crawl { .. } => {
                "take another tolerance, or a fixed step, which looks for no events"
            }
            Self::Contact { source: ContactError::Beyond { .. }, .. } => {
                "give the profile points further out, or press it less"
            }
            Self::Contact { .. } => "enlarge the span of the row, or use the engine \"curve\"",
            Self::Unbalanced { .. } => {
                "lower the load or press harder; to see what comes after, hold the body by a spring or make it \"free\" with a mass"
            }
            Self::Block { .. } => "look at what the block says of itself",
            Self::OutOfTime { .. } => "raise run.limits.wall or shorten the run",
            Self::Backwards { .. } => "advance to a time after the present one",
            Self::NotHeld { .. } => "take the stepper event, verlet or rk4",
            Self::InputMissing { .. } => "give the input its next piece before advancing",
            Self::Interrupted { .. } => "run again to the end",
        }
    }
}
