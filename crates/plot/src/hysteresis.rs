//! Hysteresis loops: tangential force over displacement.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Note, Panel, Reference, Rescaled, Series};
use crate::theme::{Dash, Ink, Style};

/// Hysteresis loop of a contact or of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HysteresisLoop<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Displacement u, m.
    pub u: &'a [f64],
    /// Tangential force `F_x`, N.
    pub force: &'a [f64],
    /// Gross slip displacement `u_c`, m; `None` if unknown or not constant.
    pub gross_slip: Option<f64>,
    /// Friction limit `μF_N`, N; `None` if unknown or not constant.
    pub limit: Option<f64>,
}

/// Draws the tangential force over displacement, with the friction limit ±`μF_N` if all loops have the same limit.
///
/// If all loops have the same `u_c` and `μF_N`, second axes show u/`u_c` and `F_x`/`μF_N`. Otherwise a second panel shows the normalised
/// loops for which `u_c` and `μF_N` are known.
pub fn loop_figure<'a>(title: &str, loops: &[HysteresisLoop<'a>]) -> Figure<'a> {
    if loops.is_empty() {
        return Figure::without_data(title, "no contacts");
    }
    let plain = Panel {
        x: Axis::new(Label::plain("displacement u"), "m"),
        y: Axis::new(Label::markup("tangential force F_x"), "N"),
        series: loops.iter().map(|l| Series::new(l.name, l.u, l.force)).collect(),
        references: common_limit(loops).map(limits).unwrap_or_default(),
        ..Panel::default()
    };
    if let Some((gross_slip, limit)) = common_scale(loops) {
        let top = Some(Rescaled { label: Label::markup("u/u_c"), by: gross_slip });
        let right = Some(Rescaled { label: Label::markup("F_x/(μF_N)"), by: limit });
        let panels = vec![Panel { top, right, ..plain }];
        return Figure { title: Label::plain(title), panels, ..Figure::default() }.with_room_for_legends();
    }
    // Palette indices follow the left panel, so that one legend serves both.
    let scaled: Vec<Series<'a>> =
        loops.iter().enumerate().filter_map(|(place, l)| normalised(place, l)).collect();
    let mut panels = vec![plain];
    if !scaled.is_empty() {
        panels.push(Panel {
            x: Axis::new(Label::markup("u/u_c"), ""),
            y: Axis::new(Label::markup("F_x/(μF_N)"), ""),
            series: scaled,
            references: limits(1.0),
            ..Panel::default()
        });
    }
    Figure { title: Label::plain(title), panels, arrangement: Arrangement::Row, ..Figure::default() }
        .with_room_for_legends()
}

/// Draws one loop as [`loop_figure`] does, with named points: displacement (m), force (N), name.
pub fn marked_loop_figure<'a>(
    title: &str,
    of: HysteresisLoop<'a>,
    marks: &[(f64, f64, String)],
) -> Figure<'a> {
    let mut figure = loop_figure(title, &[of]);
    if let Some(panel) = figure.panels.first_mut() {
        let dot = |(u, force, _): &(f64, f64, String)| Series {
            style: Style { ink: Some(Ink::Palette(1)), dash: Some(Dash::Solid), width: 1.8 },
            ..Series::new("", vec![*u], vec![*force])
        };
        panel.series.extend(marks.iter().map(dot));
        let note = |(u, force, name): &(f64, f64, String)| Note {
            lines: vec![Label::plain(name)],
            about: [(*u, *force); 2],
            on: None,
            ink: None,
        };
        panel.notes = marks.iter().map(note).collect();
    }
    figure
}

/// Returns the friction limit of all loops; `None` if it differs or is unknown.
fn common_limit(loops: &[HysteresisLoop<'_>]) -> Option<f64> {
    let first = usable(loops.first()?.limit)?;
    loops.iter().all(|l| l.limit == Some(first)).then_some(first)
}

/// Returns `u_c` and `μF_N` of all loops; `None` if they differ or are unknown.
fn common_scale(loops: &[HysteresisLoop<'_>]) -> Option<(f64, f64)> {
    let gross_slip = usable(loops.first()?.gross_slip)?;
    let limit = common_limit(loops)?;
    loops.iter().all(|l| l.gross_slip == Some(gross_slip)).then_some((gross_slip, limit))
}

fn limits(of: f64) -> Vec<Reference> {
    [of, -of].map(|y| Reference::Horizontal { y, label: Label::markup("±μF_N") }).to_vec()
}

fn usable(value: Option<f64>) -> Option<f64> {
    value.filter(|v| *v > 0.0 && v.is_finite())
}

fn normalised<'a>(place: usize, l: &HysteresisLoop<'a>) -> Option<Series<'a>> {
    let (gross_slip, limit) = (usable(l.gross_slip)?, usable(l.limit)?);
    let divided = |values: &[f64], by: f64| -> Vec<f64> { values.iter().map(|v| v / by).collect() };
    let mut series = Series::new(l.name, divided(l.u, gross_slip), divided(l.force, limit));
    series.style.ink = Some(Ink::Palette(place));
    Some(series)
}
