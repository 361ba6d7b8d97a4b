//! Errors of models and runs.

mod fault;
mod part;

pub use fault::SceneFault;
pub use part::{Field, Part, SceneError};

use crate::scene::Axis;
use stickslip_contact::ContactError;
use thiserror::Error;

/// Reason why a run stopped, with time and name of the part. [`RunError::advice`] suggests a remedy.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError {
    /// The step-size control requires steps below the resolution of time, or below the minimum step.
    #[error("at t = {t:.6e} s even a time step of {step:.3e} s exceeds the tolerance")]
    StepTooSmall {
        /// Time, s.
        t: f64,
        /// Step length, s.
        step: f64,
    },
    /// The fixed step is unstable for the fastest motion, or for a state of a block.
    #[error("the time step of {step:e} s is unstable: the stability limit is {limit:.4e} s")]
    Unstable {
        /// Step length, s.
        step: f64,
        /// Longest stable step, s.
        limit: f64,
    },
    /// The value of a coordinate is no longer finite.
    #[error("at t = {t:.6e} s the motion of `{body}`, or the work on it, is not finite")]
    NotFinite {
        /// Time, s.
        t: f64,
        /// Name of the body.
        body: String,
    },
    /// The run has reached its limit of time steps.
    #[error("the limit of {limit} steps was reached at t = {t:.6e} s")]
    TooManySteps {
        /// Time, s.
        t: f64,
        /// Limit.
        limit: u64,
    },
    /// The run has reached its limit of events.
    #[error("the limit of {limit} events was reached at t = {t:.6e} s")]
    TooManyEvents {
        /// Time, s.
        t: f64,
        /// Limit.
        limit: u64,
    },
    /// Events of a contact accumulate (Zeno behaviour).
    #[error("events of contact `{contact}` accumulate at t = {t:.6e} s: {count} within {window:.3e} s")]
    Zeno {
        /// Time, s.
        t: f64,
        /// Name of the contact.
        contact: String,
        /// Number of events.
        count: u32,
        /// Length of the time window, s.
        window: f64,
    },
    /// Events of a block accumulate.
    #[error("events of block `{block}` accumulate at t = {t:.6e} s: {count} within {window:.3e} s")]
    Chatter {
        /// Time, s.
        t: f64,
        /// Name of the block.
        block: String,
        /// Number of events.
        count: u32,
        /// Length of the time window, s.
        window: f64,
    },
    /// Many attempted steps advance the time only slightly.
    #[error("at t = {t:.6e} s the last {attempts} time steps advanced the run by only {advance:.3e} s")]
    Crawl {
        /// Time, s.
        t: f64,
        /// Number of attempts.
        attempts: u64,
        /// Time advanced, s.
        advance: f64,
    },
    /// A contact cannot follow the motion.
    #[error("contact `{contact}` at t = {t:.6e} s: {source}")]
    Contact {
        /// Time, s.
        t: f64,
        /// Name of the contact.
        contact: String,
        /// Reason.
        source: ContactError,
    },
    /// No force balances the load on a quasi-static coordinate any more: gross slip, or lift-off.
    #[error(
        "no force balances {load:.3e} N along {} of `{body}` from t = {t:.15e} s on: {}",
        .axis.key(),
        held(*.load, *.limit)
    )]
    Unbalanced {
        /// Time, s.
        t: f64,
        /// Name of the body.
        body: String,
        /// Coordinate.
        axis: Axis,
        /// Load, N.
        load: f64,
        /// Limit of the contacts, N.
        limit: f64,
    },
    /// A block cannot follow its inputs.
    #[error("block `{block}` at t = {t:.6e} s: {why}")]
    Block {
        /// Time, s.
        t: f64,
        /// Name of the block.
        block: String,
        /// Reason, by the block.
        why: String,
    },
    /// The run has reached its limit of wall-clock time.
    #[error("the limit of {limit} s of wall time was reached at t = {t:.6e} s")]
    OutOfTime {
        /// Time, s.
        t: f64,
        /// Limit, s.
        limit: f64,
    },
    /// The requested time is before the present time.
    #[error("cannot advance from t = {t:.6e} s to the earlier time t = {until:.6e} s")]
    Backwards {
        /// Time, s.
        t: f64,
        /// Requested time, s.
        until: f64,
    },
    /// A run with this stepper cannot be paused and continued.
    #[error("a run with the stepper `{stepper}` cannot be advanced in parts")]
    NotHeld {
        /// Name of the stepper.
        stepper: &'static str,
    },
    /// An input has no value for the requested time.
    #[error(
        "input {input} has no value after t = {known:.6e} s, but the run was to advance to t = {until:.6e} s"
    )]
    InputMissing {
        /// Index of the waveform.
        input: usize,
        /// End of the known values, s.
        known: f64,
        /// Requested time, s.
        until: f64,
    },
    /// The watcher of the run requested to stop.
    #[error("interrupted at t = {t:.6e} s")]
    Interrupted {
        /// Time, s.
        t: f64,
    },
}

/// Relative difference below which load and limit are reported as one number.
const ALIKE: f64 = 1e-3;

/// Returns a text about the friction limit of the contacts, N. Load and limit may be equal, because gross slip begins at the limit.
fn held(load: f64, limit: f64) -> String {
    if (load.abs() - limit).abs() <= ALIKE * limit {
        "this is the friction limit of its contacts".to_owned()
    } else {
        format!("the friction limit of its contacts is {limit:.3e} N")
    }
}

impl RunError {
    /// Returns whether the run was halted between two steps and can continue: by the watcher, or by a limit of steps or wall-clock time.
    pub fn is_halt(&self) -> bool {
        matches!(self, Self::Interrupted { .. } | Self::OutOfTime { .. } | Self::TooManySteps { .. })
    }

    /// Returns a text that suggests a remedy.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::StepTooSmall { .. } => {
                "increase the tolerance, or check lengths, masses and stiffnesses for errors of orders of magnitude"
            }
            Self::Unstable { .. } => {
                "use a time step well below the limit, or the stepper event, which needs no time step"
            }
            Self::NotFinite { .. } => {
                "check the numbers for errors of orders of magnitude; `stickslip info` prints the largest stable time step"
            }
            Self::TooManySteps { .. } => "increase run.limits.steps or the tolerance, or shorten the run",
            Self::TooManyEvents { .. } => "increase run.limits.events or shorten the run",
            Self::Zeno { .. } | Self::Chatter { .. } | Self::Crawl { .. } => {
                "use another tolerance, or a stepper with a fixed time step, which locates no events"
            }
            Self::Contact { source: ContactError::Beyond { .. }, .. } => {
                "extend the profile to larger radii, or reduce the normal load"
            }
            Self::Contact { .. } => "increase the span of the row, or use the engine \"curve\"",
            Self::Unbalanced { .. } => {
                "reduce the load or increase the normal force; to simulate the motion after this, hold the body by a spring or make it \"free\" with a mass"
            }
            Self::Block { .. } => "see the message of the block",
            Self::OutOfTime { .. } => "increase run.limits.wall or shorten the run",
            Self::Backwards { .. } => "advance to a later time",
            Self::NotHeld { .. } => "use the stepper `event`, `verlet` or `rk4`",
            Self::InputMissing { .. } => "set the next value of the input before advancing",
            Self::Interrupted { .. } => "run the scenario again",
        }
    }
}
