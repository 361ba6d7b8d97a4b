//! A panel: axes and what is drawn between them.

use crate::{Ink, Label, PlotError, Style};
use std::borrow::Cow;

/// One pair of axes and what lies between them, from the bottom up: mosaic, grid, bands, shapes, reference lines,
/// series, notes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel<'a> {
    /// Heading above the frame; none where empty.
    pub heading: Label,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Cells that pave the frame.
    pub mosaic: Option<Mosaic<'a>>,
    /// Filled areas, the later over the earlier.
    pub bands: Vec<Band<'a>>,
    /// Filled polygons, the later over the earlier.
    pub shapes: Vec<Shape>,
    /// Series, the later over the earlier.
    pub series: Vec<Series<'a>>,
    /// Reference lines, below the series and always inside the range.
    pub references: Vec<Reference>,
    /// Texts inside the frame, the more important first. Where there are any there is no grid, and the later of two
    /// notes gives way.
    pub notes: Vec<Note>,
    /// Lanes of marks, from the top down. Where there are any, their labels take the place of the y axis, and
    /// nothing else is drawn but vertical reference lines.
    pub lanes: Vec<Lane>,
    /// What is said where there is nothing to show; "no data" where empty.
    pub absence: Label,
    /// The horizontal axis in other units, above the frame.
    pub top: Option<Rescaled>,
    /// The vertical axis in other units, right of the frame.
    pub right: Option<Rescaled>,
    /// A stretch of the horizontal axis that another panel shows enlarged: shaded.
    pub enlarged: Option<(f64, f64)>,
    /// Width over height of the frame; fills its place by default.
    pub aspect: Option<f64>,
    /// Share of the figure, relative to the other panels' shares; 1 where not above 0.
    pub share: f64,
}

/// An axis. Its range is that of the data and the reference lines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// What it measures, without unit.
    pub label: Label,
    /// Unit of the numbers in the series, such as "m"; the prefix is chosen by range. Empty: dimensionless.
    pub unit: String,
    /// No margin between the data and the ends of the axis.
    pub tight: bool,
    /// Two values that are shown whatever the data are.
    pub covers: Option<(f64, f64)>,
    /// Neither ticks nor numbers, for what is not to scale.
    pub unnumbered: bool,
    /// Decades are as far apart everywhere; values not above 0 are gaps. Series, bands, lanes and reference lines
    /// alone may stand on such an axis, and mosaics at places above 0.
    pub logarithmic: bool,
}

/// A dimensionless axis beside another: the same values as shares of something.
#[derive(Debug, Clone, PartialEq)]
pub struct Rescaled {
    /// What it measures.
    pub label: Label,
    /// Of what they are shares, in the axis' unit; nothing is shown where it is not above 0.
    pub by: f64,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Series<'a> {
    /// Name in the legend; none where empty.
    pub label: Label,
    /// Horizontal values, in the axis' unit.
    pub xs: Cow<'a, [f64]>,
    /// Vertical values, as many. Where either is not finite or beyond ±1e150, the curve has a gap.
    pub ys: Cow<'a, [f64]>,
    /// Colour, dashes and width.
    pub style: Style,
    /// Whether every point is marked, where few points were measured.
    pub marked: bool,
    /// Whether heads of arrows say which way it is run through.
    pub directed: bool,
}

/// The area between two curves over one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Band<'a> {
    /// Name in the legend; none where empty.
    pub label: Label,
    /// Horizontal values, in the axis' unit, ascending.
    pub xs: Cow<'a, [f64]>,
    /// One edge, as many values; a gap where one of the three is not finite or beyond ±1e150.
    pub low: Cow<'a, [f64]>,
    /// The other edge, as many values. It may cross the first.
    pub high: Cow<'a, [f64]>,
    /// Colour.
    pub ink: Ink,
}

/// A filled polygon.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Name in the legend; none where empty.
    pub label: Label,
    /// Corners in the axes' units; those that are not finite or beyond ±1e150 are left out.
    pub corners: Vec<(f64, f64)>,
    /// Colour.
    pub ink: Ink,
}

/// A text beside or on what it names: it takes the nearest place at which it covers no line and no other text and
/// lies on no foreign shape if it can, and points to the thing from further away. Where there is none it is left out,
/// and counted.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// Lines of the text.
    pub lines: Vec<Label>,
    /// Two opposite corners of what it names, in the axes' units.
    pub about: [(f64, f64); 2],
    /// Place in the panel's list of a shape that it may well lie on.
    pub on: Option<usize>,
    /// Ink of what it names, which the text has, a little nearer to that of other texts; theirs by default.
    pub ink: Option<Ink>,
}

