//! Figures of several results over each other.

use crate::Label;
use crate::figure::Figure;
use crate::panel::{Band, Mosaic, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};
use std::borrow::Cow;

/// Width of a curve among many.
const FINE: f64 = 0.75;

/// The curves of figures of one kind in one: each figure has a colour, named in the legend, its curves told apart by
/// dashes. What is pale in a figure, for it came before, is left out, and so is what stands behind in all but the first. Lines of
/// one name that lie elsewhere in another figure are named after theirs. Panels are left out from the first on that is not the same in
/// all figures. None where that is the first of all, or none of them has curves.
pub fn overlaid<'a>(title: &str, figures: &[(String, Figure<'a>)]) -> Option<Figure<'a>> {
    let (_, first) = figures.first()?;
    let alike = |figure: &Figure<'_>| {
        let is_like = |(own, other): &(&Panel<'_>, &Panel<'_>)| {
            own.x.unit == other.x.unit && own.y.unit == other.y.unit
        };
        first.panels.iter().zip(&figure.panels).take_while(is_like).count()
    };
    let common = figures.iter().map(|(_, figure)| alike(figure)).min().unwrap_or(0);
    let panels: Vec<Panel<'a>> = (0..common).map(|place| panel(figures, place)).collect();
    if panels.iter().all(|panel| panel.series.is_empty()) {
        return None;
    }
    let figure = Figure { title: Label::plain(title), panels, provenance: Vec::new(), ..first.clone() };
    Some(figure)
}

fn panel<'a>(figures: &[(String, Figure<'a>)], place: usize) -> Panel<'a> {
    let of = |figure: &Figure<'a>| figure.panels[place].clone();
    let mut all: Panel<'a> = figures.first().map(|(_, figure)| of(figure)).unwrap_or_default();
    (all.series, all.bands, all.references) = (Vec::new(), Vec::new(), Vec::new());
    let differ = differing(figures, place);
    for (result, (name, figure)) in figures.iter().enumerate() {
        let panel = of(figure);
        // Another scale is another axis.
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
            all.series.extend(behind);
        }
        let is_seen = |series: &Series<'a>| !matches!(series.style.ink, Some(Ink::Pale(_)));
        let shown: Vec<Series<'a>> = shown.into_iter().filter(is_seen).collect();
        let is_only = shown.len() == 1;
        for (dash, series) in shown.into_iter().enumerate() {
            let words = match series.label.text() {
                label if is_only || label.is_empty() => name.clone(),
                label => format!("{name}: {label}"),
            };
            let style = Style { ink: Some(Ink::Palette(result)), dash: Some(Dash::at(dash)), width: FINE };
            all.series.push(Series { style, label: Label::plain(&words), directed: false, ..series });
        }
    }
    all
}

/// Names of lines that lie elsewhere in some figures than in the first.
fn differing(figures: &[(String, Figure<'_>)], place: usize) -> Vec<String> {
    let of = |figure: &Figure<'_>| figure.panels[place].references.clone();
    let first = figures.first().map(|(_, figure)| of(figure)).unwrap_or_default();
    let others = figures.iter().skip(1).flat_map(|(_, figure)| of(figure));
    let named = others.filter(|other| !first.contains(other)).map(|other| other.label().text());
    named.filter(|name| !name.is_empty()).collect()
}

impl Reference {
    /// The line of a result among those of others.
    fn of(self, name: &str) -> Self {
        let named = |label: Label| label.followed_by(&format!(" of {name}"));
        match self {
            Self::Horizontal { y, label } => Self::Horizontal { y, label: named(label) },
            Self::Vertical { x, label } => Self::Vertical { x, label: named(label) },
        }
    }
}

impl Figure<'_> {
    /// The figure with numbers of its own.
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
