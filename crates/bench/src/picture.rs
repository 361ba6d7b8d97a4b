//! The work-precision diagram of a scenario.

use crate::contestant::Stepping;
use crate::family::{Family, Method};
use crate::problem::Problem;
use stickslip_plot::{Figure, PlotError, Theme, WorkCurve, draw_png, draw_svg, work_precision_figure};
use stickslip_run::Job;
use stickslip_run::provenance;

/// Name of the picture's files, without ending.
pub const NAME: &str = "work-precision";

/// Series of one family.
struct Points {
    name: String,
    group: String,
    method: Method,
    error: Vec<f64>,
    seconds: Vec<f64>,
    evaluations: Vec<f64>,
}

/// Draws the diagram light, dark and as SVG.
pub(crate) fn draw(
    job: &Job,
    problem: &Problem,
    families: &[Family<'_>],
) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let points: Vec<Points> = families.iter().map(|family| Points::new(family, problem.duration)).collect();
    let curves: Vec<WorkCurve<'_>> = points.iter().map(Points::curve).collect();
    // Short: it stands along the height of a panel.
    let error = format!("error / {}", problem.norm.of.trim_start_matches("the ").replace('"', ""));
    let mut figure = work_precision_figure(job.title(), &error, &curves, Some(problem.doubt.trajectory));
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

impl Points {
    fn new(family: &Family<'_>, duration: f64) -> Self {
        let mut points = Self {
            name: family.method.name().to_owned(),
            group: group(family.method),
            method: family.method,
            error: Vec::new(),
            seconds: Vec::new(),
            evaluations: Vec::new(),
        };
        for (_, result) in family.measured() {
            points.error.push(result.errors.trajectory);
            points.seconds.push(result.cost.processor / duration);
            points.evaluations.push(result.counts.evaluations as f64 / duration);
        }
        points
    }

    fn curve(&self) -> WorkCurve<'_> {
        WorkCurve {
            name: &self.name,
            group: &self.group,
            error: &self.error,
            seconds: &self.seconds,
            evaluations: &self.evaluations,
            // The same in all panels.
            place: match self.method {
                Method::Own { stepping, .. } => colour(stepping),
                Method::Loop { staged, .. } => 4 + usize::from(staged),
                Method::Outside | Method::Floor { .. } => 6,
            },
        }
    }
}

/// What is compared beside each other: methods on the same contact.
fn group(method: Method) -> String {
    match method.springs() {
        None => "the exact contact".to_owned(),
        Some(springs) => format!("rows of {springs} springs"),
    }
}

fn colour(stepping: Stepping) -> usize {
    Stepping::ALL.iter().position(|other| *other == stepping).unwrap_or(0)
}
