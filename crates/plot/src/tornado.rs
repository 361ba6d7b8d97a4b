//! Tornado plot: sensitivities as bars in descending order.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Lane, Mark, Panel, Reference};
use crate::{Ink, Label};

/// Sensitivities of one result.
#[derive(Debug, Clone, PartialEq)]
pub struct Tornado<'a> {
    /// Name of the result.
    pub name: &'a str,
    /// Label of the horizontal axis.
    pub axis: String,
    /// Bars in descending order of length.
    pub bars: Vec<Bar>,
    /// Message if there are no bars.
    pub absence: &'a str,
}

/// Bar of a sensitivity, from zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// Name of the parameter, left of the bar.
    pub name: String,
    /// Text right of the bar.
    pub note: String,
    /// End of the bar on the axis.
    pub length: f64,
    /// Whether the bar is one of two different one-sided sensitivities; drawn pale.
    pub is_half: bool,
}

/// Height of heading and axis, in lanes.
const FRAME: usize = 3;

/// Draws one panel per result, with a height proportional to the number of bars. Positive and negative sensitivities differ in colour.
pub fn tornado_figure<'a>(title: &str, tornados: &[Tornado<'a>]) -> Figure<'a> {
    if tornados.is_empty() {
        return Figure::without_data(title, "no figure");
    }
    let lanes = |tornado: &Tornado<'_>| tornado.bars.len().max(1) + FRAME;
    let panel = |tornado: &Tornado<'a>| Panel {
        heading: Label::plain(tornado.name),
        x: Axis::new(Label::plain(&tornado.axis), ""),
        lanes: tornado.bars.iter().map(lane).collect(),
        references: vec![Reference::Vertical { x: 0.0, label: Label::default() }],
        absence: Label::plain(tornado.absence),
        share: lanes(tornado) as f64,
        ..Panel::default()
    };
    Figure {
        title: Label::plain(title),
        panels: tornados.iter().map(panel).collect(),
        arrangement: Arrangement::Column { share_x: false },
        size: Figure::size_for(160, 62, tornados.iter().map(lanes).sum()),
        ..Figure::default()
    }
}

fn lane(bar: &Bar) -> Lane {
    let place = usize::from(bar.length < 0.0);
    let ink = if bar.is_half { Ink::Pale(place) } else { Ink::Palette(place) };
    let (from, to) = (bar.length.min(0.0), bar.length.max(0.0));
    Lane { label: bar.name.clone(), note: bar.note.clone(), marks: vec![Mark { from, to, height: 1.0 }], ink }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(name: &str, length: f64, is_half: bool) -> Bar {
        Bar { name: name.to_owned(), note: format!("{length}"), length, is_half }
    }

    #[test]
    fn bars_lie_on_their_side_of_zero() {
        let bars = vec![bar("friction", 1.5, false), bar("mass", -0.5, false), bar("radius", 0.1, true)];
        let tornado = Tornado { name: "step", axis: "% per %".to_owned(), bars, absence: "none" };
        let empty = Tornado { name: "nothing", bars: Vec::new(), ..tornado.clone() };
        let figure = tornado_figure("Title", &[tornado, empty]);
        let lanes = &figure.panels[0].lanes;
        let spans: Vec<(f64, f64)> =
            lanes.iter().map(|lane| (lane.marks[0].from, lane.marks[0].to)).collect();
        assert_eq!(spans, [(0.0, 1.5), (-0.5, 0.0), (0.0, 0.1)]);
        assert_eq!(
            [lanes[0].ink, lanes[1].ink, lanes[2].ink],
            [Ink::Palette(0), Ink::Palette(1), Ink::Pale(0)]
        );
        assert!(figure.panels[0].share > figure.panels[1].share);
        assert!(crate::draw_svg(&figure).is_ok());
        assert!(crate::draw_svg(&tornado_figure("Title", &[])).is_ok());
    }
}
