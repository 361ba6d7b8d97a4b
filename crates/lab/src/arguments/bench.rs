//! The command line of a measurement.

use clap::Args;
use std::path::PathBuf;
use stickslip_bench::frames::FramesRequest;
use stickslip_bench::instructions::Counted;
use stickslip_bench::{Known, Request};
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Measure accuracy versus computing time of all steppers

The command runs a scenario with every stepper: event and dopri5 at tolerances from 1e-1 to 1e-12, rk4 and verlet at time steps that \
are halved repeatedly and end at corners. Each stepper runs on the exact curve and on rows of 64, 256 and 1 024 springs. Stepper, \
engines and output of the scenario have no effect. If a model is simple enough, these reference programs run it as well: \"loop\" and \
\"loop-rk4\", velocity Verlet and rk4 on half rows of 64 to 4 096 springs, in tuned separate code; \"exact-verlet\" and \
\"exact-rk4\", the same on the exact contact under constant load; \"ode_solvers\", Dopri5 of this crate with the exact contact and \
events located by hand; and \"floor-4\", \"floor-10\" and \"floor-16\", minimal code for P1 and similar drives, with this number of \
nodes.

An error is the largest error of any free coordinate, at the end or at any of 1 001 times of the run, relative to the stroke of the \
waveform (or to the largest travel, if no body follows a waveform). An angle counts as the displacement at the farthest contact \
point. The reference is the event stepper at a tolerance of 1e-14. Its difference from the same stepper at 1e-13 is reported.

Times are those of the run alone, without building and output: wall times, and processor times, which do not depend on the load of \
the machine. Plots and pages have processor times. With --instructions the page also has the instructions of the event stepper at \
1e-3, 1e-6 and 1e-9, counted by valgrind. All runs alternate in several rounds, and the shortest time counts. Runs that exceed the \
budget are left out with a note.

Writes OUT/NAME/bench.csv and work-precision.png (also dark, and as SVG), and the page given by --page. The page has the time of each \
stepper relative to the event stepper for the same error.

With --realtime the command measures frames in real time instead, with \"frames\" and \"event\" for each scenario: --frames frames of \
each --period in immediate succession, then --paced frames on a clock. Inputs change in every frame. The output has execution times \
and wake-up latency together with those of an empty loop, the worst frames with their events, counted work, overruns, and errors \
relative to the whole run. Writes OUT/frames.csv, worst_frames.csv, histograms.csv, accuracy.csv and frames.png (also dark, and as \
SVG), and the page given by --page.

Exit codes: 0 done, 2 bad input, 3 the reference cannot be computed or a file cannot be written, 130 interrupted.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip-lab bench drive.json
  stickslip-lab bench scenarios/p1.json scenarios/ruby_drive.json --budget \"5 min\"
  stickslip-lab bench scenarios/p1.json --out docs/performance --instructions --growth --page docs/performance.md
  stickslip-lab bench --realtime scenarios/p1.json scenarios/commanded.json --period \"20 us,50 us\" --frames 1e6
  stickslip-lab bench scenarios/p1.json --known p1:slider.x_m=1.00842862803207490e-5";

/// Most frames of a loop: days of computing.
const MOST_FRAMES: f64 = 1e12;

