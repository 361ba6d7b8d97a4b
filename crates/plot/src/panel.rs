//! Panel: axes and the data between them.

use crate::{Ink, Label, PlotError, Style};
use std::borrow::Cow;

/// One pair of axes with its data. Drawn from back to front: mosaic, grid, bands, shapes, reference lines, series, notes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel<'a> {
    /// Heading above the frame; empty for none.
    pub heading: Label,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Coloured cells that fill the frame.
    pub mosaic: Option<Mosaic<'a>>,
    /// Filled areas between curves; later ones are drawn on top.
    pub bands: Vec<Band<'a>>,
    /// Filled polygons; later ones are drawn on top.
    pub shapes: Vec<Shape>,
    /// Curves; later ones are drawn on top.
    pub series: Vec<Series<'a>>,
    /// Reference lines, drawn behind the series. The axis range includes them.
    pub references: Vec<Reference>,
    /// Texts inside the frame, in order of decreasing importance. A panel with notes has no grid.
    pub notes: Vec<Note>,
    /// Rows of marks, from top to bottom. Their names replace the y axis. A panel with lanes shows no other data
    /// except vertical reference lines.
    pub lanes: Vec<Lane>,
    /// Message if there is no data; "no data" if empty.
    pub absence: Label,
    /// Second horizontal axis in other units, above the frame.
    pub top: Option<Rescaled>,
    /// Second vertical axis in other units, right of the frame.
    pub right: Option<Rescaled>,
    /// Range of the horizontal axis that another panel enlarges; drawn as a shaded stretch.
    pub enlarged: Option<(f64, f64)>,
    /// Ratio of width to height of the frame. `None`: the frame fills the available area.
    pub aspect: Option<f64>,
    /// Relative size among the panels; values not above 0 count as 1.
    pub share: f64,
}

/// Axis, whose range covers the data and the reference lines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// Name of the quantity, without unit.
    pub label: Label,
    /// Unit of the data, such as "m"; empty if dimensionless. The prefix follows from the range.
    pub unit: String,
    /// Whether the axis ends at the data, without margin.
    pub tight: bool,
    /// Two values that the axis range always includes.
    pub covers: Option<(f64, f64)>,
    /// Whether ticks and numbers are omitted, for drawings that are not to scale.
    pub unnumbered: bool,
    /// Whether the axis is logarithmic. Values not above 0 are then gaps. Allowed for series, bands, lanes, reference
    /// lines, and mosaics at positions above 0.
    pub logarithmic: bool,
}

/// Second, dimensionless axis that shows the same values divided by a constant.
#[derive(Debug, Clone, PartialEq)]
pub struct Rescaled {
    /// Name of the dimensionless quantity.
    pub label: Label,
    /// Divisor, in the unit of the axis. The second axis is omitted if the divisor is not above 0.
    pub by: f64,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Series<'a> {
    /// Name in the legend; empty for none.
    pub label: Label,
    /// Horizontal values, in the unit of the axis.
    pub xs: Cow<'a, [f64]>,
    /// Vertical values, one per horizontal value. Points that are not finite or beyond ±1e150 are gaps.
    pub ys: Cow<'a, [f64]>,
    /// Colour, dashes and line width.
    pub style: Style,
    /// Whether every point has a marker.
    pub marked: bool,
    /// Whether arrowheads show the direction in which the points follow each other.
    pub directed: bool,
}

/// Area between two curves over the same horizontal values.
#[derive(Debug, Clone, PartialEq)]
pub struct Band<'a> {
    /// Name in the legend; empty for none.
    pub label: Label,
    /// Horizontal values, in the unit of the axis, ascending.
    pub xs: Cow<'a, [f64]>,
    /// Values of the first edge, one per horizontal value. Points that are not finite or beyond ±1e150 are gaps.
    pub low: Cow<'a, [f64]>,
    /// Values of the second edge, one per horizontal value. The edges may cross.
    pub high: Cow<'a, [f64]>,
    /// Colour.
    pub ink: Ink,
}

