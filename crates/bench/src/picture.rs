//! The work-precision diagram of a scenario.

use crate::contestant::Stepping;
use crate::family::{Family, LOOPS, Method};
use crate::problem::Problem;
use stickslip_plot::{
    Dash, Figure, Ink, PlotError, Theme, WorkCurve, draw_png, draw_svg, work_precision_figure,
};
use stickslip_results::Job;
use stickslip_results::provenance;

/// Name of the picture's files, without ending.
pub const NAME: &str = "work-precision";

/// Series of one family.
struct Points {
    name: String,
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
    let error = format!("largest error, parts of {}", problem.norm.of);
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
            name: match family.method {
                Method::Own { springs: Some(n), .. } => format!("pale: on {n} springs"),
                method => method.title(),
            },
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
        let dash = |n: usize| match LOOPS.iter().position(|row| *row == n) {
            Some(0) => Dash::Dotted,
            Some(1) => Dash::DashDot,
            Some(2) => Dash::LongDash,
            _ => Dash::Solid,
        };
        let (ink, dash) = match self.method {
            Method::Own { stepping, springs: None } => (Ink::Palette(colour(stepping)), Dash::Solid),
            Method::Loop { springs } => (Ink::Palette(4), dash(springs)),
            Method::Outside => (Ink::Palette(5), Dash::Solid),
            Method::Own { stepping, springs: Some(n) } => (Ink::Pale(colour(stepping)), dash(n)),
        };
        WorkCurve {
            name: &self.name,
            error: &self.error,
            seconds: &self.seconds,
            evaluations: &self.evaluations,
            ink,
            dash,
        }
    }
}

fn colour(stepping: Stepping) -> usize {
    Stepping::ALL.iter().position(|other| *other == stepping).unwrap_or(0)
}
