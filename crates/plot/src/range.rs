//! Range of the values that an axis shows.

use crate::panel::{Panel, Reference, Shape, is_drawable};

/// Largest magnitude that is drawn, so that differences and squares stay finite.
pub(crate) const LARGEST: f64 = 1e150;
/// Smallest span and magnitude that are distinguished from zero.
const SMALLEST: f64 = 1e-150;
/// Spans below this fraction of the magnitude are rounding errors: the series is constant.
const ROUND_OFF: f64 = 1e-13;
/// Half-range shown around a constant value, as a fraction of the value.
const AROUND_CONSTANT: f64 = 0.05;

/// Smallest and largest value; `None` without values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Extent(Option<(f64, f64)>);

impl Extent {
    fn include(&mut self, value: f64) {
        let (low, high) = self.0.unwrap_or((value, value));
        self.0 = Some((low.min(value), high.max(value)));
    }

    pub(crate) fn union(self, other: Self) -> Self {
        match (self.0, other.0) {
            (Some((a, b)), Some((c, d))) => Self(Some((a.min(c), b.max(d)))),
            (some, none) => Self(some.or(none)),
        }
    }

    /// Returns whether all values are 0, within the smallest magnitude.
    pub(crate) fn is_nothing(self) -> bool {
        self.0.is_some_and(|(low, high)| low.abs().max(high.abs()) <= SMALLEST)
    }

    /// Returns the axis range with margins on both sides, never of zero width; `None` without values.
    pub(crate) fn range(self, margin: f64) -> Option<(f64, f64)> {
        let (low, high) = self.0?;
        let size = low.abs().max(high.abs());
        if high - low <= (ROUND_OFF * size).max(SMALLEST) {
            let centre = low / 2.0 + high / 2.0;
            let half = (1.0 + 2.0 * margin) * if size <= SMALLEST { 1.0 } else { AROUND_CONSTANT * size };
            return Some((centre - half, centre + half));
        }
        Some((low - margin * (high - low), high + margin * (high - low)))
    }
}

/// Returns the ranges of a panel in x and y in axis coordinates, including reference lines. Points that cannot be drawn are ignored.
pub(crate) fn extents(panel: &Panel<'_>) -> (Extent, Extent) {
    let (mut x, mut y) = (Extent::default(), Extent::default());
    for point in panel.series.iter().flat_map(|series| panel.points(series).flatten()) {
        x.include(point.0);
        y.include(point.1);
    }
    for corner in panel.shapes.iter().flat_map(Shape::drawable) {
        x.include(corner.0);
        y.include(corner.1);
    }
    for (place, low, high) in panel.bands.iter().flat_map(|band| panel.columns(band).flatten()) {
        x.include(place);
        y.include(low);
        y.include(high);
    }
    if let Some(mosaic) = &panel.mosaic {
        mosaic.column_edges(&panel.x).into_iter().for_each(|edge| x.include(edge));
        mosaic.row_edges(&panel.y).into_iter().for_each(|edge| y.include(edge));
    }
    for mark in panel.lanes.iter().flat_map(|lane| &lane.marks) {
        let ends = [mark.from, mark.to].map(|end| panel.x.measure(end));
        ends.into_iter().filter(|&end| is_drawable(end)).for_each(|end| x.include(end));
    }
    for (extent, axis) in [(&mut x, &panel.x), (&mut y, &panel.y)] {
        let ends = axis.covers.into_iter().flat_map(|(from, to)| [axis.measure(from), axis.measure(to)]);
        ends.filter(|&end| is_drawable(end)).for_each(|end| extent.include(end));
    }
    for reference in &panel.references {
        let (extent, value) = match reference {
            Reference::Horizontal { y: value, .. } => (&mut y, panel.y.measure(*value)),
            Reference::Vertical { x: value, .. } => (&mut x, panel.x.measure(*value)),
        };
        if is_drawable(value) {
            extent.include(value);
        }
    }
    (x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(values: &[f64]) -> Option<(f64, f64)> {
        let mut extent = Extent::default();
        values.iter().for_each(|&v| extent.include(v));
        extent.range(0.0)
    }

    #[test]
    fn every_extent_has_width() {
        assert_eq!(range(&[]), None);
        assert_eq!(range(&[1.0, -3.0]), Some((-3.0, 1.0)));
        assert_eq!(range(&[0.0]), Some((-1.0, 1.0)));
        assert_eq!(range(&[5e-324]), Some((-1.0, 1.0)));
        assert_eq!(range(&[2.0]), Some((1.9, 2.1)));
        // Rounding errors of a constant are not resolved.
        let (low, high) = range(&[1.0, 1.0 + f64::EPSILON]).unwrap();
        assert!(high - low > 0.09);
        let (low, high) = range(&[-LARGEST, LARGEST]).unwrap();
        assert!((high - low).is_finite());
    }
}
