//! Positions of notes inside a frame, without overlap.

use crate::PlotError;
use crate::label::Label;
use crate::layout::{Area, Placed, Sizes};
use crate::panel::Note;
use crate::theme::Ink;
use crate::thin::Point;

/// Note with its position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlacedNote {
    /// Font size, px per em.
    pub(crate) em: f64,
    /// Lines, each with the midpoint of its baseline.
    pub(crate) lines: Vec<(Label, Point)>,
    /// Pointer from the text to the named part, if the part is distant.
    pub(crate) pointer: Option<[Point; 2]>,
    /// Ink of the named part, if the text takes its colour.
    pub(crate) ink: Option<Ink>,
}

/// Grid cells per em; candidate positions are one cell apart.
const FINENESS: f64 = 10.0;
/// Height of a line, em.
const LINE: f64 = 1.25;
/// Free margin around a text, em.
const CLEAR: f64 = 0.32;
/// Distance beyond which a note has a pointer, em.
const FAR: f64 = 0.9;
/// Penalty for lying completely on a foreign shape, and for needing a pointer, as a distance in em.
const FOREIGN: f64 = 3.0;
const POINTING: f64 = 1.5;
/// Penalty for each line that a pointer crosses, as a distance in em.
const CROSSING: f64 = 1.0;
/// Weight of the distance between the centres of note and named part; this term decides between positions at equal distance.
const CENTRED: f64 = 0.1;
/// Maximum line width as a fraction of the frame, and the maximum number of lines into which a longer line is broken.
const WIDEST: f64 = 0.3;
const BROKEN: usize = 3;
/// Maximum number of notes that are placed; the others are only counted.
const MOST: usize = 200;
/// Maximum number of candidate positions that are checked for pointers, in order of cost. This limit bounds the time with many notes.
const TRIED: usize = 10_000;

/// Finds positions for the notes of a panel. The number of notes left out appears inside the frame, or in the label
/// of the x axis if there is no room.
pub(crate) fn place(panel: &mut Placed<'_, '_>, sizes: Sizes) -> Result<(), PlotError> {
    let notes = &panel.panel.notes;
    if notes.is_empty() || panel.empty {
        return Ok(());
    }
    let mut placed = Vec::new();
    let mut board = Board::new(panel, sizes.tick);
    for note in notes.iter().take(MOST) {
        placed.extend(board.set(panel, note)?);
    }
    panel.lost = notes.len() - placed.len();
    if panel.lost > 0 {
        let words = format!("and {} more", panel.lost);
        let corner = (panel.x.end(), panel.y.end());
        let note = Note { lines: vec![Label::plain(&words)], about: [corner; 2], on: None, ink: None };
        match board.set(panel, &note)? {
            // The note names no part of the drawing.
            Some(note) => placed.push(PlacedNote { pointer: None, ..note }),
            None => panel.x.label = panel.x.label.clone().followed_by(&format!("; {} left out", panel.lost)),
        }
    }
    panel.notes = placed;
    Ok(())
}

/// Grid of cells over the frame, each with the lines, texts and shapes that cover it.
struct Board {
    frame: Area,
    em: f64,
    columns: usize,
    rows: usize,
    /// Whether a line or a text covers the cell.
    taken: Vec<bool>,
    /// Whether a text covers the cell.
    texts: Vec<bool>,
    /// Topmost shape on the cell, counted from 1; 0 for none.
    shapes: Vec<usize>,
}

/// Text to be placed, with its size in cells.
struct Text {
    width: usize,
    height: usize,
    /// Rectangle of the named part, px.
    about: Area,
}

impl Board {
    fn new(panel: &Placed<'_, '_>, em: f64) -> Self {
        let frame = panel.frame;
        let count = |length: f64| (length * FINENESS / em).floor().max(1.0) as usize;
        let (columns, rows) = (count(frame.width), count(frame.height));
        let cells = columns * rows;
        let (taken, texts, shapes) = (vec![false; cells], vec![false; cells], vec![0; cells]);
        let mut board = Self { frame, em, columns, rows, taken, texts, shapes };
        for (place, shape) in panel.panel.shapes.iter().enumerate() {
            let corners: Vec<Point> = shape.drawable().map(|corner| panel.pixel(corner)).collect();
            board.pave(&corners, place + 1);
        }
        for series in &panel.panel.series {
            let points: Vec<Option<Point>> =
                panel.panel.points(series).map(|point| point.map(|p| panel.pixel(p))).collect();
            match points[..] {
                [Some(only)] => board.stroke([only, only]),
                _ => points.windows(2).for_each(|pair| {
                    if let [Some(from), Some(to)] = *pair {
                        board.stroke([from, to]);
                    }
                }),
            }
        }
        board
    }