/// Cells of few classes, such as the states of springs over time. A cell reaches half way to its neighbours; the
/// first and the last column end at their own places, the outer rows reach as far out as in. Where cells are
/// smaller than a pixel, the pixel shows their colours mixed by area.
#[derive(Debug, Clone, PartialEq)]
pub struct Mosaic<'a> {
    /// Places of the columns, in the x axis' unit, ascending.
    pub xs: Cow<'a, [f64]>,
    /// Places of the rows, in the y axis' unit, ascending.
    pub ys: Cow<'a, [f64]>,
    /// The class of every cell, column by column.
    pub cells: Cow<'a, [u8]>,
    /// Name in the legend and colour of every class, at most 256.
    pub classes: Vec<(Label, Ink)>,
}

/// Marks side by side under one name.
#[derive(Debug, Clone, PartialEq)]
pub struct Lane {
    /// Name, left of the lane; never cut.
    pub label: String,
    /// What stands right of the lane, such as a count.
    pub note: String,
    /// The marks.
    pub marks: Vec<Mark>,
    /// Colour.
    pub ink: Ink,
}

/// A mark in a lane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// Where it begins, in the axis' unit.
    pub from: f64,
    /// Where it ends; a mark narrower than a line is drawn as one.
    pub to: f64,
    /// Height as a share of the lane's, 0 to 1.
    pub height: f64,
}

/// A straight line across a panel.
#[derive(Debug, Clone, PartialEq)]
pub enum Reference {
    /// At a vertical value.
    Horizontal {
        /// Value, in the axis' unit.
        y: f64,
        /// Name in the legend; none where empty. Lines of one name share an entry.
        label: Label,
    },
    /// At a horizontal value.
    Vertical {
        /// Value, in the axis' unit.
        x: f64,
        /// Name in the legend; none where empty. Lines of one name share an entry.
        label: Label,
    },
}

impl Axis {
    /// An axis with a margin at both ends.
    pub fn new(label: Label, unit: &str) -> Self {
        Self { label, unit: unit.to_owned(), ..Self::default() }
    }

    /// What is laid off along the axis for a value: the value, or its power of ten.
    pub(crate) fn measure(&self, value: f64) -> f64 {
        if self.logarithmic { math::log10(value) } else { value }
    }
}

impl Reference {
    /// Its name.
    pub(crate) fn label(&self) -> &Label {
        match self {
            Self::Horizontal { label, .. } | Self::Vertical { label, .. } => label,
        }
    }
}

impl Panel<'_> {
    /// The place of a reference line's name among those of the panel: lines of one name look alike, and those without like the first.
    pub(crate) fn place_of(&self, reference: &Reference) -> usize {
        let mut names: Vec<&Label> = Vec::new();
        for label in self.references.iter().map(Reference::label).filter(|label| !label.is_empty()) {
            if !names.contains(&label) {
                names.push(label);
            }
        }
        names.iter().position(|label| *label == reference.label()).unwrap_or(0)
    }

    /// Whether there is nothing to show.
    pub(crate) fn is_empty(&self) -> bool {
        let series = self.series.iter().all(|series| self.points(series).flatten().next().is_none());
        let bands = self.bands.iter().all(|band| self.columns(band).flatten().next().is_none());
        let mosaic = self.mosaic.as_ref().is_none_or(|mosaic| mosaic.cells.is_empty());
        series && bands && mosaic && self.shapes.is_empty() && self.lanes.is_empty()
    }

    /// The points of one of its series as laid off along the axes, with a gap (none) where one cannot be drawn.
    pub(crate) fn points<'p>(
        &'p self,
        series: &'p Series<'_>,
    ) -> impl Iterator<Item = Option<(f64, f64)>> + 'p {
        series.xs.iter().zip(series.ys.iter()).map(|(&x, &y)| {
            let (x, y) = (self.x.measure(x), self.y.measure(y));
            (is_drawable(x) && is_drawable(y)).then_some((x, y))
        })
    }

    /// Places and both edges of one of its bands as laid off along the axes, with a gap (none) where one cannot be drawn.
    pub(crate) fn columns<'p>(
        &'p self,
        band: &'p Band<'_>,
    ) -> impl Iterator<Item = Option<(f64, f64, f64)>> + 'p {
        band.xs.iter().zip(band.low.iter().zip(band.high.iter())).map(|(&x, (&low, &high))| {
            let [x, low, high] = [self.x.measure(x), self.y.measure(low), self.y.measure(high)];
            [x, low, high].into_iter().all(is_drawable).then_some((x, low, high))
        })
    }

    /// Checks what the types do not; `panel` is the place of this one.
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
    /// The corners that can be drawn.
    pub(crate) fn drawable(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.corners.iter().copied().filter(|(x, y)| is_drawable(*x) && is_drawable(*y))
    }
}

impl Mosaic<'_> {
    /// Whether there is one class for every cell, known, and the places are in order.
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

/// Whether a value is finite, and differences and squares of such values too.
pub(crate) fn is_drawable(value: f64) -> bool {
    value.abs() <= crate::range::LARGEST
}

impl<'a> Series<'a> {
    /// A series in the style of its place in the panel.
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
