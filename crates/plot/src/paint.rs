//! Drawing of title, legends, axes and frames.

use crate::PlotError;
use crate::canvas::{Anchor, Canvas};
use crate::figure::Figure;
use crate::label::Label;
use crate::lanes::LINE;
use crate::layout::{Area, Layout, Placed, Sizes};
use crate::legend::{Legend, ROW, Sample};
use crate::mosaic::Image;
use crate::panel::Panel;
use crate::place::{HEADING_LINE, NOTE_GAP};
use crate::theme::{Dash, Stroke, Theme};
use crate::thin::Point;
use plotters_backend::DrawingBackend;

/// Draws a figure with its layout, on top of the background and the mosaic images.
pub(crate) fn paint<B: DrawingBackend>(
    backend: &mut B,
    figure: &Figure<'_>,
    layout: &Layout<'_, '_>,
) -> Result<(), PlotError> {
    let (theme, sizes) = (&figure.theme, layout.sizes);
    let canvas = Canvas { backend, ink: theme.foreground, scale: sizes.scale };
    let mut painter = Painter { canvas, theme, sizes };
    for (line, baseline) in &layout.title {
        let at = (f64::from(figure.size.0) / 2.0, *baseline);
        painter.canvas.text(line, sizes.title, at, Anchor::Centre)?;
    }
    painter.legend(&layout.legend.0, layout.legend.1)?;
    for place in &layout.panels {
        painter.heading(place)?;
        painter.legend(&place.legend.0, place.legend.1)?;
        painter.axes(place)?;
        painter.content(place)?;
        painter.frame(place.frame)?;
    }
    Ok(painter.canvas.backend.present()?)
}

/// Returns the images of the mosaics with their frames, at `density` image pixels per px of the figure.
pub(crate) fn mosaics<'l>(
    layout: &'l Layout<'_, '_>,
    theme: &'l Theme,
    density: usize,
) -> impl Iterator<Item = (Area, Image)> + 'l {
    layout.panels.iter().filter_map(move |place| {
        let size = (place.frame.width as usize * density, place.frame.height as usize * density);
        let mosaic = place.panel.mosaic.as_ref().filter(|_| !place.empty)?;
        Some((
            place.frame,
            mosaic.image([(&place.panel.x, &place.x), (&place.panel.y, &place.y)], size, theme),
        ))
    })
}

/// Canvas with the colours and sizes of a figure.
pub(crate) struct Painter<'c, B> {
    pub(crate) canvas: Canvas<'c, B>,
    pub(crate) theme: &'c Theme,
    pub(crate) sizes: Sizes,
}

