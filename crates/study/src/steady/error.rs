//! Why no steady motion is found.

use super::never_slip;
use stickslip_drive::{RunError, SceneError};
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why no steady motion is found.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SteadyError {
    /// No waveform repeats itself.
    #[error("no waveform of the scene has a period: there is nothing to be steady with")]
    NoPeriod,
    /// A waveform that comes once and never ends.
    #[error("the waveform \"{0}\" neither has a period nor comes to an end")]
    Endless(String),
    /// A waveform that is whatever a caller says.
    #[error(
        "the waveform \"{0}\" follows what a caller commands: it has no period of its own\n   help: put a waveform with a period in its place"
    )]
    Commanded(String),
    /// Two waveforms whose periods have no common multiple worth the name.
    #[error(
        "the waveforms \"{first}\" and \"{second}\" have periods of {} s and {} s and no common period below {most} of the longer\n   help: give them periods in the ratio of small whole numbers",
        .periods[0], .periods[1]
    )]
    Incommensurate {
        /// Name of one.
        first: String,
        /// Name of the other.
        second: String,
        /// Their periods, s.
        periods: [f64; 2],
        /// Longest common period that is looked for, in the longer one.
        most: u32,
    },
    /// A motion without a step, where one is asked for.
    #[error(
        "there is no step{}\n   help: sensitivity tells figures of a run as well, without --steady and figures that begin with \"steady.\"",
        if *.least > 0.0 { format!(": it is less than {:.3e} m, which is what it may be off", .least) } else { String::new() }
    )]
    NoStep {
        /// How far the step may be off, m.
        least: f64,
    },
    /// All bodies are led or held.
    #[error(
        "nothing is free in this scene: its motion is what it is told, and steady from the second period on"
    )]
    NothingFree,
    /// A body may go on along z, or turn, for ever.
    #[error(
        "nothing holds the {axis} of \"{body}\": its motion goes on and on\n   help: let a contact press on it, or fix it"
    )]
    Drifts {
        /// Name of the body.
        body: String,
        /// z or pitch.
        axis: &'static str,
    },
    /// All contacts of the figures' body are open all through the period.
    #[error(
        "\"{body}\" is in the air all through the period: how far it flies is no step\n   help: press it on: by its weight, by a spring or a load along z"
    )]
    Flies {
        /// Name of the body.
        body: String,
        /// Periods that were computed.
        periods: u32,
    },
    /// The scene with waveforms that never end is none.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scenario with waveforms that never end is none.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A run stopped itself.
    #[error("a period could not be computed: {0}")]
    Run(#[from] RunError),
    /// It takes more steps than were allowed.
    #[error("no steady motion found within {steps} steps\n   help: allow more")]
    Costly {
        /// Most steps altogether.
        steps: u64,
    },
    /// Every period adds the same to a state.
    #[error(
        "no steady motion: each of {periods} periods in a row adds as much to {number}\n   help: what pulls may be more than friction holds, or the drive shakes at its own frequency what nothing damps: pull less, press harder, or damp it"
    )]
    Gains {
        /// The number to which most is added, in natural scales.
        number: String,
        /// How many.
        periods: u32,
    },
    /// The iteration did not end.
    #[error(
        "no steady motion found in {periods} periods: the best state comes back {best:.2e} natural lengths off\n   help: look at a plain run: it may repeat itself every second period, or never; start nearer, with a smaller stroke, or allow more periods"
    )]
    NoConvergence {
        /// Smallest defect, in natural scales.
        best: f64,
        /// Periods that were computed.
        periods: u32,
    },
    /// The same where a contact never slips grossly.
    #[error(
        "no steady motion found in {periods} periods: the best state comes back {best:.2e} natural lengths off\n   help: {}: what is held near a centre is held for ever, steady motions are a whole family (a shakedown), and a run comes near one of them slowly: look at a plain run, drive it further, so that all slip, or damp it",
        never_slip(contacts)
    )]
    Shakedown {
        /// Names of the contacts.
        contacts: Vec<String>,
        /// Smallest defect, in natural scales.
        best: f64,
        /// Periods that were computed.
        periods: u32,
    },
    /// Its caller has had enough.
    #[error("interrupted after {0} periods")]
    Interrupted(u32),
}