/// A filled polygon.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Name in the legend; empty for none.
    pub label: Label,
    /// Corners, in the units of the axes. Corners that are not finite or beyond ±1e150 are left out.
    pub corners: Vec<(f64, f64)>,
    /// Colour.
    pub ink: Ink,
}

/// Text inside the frame that names a point or a part of the drawing. The note takes the nearest position without overlap with lines and
/// other notes, if possible also off foreign shapes. A pointer connects distant notes to the part that they name. A note without a free
/// position is left out and counted.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// Lines of the text.
    pub lines: Vec<Label>,
    /// Two opposite corners of the named part, in the units of the axes.
    pub about: [(f64, f64); 2],
    /// Index of the shape in [`Panel::shapes`] that the note may cover.
    pub on: Option<usize>,
    /// Ink of the named part, which the text takes, mixed with the usual text colour. `None`: the usual text colour.
    pub ink: Option<Ink>,
}

/// Cells of a few classes, such as the states of springs over time. Cell borders lie midway between neighbouring
/// positions. The first and the last column end at their positions; the outer rows extend equally to both sides of
/// their positions. A pixel that contains several cells shows their colours mixed by area.
#[derive(Debug, Clone, PartialEq)]
pub struct Mosaic<'a> {
    /// Positions of the columns, in the unit of the x axis, ascending.
    pub xs: Cow<'a, [f64]>,
    /// Positions of the rows, in the unit of the y axis, ascending.
    pub ys: Cow<'a, [f64]>,
    /// Class of each cell, column by column.
    pub cells: Cow<'a, [u8]>,
    /// Name in the legend and colour of each class; at most 256 classes.
    pub classes: Vec<(Label, Ink)>,
}

/// Row of marks with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Lane {
    /// Name left of the lane, wrapped and shrunk where necessary.
    pub label: String,
    /// Text right of the lane, such as a count.
    pub note: String,
    /// Marks of the lane.
    pub marks: Vec<Mark>,
    /// Colour.
    pub ink: Ink,
}

/// Mark in a lane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// Start, in the unit of the axis.
    pub from: f64,
    /// End, in the unit of the axis. A mark narrower than a line is drawn as a line.
    pub to: f64,
    /// Height as a fraction of the lane height, 0 to 1.
    pub height: f64,
}

/// Straight reference line across a panel.
#[derive(Debug, Clone, PartialEq)]
pub enum Reference {
    /// Horizontal line.
    Horizontal {
        /// Vertical value, in the unit of the axis.
        y: f64,
        /// Name in the legend; empty for none. Lines with the same name share an entry.
        label: Label,
    },
    /// Vertical line.
    Vertical {
        /// Horizontal value, in the unit of the axis.
        x: f64,
        /// Name in the legend; empty for none. Lines with the same name share an entry.
        label: Label,
    },
}

impl Axis {
    /// Creates a linear axis with margins.
    pub fn new(label: Label, unit: &str) -> Self {
        Self { label, unit: unit.to_owned(), ..Self::default() }
    }

    /// Returns the coordinate along the axis: the value, or its decimal logarithm.
    pub(crate) fn measure(&self, value: f64) -> f64 {
        if self.logarithmic { math::log10(value) } else { value }
    }
}

impl Reference {
    /// Returns the name of the line in the legend.
    pub(crate) fn label(&self) -> &Label {
        match self {
            Self::Horizontal { label, .. } | Self::Vertical { label, .. } => label,
        }
    }
}