    /// Places a note at the best position and marks its cells. Returns `None` if there is no free position.
    fn set(&mut self, panel: &Placed<'_, '_>, note: &Note) -> Result<Option<PlacedNote>, PlotError> {
        let em = self.em;
        let mut lines = Vec::new();
        for line in &note.lines {
            lines.extend(line.wrapped(em, WIDEST * self.frame.width, BROKEN)?);
        }
        let width = lines.iter().map(|line| line.width(em)).collect::<Result<Vec<_>, _>>()?;
        let width = width.into_iter().fold(0.0, f64::max);
        let cells = |ems: f64| (ems * FINENESS).ceil() as usize;
        let height = cells(LINE * lines.len() as f64 + 2.0 * CLEAR);
        let measured = |(x, y): Point| (panel.panel.x.measure(x), panel.panel.y.measure(y));
        let [a, b] = note.about.map(|corner| panel.pixel(measured(corner)));
        let (left, top) = (a.0.min(b.0), a.1.min(b.1));
        let about = Area { left, top, width: (a.0 - b.0).abs(), height: (a.1 - b.1).abs() };
        let text = Text { width: cells(width / em + 2.0 * CLEAR), height, about };
        let Some((column, row)) = self.search(&text, note.on) else { return Ok(None) };
        let area = self.area(&text, (column, row));
        let pointer = self.pointer(area, about);
        if let Some(pointer) = pointer {
            self.stroke(pointer);
        }
        for row in row..row + text.height {
            let cells = row * self.columns + column..row * self.columns + column + text.width;
            self.taken[cells.clone()].fill(true);
            self.texts[cells].fill(true);
        }
        let middle = area.left + area.width / 2.0;
        let baseline = |i: usize| area.top + ((i as f64 + 0.5) * LINE + CLEAR + 0.36) * em;
        let lines = lines.into_iter().enumerate().map(|(i, line)| (line, (middle, baseline(i))));
        Ok(Some(PlacedNote { em, lines: lines.collect(), pointer, ink: note.ink }))
    }

