//! Result over two parameters: a heat map with contours, or areas of classes with borders.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Mosaic, Note, Panel, Series};
use crate::theme::{Dash, Ink, Style};
use crate::{Label, scale::quantity};

/// Result over two parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct ResultMap<'a> {
    /// Horizontal and vertical axis: name, unit, and whether it is logarithmic.
    pub axes: [(&'a str, &'a str, bool); 2],
    /// Positions of the columns and rows of cells, ascending.
    pub places: [Vec<f64>; 2],
    /// Content of the cells.
    pub content: MapContent<'a>,
    /// Measured points, grouped by the names of their classes.
    pub points: &'a [(String, Vec<[f64; 2]>)],
}

/// Polylines in the frame.
type Lines = Vec<Vec<[f64; 2]>>;

/// Content of the cells of a map.
#[derive(Debug, Clone, PartialEq)]
pub enum MapContent<'a> {
    /// A numerical result.
    Numbers {
        /// Name and unit of the result.
        name: (&'a str, &'a str),
        /// Values, column by column; NaN without a result.
        values: Vec<f64>,
        /// Contour levels and their polylines.
        contours: &'a [(f64, Lines)],
    },
    /// A result with a few classes, such as the sliding regimes.
    Words {
        /// Name of each class.
        words: &'a [String],
        /// Class of each cell, column by column. Cells without a result have the index after the last class.
        classes: Vec<u8>,
        /// Borders between the areas of the classes.
        borders: Lines,
        /// Positions inside the areas for the class names, with the class index.
        names: Vec<([f64; 2], usize)>,
    },
}

/// Palette indices of the first four classes, chosen for regimes from open to gross slip.
const INKS: [usize; 4] = [5, 0, 2, 1];
/// Number of shades of a heat map.
const SHADES: usize = 255;
/// Width of the colour bar relative to the map.
const BAR: f64 = 0.09;
/// Line widths of borders and contours and size of points, as multiples of a curve's width.
const BORDER: f64 = 1.3;
const CONTOUR: f64 = 0.5;
const POINT: f64 = 1.6;

/// Draws the map, with a colour bar for numbers.
pub fn map_figure<'a>(title: &str, map: ResultMap<'a>) -> Figure<'a> {
    let [x, y] = map.axes.map(|(name, unit, logarithmic)| Axis {
        tight: true,
        logarithmic,
        ..Axis::new(Label::plain(name), unit)
    });
    let [xs, ys] = map.places;
    let words = if let MapContent::Words { words, .. } = &map.content { *words } else { &[] };
    let (cells, classes, series, notes, bar) = match map.content {
        MapContent::Numbers { name, values, contours } => numbers(name, &values, contours),
        MapContent::Words { words, classes, borders, names } => {
            let (inks, notes) = areas(words, &classes, &names);
            (classes, inks, curves(&borders, BORDER), notes, None)
        }
    };
    let mosaic = Mosaic { xs: xs.into(), ys: ys.into(), cells: cells.into(), classes };
    let series = series.into_iter().chain(dots(map.points, words)).collect();
    let main = Panel { x, y, mosaic: Some(mosaic), series, notes, share: 1.0, ..Panel::default() };
    Figure {
        title: Label::plain(title),
        panels: std::iter::once(main).chain(bar).collect(),
        arrangement: Arrangement::Row,
        ..Figure::default()
    }
}

/// Cells, classes, polylines, notes and the colour bar of a map.
type Parts<'a> = (Vec<u8>, Vec<(Label, Ink)>, Vec<Series<'a>>, Vec<Note>, Option<Panel<'a>>);

/// Returns the parts of a heat map: shades, contours with level labels, colour bar.
fn numbers<'a>((name, unit): (&str, &str), values: &[f64], contours: &[(f64, Lines)]) -> Parts<'a> {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let shade = |value: &f64| match (value - low) / (high - low) {
        _ if value.is_nan() => SHADES as u8,
        share if share.is_finite() => (share * (SHADES - 1) as f64).round() as u8,
        _ => 0,
    };
    let ramp = || (0..SHADES).map(|shade| (Label::default(), Ink::Ramp(shade as u8)));
    let none = values.iter().any(|value| value.is_nan()).then(|| (Label::plain("no result"), Ink::Muted));
    let series = contours.iter().flat_map(|(_, lines)| curves(lines, CONTOUR)).collect();
    let levels = contours.iter().filter_map(|(level, lines)| {
        let longest = lines.iter().max_by_key(|line| line.len())?;
        let at = longest.get(longest.len() / 2)?;
        let text = quantity(*level, unit, 6);
        Some(Note { lines: vec![Label::plain(&text)], about: [(at[0], at[1]); 2], on: None, ink: None })
    });
    // A range within rounding has no shades.
    let has_shades = (high - low).is_finite() && high - low > 1e-12 * high.abs().max(low.abs());
    let bar = has_shades.then(|| Panel {
        x: Axis { unnumbered: true, tight: true, ..Axis::default() },
        y: Axis { tight: true, ..Axis::new(Label::plain(name), unit) },
        mosaic: Some(Mosaic {
            xs: vec![0.0].into(),
            ys: (0..SHADES)
                .map(|shade| low + (high - low) * (shade as f64 / (SHADES - 1) as f64))
                .collect::<Vec<_>>()
                .into(),
            cells: (0..SHADES).map(|shade| shade as u8).collect::<Vec<_>>().into(),
            classes: ramp().collect(),
        }),
        share: BAR,
        ..Panel::default()
    });
    (values.iter().map(shade).collect(), ramp().chain(none).collect(), series, levels.collect(), bar)
}

