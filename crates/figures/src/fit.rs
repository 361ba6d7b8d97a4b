//! Plot of a fit: measured data, model and residual.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{Arrangement, Axis, Dash, Figure, Ink, Label, Panel, Series, Style};
use stickslip_run::Job;
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_study::fit::Fit;

/// Name of the plot.
const NAME: &str = "fit";
/// Height of the panel of the residual relative to the other panel.
const RESIDUAL: f64 = 0.4;

/// Returns all possible file names of the plot.
#[must_use]
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&[NAME])
}

/// Draws a fit: loops over displacement, other data over time.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw((job, fit): (&Job, &Fit), look: &Look) -> Result<Vec<Picture>, FigureError> {
    let (data, count) = (&fit.data, fit.data.t.len());
    let x = if data.is_loop { &data.u } else { &data.t };
    let axis = || match data.is_loop {
        true => Axis::new(Label::plain("displacement u"), "m"),
        false => Axis::new(Label::plain("time t"), "s"),
    };
    let closed = |values: &[f64]| {
        let end = values.first().copied().filter(|_| data.is_loop);
        values[..count].iter().copied().chain(end).collect::<Vec<f64>>()
    };
    let (x, measured, model) = (closed(x), closed(&data.force), closed(&fit.force));
    let left: Vec<f64> = measured.iter().zip(&model).map(|(measured, model)| measured - model).collect();
    let style = |ink, width| Style { ink: Some(ink), dash: Some(Dash::Solid), width };
    let loops = Panel {
        x: axis(),
        y: Axis::new(Label::markup("tangential force F_x"), "N"),
        series: vec![
            Series { style: style(Ink::Pale(0), 2.4), ..Series::new("measured", x.clone(), measured) },
            Series { style: style(Ink::Palette(1), 1.0), ..Series::new("model", x.clone(), model) },
        ],
        ..Panel::default()
    };
    let residual = Panel {
        x: axis(),
        y: Axis::new(Label::plain("measured minus model"), "N"),
        series: vec![Series { style: style(Ink::Palette(0), 0.9), ..Series::new("", x, left) }],
        share: RESIDUAL,
        ..Panel::default()
    };
    let (title, arrangement) = (Label::plain(job.title()), Arrangement::Column { share_x: true });
    let figure = Figure { title, arrangement, panels: vec![loops, residual], ..Figure::default() };
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, job.program.clone()),
        (HASH, job.hash.clone()),
        (SCENARIO, job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance, kept: None };
    pen.draw_as(NAME, figure).map_err(|source| FigureError::Plot { plot: NAME, source })
}
