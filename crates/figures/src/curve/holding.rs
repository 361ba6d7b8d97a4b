//! Plot of holding forces.

use super::{drawn, lanes, warnings};
use crate::look::{Look, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MachineCourse, MachineCurve, MachineLine};
use stickslip_study::curve::holding::{Holding, NAME, Point};

/// Draws the holding forces for loads along +x and -x, as one curve if they are equal.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw(
    (holding, points): (&Holding, &[Point]),
    logarithmic: bool,
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let values: Vec<f64> = points.iter().map(|point| point.value).collect();
    let machine = MachineCurve {
        axis: (&holding.variation.name, holding.variation.unit),
        logarithmic,
        values: &values,
        present: holding.variation.present,
        landmarks: Vec::new(),
        courses: vec![MachineCourse { name: "holding force", unit: "N", lines: lines(points) }],
        faults: faults(points),
    };
    let done = points.iter().filter(|point| point.is_done()).count();
    drawn((&holding.job, NAME), ((done, points.len()), done < points.len()), &machine, look)
}

fn lines(points: &[Point]) -> Vec<MachineLine<'static>> {
    let line = |name, way: usize| MachineLine {
        name,
        values: points.iter().map(|p| p.ways[way].as_ref().map_or(f64::NAN, |held| held.force)).collect(),
        spreads: vec![0.0; points.len()],
    };
    match points.iter().all(Point::is_alike) {
        true => vec![line("", 0)],
        false => vec![line("load along +x", 0), line("load along \u{2212}x", 1)],
    }
}

/// Returns the values without a holding force and values with warnings, grouped by reason.
fn faults(points: &[Point]) -> Vec<(String, Vec<f64>)> {
    let kinds = points.iter().flat_map(|point| {
        point.ways.iter().filter_map(|way| Some((point.value, way.as_ref().err()?.kind().to_owned())))
    });
    lanes(kinds.chain(warnings(points.iter().map(|point| (point.value, point.warnings.as_slice())))))
}
