//! The command line of a contact by itself.

use super::assignment;
use super::look::LookArguments;
use clap::Args;
use std::path::PathBuf;
use stickslip_contact::{NormalGiven, TangentialGiven};
use stickslip_run::theory::asked;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Solve a single contact without a run: constants, load histories, stresses

The command takes the materials, profile and friction coefficient of a contact from FILE. The normal load is the load in FILE \
at t = 0, unless an option gives another normal load. The motion of the bodies has no effect.

Prints the constants of the contact and a table of contact radius a, normal force F_N and stiffness over indentation d. A second \
table gives the universal curve of the first loading, tangential force F_x over relative stick radius c/a. F_x is computed in two \
ways: by superposition (4.38) and by an integral (4.39). Equation numbers refer to section 4.4 of the Handbook of Contact \
Mechanics (Popov, Heß, Willert 2019).

Two options together define a first loading. The normal option is --indentation, --radius or --force. The tangential option is \
--displacement, --stick-radius or --tangential. The command computes the other four quantities, the friction work and the energies.

--history moves the contact along a path with straight sections in d and u. If the first corner gives a normal load, the path \
starts at this corner without tangential force. Otherwise the path starts at u = 0 under the given normal load. With --history or \
--out, the command writes:
  history.csv    forces and energies along the path
  fields.csv     pressure, shear stress, displacement and slip over r at each corner
  line.csv       line loads, friction limits and stretches of the row of springs
  friction.csv   friction work over r
  normal.csv     normal force and contact radius over indentation
  universal.csv  first loading over c/a
  contact.json   constants and corners
  plots          PNG or SVG files

The command uses the exact memory curve even if the scenario selects a row of springs. All results are for one contact, even if \
\"count\" in the scenario is larger than 1. Exit codes: 0 done, 2 bad input, 3 a file cannot be written.";

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
    /// Name of the contact; required if the scenario has several contacts
    #[arg(long, value_name = "NAME")]
    pub(crate) contact: Option<String>,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    #[command(flatten)]
    pub(crate) pressed: PressedArguments,
    #[command(flatten)]
    pub(crate) pushed: PushedArguments,
    /// Corners of the load history, or a CSV file with one corner per row. A corner is u or F_x, or a pair of a normal and a tangential
    /// value, such as d : u
    #[arg(long, value_name = "CORNERS", allow_hyphen_values = true, conflicts_with = "pushed")]
    pub(crate) history: Option<String>,
    /// Folder for the output files [default: results/NAME-contact]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Also draw cycle.png, an animation of the springs along the last five sections of the history
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
