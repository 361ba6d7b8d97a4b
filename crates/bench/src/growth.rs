//! Scaling of the run time with springs, contacts, coordinates, simulated time, rows and memory.
//!
//! The model is the benchmark drive P1 with one size increased, computed by the event stepper at 1e-6. Rows of springs are computed by
//! velocity Verlet, which visits all springs in every step. All sizes are measured alternately, and the minimum of all rounds counts.

mod kinds;
mod scenes;

use crate::clock::{Stopwatch, Times};
use crate::error::BenchError;
use kinds::Kind;
use std::path::Path;
use stickslip_drive::{Counts, Model, Plan, RunError, State};
use stickslip_plot::{Figure, GrowthCurve, PlotError, Theme, draw_png, draw_svg, growth_figure};
use stickslip_run::Unrecorded;
use stickslip_run::Watcher;
use stickslip_run::folder::Folder;
use stickslip_run::program::this_program;
use stickslip_run::provenance;

/// Name of the table.
pub const TABLE: &str = "growth.csv";
/// Name of the plot files without extension, also used in messages.
pub const PICTURE: &str = "growth";
/// Number of rounds.
pub const TURNS: u32 = 9;
/// Target time of a round of one size, s; runs are repeated accordingly.
const TURN: f64 = 4e-3;
/// Axis label of the costs.
const COST: &str = "time per simulated second";

/// Measurement of one size.
struct Point {
    /// Size: number of springs, contacts or coordinates, or another increased quantity.
    size: f64,
    model: Model,
    plan: Plan,
    /// State at the start of the measurement.
    start: State,
    /// Simulated time of the measurement, s.
    span: f64,
    cost: Times,
    times: u32,
    counts: Counts,
}

/// Measurements of all sizes of one kind.
struct Curve {
    kind: Kind,
    points: Vec<Point>,
}

/// Runs the benchmark and writes `growth.csv` and the plot into a folder. The watcher receives the number of finished rounds, of
/// [`TURNS`].
///
/// # Errors
/// A run that fails, a file that cannot be written, or an interruption by the watcher.
pub fn measure(out: &Path, watcher: &dyn Watcher) -> Result<(), BenchError> {
    let stopped = |error: RunError| match error {
        RunError::Interrupted { .. } => BenchError::Interrupted(PICTURE.to_owned()),
        error => BenchError::Stopped { name: PICTURE.to_owned(), why: error.to_string() },
    };
    let wrong = |why: String| BenchError::Stopped { name: PICTURE.to_owned(), why };
    let mut curves = Vec::new();
    for kind in Kind::ALL {
        curves.push(Curve { kind, points: kind.points().map_err(wrong)? });
    }
    for turn in 0..TURNS {
        for point in curves.iter_mut().flat_map(|curve| &mut curve.points) {
            point.turn(turn, watcher).map_err(stopped)?;
        }
        watcher.reached(f64::from(turn + 1));
    }
    let pictures =
        draw(&curves).map_err(|source| BenchError::Picture { name: PICTURE.to_owned(), source })?;
    let failed = |source| BenchError::File { path: out.to_owned(), source };
    let mut folder = Folder::make(out).map_err(failed)?;
    folder.write(TABLE, table(&curves).as_bytes()).map_err(failed)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes)).map_err(failed)?;
    folder.publish().map_err(failed)
}

impl Point {
    /// Returns a measurement that starts at t = 0.
    fn new(size: f64, model: Model, plan: Plan) -> Result<Self, String> {
        let start = model.start(&plan).map_err(|error| error.to_string())?;
        Ok(Self::from(size, model, plan, start))
    }

    /// Returns a measurement that starts from a state.
    fn from(size: f64, model: Model, plan: Plan, start: State) -> Self {
        let span = plan.duration - start.time();
        let cost = Times { processor: f64::INFINITY, wall: f64::INFINITY };
        Self { size, model, plan, start, span, cost, times: 1, counts: Counts::default() }
    }

    fn turn(&mut self, turn: u32, watcher: &dyn Watcher) -> Result<(), RunError> {
        let mut states = vec![self.start.clone(); self.times as usize];
        let watch = Stopwatch::start();
        for state in &mut states {
            stickslip_drive::run(&self.model, &self.plan, state, &mut Unrecorded(watcher))?;
        }
        self.cost = self.cost.shorter(watch.each(self.times));
        if let (0, Some(end)) = (turn, states.last()) {
            let (now, then) = (end.counts(), self.start.counts());
            self.counts = Counts {
                steps: now.steps - then.steps,
                rejected: now.rejected - then.rejected,
                evaluations: now.evaluations - then.evaluations,
                events: now.events - then.events,
                detours: now.detours - then.detours,
                missed: now.missed - then.missed,
            };
            self.times = (TURN / self.cost.wall).clamp(1.0, 100.0) as u32;
        }
        Ok(())
    }

    fn per_second(&self) -> f64 {
        self.cost.processor / self.span
    }
}

fn table(curves: &[Curve]) -> String {
    let mut text =
        "what,size,processor_s_per_s,wall_s_per_s,simulated_s,evaluations,steps,rejected,events\n".to_owned();
    for curve in curves {
        for point in &curve.points {
            let counts = point.counts;
            text += &format!(
                "{},{},{:e},{:e},{:e},{},{},{},{}\n",
                curve.kind.key(),
                point.size,
                point.per_second(),
                point.cost.wall / point.span,
                point.span,
                counts.evaluations,
                counts.steps,
                counts.rejected,
                counts.events,
            );
        }
    }
    text
}

/// Draws the plot as light and dark PNG and as SVG.
fn draw(curves: &[Curve]) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let series: Vec<(Vec<f64>, Vec<f64>)> = curves
        .iter()
        .map(|curve| curve.points.iter().map(|point| (point.size, point.per_second())).unzip())
        .collect();
    let curves: Vec<GrowthCurve<'_>> = curves
        .iter()
        .zip(&series)
        .map(|(curve, (sizes, costs))| {
            let (name, unit) = curve.kind.words();
            let per_size = unit == "s";
            GrowthCurve { name, unit, sizes, costs, per_size }
        })
        .collect();
    let mut figure = growth_figure("Run time of P1 versus the size of the model", COST, &curves);
    figure.provenance = vec![(provenance::PROGRAM.to_owned(), this_program())];
    let dark = Figure { theme: Theme::dark(), ..figure.clone() };
    Ok(vec![
        (format!("{PICTURE}.png"), draw_png(&figure)?),
        (format!("{PICTURE}-dark.png"), draw_png(&dark)?),
        (format!("{PICTURE}.svg"), draw_svg(&figure)?.into_bytes()),
    ])
}
