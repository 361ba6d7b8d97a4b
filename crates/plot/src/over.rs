//! Overlays of several results in one figure.

use crate::Label;
use crate::figure::Figure;
use crate::panel::{Band, Mosaic, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};
use std::borrow::Cow;

/// Width of a curve in an overlay, as a multiple of the usual width.
const FINE: f64 = 0.75;

/// Overlays the curves of figures of the same kind. Each figure has a colour and a legend entry; its curves differ in dashes.
///
/// Pale curves are left out, and muted curves are taken from the first figure only. Reference lines that differ between figures are named
/// after their figure. Panels that not all figures have are left out. Returns `None` if no panel with curves remains.
pub fn overlaid<'a>(title: &str, figures: &[(String, Figure<'a>)]) -> Option<Figure<'a>> {
    let (_, first) = figures.first()?;
    let of_all = |place: usize| -> Option<Vec<(&str, Panel<'a>)>> {
        figures.iter().map(|(name, figure)| Some((name.as_str(), like(figure, first, place)?))).collect()
    };
    let panels: Vec<Panel<'a>> = (0..first.panels.len()).filter_map(of_all).map(panel).collect();
    if panels.iter().all(|panel| panel.series.is_empty()) {
        return None;
    }
    // The arrangement is that of a figure with just these panels.
    let mut all = figures.iter().map(|(_, figure)| figure);
    let stands = all.find(|figure| figure.panels.len() == panels.len()).unwrap_or(first).clone();
    Some(Figure { title: Label::plain(title), panels, provenance: Vec::new(), ..stands })
}

/// Returns the panel of a figure with the same quantities as panel `place` of the first figure; among several, the panel of equal rank.
fn like<'a>(figure: &Figure<'a>, first: &Figure<'a>, place: usize) -> Option<Panel<'a>> {
    let shown = |panel: &Panel<'_>| {
        let [x, y] = [&panel.x, &panel.y].map(|axis| (axis.label.text(), axis.unit.clone()));
        // An enlarged time range is a panel of its own kind.
        (x, y, panel.x.covers.is_some())
    };
    let own = shown(&first.panels[place]);
    let before = first.panels[..place].iter().filter(|panel| shown(panel) == own).count();
    figure.panels.iter().filter(|panel| shown(panel) == own).nth(before).cloned()
}

/// Overlays panels of the same quantities, each with the name of its figure.
fn panel<'a>(panels: Vec<(&str, Panel<'a>)>) -> Panel<'a> {
    let mut all: Panel<'a> = panels.first().map(|(_, panel)| panel.clone()).unwrap_or_default();
    (all.series, all.bands, all.references) = (Vec::new(), Vec::new(), Vec::new());
    all.enlarged = all.enlarged.filter(|_| panels.iter().all(|(_, panel)| panel.enlarged == all.enlarged));
    let differ = differing(&panels);
    let others = panels.iter().skip(1).map(|(_, panel)| panel.series.clone()).collect::<Vec<_>>();
    for (result, (name, panel)) in panels.into_iter().enumerate() {
        // Second axes are kept only if all panels have the same.
        all.top = all.top.filter(|top| panel.top.as_ref() == Some(top));
        all.right = all.right.filter(|right| panel.right.as_ref() == Some(right));
        for reference in panel.references {
            let named =
                if differ.contains(&reference.label().text()) { reference.of(name) } else { reference };
            if !all.references.contains(&named) {
                all.references.push(named);
            }
        }
        let (behind, shown): (Vec<_>, Vec<_>) =
            panel.series.into_iter().partition(|series| series.style.ink == Some(Ink::Muted));
        if result == 0 {
            // Muted curves that differ between the results carry the name of the first.
            let own = |series: Series<'a>| {
                let is_of_all = others.iter().all(|other| other.contains(&series));
                if is_of_all { series } else { Series { label: named(name, &series), ..series } }
            };
            all.series.extend(behind.into_iter().map(own));
        }
        let is_seen = |series: &Series<'a>| !matches!(series.style.ink, Some(Ink::Pale(_)));
        let shown: Vec<Series<'a>> = shown.into_iter().filter(is_seen).collect();
        let is_only = shown.len() == 1;
        for (dash, series) in shown.into_iter().enumerate() {
            let label = if is_only { Label::plain(name) } else { named(name, &series) };
            let style = Style { ink: Some(Ink::Palette(result)), dash: Some(Dash::at(dash)), width: FINE };
            all.series.push(Series { style, label, directed: false, ..series });
        }
    }
    all
}

/// Returns the legend entry of a curve: name of the figure, and of the curve if it has one.
fn named(name: &str, series: &Series<'_>) -> Label {
    match series.label.text() {
        label if label.is_empty() => Label::plain(name),
        label => Label::plain(&format!("{name}: {label}")),
    }
}

/// Returns the names of reference lines that are not the same in all panels.
fn differing(panels: &[(&str, Panel<'_>)]) -> Vec<String> {
    let first = panels.first().map(|(_, panel)| &panel.references[..]).unwrap_or_default();
    let others = panels.iter().skip(1).flat_map(|(_, panel)| &panel.references);
    let named = others.filter(|other| !first.contains(other)).map(|other| other.label().text());
    named.filter(|name| !name.is_empty()).collect()
}

impl Reference {
    /// Adds the name of a result to the name of a reference line.
    fn of(self, name: &str) -> Self {
        let named = |label: Label| label.followed_by(&format!(" of {name}"));
        match self {
            Self::Horizontal { y, label } => Self::Horizontal { y, label: named(label) },
            Self::Vertical { x, label } => Self::Vertical { x, label: named(label) },
        }
    }
}

impl Figure<'_> {
    /// Converts borrowed data to owned data.
    pub fn into_owned(self) -> Figure<'static> {
        let panels = self.panels.into_iter().map(owned).collect();
        Figure {
            panels,
            title: self.title,
            arrangement: self.arrangement,
            size: self.size,
            print_width: self.print_width,
            theme: self.theme,
            provenance: self.provenance,
        }
    }
}

fn owned(panel: Panel<'_>) -> Panel<'static> {
    let numbers = |values: Cow<'_, [f64]>| Cow::Owned(values.into_owned());
    let curve = |series: Series<'_>| Series {
        xs: numbers(series.xs),
        ys: numbers(series.ys),
        label: series.label,
        style: series.style,
        marked: series.marked,
        directed: series.directed,
    };
    let area = |band: Band<'_>| Band {
        xs: numbers(band.xs),
        low: numbers(band.low),
        high: numbers(band.high),
        label: band.label,
        ink: band.ink,
    };
    let cells = |mosaic: Mosaic<'_>| Mosaic {
        xs: numbers(mosaic.xs),
        ys: numbers(mosaic.ys),
        cells: Cow::Owned(mosaic.cells.into_owned()),
        classes: mosaic.classes,
    };
    Panel {
        series: panel.series.into_iter().map(curve).collect(),
        bands: panel.bands.into_iter().map(area).collect(),
        mosaic: panel.mosaic.map(cells),
        heading: panel.heading,
        x: panel.x,
        y: panel.y,
        shapes: panel.shapes,
        references: panel.references,
        notes: panel.notes,
        lanes: panel.lanes,
        absence: panel.absence,
        top: panel.top,
        right: panel.right,
        enlarged: panel.enlarged,
        aspect: panel.aspect,
        share: panel.share,
    }
}
