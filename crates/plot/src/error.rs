//! Errors of drawing.

use crate::Figure;
use plotters_backend::DrawingErrorKind;
use thiserror::Error;

/// Reason why a figure cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlotError {
    /// The figure has no panels.
    #[error("the plot has no panels")]
    NoPanels,
    /// The size is out of range.
    #[error("expected a plot of {least} to {most} px in width and height, got {width} x {height}", least = Figure::LEAST, most = Figure::MOST)]
    Size {
        /// Width, px.
        width: u32,
        /// Height, px.
        height: u32,
    },
    /// The x and y values of a series differ in number.
    #[error("panel {panel}, series {series}: {xs} x values and {ys} y values")]
    Lengths {
        /// Index of the panel.
        panel: usize,
        /// Index of the series.
        series: usize,
        /// Number of x values.
        xs: usize,
        /// Number of y values.
        ys: usize,
    },
    /// The values and edges of a band differ in number.
    #[error("panel {panel}, band {band}: {xs} x values, {low} and {high} values of the edges")]
    Edges {
        /// Index of the panel.
        panel: usize,
        /// Index of the band.
        band: usize,
        /// Number of x values.
        xs: usize,
        /// Number of values of the first edge.
        low: usize,
        /// Number of values of the second edge.
        high: usize,
    },
    /// The cells, classes or positions of a mosaic are inconsistent.
    #[error(
        "panel {panel}: expected one known class for each cell of the mosaic, and finite positions in ascending order"
    )]
    Mosaic {
        /// Index of the panel.
        panel: usize,
    },
    /// Title, legends and labels leave too little room for the data.
    #[error(
        "panel {panel} would have {width:.0} x {height:.0} px inside its labels; draw a larger plot or fewer panels"
    )]
    NoRoom {
        /// Index of the panel.
        panel: usize,
        /// Remaining width, px.
        width: f64,
        /// Remaining height, px.
        height: f64,
    },
    /// The key is not allowed in a PNG text chunk.
    #[error("expected a key of 1 to 79 printable Latin-1 characters, got {0:?}")]
    Key(String),
    /// The built-in font cannot be read.
    #[error("the built-in font cannot be read")]
    Font,
    /// The plotters backend failed.
    #[error("drawing failed: {0}")]
    Draw(String),
    /// PNG encoding or decoding failed.
    #[error("PNG: {0}")]
    Png(String),
    /// The SVG cannot be parsed.
    #[error("SVG: {0}")]
    Svg(String),
    /// The bytes are neither PNG nor SVG.
    #[error("neither PNG nor SVG")]
    NoPicture,
}

impl<E: std::error::Error + Send + Sync> From<DrawingErrorKind<E>> for PlotError {
    fn from(error: DrawingErrorKind<E>) -> Self {
        Self::Draw(error.to_string())
    }
}

impl From<png::EncodingError> for PlotError {
    fn from(error: png::EncodingError) -> Self {
        Self::Png(error.to_string())
    }
}

impl From<png::DecodingError> for PlotError {
    fn from(error: png::DecodingError) -> Self {
        // The decoder's format errors describe its internals.
        Self::Png(match &error {
            png::DecodingError::Format(_) => "damaged".to_owned(),
            _ => error.to_string(),
        })
    }
}
