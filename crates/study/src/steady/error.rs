//! Errors of the search for a periodic orbit.

use super::never_slip;
use stickslip_drive::{RunError, SceneError};
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Reason why no periodic orbit is found.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SteadyError {
    /// No waveform has a period.
    #[error("no waveform has a period, so there is no periodic orbit")]
    NoPeriod,
    /// A waveform has neither a period nor an end.
    #[error("the waveform \"{0}\" has neither a period nor an end")]
    Endless(String),
    /// A calling program commands a waveform.
    #[error(
        "a calling program commands the waveform \"{0}\", so it has no period\n   help: replace it by a waveform with a period"
    )]
    Commanded(String),
    /// Two waveforms have no small common period.
    #[error(
        "the waveforms \"{first}\" and \"{second}\" have periods of {} s and {} s, but no common period below {most} of the longer ones\n   help: choose periods with a ratio of small integers",
        .periods[0], .periods[1]
    )]
    Incommensurate {
        /// Name of the first waveform.
        first: String,
        /// Name of the second waveform.
        second: String,
        /// Periods of both waveforms, s.
        periods: [f64; 2],
        /// Longest common period, as a multiple of the longer period.
        most: u32,
    },
    /// The orbit has no step, although a step is required.
    #[error(
        "there is no step{}\n   help: name results of a run, without --steady and results that begin with \"steady.\"",
        if *.least > 0.0 { format!(": it is below its error of {:.3e} m", .least) } else { String::new() }
    )]
    NoStep {
        /// Error of the step length, m.
        least: f64,
    },
    /// No coordinate is free.
    #[error(
        "no coordinate is free: waveforms prescribe the motion, which is periodic from the second period on"
    )]
    NothingFree,
    /// Nothing holds the z position or the pitch of a body.
    #[error(
        "no part holds the {axis} of \"{body}\", so its motion does not become periodic\n   help: add a contact, or make the coordinate \"fixed\""
    )]
    Drifts {
        /// Name of the body.
        body: String,
        /// Axis of the coordinate: `z` or `pitch`.
        axis: &'static str,
    },
    /// All contacts of the body named in `figures` are open during the whole period.
    #[error(
        "all contacts of \"{body}\" are open during the whole period, so its displacement is not a step\n   help: press the body against its contacts by gravity, a spring or a load along z"
    )]
    Flies {
        /// Name of the body.
        body: String,
        /// Number of simulated periods.
        periods: u32,
    },
    /// The model with endless waveforms is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scenario with endless waveforms is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A run stopped with an error.
    #[error("a period could not be simulated: {0}")]
    Run(#[from] RunError),
    /// The search needs more than the allowed number of time steps.
    #[error("no periodic orbit found within {steps} time steps\n   help: allow more")]
    Costly {
        /// Maximum number of time steps.
        steps: u64,
    },
    /// Every period adds the same amount to the state.
    #[error(
        "no periodic orbit: {number} increases by the same amount in each of {periods} consecutive periods\n   help: the load may exceed the friction limit, or the drive may excite an undamped resonance: reduce the load, increase the normal force, or add damping"
    )]
    Gains {
        /// Unknown with the largest increase, in natural scales.
        number: String,
        /// Number of periods.
        periods: u32,
    },
    /// The iteration did not converge.
    #[error(
        "no periodic orbit found in {periods} periods: after a period, the best state differs by {best:.2e} natural lengths\n   help: simulate a long run: its period may be several drive periods, or it may be irregular; start with a smaller stroke, or allow more periods"
    )]
    NoConvergence {
        /// Smallest defect, in natural scales.
        best: f64,
        /// Number of simulated periods.
        periods: u32,
    },
    /// The iteration did not converge, and some contacts never slip grossly.
    #[error(
        "no periodic orbit found in {periods} periods: after a period, the best state differs by {best:.2e} natural lengths\n   help: {}, so the periodic orbits are a family (shakedown), and a run converges slowly: simulate a long run, increase the stroke until all contacts slip, or add damping",
        never_slip(contacts)
    )]
    Shakedown {
        /// Names of the contacts.
        contacts: Vec<String>,
        /// Smallest defect, in natural scales.
        best: f64,
        /// Number of simulated periods.
        periods: u32,
    },
    /// The caller interrupted the search.
    #[error("interrupted after {0} periods")]
    Interrupted(u32),
}
