//! Legends, which are always outside the frame.

use crate::panel::{Panel, Series, is_drawable};
use crate::theme::{Colour, Stroke};
use crate::{Label, PlotError, Theme};

/// Entry of a legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) label: Label,
    pub(crate) sample: Sample,
}

/// Symbol before a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Sample {
    /// No symbol, for the note that entries were left out.
    None,
    /// Piece of a curve.
    Line(Stroke),
    /// Point.
    Dot(Stroke),
    /// Piece of an area.
    Swatch(Colour),
}

/// Entries in rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Legend {
    /// Entries with their left edges, px from the left edge of the legend.
    pub(crate) rows: Vec<Vec<(f64, Entry)>>,
}

/// Gap between symbol and text, em.
const SAMPLE_GAP: f64 = 0.4;
/// Height of a row, em.
pub(crate) const ROW: f64 = 1.4;
/// Gap between two entries, em.
const ENTRY_GAP: f64 = 1.3;

/// Returns the legend entries of a panel: named series in order, then mosaic classes, bands, shapes and reference lines. Equal entries are
/// listed once.
pub(crate) fn entries(panel: &Panel<'_>, theme: &Theme) -> Vec<Entry> {
    let curves = panel.series.iter().enumerate().map(|(place, series)| {
        let stroke = theme.stroke(series.style, place);
        (&series.label, if series.is_scattered() { Sample::Dot(stroke) } else { Sample::Line(stroke) })
    });
    let swatch = |ink| Sample::Swatch(theme.colour(ink));
    let classes = panel.mosaic.iter().flat_map(|mosaic| &mosaic.classes);
    let classes = classes.map(|(label, ink)| (label, swatch(*ink)));
    let bands = panel.bands.iter().map(|band| (&band.label, swatch(band.ink)));
    let shapes = panel.shapes.iter().map(|shape| (&shape.label, swatch(shape.ink)));
    let lines = panel
        .references
        .iter()
        .map(|reference| (reference.label(), Sample::Line(theme.reference(panel.place_of(reference)))));
    let mut entries: Vec<Entry> = Vec::new();
    for (label, sample) in curves.chain(classes).chain(bands).chain(shapes).chain(lines) {
        let entry = Entry { label: label.clone(), sample };
        if !label.is_empty() && !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    entries
}

impl Series<'_> {
    /// Returns whether the series has only isolated points: a single point, or several points with gaps between them.
    pub(crate) fn is_scattered(&self) -> bool {
        let drawn = |(x, y): (&f64, &f64)| is_drawable(*x) && is_drawable(*y);
        let drawn: Vec<bool> = self.xs.iter().zip(self.ys.iter()).map(drawn).collect();
        drawn.contains(&true) && drawn.windows(2).all(|pair| pair != [true, true])
    }
}

impl Sample {
    /// Returns the width, px.
    pub(crate) fn width(self, em: f64) -> f64 {
        em * match self {
            Self::None => 0.0,
            Self::Line(_) => 2.3,
            Self::Dot(_) => 0.6,
            Self::Swatch(_) => 1.3,
        }
    }
}

impl Entry {
    /// Returns the left edge of the text, px from the left edge of the entry.
    pub(crate) fn text_at(&self, em: f64) -> f64 {
        if self.sample == Sample::None { 0.0 } else { self.sample.width(em) + SAMPLE_GAP * em }
    }

    fn width(&self, em: f64) -> Result<f64, PlotError> {
        Ok(self.text_at(em) + self.label.width(em)?)
    }
}

impl Legend {
    /// Wraps the entries into as few rows as possible. Entries that need more than `most` rows are only counted.
    pub(crate) fn new(entries: &[Entry], width: f64, em: f64, most: usize) -> Result<Self, PlotError> {
        let all = Self::flow(entries, width, em)?;
        if all.rows.len() <= most {
            return Ok(all);
        }
        // Entries are left out from the end until the rest and the note fit.
        for kept in (0..entries.len()).rev() {
            let mut shorter = entries[..kept].to_vec();
            shorter.push(Entry {
                label: Label::plain(&format!("… and {} more", entries.len() - kept)),
                sample: Sample::None,
            });
            let legend = Self::flow(&shorter, width, em)?;
            if legend.rows.len() <= most {
                return Ok(legend);
            }
        }
        Ok(Self::default())
    }

