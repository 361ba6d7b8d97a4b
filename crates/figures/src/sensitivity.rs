//! Plot of sensitivities: elasticities of results as bars.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{Bar, Tornado, tornado_figure};
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_study::sensitivity::{Sensitivity, Taken};

/// Names of the plot of a complete and of an interrupted sensitivity analysis.
const NAMES: [&str; 2] = ["sensitivity", "sensitivity-partial"];
/// Maximum number of bars per result, and of results; the table contains all.
const BARS: usize = 12;
const FIGURES: usize = 6;
/// Errors above this fraction of the longest bar are given next to the bar.
const DOUBT: f64 = 0.01;
/// Elasticities below this magnitude are written with exponents.
const PLACES: f64 = 0.1;

/// Returns all possible file names of the plot; existing files are deleted when the plot is written. A complete plot also replaces an
/// interrupted one.
pub fn all_files(is_cut: bool) -> Vec<String> {
    Look::all_files_of(&NAMES[usize::from(is_cut)..])
}

/// Draws the elasticities: change of each result in per cent for a change of each parameter by one per cent.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw((asked, taken): (&Sensitivity, &Taken), look: &Look) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, asked.job.title().to_owned()),
        (PROGRAM, asked.job.program.clone()),
        (HASH, asked.job.hash.clone()),
        (SCENARIO, asked.job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance, kept: None };
    let figures = asked.figures.iter().enumerate().take(FIGURES);
    let tornados: Vec<Tornado<'_>> = figures
        .map(|(f, figure)| {
            let all = bars(asked, taken, f);
            let longest = all.iter().fold(0.0, |most: f64, (bar, _)| most.max(bar.length.abs()));
            let more = all.len().saturating_sub(BARS);
            let bars = all.into_iter().take(BARS).map(|(bar, error)| noted(bar, error, longest));
            let axis = match more {
                0 => "change, % per % of the parameter".to_owned(),
                more => format!("change, % per %; {more} shorter bars left out"),
            };
            Tornado { name: &figure.name, axis, bars: bars.collect(), absence: "no elasticities" }
        })
        .collect();
    let is_cut = taken.is_cut();
    let mut title = asked.job.title().to_owned();
    if is_cut {
        let all = asked.figures.len() * asked.quantities.len();
        title.push_str(&format!(" (interrupted: {} of {all} derivatives)", all - taken.faults()));
    }
    let (plot, figure) = (NAMES[usize::from(is_cut)], tornado_figure(&title, &tornados));
    pen.draw_as(plot, figure).map_err(|source| FigureError::Plot { plot, source })
}

/// Returns the bars of a result with their errors, the longest first.
fn bars(asked: &Sensitivity, taken: &Taken, f: usize) -> Vec<(Bar, f64)> {
    let of = |q: usize| {
        let elasticity = move |slope: f64| Taken::elasticity(asked, (f, q), slope);
        let path = &asked.quantities[q].path;
        taken.derivatives[f][q].sides().into_iter().filter_map(move |(side, slope)| {
            let slope = slope.ok()?;
            let (length, error) = (elasticity(slope.value)?, elasticity(slope.error)?.abs());
            let name = side.map_or_else(|| path.clone(), |side| format!("{path}, {side}"));
            // Elasticities that are smaller than their error have no bar.
            (length.abs() > error)
                .then(|| (Bar { name, note: String::new(), length, is_half: side.is_some() }, error))
        })
    };
    taken.order(asked, f).into_iter().flat_map(of).collect()
}

fn noted(bar: Bar, error: f64, longest: f64) -> Bar {
    let doubt = if error > DOUBT * longest { format!(" ± {error:.1e}") } else { String::new() };
    // Three decimals would not resolve small elasticities.
    let length = if bar.length.abs() < PLACES {
        format!("{:+.2e}", bar.length)
    } else {
        format!("{:+.3}", bar.length)
    };
    Bar { note: format!("{length}{doubt}").replace('-', "\u{2212}"), ..bar }
}
