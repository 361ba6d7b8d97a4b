//! Drawing of the data inside a frame.

use crate::PlotError;
use crate::canvas::Anchor;
use crate::label::Label;
use crate::layout::{Area, Placed};
use crate::notes::PlacedNote;
use crate::paint::{DOT, Painter};
use crate::panel::{Band, Lane, Mark, Reference, Series, is_drawable};
use crate::theme::{Dash, Stroke};
use crate::thin::{Point, length, straightened, thinned, without_repeats, without_retraced};
use plotters_backend::DrawingBackend;

/// Curves longer than this multiple of the frame's sides are drawn solid, as dashes would not be visible.
const FILLS: f64 = 40.0;
/// Minimum width of a mark in a lane, px of a figure 1600 px wide.
const MARK: f64 = 2.4;
/// Free height above and below the marks, as a fraction of the lane height.
const LANE_GAP: f64 = 0.12;

impl<B: DrawingBackend> Painter<'_, B> {
    /// Draws everything in front of the mosaic, in the order given in [`crate::Panel`].
    pub(crate) fn content(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let panel = place.panel;
        if place.empty {
            let frame = place.frame;
            let at = (frame.left + frame.width / 2.0, frame.top + frame.height / 2.0);
            let words =
                if panel.absence.is_empty() { Label::plain("no data") } else { panel.absence.clone() };
            return self.canvas.text(&words, self.sizes.label, at, Anchor::Centre);
        }
        if let Some(stretch) = panel.enlarged {
            self.enlarged(place, stretch)?;
        }
        panel.bands.iter().try_for_each(|band| self.band(place, band))?;
        for shape in &panel.shapes {
            let corners: Vec<Point> = shape.drawable().map(|corner| place.pixel(corner)).collect();
            self.canvas.polygon(&corners, self.theme.colour(shape.ink))?;
        }
        panel.references.iter().try_for_each(|reference| self.reference(place, reference))?;
        panel.series.iter().enumerate().try_for_each(|(i, series)| self.series(place, series, i))?;
        panel.lanes.iter().enumerate().try_for_each(|(i, lane)| self.lane(place, lane, i))?;
        place.notes.iter().try_for_each(|note| self.note(note))
    }

    fn note(&mut self, note: &PlacedNote) -> Result<(), PlotError> {
        if let Some(pointer) = &note.pointer {
            let stroke = Stroke { colour: self.theme.muted, dash: Dash::Solid, width: 1.5 };
            self.canvas.line(pointer, stroke)?;
        }
        let usual = self.canvas.ink;
        self.canvas.ink = note.ink.map_or(usual, |ink| self.theme.lettering(ink));
        let drawn =
            note.lines.iter().try_for_each(|(line, at)| self.canvas.text(line, note.em, *at, Anchor::Centre));
        self.canvas.ink = usual;
        drawn
    }

    fn band(&mut self, place: &Placed<'_, '_>, band: &Band<'_>) -> Result<(), PlotError> {
        let columns = || place.panel.columns(band);
        let low = thinned(columns().map(|column| column.map(|(x, low, _)| place.pixel((x, low)))));
        let high = thinned(columns().map(|column| column.map(|(x, _, high)| place.pixel((x, high)))));
        let colour = self.theme.colour(band.ink);
        // Both edges have the same gaps.
        for (low, mut edge) in low.iter().zip(high) {
            edge.extend(low.iter().rev());
            self.canvas.polygon(&edge, colour)?;
        }
        Ok(())
    }

    fn reference(&mut self, place: &Placed<'_, '_>, reference: &Reference) -> Result<(), PlotError> {
        let (frame, stroke) = (place.frame, self.theme.reference(place.panel.place_of(reference)));
        match *reference {
            Reference::Horizontal { y, .. } if is_drawable(place.panel.y.measure(y)) => {
                let y = place.panel.y.measure(y);
                let y = frame.top + frame.height * (1.0 - place.y.place(y));
                self.canvas.line(&[(frame.left, y), (frame.left + frame.width, y)], stroke)
            }
            Reference::Vertical { x, .. } if is_drawable(place.panel.x.measure(x)) => {
                let x = place.panel.x.measure(x);
                let x = frame.left + frame.width * place.x.place(x);
                self.canvas.line(&[(x, frame.top), (x, frame.top + frame.height)], stroke)
            }
            _ => Ok(()),
        }
    }

    fn series(&mut self, place: &Placed<'_, '_>, series: &Series<'_>, i: usize) -> Result<(), PlotError> {
        let mut stroke = self.theme.stroke(series.style, i);
        let lines = thinned(place.panel.points(series).map(|point| point.map(|point| place.pixel(point))));
        if length(&lines) > FILLS * (place.frame.width + place.frame.height) {
            stroke.dash = Dash::Solid;
        }
        let lines =
            if stroke.dash == Dash::Solid { without_repeats(lines) } else { without_retraced(&lines) };
        let lines = straightened(lines);
        for line in &lines {
            match line[..] {
                [only] => self.canvas.disc(only, DOT * stroke.width, stroke.colour)?,
                _ => self.canvas.line(line, stroke)?,
            }
        }
        if series.directed {
            self.arrows(&lines, stroke)?;
        }
        let marked = place.panel.points(series).flatten().filter(|_| series.marked);
        marked
            .map(|point| place.pixel(point))
            .try_for_each(|point| self.canvas.disc(point, DOT * stroke.width, stroke.colour))
    }

    fn lane(&mut self, place: &Placed<'_, '_>, lane: &Lane, i: usize) -> Result<(), PlotError> {
        let frame = place.frame;
        let height = frame.height / place.panel.lanes.len() as f64;
        let bottom = frame.top + height * (i as f64 + 1.0);
        if i + 1 < place.panel.lanes.len() {
            let grid = Stroke { colour: self.theme.grid, dash: Dash::Solid, width: 1.5 };
            self.canvas.line(&[(frame.left, bottom), (frame.left + frame.width, bottom)], grid)?;
        }
        let (base, full) = (bottom - LANE_GAP * height, (1.0 - 2.0 * LANE_GAP) * height);
        let colour = self.theme.colour(lane.ink);
        let laid = |end: f64| place.panel.x.measure(end);
        let marks = lane.marks.iter().map(|mark| Mark { from: laid(mark.from), to: laid(mark.to), ..*mark });
        let marks: Vec<Mark> = marks.filter(|mark| is_drawable(mark.from) && is_drawable(mark.to)).collect();
        let pixel = |x: f64| frame.left + frame.width * place.x.place(x);
        let top = |mark: &Mark| base - full * mark.height.clamp(0.0, 1.0);
        // Adjacent marks are merged into one area to avoid seams.
        for run in marks.chunk_by(|a, b| a.to == b.from) {
            let (left, right) = (pixel(run[0].from), pixel(run[run.len() - 1].to));
            let width = MARK * self.sizes.scale;
            if right - left < width {
                let (left, top) = ((left + right - width) / 2.0, run.iter().map(top).fold(base, f64::min));
                self.canvas.fill(Area { left, top, width, height: base - top }, colour)?;
                continue;
            }
            let steps = run.iter().flat_map(|mark| [mark.from, mark.to].map(|end| (pixel(end), top(mark))));
            let outline: Vec<Point> =
                std::iter::once((left, base)).chain(steps).chain([(right, base)]).collect();
            self.canvas.polygon(&outline, colour)?;
        }
        Ok(())
    }
}

impl Placed<'_, '_> {
    /// Converts axis coordinates to px.
    pub(crate) fn pixel(&self, (x, y): Point) -> Point {
        let frame = self.frame;
        (frame.left + frame.width * self.x.place(x), frame.top + frame.height * (1.0 - self.y.place(y)))
    }
}