    /// Returns the free position with the lowest cost, as column and row of the top left cell.
    fn search(&self, text: &Text, on: Option<usize>) -> Option<(usize, usize)> {
        let own = on.map_or(0, |place| place + 1);
        let taken = Sums::new(self, |cell| self.taken[cell]);
        let foreign = Sums::new(self, |cell| self.shapes[cell] != 0 && self.shapes[cell] != own);
        let size = (text.width, text.height);
        let columns = 0..(self.columns + 1).saturating_sub(text.width);
        let rows = 0..(self.rows + 1).saturating_sub(text.height);
        let places = rows.flat_map(|row| columns.clone().map(move |column| (column, row)));
        let free = places.filter(|&at| taken.count(at, size) == 0);
        let mut places: Vec<(f64, (usize, usize))> = free
            .map(|at| {
                let share = f64::from(foreign.count(at, size)) / (text.width * text.height) as f64;
                (self.cost(text, at) + FOREIGN * share, at)
            })
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Option<(f64, (usize, usize))> = None;
        for (cost, at) in places.into_iter().take(TRIED) {
            if best.is_some_and(|(least, _)| cost >= least) {
                break;
            }
            let pointer = self.pointer(self.area(text, at), text.about);
            let Some(crossed) = pointer.map_or(Some(0), |pointer| self.crossed(pointer)) else { continue };
            let cost = cost + CROSSING * crossed as f64;
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, at));
            }
        }
        best.map(|(_, at)| at)
    }

    /// Returns the cost of a position for its distance from the named part, em.
    fn cost(&self, text: &Text, at: (usize, usize)) -> f64 {
        let area = self.area(text, at);
        let away = distance(area, text.about) / self.em;
        let (here, there) = (centre(area), centre(text.about));
        let off = math::hypot(here.0 - there.0, here.1 - there.1) / self.em;
        away + CENTRED * off + if away > FAR { POINTING } else { 0.0 }
    }

    /// Returns the rectangle of a text at a position, px.
    fn area(&self, text: &Text, (column, row): (usize, usize)) -> Area {
        let cell = self.em / FINENESS;
        let (left, top) = (self.frame.left + column as f64 * cell, self.frame.top + row as f64 * cell);
        Area { left, top, width: text.width as f64 * cell, height: text.height as f64 * cell }
    }

    /// Returns the pointer from a text to the named part; `None` if they are close.
    fn pointer(&self, text: Area, about: Area) -> Option<[Point; 2]> {
        let end = nearest(about, centre(text));
        let inner = CLEAR * self.em;
        let (width, height) = (text.width - 2.0 * inner, text.height - 2.0 * inner);
        let text_alone = Area { left: text.left + inner, top: text.top + inner, width, height };
        (distance(text, about) > FAR * self.em).then(|| [nearest(text_alone, end), end])
    }

    /// Returns the number of lines that a pointer crosses; `None` if it crosses a text.
    fn crossed(&self, pointer: [Point; 2]) -> Option<usize> {
        let (mut crossed, mut was_taken) = (0, false);
        for cell in self.cells(pointer) {
            if self.texts[cell] {
                return None;
            }
            crossed += usize::from(self.taken[cell] && !was_taken);
            was_taken = self.taken[cell];
        }
        Some(crossed)
    }

    fn stroke(&mut self, line: [Point; 2]) {
        let cells: Vec<usize> = self.cells(line).collect();
        cells.into_iter().for_each(|cell| self.taken[cell] = true);
    }

    /// Returns the cells along a line, inside the frame.
    fn cells(&self, [from, to]: [Point; 2]) -> impl Iterator<Item = usize> + '_ {
        let cell = self.em / FINENESS;
        // No visible line is longer than both sides of the frame together.
        let most = 4.0 * (self.columns + self.rows) as f64;
        let steps = (2.0 * math::hypot(to.0 - from.0, to.1 - from.1) / cell).ceil().clamp(1.0, most) as usize;
        (0..=steps).filter_map(move |k| {
            let share = k as f64 / steps as f64;
            let x = (from.0 + share * (to.0 - from.0) - self.frame.left) / cell;
            let y = (from.1 + share * (to.1 - from.1) - self.frame.top) / cell;
            let is_inside = x >= 0.0 && y >= 0.0 && x < self.columns as f64 && y < self.rows as f64;
            is_inside.then(|| y as usize * self.columns + x as usize)
        })
    }

    /// Marks the cells whose centres are inside a polygon, by the even-odd rule.
    fn pave(&mut self, corners: &[Point], mark: usize) {
        let cell = self.em / FINENESS;
        for row in 0..self.rows {
            let y = self.frame.top + (row as f64 + 0.5) * cell;
            let edges = corners.iter().zip(corners.iter().cycle().skip(1));
            let mut cuts: Vec<f64> = edges
                .filter(|(a, b)| (a.1 <= y) != (b.1 <= y))
                .map(|(a, b)| a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0))
                .collect();
            cuts.sort_by(f64::total_cmp);
            for pair in cuts.chunks_exact(2) {
                let column = |x: f64| ((x - self.frame.left) / cell - 0.5).ceil().max(0.0) as usize;
                let (from, to) = (column(pair[0]).min(self.columns), column(pair[1]).min(self.columns));
                self.shapes[row * self.columns + from..row * self.columns + to].fill(mark);
            }
        }
    }
}

/// Summed-area table: numbers of marked cells in all rectangles that begin at the first cell.
struct Sums {
    width: usize,
    sums: Vec<u32>,
}

impl Sums {
    fn new(board: &Board, is_marked: impl Fn(usize) -> bool) -> Self {
        let width = board.columns + 1;
        let mut sums = vec![0; width * (board.rows + 1)];
        for row in 0..board.rows {
            let mut along = 0;
            for column in 0..board.columns {
                along += u32::from(is_marked(row * board.columns + column));
                sums[(row + 1) * width + column + 1] = sums[row * width + column + 1] + along;
            }
        }
        Self { width, sums }
    }

    fn count(&self, (column, row): (usize, usize), (width, height): (usize, usize)) -> u32 {
        let sum = |column: usize, row: usize| self.sums[row * self.width + column];
        let (right, bottom) = (column + width, row + height);
        sum(right, bottom) + sum(column, row) - sum(column, bottom) - sum(right, row)
    }
}

fn centre(area: Area) -> Point {
    (area.left + area.width / 2.0, area.top + area.height / 2.0)
}

/// Returns the point of a rectangle that is nearest to a given point.
fn nearest(area: Area, (x, y): Point) -> Point {
    (x.max(area.left).min(area.left + area.width), y.max(area.top).min(area.top + area.height))
}

/// Returns the distance between two rectangles.
fn distance(a: Area, b: Area) -> f64 {
    let gap = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0 - b.1).max(b.0 - a.0 - a.1).max(0.0);
    math::hypot(gap((a.left, a.width), (b.left, b.width)), gap((a.top, a.height), (b.top, b.height)))
}
