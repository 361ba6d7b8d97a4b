//! The data model of a figure.

use crate::{Label, Style, Theme};
use std::borrow::Cow;
use thiserror::Error;

/// A figure: what it shows, not yet how many pixels apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure<'a> {
    /// Title above the panels; none where empty.
    pub title: Label,
    /// Panels in order.
    pub panels: Vec<Panel<'a>>,
    /// How the panels are arranged.
    pub arrangement: Arrangement,
    /// Width and height, px. The texts keep their share of the width: 1600 px are meant for 16 cm in print.
    pub size: (u32, u32),
    /// Colours and sizes.
    pub theme: Theme,
    /// Keys and values that the file carries unseen: PNG text chunks, the description of an SVG.
    pub provenance: Vec<(String, String)>,
}

/// How panels are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrangement {
    /// Side by side.
    Row,
    /// One above the other.
    Column {
        /// One x axis for all, with numbers below the last panel only.
        share_x: bool,
    },
}

/// One pair of axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel<'a> {
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Series, the later over the earlier.
    pub series: Vec<Series<'a>>,
    /// Reference lines, below the series and always inside the range.
    pub references: Vec<Reference>,
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

/// Why a figure cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlotError {
    /// A figure without panels.
    #[error("the figure has no panels")]
    NoPanels,
    /// A size out of range.
    #[error("expected a figure of {least} to {most} px each way, got {width} x {height}", least = Figure::LEAST, most = Figure::MOST)]
    Size {
        /// Width, px.
        width: u32,
        /// Height, px.
        height: u32,
    },
    /// Coordinates of one series that do not pair up.
    #[error("panel {panel}, series {series}: {xs} x values and {ys} y values")]
    Lengths {
        /// Place of the panel.
        panel: usize,
        /// Place of the series.
        series: usize,
        /// Number of x values.
        xs: usize,
        /// Number of y values.
        ys: usize,
    },
    /// Titles, legends and labels leave no room for the data.
    #[error(
        "panel {panel} would be {width:.0} x {height:.0} px inside its labels; make the figure larger or the panels fewer"
    )]
    NoRoom {
        /// Place of the panel.
        panel: usize,
        /// Width that would be left, px.
        width: f64,
        /// Height that would be left, px.
        height: f64,
    },
    /// A key that a PNG text chunk cannot have.
    #[error("expected a key of 1 to 79 printable Latin-1 characters, got {0:?}")]
    Key(String),
    /// The built-in font cannot be read.
    #[error("the built-in font cannot be read")]
    Font,
    /// The backend refused.
    #[error("drawing failed: {0}")]
    Draw(String),
    /// The encoder or decoder of PNG refused.
    #[error("PNG: {0}")]
    Png(String),
}

impl Figure<'_> {
    /// Least width and height, px.
    pub const LEAST: u32 = 200;
    /// Most width and height, px.
    pub const MOST: u32 = 8000;
    /// Default size, px.
    pub const DEFAULT_SIZE: (u32, u32) = (1600, 1000);

    /// Width of a panel's own legend at the most, as a share of the figure's.
    pub(crate) fn legend_share(&self, place: usize) -> f64 {
        // The place of a panel is wider than this by the numbers of its axis.
        0.75 * if self.arrangement == Arrangement::Row { self.shares()[place] } else { 1.0 }
    }

    /// The panels' shares of the figure, summing to 1.
    pub(crate) fn shares(&self) -> Vec<f64> {
        let usable = |share: f64| if share > 0.0 && share.is_finite() { share.clamp(1e-3, 1e3) } else { 1.0 };
        let sum: f64 = self.panels.iter().map(|panel| usable(panel.share)).sum();
        self.panels.iter().map(|panel| usable(panel.share) / sum).collect()
    }

    /// Checks what the types do not.
    pub(crate) fn check(&self) -> Result<(), PlotError> {
        let (width, height) = self.size;
        if [width, height].iter().any(|side| !(Self::LEAST..=Self::MOST).contains(side)) {
            return Err(PlotError::Size { width, height });
        }
        if self.panels.is_empty() {
            return Err(PlotError::NoPanels);
        }
        for (panel, content) in self.panels.iter().enumerate() {
            for (series, curve) in content.series.iter().enumerate() {
                let (xs, ys) = (curve.xs.len(), curve.ys.len());
                if xs != ys {
                    return Err(PlotError::Lengths { panel, series, xs, ys });
                }
            }
        }
        Ok(())
    }
}

impl Default for Figure<'_> {
    fn default() -> Self {
        Self {
            title: Label::default(),
            panels: Vec::new(),
            arrangement: Arrangement::Row,
            size: Self::DEFAULT_SIZE,
            theme: Theme::light(),
            provenance: Vec::new(),
        }
    }
}

impl Axis {
    /// An axis with a margin at both ends.
    pub fn new(label: Label, unit: &str) -> Self {
        Self { label, unit: unit.to_owned(), tight: false }
    }
}

impl<'a> Series<'a> {
    /// A series in the style of its place in the panel.
    pub fn new(
        label: impl Into<Label>,
        xs: impl Into<Cow<'a, [f64]>>,
        ys: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        Self { label: label.into(), xs: xs.into(), ys: ys.into(), style: Style::default() }
    }

    /// The points, with a gap (none) where one cannot be drawn.
    pub(crate) fn points(&self) -> impl Iterator<Item = Option<(f64, f64)>> + '_ {
        let drawable = |v: f64| v.abs() <= crate::range::LARGEST;
        self.xs.iter().zip(self.ys.iter()).map(move |(&x, &y)| (drawable(x) && drawable(y)).then_some((x, y)))
    }
}
