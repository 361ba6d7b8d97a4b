//! The command line of a contact by itself.

use super::assignment;
use super::look::LookArguments;
use clap::Args;
use std::path::PathBuf;
use stickslip_contact::{NormalGiven, TangentialGiven};
use stickslip_run::theory::asked;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Solve one contact without a run: constants, curves, first loading, histories, stresses

Takes the materials, profile, friction and, by default, the normal load at t = 0 of a contact of FILE; bodies and waveforms do \
not matter. Prints its constants, F_N and a over d, and the universal curve of the first loading: F_x over c/a, by \
superposition (4.38) and by the integral (4.39). Equation numbers refer to the Handbook of Contact Mechanics (Popov, Heß, \
Willert 2019), section 4.4.

One of --indentation, --radius, --force with one of --displacement, --stick-radius, --tangential defines a first loading; the \
other four follow, with friction work and energies.

With --history or --out, files are written: history.csv (forces and energies along the path), fields.csv (pressure, shear \
stress, displacement, slip over r at each corner), line.csv (line loads, limits and stretches of the row of springs), \
friction.csv (friction work over r), normal.csv, universal.csv, contact.json and plots. A history is a polyline of d and u. If its first corner gives a normal load, the history starts there without tangential force, otherwise at u = 0 under the given load.

The exact curve of the profile is used, whatever engine the scenario names. All results are for one contact, even if its count \
is larger. Exit codes: 0 done, 2 bad input, 3 a file cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip contact drive.json
  stickslip contact drive.json --force \"10 N\" --tangential \"2 N\"
  stickslip contact drive.json --contact ball --radius \"40 um\" --stick-radius \"10 um\" --json
  stickslip contact drive.json --history \"30 nm, -30 nm, 10 nm\"           u at each corner
  stickslip contact drive.json --history \"1 N : 0 N, 5 N : 0.4 N, 2 N : 0.1 N\"  load : push
  stickslip contact drive.json --history path.csv --out here              columns d or fn, u or fx";

#[derive(Debug, Args)]
pub(crate) struct ContactArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Name of the contact; not needed if the scenario has only one
    #[arg(long, value_name = "NAME")]
    pub(crate) contact: Option<String>,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    #[command(flatten)]
    pub(crate) pressed: PressedArguments,
    #[command(flatten)]
    pub(crate) pushed: PushedArguments,
    /// Move the contact along these corners, each u or F_x, or a pair d : u; or along the rows of a CSV file
    #[arg(long, value_name = "CORNERS", allow_hyphen_values = true, conflicts_with = "pushed")]
    pub(crate) history: Option<String>,
    /// Folder of the files [default: results/NAME-contact]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Also draw cycle.png, an animation of the springs on the last five legs
    #[arg(long)]
    pub(crate) animate: bool,
    /// Print one line of JSON instead of tables; numbers that are not finite are null
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// How the contact is pressed.
#[derive(Debug, Args)]
#[group(id = "pressing", multiple = false)]
pub(crate) struct PressedArguments {
    /// Indentation d, such as "1 um"
    #[arg(long, value_name = "D", allow_hyphen_values = true, value_parser = length)]
    indentation: Option<f64>,
    /// Contact radius a, such as "40 um"
    #[arg(long, value_name = "A", allow_hyphen_values = true, value_parser = length)]
    radius: Option<f64>,
    /// Normal force F_N, such as "10 N"
    #[arg(long, value_name = "FN", allow_hyphen_values = true, value_parser = force)]
    force: Option<f64>,
}

/// How it is pushed sideways.
#[derive(Debug, Args)]
#[group(id = "pushed", multiple = false)]
pub(crate) struct PushedArguments {
    /// Displacement u, such as "50 nm"
    #[arg(long, value_name = "U", allow_hyphen_values = true, value_parser = length)]
    displacement: Option<f64>,
    /// Radius c of the stick zone
    #[arg(long, value_name = "C", allow_hyphen_values = true, value_parser = length)]
    stick_radius: Option<f64>,
    /// Tangential force F_x, such as "2 N"
    #[arg(long, value_name = "FX", allow_hyphen_values = true, value_parser = force)]
    tangential: Option<f64>,
}

impl PressedArguments {
    /// What is asked for; none: what the scenario says.
    pub(crate) fn given(&self) -> Option<NormalGiven> {
        let radius = self.radius.map(NormalGiven::Radius);
        self.indentation.map(NormalGiven::Indentation).or(radius).or(self.force.map(NormalGiven::Force))
    }
}

impl PushedArguments {
    /// What is asked for, if anything.
    pub(crate) fn given(&self) -> Option<TangentialGiven> {
        let displacement = self.displacement.map(TangentialGiven::Displacement);
        let radius = self.stick_radius.map(TangentialGiven::StickRadius);
        displacement.or(radius).or(self.tangential.map(TangentialGiven::Force))
    }
}

fn length(text: &str) -> Result<f64, String> {
    asked(text, "m")
}

fn force(text: &str) -> Result<f64, String> {
    asked(text, "N")
}
