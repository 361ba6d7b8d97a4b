//! Plot of a result over two parameters, with measured points.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MapContent, ResultMap, map_figure};
use stickslip_quantity::names::bare;
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_study::map::{Axis, Field, Map, Overlay};

/// Name of the plot.
const NAME: &str = "map";
/// Number of cells along both axes.
const CELLS: [usize; 2] = [288, 192];
/// Number of candidate positions of class names along both axes.
const SAMPLES: [usize; 2] = [30, 20];

/// Returns all possible file names of the plot.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&[NAME])
}

/// Draws a map.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw(
    (map, field): (&Map, &Field),
    overlay: Option<&Overlay>,
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, map.job.title().to_owned()),
        (PROGRAM, map.job.program.clone()),
        ("Map", map.of.clone()),
        (HASH, map.job.hash.clone()),
        (SCENARIO, map.job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance, kept: None };
    let axis = |axis: &'_ Axis| (axis.path.clone(), axis.unit, axis.is_logarithmic);
    let [x, y] = [&map.axes[0], &map.axes[1]].map(axis);
    let content = match &field.words {
        None => MapContent::Numbers {
            name: (bare(&map.of), map.unit),
            values: cells().map(|place| value(field, place)).collect(),
            contours: &field.contours,
        },
        Some(words) => MapContent::Words {
            words,
            classes: cells().map(|place| class(map, field, place).unwrap_or(words.len()) as u8).collect(),
            borders: field.borders.iter().map(|border| border.points.clone()).collect(),
            names: names(map, field),
        },
    };
    let places = [0, 1].map(|axis| map.axes[axis].values(CELLS[axis]));
    let points = overlay.map_or(&[][..], |overlay| overlay.classes.as_slice());
    let shown = ResultMap { axes: [(&x.0, x.1, x.2), (&y.0, y.1, y.2)], places, content, points };
    let title = format!("{}: {}", map.job.title(), bare(&map.of));
    pen.draw_as(NAME, map_figure(&title, shown)).map_err(|source| FigureError::Plot { plot: NAME, source })
}

/// Returns the positions of the cells as fractions of the axes, column by column.
fn cells() -> impl Iterator<Item = [f64; 2]> {
    let share = |k: usize, axis: usize| k as f64 / (CELLS[axis] - 1) as f64;
    (0..CELLS[0]).flat_map(move |i| (0..CELLS[1]).map(move |j| [share(i, 0), share(j, 1)]))
}

/// Returns the value by bilinear interpolation; NaN next to a grid point without a result.
fn value(field: &Field, place: [f64; 2]) -> f64 {
    let counts = [field.xs.len(), field.ys.len()];
    let along = [0, 1].map(|axis| place[axis] * (counts[axis] - 1) as f64);
    let from = [0, 1].map(|axis| (along[axis] as usize).min(counts[axis] - 2));
    let part = [0, 1].map(|axis| along[axis] - from[axis] as f64);
    let node = |i: usize, j: usize| {
        let weight = |step: usize, part: f64| if step == 0 { 1.0 - part } else { part };
        let weight = weight(i, part[0]) * weight(j, part[1]);
        // A point of weight 0 may have no result.
        if weight == 0.0 { 0.0 } else { weight * field.values[(from[0] + i) * counts[1] + from[1] + j] }
    };
    node(0, 0) + node(0, 1) + node(1, 0) + node(1, 1)
}

/// Returns the class of the grid point nearest to a position, changed at each border crossed from there. `None` without a result.
fn class(map: &Map, field: &Field, place: [f64; 2]) -> Option<usize> {
    let counts = [field.xs.len(), field.ys.len()];
    // Points on the rim may have a class without an area, such as stick at zero amplitude.
    let inner = |axis: usize, k: usize| if counts[axis] > 2 { k.clamp(1, counts[axis] - 2) } else { k };
    let nearest = [0, 1].map(|axis| inner(axis, (place[axis] * (counts[axis] - 1) as f64).round() as usize));
    let found = *field.values.get(nearest[0] * counts[1] + nearest[1])?;
    let node = [0, 1].map(|axis| nearest[axis] as f64 / (counts[axis] - 1) as f64);
    let mut here = found.is_finite().then_some(found as usize)?;
    for border in &field.borders {
        let shares: Vec<[f64; 2]> =
            border.points.iter().map(|point| [0, 1].map(|axis| map.axes[axis].share(point[axis]))).collect();
        let crossings = shares.windows(2).filter(|pair| crosses([node, place], [pair[0], pair[1]])).count();
        if crossings % 2 == 1 {
            let [lesser, greater] = border.between.map(|regime| regime as usize);
            here = if here == lesser { greater } else { lesser };
        }
    }
    Some(here)
}

/// Returns whether two line segments cross.
fn crosses([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0.0
    };
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

/// Returns the position of each class name: the sample of that class farthest from other classes and from the rim.
fn names(map: &Map, field: &Field) -> Vec<([f64; 2], usize)> {
    let place = |k: usize| {
        let [i, j] = [k / SAMPLES[1], k % SAMPLES[1]];
        [(i as f64 + 0.5) / SAMPLES[0] as f64, (j as f64 + 0.5) / SAMPLES[1] as f64]
    };
    let samples: Vec<_> =
        (0..SAMPLES[0] * SAMPLES[1]).map(|k| (place(k), class(map, field, place(k)))).collect();
    let room = |here: [f64; 2], own: usize| {
        let rim = [here[0], 1.0 - here[0], here[1], 1.0 - here[1]].into_iter().fold(1.0, f64::min);
        let others = samples.iter().filter(|(_, class)| *class != Some(own));
        let distance = |a: &[f64; 2]| ((a[0] - here[0]).powi(2) + (a[1] - here[1]).powi(2)).sqrt();
        others.map(|(other, _)| distance(other)).fold(2.0 * rim, f64::min)
    };
    let best = |own: usize| {
        let places = samples.iter().filter(|(_, class)| *class == Some(own)).map(|(place, _)| *place);
        places.max_by(|a, b| room(*a, own).total_cmp(&room(*b, own)))
    };
    let words = field.words.as_ref().map_or(0, Vec::len);
    let named = (0..words).filter_map(|class| Some((best(class)?, class)));
    named.map(|(at, class)| ([0, 1].map(|axis| map.axes[axis].at(at[axis])), class)).collect()
}
