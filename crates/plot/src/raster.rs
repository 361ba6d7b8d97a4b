//! Bitmap backend of plotters: anti-aliased strokes with round joins, and glyphs as outlines.
//!
//! This backend replaces plotters' own bitmap backend, which anti-aliases only lines 1 px wide.

use crate::canvas::{BASELINE, FONT_SIZE, UNITS};
use crate::font;
use crate::mosaic::Image;
use crate::palette::Word;
use crate::stroke::Coverage;
use crate::theme::Colour;
use plotters_backend::text_anchor::HPos;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};
use thiserror::Error;
use tiny_skia::{Color, FillRule, Paint, Path, PathBuilder, Pixmap, PremultipliedColorU8, Stroke, Transform};

/// Bitmap during drawing.
pub(crate) struct Raster {
    pixmap: Pixmap,
    coverage: Coverage,
}

/// Errors of the bitmap backend.
#[derive(Debug, Clone, Error)]
pub(crate) enum RasterError {
    /// The built-in font cannot be read.
    #[error("the built-in font cannot be read")]
    Font,
    /// The text is neither horizontal nor turned by 270 degrees.
    #[error("this rotation of text is not supported")]
    Turn,
}

type Drawn = Result<(), DrawingErrorKind<RasterError>>;

impl Raster {
    /// Creates a bitmap of one colour; `None` for a size of zero or beyond memory.
    pub(crate) fn new((width, height): (u32, u32), Colour(r, g, b): Colour) -> Option<Self> {
        let mut pixmap = Pixmap::new(width, height)?;
        pixmap.fill(Color::from_rgba8(r, g, b, 255));
        Some(Self { pixmap, coverage: Coverage::new((width, height)) })
    }

    /// Returns the red, green and blue of each pixel, row by row.
    pub(crate) fn rgb(&self) -> Vec<u8> {
        self.pixmap.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect()
    }

    /// Returns the colour of each pixel, row by row.
    pub(crate) fn colours(&self) -> impl Iterator<Item = Word> + Clone + '_ {
        self.pixmap.data().as_chunks().0.iter().map(|pixel| Word::from_le_bytes(*pixel))
    }

    /// Copies an opaque image into the bitmap; parts outside are left out.
    pub(crate) fn paste(&mut self, image: &Image, (left, top): (usize, usize)) {
        let width = self.pixmap.width() as usize;
        let opaque = |c: &[u8]| PremultipliedColorU8::from_rgba(c[0], c[1], c[2], 255);
        let rows = self.pixmap.pixels_mut().chunks_exact_mut(width).skip(top);
        for (pixels, row) in rows.zip(image.rgb.chunks_exact(3 * image.width.max(1))) {
            for (pixel, colour) in pixels.iter_mut().skip(left).zip(row.chunks_exact(3)) {
                *pixel = opaque(colour).unwrap_or(*pixel);
            }
        }
    }

    fn fill_path(&mut self, path: &Path, colour: BackendColor, transform: Transform) {
        self.pixmap.fill_path(path, &paint(colour), FillRule::Winding, transform, None);
    }
}

impl DrawingBackend for Raster {
    type ErrorType = RasterError;

    fn get_size(&self) -> (u32, u32) {
        (self.pixmap.width() * UNITS, self.pixmap.height() * UNITS)
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect((x, y), (x + 1, y + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        if !fill {
            return self.draw_path([from, (to.0, from.1), to, (from.0, to.1), from], style);
        }
        // The rectangle of tiny-skia cannot be thinner than a pixel.
        self.fill_polygon([from, (to.0, from.1), to, (from.0, to.1)], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<(f32, f32)> = path.into_iter().map(pixels).collect();
        let width = style.stroke_width() as f32 / UNITS as f32;
        let BackendColor { rgb: (r, g, b), alpha } = style.color();
        let (ink, alpha) = ([r, g, b].map(f32::from), alpha.clamp(0.0, 1.0) as f32);
        let pixels = self.pixmap.pixels_mut();
        self.coverage.draw(&points, width, |place, share| {
            let Some(pixel) = pixels.get_mut(place) else { return };
            let mixed = |behind: u8, ink: f32| {
                let behind = f32::from(behind);
                (behind + alpha * share * (ink - behind) + 0.5) as u8
            };
            let [r, g, b] =
                [mixed(pixel.red(), ink[0]), mixed(pixel.green(), ink[1]), mixed(pixel.blue(), ink[2])];
            *pixel = PremultipliedColorU8::from_rgba(r, g, b, 255).unwrap_or(*pixel);
        });
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let (x, y) = pixels(centre);
        let Some(path) = PathBuilder::from_circle(x, y, radius as f32 / UNITS as f32) else { return Ok(()) };
        if fill {
            self.fill_path(&path, style.color(), Transform::identity());
        } else {
            let width = style.stroke_width() as f32 / UNITS as f32;
            let stroke = Stroke { width, ..Stroke::default() };
            self.pixmap.stroke_path(&path, &paint(style.color()), &stroke, Transform::identity(), None);
        }
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<(f32, f32)> = path.into_iter().map(pixels).collect();
        if let Some(path) = polygon(&points) {
            self.fill_path(&path, style.color(), Transform::identity());
        }
        Ok(())
    }

    /// Draws a text as plotters' SVG backend places it: top anchor, baseline [`BASELINE`] em below.
    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        let failed = |e: RasterError| DrawingErrorKind::DrawingError(e);
        let em = style.size() / FONT_SIZE / f64::from(UNITS);
        let width = em * font::advance(text).map_err(|_| failed(RasterError::Font))?;
        let start = match style.anchor().h_pos {
            HPos::Left => 0.0,
            HPos::Center => -width / 2.0,
            HPos::Right => -width,
        };
        let (x, y) = pixels(at);
        let turned = match style.transform() {
            FontTransform::None => Transform::from_translate(x, y),
            FontTransform::Rotate270 => Transform::from_row(0.0, -1.0, 1.0, 0.0, x, y),
            _ => return Err(failed(RasterError::Turn)),
        };
        let mut outline = PathBuilder::new();
        font::outline(text, em, &mut outline).map_err(|_| failed(RasterError::Font))?;
        if let Some(path) = outline.finish() {
            self.fill_path(&path, style.color(), turned.pre_translate(start as f32, (BASELINE * em) as f32));
        }
        Ok(())
    }
}

fn polygon(points: &[(f32, f32)]) -> Option<Path> {
    let mut path = PathBuilder::with_capacity(points.len() + 1, points.len() + 1);
    let mut points = points.iter();
    let &(x, y) = points.next()?;
    path.move_to(x, y);
    points.for_each(|&(x, y)| path.line_to(x, y));
    path.close();
    path.finish()
}

fn pixels((x, y): BackendCoord) -> (f32, f32) {
    (x as f32 / UNITS as f32, y as f32 / UNITS as f32)
}

fn paint(colour: BackendColor) -> Paint<'static> {
    let (r, g, b) = colour.rgb;
    let mut paint = Paint::default();
    let alpha = (colour.alpha.clamp(0.0, 1.0) * 255.0).round() as u8;
    paint.set_color(Color::from_rgba8(r, g, b, alpha));
    paint
}
