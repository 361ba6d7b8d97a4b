//! The figure in strokes and texts, on any backend of plotters.
//!
//! Backends count in whole units; a unit is an eighth of a pixel here, so that curves stay smooth and a picture and
//! a drawing get the same numbers.

use crate::dash::dashed;
use crate::figure::{Figure, PlotError, Reference};
use crate::font;
use crate::label::{Label, SUBSCRIPT_DROP};
use crate::layout::{Area, Layout, Placed};
use crate::legend::{Legend, ROW, SAMPLE, SAMPLE_GAP};
use crate::theme::{Colour, Dash, Stroke, Theme};
use crate::thin::{Point, length, thinned, without_repeats, without_retraced};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontFamily, FontStyle, FontTransform, IntoFont, RGBColor, ShapeStyle, TextStyle};
use plotters_backend::DrawingBackend;

/// Backend units per pixel.
pub(crate) const UNITS: u32 = 8;
/// Plotters' size of a font is this times its em.
pub(crate) const FONT_SIZE: f64 = 1.24;
/// With a top anchor plotters' SVG puts the baseline this far below the given point, em.
pub(crate) const BASELINE: f64 = 0.76;
/// A curve longer than this many times the frame's sides fills areas, where dashes only cost time.
const FILLS: f64 = 40.0;

/// Which point of a text is given: always on its baseline.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Anchor {
    Left,
    Centre,
    Right,
}

/// Draws the figure in its layout.
pub(crate) fn paint<B: DrawingBackend>(
    backend: &mut B,
    figure: &Figure<'_>,
    layout: &Layout<'_, '_>,
) -> Result<(), PlotError> {
    let theme = &figure.theme;
    let mut canvas = Canvas { backend, theme, layout };
    let (width, height) = (f64::from(figure.size.0), f64::from(figure.size.1));
    canvas.fill(Area { left: 0.0, top: 0.0, width, height }, theme.background)?;
    for (line, baseline) in &layout.title {
        canvas.text(line, layout.sizes.title, (width / 2.0, *baseline), Anchor::Centre)?;
    }
    canvas.legend(&layout.legend.0, layout.legend.1)?;
    for place in &layout.panels {
        canvas.legend(&place.legend.0, place.legend.1)?;
        canvas.axes(place)?;
        canvas.references(place)?;
        canvas.series(place)?;
        canvas.frame(place.frame)?;
    }
    canvas.backend.present().map_err(|e| PlotError::Draw(e.to_string()))
}

struct Canvas<'c, 'f, 'a, B> {
    backend: &'c mut B,
    theme: &'c Theme,
    layout: &'c Layout<'f, 'a>,
}