    /// Returns the width of the widest row, px.
    pub(crate) fn width(&self, em: f64) -> Result<f64, PlotError> {
        let mut most = 0.0_f64;
        for (left, entry) in self.rows.iter().filter_map(|row| row.last()) {
            most = most.max(left + entry.width(em)?);
        }
        Ok(most)
    }

    /// Returns the height, px.
    pub(crate) fn height(&self, em: f64) -> f64 {
        self.rows.len() as f64 * ROW * em
    }

    /// Arranges the entries in rows; several rows are aligned in columns if that takes at most one more row.
    fn flow(entries: &[Entry], width: f64, em: f64) -> Result<Self, PlotError> {
        let mut widths = Vec::new();
        let mut cut = Vec::new();
        for entry in entries {
            let label = entry.label.cut(em, width - entry.text_at(em))?;
            cut.push(Entry { label, sample: entry.sample });
            widths.push(cut[cut.len() - 1].width(em)?);
        }
        let gap = ENTRY_GAP * em;
        let ragged = rows(&widths, width, gap);
        let widest = widths.iter().copied().fold(0.0, f64::max);
        let aligned = rows(&vec![widest; widths.len()], width, gap);
        let in_columns = row_count(&ragged) > 1 && row_count(&aligned) <= row_count(&ragged) + 1;
        let lefts = if in_columns { aligned } else { ragged };
        let mut rows: Vec<Vec<(f64, Entry)>> = vec![Vec::new(); row_count(&lefts)];
        for ((row, left), entry) in lefts.into_iter().zip(cut) {
            rows[row].push((left, entry));
        }
        Ok(Self { rows })
    }
}

/// Returns the row and left edge of entries of given widths.
fn rows(widths: &[f64], most: f64, gap: f64) -> Vec<(usize, f64)> {
    let (mut row, mut at) = (0, 0.0);
    let mut places = Vec::new();
    for width in widths {
        if at > 0.0 && at + width > most {
            (row, at) = (row + 1, 0.0);
        }
        places.push((row, at));
        at += width + gap;
    }
    places
}

/// Returns the number of rows.
fn row_count(places: &[(usize, f64)]) -> usize {
    places.last().map_or(0, |(row, _)| row + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Series;
    use crate::panel::Reference;

    fn panel(names: usize) -> Panel<'static> {
        let series = (0..names)
            .map(|i| Series::new(format!("series number {i}"), vec![0.0; 2], vec![0.0; 2]))
            .collect();
        Panel { series, ..Panel::default() }
    }

    #[test]
    fn rows_wrap_and_a_crowd_is_counted() {
        let theme = Theme::light();
        let few = Legend::new(&entries(&panel(5), &theme), 1000.0, 30.0, 3).unwrap();
        assert_eq!(few.rows.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2, 1]);
        let many = Legend::new(&entries(&panel(50), &theme), 1000.0, 30.0, 3).unwrap();
        assert_eq!(many.rows.len(), 3);
        let named = many.rows.iter().flatten().filter(|(_, entry)| entry.sample != Sample::None).count();
        assert_eq!(many.rows[2].last().unwrap().1.label.text(), format!("… and {} more", 50 - named));
        assert!(named >= 5 && many.width(30.0).unwrap() <= 1000.0);
    }

    #[test]
    fn one_name_is_listed_once() {
        let theme = Theme::light();
        let line = |y| Reference::Horizontal { y, label: Label::plain("limit") };
        let panel = Panel { references: vec![line(1.0), line(-1.0)], ..panel(0) };
        assert_eq!(entries(&panel, &theme).len(), 1);
        // Two reference lines with different names must differ in their dashes.
        let names =
            ["stall", "best", "stall"].map(|name| Reference::Vertical { x: 1.0, label: Label::plain(name) });
        let panel = Panel { references: names.to_vec(), ..panel };
        let told = entries(&panel, &theme);
        assert!(told.len() == 2 && told[0].sample != told[1].sample);
        assert!(Legend::new(&[], 100.0, 30.0, 3).unwrap().rows.is_empty());
    }
}
