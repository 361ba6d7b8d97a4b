//! The work–precision diagram of a scenario, drawn from the table of its runs.

use crate::norm;
use stickslip_plot::{Figure, PlotError, Theme, WorkCurve, draw_png, draw_svg, work_precision_figure};
use stickslip_run::Job;
use stickslip_run::provenance;

/// Name of the plot files without extension.
pub const NAME: &str = "work-precision";

/// Curves of the diagram: name, methods and contact engine. For each error, the best run of these methods counts.
const CURVES: [(&str, &[&str], &str); 6] = [
    ("event", &["event"], "curve"),
    ("rk4", &["rk4", "exact-rk4"], "curve"),
    ("verlet", &["verlet", "exact-verlet"], "curve"),
    ("dopri5", &["dopri5", "ode_solvers"], "curve"),
    ("springs", &["loop", "loop-rk4"], "springs"),
    ("frames", &["frames"], "curve"),
];

/// Draws the diagram as light and dark PNG and as SVG, from the text of `bench.csv`. Rows without a result are left out.
///
/// # Errors
/// A figure that cannot be drawn.
pub fn draw(job: &Job, table: &str) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let head = reader.headers().cloned().unwrap_or_default();
    let rows: Vec<csv::StringRecord> = reader.records().map_while(Result::ok).collect();
    let field = |row: &csv::StringRecord, name: &str| {
        let column = head.iter().position(|known| known == name);
        column.and_then(|column| row.get(column)).unwrap_or_default().to_owned()
    };
    let value = |row: &csv::StringRecord, name: &str| field(row, name).parse().unwrap_or(f64::NAN);
    let columns = CURVES.map(|(_, methods, engine)| {
        let is_own = |row: &&csv::StringRecord| {
            methods.contains(&field(row, "method").as_str()) && field(row, "engine") == engine
        };
        let own: Vec<&csv::StringRecord> = rows.iter().filter(is_own).collect();
        let column = |name: &str| own.iter().map(|row| value(row, name)).collect::<Vec<f64>>();
        let duration = job.scenario.plan.duration;
        let evaluations: Vec<f64> = column("evaluations").iter().map(|count| count / duration).collect();
        [column("trajectory_error"), column("processor_s_per_s"), evaluations]
    });
    let curves: Vec<WorkCurve<'_>> = CURVES
        .iter()
        .zip(&columns)
        .enumerate()
        .map(|(place, ((name, ..), [error, seconds, evaluations]))| WorkCurve {
            name,
            error,
            seconds,
            evaluations,
            place,
        })
        .collect();
    let error = if norm::stroke(&job.scenario.scene, job.scenario.figures).is_some() {
        "error / stroke"
    } else {
        "error / travel"
    };
    let mut figure = work_precision_figure(job.title(), error, &curves);
    figure.provenance = [
        (provenance::TITLE, job.title().to_owned()),
        (provenance::PROGRAM, job.program.clone()),
        (provenance::HASH, job.hash.clone()),
    ]
    .map(|(key, text)| (key.to_owned(), text))
    .to_vec();
    let dark = Figure { theme: Theme::dark(), ..figure.clone() };
    Ok(vec![
        (format!("{NAME}.png"), draw_png(&figure)?),
        (format!("{NAME}-dark.png"), draw_png(&dark)?),
        (format!("{NAME}.svg"), draw_svg(&figure)?.into_bytes()),
    ])
}
