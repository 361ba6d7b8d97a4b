//! Plot of an optimum: the result along each parameter through the optimum.

use super::pictured;
use crate::look::{Look, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MachineCourse, MachineCurve, MachineLine};
use stickslip_quantity::names;
use stickslip_run::Job;
use stickslip_study::optimum::Section;

/// Name of the picture.
pub const NAME: &str = "optimum";

/// Draws the sections through an optimum over the distance from it, relative to the range of each parameter.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw<'a>(
    job: &Job,
    result: &'a str,
    sections: &'a [Section],
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let mut values: Vec<f64> = sections.iter().flat_map(Section::distances).map(|(x, _)| x).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let line = |section: &'a Section| MachineLine {
        name: &section.name,
        values: values.iter().map(|x| at(&section.distances(), *x)).collect(),
        spreads: vec![0.0; values.len()],
    };
    let course = MachineCourse {
        name: names::bare(result),
        unit: names::unit(result),
        lines: sections.iter().map(line).collect(),
    };
    let machine = MachineCurve {
        axis: ("distance from the optimum relative to the range", ""),
        logarithmic: false,
        values: &values,
        present: None,
        landmarks: Vec::new(),
        courses: vec![course],
        faults: Vec::new(),
    };
    pictured((job, NAME), (NAME, &format!("{}: sections through the optimum", job.title())), &machine, look)
}

/// Returns a section by linear interpolation; NaN outside its range.
fn at(points: &[(f64, f64)], x: f64) -> f64 {
    let within = |pair: &&[(f64, f64)]| pair[0].0 <= x && x <= pair[1].0;
    let between = |pair: &[(f64, f64)]| {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        y0 + (y1 - y0) * ((x - x0) / (x1 - x0))
    };
    points.windows(2).find(within).map_or(f64::NAN, between)
}
