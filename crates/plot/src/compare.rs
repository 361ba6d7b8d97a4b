//! Comparison of two runs.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Channel of two runs. Each curve is a pair of times (s) and values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComparedChannel<'a> {
    /// Name of the channel.
    pub name: &'a str,
    /// Unit of its values.
    pub unit: &'a str,
    /// First run.
    pub a: (&'a [f64], &'a [f64]),
    /// Second run.
    pub b: (&'a [f64], &'a [f64]),
    /// Whether the first run is an excerpt; it is then drawn as points.
    pub is_excerpt: bool,
    /// Difference second minus first at the common times.
    pub difference: (&'a [f64], &'a [f64]),
}

/// Draws two panels per channel: both runs (B dashed), and below the difference B − A.
pub fn compare_figure<'a>(title: &str, names: (&str, &str), channels: &[ComparedChannel<'a>]) -> Figure<'a> {
    if channels.is_empty() {
        return Figure::without_data(title, "no channels to compare");
    }
    let panels: Vec<Panel<'a>> = channels.iter().flat_map(|channel| pair(names, channel)).collect();
    Figure {
        title: Label::plain(title),
        panels,
        arrangement: Arrangement::Column { share_x: true },
        size: Figure::size_for(240, 580, channels.len()),
        ..Figure::default()
    }
    .with_room_for_legends()
}

fn pair<'a>((a, b): (&str, &str), channel: &ComparedChannel<'a>) -> [Panel<'a>; 2] {
    let time = Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") };
    let curve = |name: &str, (xs, ys): (&'a [f64], &'a [f64]), ink, dash| Series {
        style: Style { ink: Some(ink), dash: Some(dash), width: 1.0 },
        ..Series::new(name, xs, ys)
    };
    let points = |mut curve: Series<'a>| {
        if channel.is_excerpt {
            // Gaps prevent connecting lines.
            let apart = |values: &[f64]| values.iter().flat_map(|value| [*value, f64::NAN]).collect();
            (curve.xs, curve.ys, curve.marked) = (apart(&curve.xs), apart(&curve.ys), true);
        }
        curve
    };
    let both = Panel {
        heading: Label::plain(channel.name),
        x: time.clone(),
        y: Axis::new(Label::plain("value"), channel.unit),
        series: vec![
            points(curve(&format!("A: {a}"), channel.a, Ink::Palette(0), Dash::Solid)),
            curve(&format!("B: {b}"), channel.b, Ink::Palette(1), Dash::Dashed),
        ],
        share: 1.6,
        ..Panel::default()
    };
    let difference = Panel {
        heading: Label::plain(&format!("{}, B − A", channel.name)),
        x: time,
        y: Axis::new(Label::default(), channel.unit),
        series: vec![points(curve("", channel.difference, Ink::Foreground, Dash::Solid))],
        references: vec![Reference::Horizontal { y: 0.0, label: Label::default() }],
        absence: Label::plain("no common times"),
        share: 1.0,
        ..Panel::default()
    };
    [both, difference]
}
