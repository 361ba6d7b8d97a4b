//! Built-in font `DejaVu` Sans: advance widths and outlines.

use crate::PlotError;
use std::sync::OnceLock;
use tiny_skia::PathBuilder;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Font family in SVG files; the fallbacks have nearly the same widths.
pub(crate) const FAMILY: &str = "DejaVu Sans, Bitstream Vera Sans, Verdana, sans-serif";

/// Returns the font, which is parsed once.
fn face() -> Result<&'static Face<'static>, PlotError> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(dejavu::sans::regular(), 0).ok()).as_ref().ok_or(PlotError::Font)
}

/// Returns the width of a text, em.
pub(crate) fn advance(text: &str) -> Result<f64, PlotError> {
    let face = face()?;
    let units: f64 = text.chars().map(|c| advance_units(face, glyph(face, c))).sum();
    Ok(units / f64::from(face.units_per_em()))
}

/// Adds the outlines of a text to a path. The baseline runs from the origin to the right, y points downwards, and 1 em is `em` px.
pub(crate) fn outline(text: &str, em: f64, path: &mut PathBuilder) -> Result<(), PlotError> {
    let face = face()?;
    let scale = em / f64::from(face.units_per_em());
    let mut at = 0.0;
    for c in text.chars() {
        let id = glyph(face, c);
        // Blanks have no outline.
        let _ = face.outline_glyph(id, &mut Outline { path, scale: scale as f32, left: (at * scale) as f32 });
        at += advance_units(face, id);
    }
    Ok(())
}

/// Returns the glyph of a character, or the placeholder box if the font lacks the character.
fn glyph(face: &Face<'_>, c: char) -> GlyphId {
    face.glyph_index(c).unwrap_or(GlyphId(0))
}

fn advance_units(face: &Face<'_>, id: GlyphId) -> f64 {
    f64::from(face.glyph_hor_advance(id).unwrap_or(0))
}

struct Outline<'a> {
    path: &'a mut PathBuilder,
    scale: f32,
    left: f32,
}

impl Outline<'_> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.left + self.scale * x, -self.scale * y)
    }
}

impl OutlineBuilder for Outline<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_character_the_figures_use() {
        let face = face().unwrap();
        for c in "0123456789.−×⁰¹²³⁴⁵⁶⁷⁸⁹⁻…µμκδ±∞°·*/()".chars() {
            assert!(face.glyph_index(c).is_some(), "{c}");
        }
        // DejaVu Sans 2.37: every digit is 1303 of 2048 units wide.
        assert!((advance("0417").unwrap() - 4.0 * 1303.0 / 2048.0).abs() < 1e-12);
    }
}