/// Returns the colours and names of areas. Classes without a name in the map have a legend entry.
fn areas(words: &[String], classes: &[u8], names: &[([f64; 2], usize)]) -> (Vec<(Label, Ink)>, Vec<Note>) {
    let is_shown = |class: usize| classes.contains(&(class as u8));
    let is_named = |class: usize| names.iter().any(|(_, named)| *named == class);
    let legend = |class: usize, word: &str| {
        if is_shown(class) && !is_named(class) { Label::plain(word) } else { Label::default() }
    };
    let mut inks: Vec<(Label, Ink)> =
        words.iter().enumerate().map(|(class, word)| (legend(class, word), Ink::Pale(ink(class)))).collect();
    inks.push((legend(words.len(), "no result"), Ink::Muted));
    let note = |(at, class): &([f64; 2], usize)| Note {
        lines: vec![Label::plain(words.get(*class).map_or("", String::as_str))],
        about: [(at[0], at[1]); 2],
        on: None,
        ink: Some(Ink::Palette(ink(*class))),
    };
    (inks, names.iter().map(note).collect())
}

/// Returns the palette index of a class.
fn ink(class: usize) -> usize {
    INKS.get(class).copied().unwrap_or(class)
}

/// Returns the polylines in the text colour.
fn curves<'a>(lines: &[Vec<[f64; 2]>], width: f64) -> Vec<Series<'a>> {
    let style = Style { ink: Some(Ink::Foreground), dash: Some(Dash::Solid), width };
    let curve = |line: &Vec<[f64; 2]>| {
        let along = |axis: usize| line.iter().map(|point| point[axis]).collect::<Vec<_>>();
        Series { style, ..Series::new(Label::default(), along(0), along(1)) }
    };
    lines.iter().map(curve).collect()
}

/// Returns the measured points as discs with a rim. A point of a class that occurs in the map has the colour of that class.
fn dots<'a>(classes: &[(String, Vec<[f64; 2]>)], words: &[String]) -> Vec<Series<'a>> {
    let dot = |(place, (name, points)): (usize, &(String, Vec<[f64; 2]>))| {
        // Gaps prevent connecting lines.
        let along = |axis: usize| points.iter().flat_map(|point| [point[axis], f64::NAN]).collect::<Vec<_>>();
        let disc = |label: &str, ink, width| Series {
            style: Style { ink: Some(ink), dash: None, width },
            marked: true,
            ..Series::new(Label::plain(label), along(0), along(1))
        };
        let place = words.iter().position(|word| word == name).map_or(place, ink);
        let name = if name.is_empty() { "measured".to_owned() } else { format!("measured: {name}") };
        [disc("", Ink::Foreground, 1.5 * POINT), disc(&name, Ink::Palette(place), POINT)]
    };
    classes.iter().enumerate().flat_map(dot).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_of_numbers_and_words_are_drawn_on_either_axis() {
        let places = || [vec![0.1, 1.0, 10.0], vec![1.0, 2.0]];
        let axes = [("load", "N", true), ("stroke", "m", false)];
        let contours = [(2.0, vec![vec![[0.1, 1.5], [10.0, 1.5]]])];
        let values = vec![0.0, 1.0, 2.0, 3.0, f64::NAN, 5.0];
        let content = MapContent::Numbers { name: ("step", "m"), values, contours: &contours };
        let points = [("gross".to_owned(), vec![[0.5, 1.2], [5.0, 1.8]])];
        let figure = map_figure("Title", ResultMap { axes, places: places(), content, points: &points });
        assert_eq!((figure.panels.len(), figure.panels[0].notes.len()), (2, 1));
        assert!(crate::draw_png(&figure).is_ok() && crate::draw_svg(&figure).is_ok());
        let words = ["partial", "gross"].map(str::to_owned);
        let names = vec![([0.1, 1.0], 0), ([10.0, 2.0], 1)];
        let (classes, borders) = (vec![0, 0, 1, 1, 1, 2], vec![vec![[0.3, 1.0], [0.3, 2.0]]]);
        let content = MapContent::Words { words: &words, classes, borders, names };
        let figure = map_figure("Title", ResultMap { axes, places: places(), content, points: &[] });
        let svg = crate::draw_svg(&figure).unwrap();
        assert!(["partial", "gross", "no result", "load"].iter().all(|word| svg.contains(word)));
    }
}
