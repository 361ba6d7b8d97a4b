//! Drawing of a model: lines, shapes and notes in px, y up.

use super::outline::Rect;
use super::symbols::Lines;
use crate::Label;
use crate::panel::{Note, Series, Shape};
use crate::theme::{Dash, Ink, Style};
use crate::thin::Point;

/// Drawing under construction.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    shapes: Vec<(Label, Vec<Point>, Ink)>,
    lines: Vec<(Vec<Point>, Style)>,
    notes: Vec<(Vec<Label>, Rect, Option<usize>)>,
}

/// Line styles.
pub(super) const OUTLINE: Style = line(Ink::Foreground, 0.7);
pub(super) const FINE: Style = line(Ink::Foreground, 0.4);
pub(super) const FORCE: Style = line(Ink::Palette(2), 0.9);
pub(super) const FOLLOWS: Style = line(Ink::Palette(1), 0.9);
pub(super) const TIE: Style = Style { ink: Some(Ink::Muted), dash: Some(Dash::Dashed), width: 0.45 };

/// Returns the solid line style.
pub(super) const fn line(ink: Ink, width: f64) -> Style {
    Style { ink: Some(ink), dash: Some(Dash::Solid), width }
}

impl Sheet {
    /// Adds a filled polygon and returns its index, for notes that may cover it.
    pub(super) fn fill(&mut self, label: &str, corners: Vec<Point>, ink: Ink) -> usize {
        self.shapes.push((Label::plain(label), corners, ink));
        self.shapes.len() - 1
    }

    pub(super) fn draw(&mut self, lines: Lines, style: Style) {
        self.lines.extend(lines.into_iter().map(|line| (line, style)));
    }

    /// Adds a note about a rectangle; empty lines are left out.
    pub(super) fn note(&mut self, lines: &[String], about: Rect, on: Option<usize>) {
        let lines: Vec<Label> =
            lines.iter().map(|line| Label::plain(line)).filter(|line| !line.is_empty()).collect();
        if !lines.is_empty() {
            self.notes.push((lines, about, on));
        }
    }

    /// Returns the bounding box of shapes and lines.
    pub(super) fn bounds(&self) -> Option<Rect> {
        let lines = self.lines.iter().flat_map(|(line, _)| line);
        let points = self.shapes.iter().flat_map(|(_, corners, _)| corners).chain(lines);
        points.map(|&point| Rect::of(point)).reduce(Rect::union)
    }

    /// Exchanges the directions x and y.
    pub(super) fn upright(mut self) -> Self {
        let turned = |(x, y): Point| (y, x);
        let shapes = self.shapes.iter_mut().flat_map(|(_, corners, _)| corners);
        let lines = self.lines.iter_mut().flat_map(|(line, _)| line);
        shapes.chain(lines).for_each(|point| *point = turned(*point));
        for (_, about, _) in &mut self.notes {
            let Rect { left, right, bottom, top } = *about;
            *about = Rect { left: bottom, right: top, bottom: left, top: right };
        }
        self
    }

    /// Converts shapes, lines and notes to metres; `scale` is in px per metre.
    pub(super) fn unrolled(self, scale: Point) -> (Vec<Shape>, Vec<Series<'static>>, Vec<Note>) {
        let metres = move |(x, y): Point| (x / scale.0, y / scale.1);
        let shape = |(label, corners, ink): (Label, Vec<Point>, Ink)| Shape {
            label,
            corners: corners.into_iter().map(metres).collect(),
            ink,
        };
        let series = |(line, style): (Vec<Point>, Style)| {
            let (xs, ys): (Vec<f64>, Vec<f64>) = line.into_iter().map(metres).unzip();
            Series { style, ..Series::new("", xs, ys) }
        };
        let note = |(lines, about, on): (Vec<Label>, Rect, Option<usize>)| Note {
            lines,
            about: [metres((about.left, about.bottom)), metres((about.right, about.top))],
            on,
            ink: None,
        };
        (
            self.shapes.into_iter().map(shape).collect(),
            self.lines.into_iter().map(series).collect(),
            self.notes.into_iter().map(note).collect(),
        )
    }
}

/// Returns the bounding box of lines.
pub(super) fn around(lines: &Lines) -> Rect {
    let points = lines.iter().flatten().map(|&point| Rect::of(point));
    points.reduce(Rect::union).unwrap_or(Rect::of((0.0, 0.0)))
}
