//! Plots of several results in one figure.

use crate::look::{Look, Pen, Picture};
use crate::pictures::{self, FigureError, Sources};
use std::sync::Mutex;
use stickslip_plot::{Axis, Figure, Panel, overlaid};
use stickslip_run::program::this_program;
use stickslip_run::provenance::{HASH, PROGRAM, TITLE};
use stickslip_scenario::PlotName;

/// Plots that can be overlaid: plots that consist of curves only.
pub const OVERLAID: [PlotName; 4] = [PlotName::Loop, PlotName::Trajectory, PlotName::Phase, PlotName::Xy];

/// Returns the name of the overlay of a plot.
pub fn name(plot: &str) -> String {
    format!("over-{plot}")
}

/// Draws a plot of several results in one figure, such as `over-loop.png`. Each result has a name for the legend.
///
/// # Errors
/// If a plot cannot be drawn, or if the results have no panels with curves in common.
pub fn draw(
    results: &[(String, Sources<'_>)],
    plot: PlotName,
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let mut kinds: Vec<(String, Vec<(String, Figure<'static>)>)> = Vec::new();
    for (place, (result, sources)) in results.iter().enumerate() {
        let pen = Pen { look, provenance: Vec::new(), kept: Some(Mutex::default()) };
        pictures::picture(sources, plot, &pen)?;
        for (name, figure) in pen.into_kept() {
            match kinds.iter_mut().find(|(kind, _)| *kind == name) {
                Some((_, figures)) => figures.push((result.clone(), figure)),
                // Figures that the first result does not have cannot be overlaid.
                None if place == 0 => kinds.push((name, vec![(result.clone(), figure)])),
                None => {}
            }
        }
    }
    let pen = Pen { look, provenance: provenance(results), kept: None };
    let mut drawn = Vec::new();
    for (kind, figures) in kinds {
        let unlike = || FigureError::Unlike { plot: plot.name(), unlike: unlike(&figures) };
        let figure = overlaid(&title(results), &figures).ok_or_else(unlike)?;
        let failed = |source| FigureError::Plot { plot: plot.name(), source };
        drawn.extend(pen.draw_as(&name(&kind), figure).map_err(failed)?);
    }
    Ok(drawn)
}

/// Describes the panels of the first figure and of a figure with other panels.
fn unlike(figures: &[(String, Figure<'_>)]) -> String {
    let told = |(name, figure): &(String, Figure<'_>)| format!("{name} has {}", panels(figure));
    let first = figures.first();
    let other =
        figures.iter().find(|(_, figure)| first.is_some_and(|(_, first)| panels(figure) != panels(first)));
    match first.zip(other) {
        Some((first, other)) => {
            format!("the panels of these results differ: {}, {}", told(first), told(other))
        }
        None => "none of these results has data for this plot".to_owned(),
    }
}

/// Describes the panels of a figure by their quantities.
fn panels(figure: &Figure<'_>) -> String {
    let axis = |axis: &Axis| match axis.unit.as_str() {
        "" => axis.label.text().to_owned(),
        unit => format!("{} ({unit})", axis.label.text()),
    };
    let panel = |panel: &Panel<'_>| format!("{} over {}", axis(&panel.y), axis(&panel.x));
    figure.panels.iter().map(panel).collect::<Vec<_>>().join(" and ")
}

/// Returns the common title of the results, or their names.
fn title(results: &[(String, Sources<'_>)]) -> String {
    let mut titles = results.iter().map(|(_, sources)| sources.job.title());
    match titles.next() {
        Some(first) if titles.all(|title| title == first) => first.to_owned(),
        _ => results.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", "),
    }
}

/// Returns the metadata of the picture, which contain only the hashes of its scenarios.
fn provenance(results: &[(String, Sources<'_>)]) -> Vec<(String, String)> {
    let mut texts = vec![(TITLE.to_owned(), title(results)), (PROGRAM.to_owned(), this_program())];
    for (number, (_, sources)) in (1..).zip(results) {
        texts.push((format!("{HASH} of {number}"), sources.job.hash.clone()));
    }
    texts
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_plot::{HysteresisLoop, loop_figure};

    /// The message names the panels that differ.
    #[test]
    fn panels_that_differ_are_named() {
        let of = |limit: Option<f64>| HysteresisLoop {
            name: "ball",
            u: &[0.0, 1e-7],
            force: &[0.0, 1.0],
            gross_slip: limit.map(|_| 1e-7),
            limit,
        };
        // Two different limits require a panel of their own.
        let one = ("one".to_owned(), loop_figure("", &[of(Some(1.0))]));
        let two = ("two".to_owned(), loop_figure("", &[of(Some(1.0)), of(Some(2.0))]));
        let said = unlike(&[one.clone(), two]);
        assert!(said.contains("one has tangential force") && said.contains(" and F"), "{said}");
        assert!(unlike(&[one.clone(), one]).contains("has data"));
    }
}
