//! What cannot be drawn, and why.

use crate::Figure;
use plotters_backend::DrawingErrorKind;
use thiserror::Error;

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
    /// Edges of a band that do not pair up.
    #[error("panel {panel}, band {band}: {xs} x values, {low} and {high} of its edges")]
    Edges {
        /// Place of the panel.
        panel: usize,
        /// Place of the band.
        band: usize,
        /// Number of x values.
        xs: usize,
        /// Numbers of values of the edges.
        low: usize,
        /// See `low`.
        high: usize,
    },
    /// A mosaic that does not fit together.
    #[error(
        "panel {panel}: expected one known class for every cell of the mosaic, and finite places in ascending order"
    )]
    Mosaic {
        /// Place of the panel.
        panel: usize,
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
    /// The reader of SVG refused.
    #[error("SVG: {0}")]
    Svg(String),
    /// Bytes that are no drawn figure.
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
        // What the decoder says of a part that is damaged shows its own structures.
        Self::Png(match &error {
            png::DecodingError::Format(_) => "damaged".to_owned(),
            _ => error.to_string(),
        })
    }
}