impl Panel<'_> {
    /// Returns the index of a reference line's name among the names in the panel; it selects the line style. 0 for lines without a name.
    pub(crate) fn place_of(&self, reference: &Reference) -> usize {
        let mut names: Vec<&Label> = Vec::new();
        for label in self.references.iter().map(Reference::label).filter(|label| !label.is_empty()) {
            if !names.contains(&label) {
                names.push(label);
            }
        }
        names.iter().position(|label| *label == reference.label()).unwrap_or(0)
    }

    /// Returns whether the panel has no data.
    pub(crate) fn is_empty(&self) -> bool {
        let series = self.series.iter().all(|series| self.points(series).flatten().next().is_none());
        let bands = self.bands.iter().all(|band| self.columns(band).flatten().next().is_none());
        let mosaic = self.mosaic.as_ref().is_none_or(|mosaic| mosaic.cells.is_empty());
        series && bands && mosaic && self.shapes.is_empty() && self.lanes.is_empty()
    }

    /// Returns the points of a series in axis coordinates; `None` for a gap.
    pub(crate) fn points<'p>(
        &'p self,
        series: &'p Series<'_>,
    ) -> impl Iterator<Item = Option<(f64, f64)>> + 'p {
        series.xs.iter().zip(series.ys.iter()).map(|(&x, &y)| {
            let (x, y) = (self.x.measure(x), self.y.measure(y));
            (is_drawable(x) && is_drawable(y)).then_some((x, y))
        })
    }

    /// Returns the horizontal coordinate and both edges of a band in axis coordinates; `None` for a gap.
    pub(crate) fn columns<'p>(
        &'p self,
        band: &'p Band<'_>,
    ) -> impl Iterator<Item = Option<(f64, f64, f64)>> + 'p {
        band.xs.iter().zip(band.low.iter().zip(band.high.iter())).map(|(&x, (&low, &high))| {
            let [x, low, high] = [self.x.measure(x), self.y.measure(low), self.y.measure(high)];
            [x, low, high].into_iter().all(is_drawable).then_some((x, low, high))
        })
    }

    /// Checks array lengths and the mosaic; `panel` is the index of this panel for the error.
    pub(crate) fn check(&self, panel: usize) -> Result<(), PlotError> {
        for (series, curve) in self.series.iter().enumerate() {
            let (xs, ys) = (curve.xs.len(), curve.ys.len());
            if xs != ys {
                return Err(PlotError::Lengths { panel, series, xs, ys });
            }
        }
        for (band, area) in self.bands.iter().enumerate() {
            let (xs, low, high) = (area.xs.len(), area.low.len(), area.high.len());
            if low != xs || high != xs {
                return Err(PlotError::Edges { panel, band, xs, low, high });
            }
        }
        if self.mosaic.as_ref().is_some_and(|mosaic| !mosaic.is_sound()) {
            return Err(PlotError::Mosaic { panel });
        }
        Ok(())
    }
}

impl Shape {
    /// Returns the corners with drawable coordinates.
    pub(crate) fn drawable(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.corners.iter().copied().filter(|(x, y)| is_drawable(*x) && is_drawable(*y))
    }
}

impl Mosaic<'_> {
    /// Returns whether every cell has a known class and the positions are ascending.
    pub(crate) fn is_sound(&self) -> bool {
        let ordered = |places: &[f64]| {
            places.iter().copied().all(is_drawable) && places.windows(2).all(|pair| pair[0] <= pair[1])
        };
        let known = |class: &u8| usize::from(*class) < self.classes.len();
        self.cells.len() == self.xs.len() * self.ys.len()
            && self.cells.iter().all(known)
            && ordered(&self.xs)
            && ordered(&self.ys)
    }
}

/// Returns whether a value is at most 1e150 in magnitude, so that differences and squares stay finite.
pub(crate) fn is_drawable(value: f64) -> bool {
    value.abs() <= crate::range::LARGEST
}

impl<'a> Series<'a> {
    /// Creates a series in the style of its index in the panel.
    pub fn new(
        label: impl Into<Label>,
        xs: impl Into<Cow<'a, [f64]>>,
        ys: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        Self {
            label: label.into(),
            xs: xs.into(),
            ys: ys.into(),
            style: Style::default(),
            marked: false,
            directed: false,
        }
    }
}
