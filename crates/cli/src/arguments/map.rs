//! The command line of maps.

use super::look::LookArguments;
use super::threads::Work;
use super::{assignment, course};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Map a result over two parameters: contours; borders of stick, partial and gross slip

The command computes a result at the points of a grid over two parameters of a scenario, and draws a heat map with contours. A result \
is a path of summary.json, or a channel at the end of the run, as in `stickslip study`.

The result contacts.NAME.regime is the slip regime of a contact over the last period: open, stick, partial or gross. Borders between \
regimes are traced. Each point of a border is computed independently of the grid. If waveforms alone prescribe the motion of the \
contact, no run is needed: gross slip begins where the maximum of u-κd equals the minimum of u+κd over a period, with κ = μE*/G*. \
Otherwise, regimes are results of runs, and borders are exact to 1e-4 of the ranges.

Writes map.csv (x, y, result), map.json with the borders, and the plot map.png. The runs of the grid are kept in DIR/parts, one \
folder per map. The runs of traced borders are kept in map.journal until the map is complete. After an interruption, the same command \
computes the missing runs. Exit codes: 0 done; 2 bad input; 3 no point has a result, or a file cannot be written; 130 interrupted.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip map drive.json --x contacts.ball.friction=0.1..0.3 --y bodies.slider.mass=5g..50g --of steps.last_m
  stickslip map fretting.json --x contacts.ball.normal.force=1N..20N --y waveforms.drive.sine.amplitude=0..1um \\
    --of contacts.ball.regime --overlay measured.csv";

#[derive(Debug, Args)]
pub(crate) struct MapArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Parameter along the horizontal axis and its range, such as contacts.ball.normal.force=0.1N..10N
    #[arg(long, value_name = "PATH=FROM..TO", value_parser = course)]
    pub(crate) x: (String, String),
    /// Parameter along the vertical axis and its range
    #[arg(long, value_name = "PATH=FROM..TO", value_parser = course)]
    pub(crate) y: (String, String),
    /// Result: a path of summary.json, a channel at the end of the run, or contacts.NAME.regime
    #[arg(long, value_name = "RESULT")]
    pub(crate) of: String,
    /// Space the points of the horizontal axis in equal ratios
    #[arg(long)]
    pub(crate) log_x: bool,
    /// Space the points of the vertical axis in equal ratios
    #[arg(long)]
    pub(crate) log_y: bool,
    /// Number of points of the grid along each axis, such as 33 or 40x25 [default: 33; 5 for regimes that need runs]
    #[arg(long, value_name = "N|NxM", value_parser = points)]
    pub(crate) points: Option<[usize; 2]>,
    /// CSV table of measured points to draw over the map: columns x and y, or the paths; optionally a class of each point
    #[arg(long, value_name = "FILE")]
    pub(crate) overlay: Option<PathBuf>,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    #[command(flatten)]
    pub(crate) work: Work,
    /// Folder for the output files [default: results/NAME-map]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON, the content of map.json
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no warnings
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads numbers of points: one for both axes, or one for each.
fn points(text: &str) -> Result<[usize; 2], String> {
    let (x, y) = text.split_once('x').unwrap_or((text, text));
    let read = |part: &str| part.trim().parse().ok().filter(|count| (2..=1000).contains(count));
    let both = read(x).zip(read(y)).map(|(x, y)| [x, y]);
    both.ok_or_else(|| "expected a number of points from 2 to 1000, such as 33 or 40x25".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_of_one_axis_or_both() {
        assert_eq!((points("33"), points("40x25")), (Ok([33; 2]), Ok([40, 25])));
        assert!(["1", "33x", "x", "3x1001", "many"].iter().all(|text| points(text).is_err()));
    }
}
