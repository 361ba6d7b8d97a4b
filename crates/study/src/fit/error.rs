//! Errors of a fit.

use stickslip_run::Refusal;
use stickslip_run::measured::MeasuredError;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Reason why a fit fails.
#[derive(Debug, Error)]
pub enum FitError {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A parameter of the scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The data cannot be read or evaluated.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// There are no free parameters.
    #[error("--free  expected key paths of numbers, such as contacts.ball.friction")]
    Nothing,
    /// A free parameter has no value in the scenario.
    #[error("--free  {0} has no value in the scenario: write an initial value for the fit into the scenario")]
    LeftOut(String),
    /// The contact does not exist or is ambiguous.
    #[error("--contact  expected the name of one of the contacts: {0}")]
    Contact(String),
    /// The channel does not exist.
    #[error("there is no channel {wanted}; channels: {known}")]
    Channel {
        /// Requested channel.
        wanted: String,
        /// Available channels.
        known: String,
    },
    /// The load of the contact is not constant.
    #[error(
        "the load of contact {0} is not constant, so its displacement does not determine its loop\n   help: name the displacement channel of a body, such as --displacement disp=rig.x"
    )]
    Load(String),
    /// The data cannot distinguish the parameters.
    #[error("the data cannot distinguish {}\n   help: remove one of them from --free; a loop at constant load determines only the friction limit \u{3bc}F_N and the stiffness 2G*a", groups(.0))]
    Undetermined(Vec<Vec<String>>),
    /// The scenario cannot be simulated along the data at the initial values.
    #[error("the scenario cannot be simulated along the data: {0}")]
    Variant(String),
    /// The fit did not converge.
    #[error("the fit did not converge\n   help: set initial values nearer to the solution with --set")]
    NoFit,
    /// A channel is constant.
    #[error("{0}: its {1} are constant, so there is no loop to fit")]
    Constant(String, &'static str),
    /// The caller interrupted the fit.
    #[error("interrupted")]
    Interrupted,
    /// There are too few rows.
    #[error("{0} rows are too few to fit {1} parameters")]
    Few(usize, usize),
}

fn groups(groups: &[Vec<String>]) -> String {
    let one = |group: &Vec<String>| match group.as_slice() {
        [only] => format!("{only}, which has no effect on them"),
        group => group.join(" and "),
    };
    groups.iter().map(one).collect::<Vec<_>>().join("; ")
}
