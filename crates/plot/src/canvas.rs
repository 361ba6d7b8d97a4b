//! Drawing primitives: strokes, areas and texts on any plotters backend.
//!
//! Plotters uses integer coordinates. One unit is an eighth of a pixel, so that curves are smooth and PNG and SVG get
//! the same coordinates.

use crate::PlotError;
use crate::dash::dashed;
use crate::font;
use crate::label::{Label, SUBSCRIPT_DROP};
use crate::layout::Area;
use crate::theme::{Colour, Stroke};
use crate::thin::Point;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontFamily, FontStyle, FontTransform, IntoFont, RGBColor, ShapeStyle, TextStyle};
use plotters_backend::DrawingBackend;

/// Backend units per pixel.
pub(crate) const UNITS: u32 = 8;
/// Ratio of plotters' font size to the em.
pub(crate) const FONT_SIZE: f64 = 1.24;
/// Distance of the baseline below the given point with a top anchor in plotters' SVG, em.
pub(crate) const BASELINE: f64 = 0.76;

/// Horizontal alignment of a text. The given point lies on its baseline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Anchor {
    Left,
    Centre,
    Right,
}

/// Backend with text colour and scale of strokes.
pub(crate) struct Canvas<'c, B> {
    pub(crate) backend: &'c mut B,
    pub(crate) ink: Colour,
    /// Scale factor relative to a figure 1600 px wide.
    pub(crate) scale: f64,
}

impl<B: DrawingBackend> Canvas<'_, B> {
    pub(crate) fn fill(&mut self, area: Area, colour: Colour) -> Result<(), PlotError> {
        let corners = (units((area.left, area.top)), units((area.left + area.width, area.top + area.height)));
        Ok(self.backend.draw_rect(corners.0, corners.1, &solid(colour), true)?)
    }

    /// Fills a polygon.
    pub(crate) fn polygon(&mut self, points: &[Point], colour: Colour) -> Result<(), PlotError> {
        let corners = points.iter().copied().map(units);
        Ok(self.backend.fill_polygon(corners, &solid(colour))?)
    }

    /// Draws a point as a disc.
    pub(crate) fn disc(&mut self, centre: Point, radius: f64, colour: Colour) -> Result<(), PlotError> {
        let radius = (radius * self.scale * f64::from(UNITS)).round().max(1.0) as u32;
        Ok(self.backend.draw_circle(units(centre), radius, &solid(colour), true)?)
    }

    pub(crate) fn line(&mut self, points: &[Point], stroke: Stroke) -> Result<(), PlotError> {
        let width = stroke.width * self.scale;
        let stroke_width = (width * f64::from(UNITS)).round().max(1.0) as u32;
        let style = ShapeStyle { color: rgb(stroke.colour).into(), filled: false, stroke_width };
        for piece in dashed(points, stroke.dash, width) {
            let path = piece.into_iter().map(units);
            self.backend.draw_path(path, &style)?;
        }
        Ok(())
    }

    /// Draws a horizontal text.
    pub(crate) fn text(
        &mut self,
        label: &Label,
        em: f64,
        at: Point,
        anchor: Anchor,
    ) -> Result<(), PlotError> {
        self.runs(label, em, anchor, |along, down| (at.0 + along, at.1 + down), &FontTransform::None)
    }

    /// Draws a text from bottom to top, centred, with its baseline through the point.
    pub(crate) fn upright(&mut self, label: &Label, em: f64, at: Point) -> Result<(), PlotError> {
        self.runs(
            label,
            em,
            Anchor::Centre,
            |along, down| (at.0 + down, at.1 - along),
            &FontTransform::Rotate270,
        )
    }

    /// Draws the runs of a label. `turned` maps distances along and below the baseline to a point of the picture.
    fn runs(
        &mut self,
        label: &Label,
        em: f64,
        anchor: Anchor,
        turned: impl Fn(f64, f64) -> Point,
        transform: &FontTransform,
    ) -> Result<(), PlotError> {
        let whole = label.width(em)?;
        let colour = rgb(self.ink);
        // The SVG viewer aligns a single run, as its font may have other widths.
        let single = label.runs().len() == 1;
        let (mut along, h_pos) = match anchor {
            Anchor::Left => (0.0, HPos::Left),
            Anchor::Centre if single => (0.0, HPos::Center),
            Anchor::Right if single => (0.0, HPos::Right),
            Anchor::Centre => (-whole / 2.0, HPos::Left),
            Anchor::Right => (-whole, HPos::Left),
        };
        for run in label.runs() {
            let em_run = em * run.scale();
            let drop = if run.subscript { SUBSCRIPT_DROP * em } else { 0.0 };
            let font =
                (FontFamily::Name(font::FAMILY), em_run * FONT_SIZE * f64::from(UNITS), FontStyle::Normal);
            let style = TextStyle::from(font.into_font().transform(transform.clone()))
                .color(&colour)
                .pos(Pos::new(h_pos, VPos::Top));
            // SVG drops blanks at the ends of a text, so they are added as distances.
            let text = run.text.trim_start();
            along += font::advance(&run.text[..run.text.len() - text.len()])? * em_run;
            let at = units(turned(along, drop - BASELINE * em_run));
            self.backend.draw_text(text.trim_end(), &style, at)?;
            along += font::advance(text)? * em_run;
        }
        Ok(())
    }
}

fn solid(colour: Colour) -> ShapeStyle {
    ShapeStyle { color: rgb(colour).into(), filled: true, stroke_width: 0 }
}

fn units((x, y): Point) -> (i32, i32) {
    ((x * f64::from(UNITS)).round() as i32, (y * f64::from(UNITS)).round() as i32)
}

fn rgb(Colour(r, g, b): Colour) -> RGBColor {
    RGBColor(r, g, b)
}