#[derive(Debug, Args)]
pub(crate) struct BenchArguments {
    /// Scenario files
    #[arg(required_unless_present = "growth", value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Folder of what is measured: NAME.json writes into OUT/NAME/
    #[arg(long, value_name = "OUT", default_value = "bench")]
    pub(crate) out: PathBuf,
    /// Wall time for each scenario, besides its reference
    #[arg(long, value_name = "TIME", default_value = "60 s", allow_hyphen_values = true, value_parser = seconds)]
    pub(crate) budget: f64,
    /// Put a value into every scenario, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = crate::arguments::assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// A coordinate at the end of scenario NAME that is known from elsewhere, SI: errors against it are told as well
    #[arg(long, value_name = "NAME:CHANNEL=VALUE", value_parser = known)]
    pub(crate) known: Vec<(String, Known)>,
    /// Count the instructions of the event stepper at 1e-3, 1e-6 and 1e-9 for the page, where valgrind is installed
    #[arg(long, requires = "page")]
    pub(crate) instructions: bool,
    /// Run the file once, for valgrind to count
    #[arg(long, hide = true, requires = "files")]
    pub(crate) counted: Option<Counted>,
    /// What more of something costs, too: springs, contacts, coordinates, simulated time, rows, memory; OUT/growth.csv and .png
    #[arg(long)]
    pub(crate) growth: bool,
    /// A page in Markdown with the tables and pictures of all scenarios
    #[arg(long, value_name = "FILE")]
    pub(crate) page: Option<PathBuf>,
    /// Draw the diagrams anew from OUT/NAME/bench.csv, without a measurement
    #[arg(long, requires = "files", conflicts_with_all = ["growth", "realtime", "page"])]
    pub(crate) redraw: bool,
    /// Measure frames in real time: how long they take, what happens in them, what they lose
    #[arg(long, requires = "files", conflicts_with_all = ["growth", "known", "budget", "instructions"])]
    pub(crate) realtime: bool,
    /// Lengths of the frames
    #[arg(long, value_name = "TIME,…", default_value = "20 us", value_delimiter = ',', requires = "realtime", allow_hyphen_values = true, value_parser = frame)]
    pub(crate) period: Vec<f64>,
    /// Frames of each loop that nothing paces, such as 1e7
    #[arg(long, value_name = "N", default_value = "1e6", requires = "realtime", allow_hyphen_values = true, value_parser = frames)]
    pub(crate) frames: u64,
    /// How long each loop after a clock goes on; 0 leaves them out
    #[arg(long, value_name = "TIME", default_value = "2 s", requires = "realtime", allow_hyphen_values = true, value_parser = not_negative)]
    pub(crate) paced: f64,
    /// No progress, no result; errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

impl BenchArguments {
    /// What is asked to be measured.
    pub(crate) fn request(&self) -> Request {
        Request {
            files: self.files.clone(),
            out: self.out.clone(),
            budget: self.budget,
            set: self.set.clone(),
            known: self.known.clone(),
            instructions: self.instructions,
            growth: self.growth,
            page: self.page.clone(),
        }
    }

    /// What is asked to be measured in real time.
    pub(crate) fn frames_request(&self) -> FramesRequest {
        FramesRequest {
            files: self.files.clone(),
            set: self.set.clone(),
            periods: self.period.clone(),
            frames: self.frames,
            paced: self.paced,
            out: self.out.clone(),
            page: self.page.clone(),
        }
    }
}

/// Reads a time above 0.
fn seconds(text: &str) -> Result<f64, String> {
    let value = quantity(text, "s")?;
    if value > 0.0 { Ok(value) } else { Err("expected a time above 0".to_owned()) }
}

/// Reads the length of a frame: a number without a unit is one of seconds, and would take for ever.
fn frame(text: &str) -> Result<f64, String> {
    let value = quantity(text, "s")?;
    let is_frame = value > 0.0 && value <= 1.0;
    if is_frame { Ok(value) } else { Err("expected a time above 0, up to 1 s, such as \"20 us\"".to_owned()) }
}

/// Reads a time not below 0.
fn not_negative(text: &str) -> Result<f64, String> {
    let value = quantity(text, "s")?;
    if value >= 0.0 { Ok(value) } else { Err("expected a time, 0 or above".to_owned()) }
}

/// Reads a number of frames, also as 1e7.
fn frames(text: &str) -> Result<u64, String> {
    let value: f64 = text.trim().parse().map_err(|_| format!("expected a number, got \"{text}\""))?;
    let is_number = (1.0..=MOST_FRAMES).contains(&value) && value.fract() == 0.0;
    if is_number {
        Ok(value as u64)
    } else {
        Err(format!("expected a whole number from 1 to {MOST_FRAMES:e}"))
    }
}

/// Splits `NAME:CHANNEL=VALUE`.
fn known(text: &str) -> Result<(String, Known), String> {
    let expected = || "expected NAME:CHANNEL=VALUE, such as p1:slider.x_m=1.0e-5".to_owned();
    let (name, rest) = text.split_once(':').ok_or_else(expected)?;
    let (channel, value) = rest.rsplit_once('=').ok_or_else(expected)?;
    let value: f64 = value.trim().parse().map_err(|_| format!("expected a number, got \"{value}\""))?;
    Ok((name.to_owned(), Known { channel: channel.to_owned(), value }))
}