impl<B: DrawingBackend> Canvas<'_, '_, '_, B> {
    /// Grid, ticks, numbers and labels.
    fn axes(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let (sizes, frame, theme) = (self.layout.sizes, place.frame, self.theme);
        let (right, bottom) = (frame.left + frame.width, frame.top + frame.height);
        let grid = Stroke { colour: theme.grid, dash: Dash::Solid, width: 1.5 };
        let mark = Stroke { colour: theme.foreground, dash: Dash::Solid, width: 2.0 };
        for (at, text) in &place.x.ticks {
            let x = (frame.left + at * frame.width).round();
            self.line(&[(x, frame.top), (x, bottom)], grid)?;
            self.line(&[(x, bottom), (x, bottom + sizes.mark)], mark)?;
            if place.numbered {
                let baseline = bottom + sizes.mark + 1.05 * sizes.tick;
                self.text(&Label::plain(text), sizes.tick, (x, baseline), Anchor::Centre)?;
            }
        }
        for (at, text) in &place.y.ticks {
            let y = (bottom - at * frame.height).round();
            self.line(&[(frame.left, y), (right, y)], grid)?;
            self.line(&[(frame.left - sizes.mark, y), (frame.left, y)], mark)?;
            let end = frame.left - sizes.mark - 0.3 * sizes.tick;
            self.text(&Label::plain(text), sizes.tick, (end, y + 0.36 * sizes.tick), Anchor::Right)?;
        }
        if place.numbered {
            // Right of the upright label, which may reach down here.
            let (start, end) = (place.numbers_left, place.cell.left + place.cell.width);
            let (label, em) = place.x.label.fitted(&place.x.unit, sizes.label, end - start)?;
            let baseline = bottom + sizes.mark + 1.45 * sizes.tick + 0.85 * sizes.label;
            let centre = centred(frame.left + frame.width / 2.0, (start, end), label.width(em)?);
            self.text(&label, em, (centre, baseline), Anchor::Centre)?;
        }
        // Beside the legend too, unless that stands this far left.
        let beside_legend = place.legend.1.0 >= place.numbers_left;
        let start = if beside_legend { place.cell.top } else { frame.top };
        let end = place.cell.top + place.cell.height;
        let (label, em) = place.y.label.fitted(&place.y.unit, sizes.label, end - start)?;
        let centre = centred(frame.top + frame.height / 2.0, (start, end), label.width(em)?);
        self.upright(&label, em, (place.numbers_left - 0.45 * sizes.label, centre))
    }

    fn references(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let frame = place.frame;
        let stroke = self.theme.reference();
        for reference in &place.panel.references {
            match *reference {
                Reference::Horizontal { y, .. } if y.abs() <= crate::range::LARGEST => {
                    let y = frame.top + frame.height * (1.0 - place.y.place(y));
                    self.line(&[(frame.left, y), (frame.left + frame.width, y)], stroke)?;
                }
                Reference::Vertical { x, .. } if x.abs() <= crate::range::LARGEST => {
                    let x = frame.left + frame.width * place.x.place(x);
                    self.line(&[(x, frame.top), (x, frame.top + frame.height)], stroke)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn series(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let frame = place.frame;
        if place.empty {
            let at = (frame.left + frame.width / 2.0, frame.top + frame.height / 2.0);
            return self.text(&Label::plain("no data"), self.layout.sizes.label, at, Anchor::Centre);
        }
        let pixel = |(x, y): Point| {
            (frame.left + frame.width * place.x.place(x), frame.top + frame.height * (1.0 - place.y.place(y)))
        };
        for (i, series) in place.panel.series.iter().enumerate() {
            let mut stroke = self.theme.stroke(series.style, i);
            let lines = thinned(series.points().map(|point| point.map(pixel)));
            if length(&lines) > FILLS * (frame.width + frame.height) {
                stroke.dash = Dash::Solid;
            }
            let lines =
                if stroke.dash == Dash::Solid { without_repeats(lines) } else { without_retraced(&lines) };
            for line in &lines {
                match line[..] {
                    [only] => self.disc(only, 1.6 * stroke.width, stroke.colour)?,
                    _ => self.line(line, stroke)?,
                }
            }
        }
        Ok(())
    }

    fn frame(&mut self, frame: Area) -> Result<(), PlotError> {
        let Area { left, top, width, height } = frame;
        let (right, bottom) = (left + width, top + height);
        let stroke = Stroke { colour: self.theme.foreground, dash: Dash::Solid, width: 2.0 };
        self.line(&[(left, top), (right, top), (right, bottom), (left, bottom), (left, top)], stroke)
    }

    fn legend(&mut self, legend: &Legend, (left, top): Point) -> Result<(), PlotError> {
        let em = self.layout.sizes.tick;
        for (i, row) in legend.rows.iter().enumerate() {
            let middle = top + (i as f64 + 0.5) * ROW * em;
            for (at, entry) in row {
                let mut x = left + at;
                if let Some(stroke) = entry.stroke {
                    self.line(&[(x, middle), (x + SAMPLE * em, middle)], stroke)?;
                    x += (SAMPLE + SAMPLE_GAP) * em;
                }
                self.text(&entry.label, em, (x, middle + 0.36 * em), Anchor::Left)?;
            }
        }
        Ok(())
    }

    fn fill(&mut self, area: Area, colour: Colour) -> Result<(), PlotError> {
        let corners = (units((area.left, area.top)), units((area.left + area.width, area.top + area.height)));
        let style = ShapeStyle { color: rgb(colour).into(), filled: true, stroke_width: 0 };
        self.backend.draw_rect(corners.0, corners.1, &style, true).map_err(|e| PlotError::Draw(e.to_string()))
    }

    /// A point that is a series of its own.
    fn disc(&mut self, centre: Point, radius: f64, colour: Colour) -> Result<(), PlotError> {
        let radius = (radius * self.layout.sizes.scale * f64::from(UNITS)).round().max(1.0) as u32;
        let style = ShapeStyle { color: rgb(colour).into(), filled: true, stroke_width: 0 };
        self.backend
            .draw_circle(units(centre), radius, &style, true)
            .map_err(|e| PlotError::Draw(e.to_string()))
    }

    fn line(&mut self, points: &[Point], stroke: Stroke) -> Result<(), PlotError> {
        let width = stroke.width * self.layout.sizes.scale;
        let stroke_width = (width * f64::from(UNITS)).round().max(1.0) as u32;
        let style = ShapeStyle { color: rgb(stroke.colour).into(), filled: false, stroke_width };
        for piece in dashed(points, stroke.dash, width) {
            let path = piece.into_iter().map(units);
            self.backend.draw_path(path, &style).map_err(|e| PlotError::Draw(e.to_string()))?;
        }
        Ok(())
    }

    /// Text from left to right, its anchor on the baseline.
    fn text(&mut self, label: &Label, em: f64, at: Point, anchor: Anchor) -> Result<(), PlotError> {
        self.runs(label, em, anchor, |along, down| (at.0 + along, at.1 + down), &FontTransform::None)
    }

    /// Text from bottom to top, centred, its baseline through the point.
    fn upright(&mut self, label: &Label, em: f64, at: Point) -> Result<(), PlotError> {
        self.runs(
            label,
            em,
            Anchor::Centre,
            |along, down| (at.0 + down, at.1 - along),
            &FontTransform::Rotate270,
        )
    }

    /// Draws the runs of a label; `turned` maps ways along and below the baseline to a point of the picture.
    fn runs(
        &mut self,
        label: &Label,
        em: f64,
        anchor: Anchor,
        turned: impl Fn(f64, f64) -> Point,
        transform: &FontTransform,
    ) -> Result<(), PlotError> {
        let whole = label.width(em)?;
        let colour = rgb(self.theme.foreground);
        // A single run leaves the alignment to the viewer of an SVG, whose font may be a little wider.
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
            // An SVG drops the blanks at the ends of a text: they are a way, not characters.
            let text = run.text.trim_start();
            along += font::advance(&run.text[..run.text.len() - text.len()])? * em_run;
            let at = units(turned(along, drop - BASELINE * em_run));
            self.backend
                .draw_text(text.trim_end(), &style, at)
                .map_err(|e| PlotError::Draw(e.to_string()))?;
            along += font::advance(text)? * em_run;
        }
        Ok(())
    }
}

/// Centre of a label of some length: the middle of its frame, moved as little as keeps it between two ends.
fn centred(middle: f64, (start, end): (f64, f64), length: f64) -> f64 {
    let half = (length / 2.0).min((end - start) / 2.0).max(0.0);
    middle.min(end - half).max(start + half)
}

fn units((x, y): Point) -> (i32, i32) {
    ((x * f64::from(UNITS)).round() as i32, (y * f64::from(UNITS)).round() as i32)
}

fn rgb(Colour(r, g, b): Colour) -> RGBColor {
    RGBColor(r, g, b)
}