impl<B: DrawingBackend> Painter<'_, B> {
    fn heading(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let ((left, top), em) = (place.heading.1, self.sizes.tick);
        for (i, line) in place.heading.0.iter().enumerate() {
            let baseline = top + (i as f64 + 0.75) * HEADING_LINE * em;
            self.canvas.text(line, em, (left, baseline), Anchor::Left)?;
        }
        Ok(())
    }

    /// Draws grid, ticks, numbers and labels.
    fn axes(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        self.x_axis(place)?;
        self.beside(place)?;
        if place.panel.lanes.is_empty() { self.y_axis(place) } else { self.names(place) }
    }

    fn x_axis(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let (sizes, frame) = (self.sizes, place.frame);
        let bottom = frame.top + frame.height;
        for (at, text) in &place.x.ticks {
            let x = (frame.left + at * frame.width).round();
            if has_grid(place.panel) {
                self.canvas.line(&[(x, frame.top), (x, bottom)], self.grid())?;
            }
            self.canvas.line(&[(x, bottom), (x, bottom + sizes.mark)], self.mark())?;
            if place.numbered.0 {
                let baseline = bottom + sizes.mark + 1.05 * sizes.tick;
                self.canvas.text(&Label::plain(text), sizes.tick, (x, baseline), Anchor::Centre)?;
            }
        }
        if !place.numbered.0 {
            return Ok(());
        }
        // The label starts right of the label of the y axis, which may extend down to here.
        let (start, end) = (place.numbers_left, place.cell.left + place.cell.width);
        let (label, em) = place.x.label.fitted(&place.x.unit, sizes.label, end - start)?;
        let baseline = bottom + sizes.mark + 1.45 * sizes.tick + 0.85 * sizes.label;
        let centre = centred(frame.left + frame.width / 2.0, (start, end), label.width(em)?);
        self.canvas.text(&label, em, (centre, baseline), Anchor::Centre)
    }

    fn y_axis(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let (sizes, frame) = (self.sizes, place.frame);
        let (right, bottom) = (frame.left + frame.width, frame.top + frame.height);
        for (at, text) in &place.y.ticks {
            let y = (bottom - at * frame.height).round();
            if has_grid(place.panel) {
                self.canvas.line(&[(frame.left, y), (right, y)], self.grid())?;
            }
            self.canvas.line(&[(frame.left - sizes.mark, y), (frame.left, y)], self.mark())?;
            if place.numbered.1 {
                let end = (frame.left - sizes.mark - 0.3 * sizes.tick, y + 0.36 * sizes.tick);
                self.canvas.text(&Label::plain(text), sizes.tick, end, Anchor::Right)?;
            }
        }
        if !place.numbered.1 {
            return Ok(());
        }
        // The label may extend along heading and legend, unless the legend is as far left as the label.
        let beside_legend = place.legend.1.0 >= place.numbers_left;
        let start = if beside_legend { place.cell.top } else { frame.top };
        let end = place.cell.top + place.cell.height;
        let (label, em) = place.y.label.fitted(&place.y.unit, sizes.label, end - start)?;
        let centre = centred(frame.top + frame.height / 2.0, (start, end), label.width(em)?);
        self.canvas.upright(&label, em, (place.numbers_left - 0.45 * sizes.label, centre))
    }

    /// Draws names and notes of the lanes.
    fn names(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let (sizes, frame, em) = (self.sizes, place.frame, place.names.em);
        let (end, start) =
            (frame.left - sizes.mark - 0.3 * sizes.tick, frame.left + frame.width + NOTE_GAP * sizes.tick);
        let height = frame.height / place.panel.lanes.len() as f64;
        for (i, (lines, lane)) in place.names.lines.iter().zip(&place.panel.lanes).enumerate() {
            let baseline = frame.top + (i as f64 + 0.5) * height + 0.36 * em;
            for (k, line) in lines.iter().enumerate() {
                let below = (k as f64 - (lines.len() - 1) as f64 / 2.0) * LINE * em;
                self.canvas.text(line, em, (end, baseline + below), Anchor::Right)?;
            }
            self.canvas.text(&Label::plain(&lane.note), em, (start, baseline), Anchor::Left)?;
        }
        Ok(())
    }

    fn frame(&mut self, frame: Area) -> Result<(), PlotError> {
        let Area { left, top, width, height } = frame;
        let (right, bottom) = (left + width, top + height);
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.canvas.line(&corners, self.mark())
    }

    fn legend(&mut self, legend: &Legend, (left, top): Point) -> Result<(), PlotError> {
        let em = self.sizes.tick;
        for (i, row) in legend.rows.iter().enumerate() {
            let middle = top + (i as f64 + 0.5) * ROW * em;
            for (at, entry) in row {
                let x = left + at;
                self.sample(entry.sample, (x, middle))?;
                let baseline = (x + entry.text_at(em), middle + 0.36 * em);
                self.canvas.text(&entry.label, em, baseline, Anchor::Left)?;
            }
        }
        Ok(())
    }

    /// Draws the symbol of a legend entry; the point is the middle of its left edge.
    fn sample(&mut self, sample: Sample, (left, middle): Point) -> Result<(), PlotError> {
        let em = self.sizes.tick;
        let width = sample.width(em);
        match sample {
            Sample::None => Ok(()),
            Sample::Line(stroke) => self.canvas.line(&[(left, middle), (left + width, middle)], stroke),
            Sample::Dot(stroke) => {
                self.canvas.disc((left + width / 2.0, middle), DOT * stroke.width, stroke.colour)
            }
            Sample::Swatch(colour) => {
                let area = Area { left, top: middle - 0.4 * em, width, height: 0.8 * em };
                self.canvas.fill(area, colour)?;
                let (right, bottom) = (left + width, area.top + area.height);
                let corners =
                    [(left, area.top), (right, area.top), (right, bottom), (left, bottom), (left, area.top)];
                self.canvas.line(&corners, Stroke { colour: self.theme.muted, dash: Dash::Solid, width: 1.5 })
            }
        }
    }

    fn grid(&self) -> Stroke {
        Stroke { colour: self.theme.grid, dash: Dash::Solid, width: 1.5 }
    }

    pub(crate) fn mark(&self) -> Stroke {
        Stroke { colour: self.theme.foreground, dash: Dash::Solid, width: 2.0 }
    }
}

/// Returns whether a panel has a grid: not with a mosaic, which would hide the grid, and not with notes.
fn has_grid(panel: &Panel<'_>) -> bool {
    panel.mosaic.is_none() && panel.notes.is_empty()
}

/// Radius of an isolated point, in line widths.
pub(crate) const DOT: f64 = 1.6;

/// Returns the centre of a label: the middle of its frame, shifted as little as necessary to lie between two ends.
fn centred(middle: f64, (start, end): (f64, f64), length: f64) -> f64 {
    let half = (length / 2.0).min((end - start) / 2.0).max(0.0);
    middle.min(end - half).max(start + half)
}
