//! Why there is no fit.

use stickslip_run::Refusal;
use stickslip_run::measured::MeasuredError;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why there is no fit.
#[derive(Debug, Error)]
pub enum FitError {
    /// The scenario.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A number of it.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The data.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// No number.
    #[error("--free  expected key paths of numbers, such as contacts.ball.friction")]
    Nothing,
    /// A number without a value.
    #[error("--free  {0} is left out in the scenario: write down a value that the fit can begin with")]
    LeftOut(String),
    /// A contact.
    #[error("--contact  expected the name of one of the contacts: {0}")]
    Contact(String),
    /// A channel.
    #[error("there is no channel {wanted}; there are {known}")]
    Channel {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
    /// A contact whose load is not constant.
    #[error(
        "contact {0} has no constant load: it is not led by its displacement alone\n   help: name a channel of a body that leads it, such as --displacement disp=rig.x"
    )]
    Load(String),
    /// Numbers that the data do not tell.
    #[error("the data cannot tell apart: {}\n   help: free one of them less; a loop at constant load tells the limit force \u{3bc}F_N and the stiffness 2G*a, and no more", groups(.0))]
    Undetermined(Vec<Vec<String>>),
    /// A variant that cannot be run, at the numbers that the scenario has.
    #[error("the scenario cannot be computed along the data: {0}")]
    Variant(String),
    /// A search without an end.
    #[error("no numbers fit the data: the search came to no end\n   help: begin nearer, with --set")]
    NoFit,
    /// A channel that says nothing.
    #[error("{0}: its {1} are constant: there is nothing to fit to")]
    Constant(String, &'static str),
    /// Whoever asked wants no more.
    #[error("interrupted")]
    Interrupted,
    /// Too few rows.
    #[error("{0} rows are too few to fit {1} numbers")]
    Few(usize, usize),
}

fn groups(groups: &[Vec<String>]) -> String {
    let one = |group: &Vec<String>| match group.as_slice() {
        [only] => format!("{only}, which changes nothing in them"),
        group => group.join(" and "),
    };
    groups.iter().map(one).collect::<Vec<_>>().join("; ")
}
