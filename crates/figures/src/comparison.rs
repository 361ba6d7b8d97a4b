//! Plot of a comparison: both runs and their difference in the channels that differ most.

use std::path::Path;
use stickslip_compare::{ChannelDifference, CommonRows, Comparison, Results};
use stickslip_plot::{ComparedChannel, Figure, PlotError, compare_figure, draw_png, draw_svg};
use stickslip_run::program::this_program;

/// Maximum number of channels.
const SHOWN: usize = 3;

/// File format of the plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// PNG.
    Png,
    /// SVG.
    Svg,
}

/// Channel of both runs up to the end of the shorter one, and its difference at the common times.
struct Curve<'a> {
    channel: &'a ChannelDifference,
    a: (&'a [f64], &'a [f64]),
    b: (&'a [f64], &'a [f64]),
    time: Vec<f64>,
    difference: Vec<f64>,
}

impl Form {
    /// Returns the format for a file name extension; `None` for other extensions.
    pub fn of(file: &Path) -> Option<Self> {
        let end = file.extension().map(|end| end.to_string_lossy().to_lowercase());
        match end.as_deref() {
            Some("png") => Some(Self::Png),
            Some("svg") => Some(Self::Svg),
            _ => None,
        }
    }

    fn draw(self, figure: &Figure<'_>) -> Result<Vec<u8>, PlotError> {
        match self {
            Self::Png => draw_png(figure),
            Self::Svg => draw_svg(figure).map(String::into_bytes),
        }
    }
}

/// Draws the comparison. Returns the content of the file and the names of the channels shown.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw(
    (a, b): (&Results, &Results),
    comparison: &Comparison,
    rows: &CommonRows,
    form: Form,
) -> Result<(Vec<u8>, Vec<String>), PlotError> {
    let curves = curves((a, b), comparison, rows);
    let channels: Vec<ComparedChannel<'_>> = curves
        .iter()
        .map(|curve| ComparedChannel {
            name: &curve.channel.name,
            unit: curve.channel.unit,
            a: curve.a,
            b: curve.b,
            is_excerpt: a.is_excerpt(),
            difference: (&curve.time, &curve.difference),
        })
        .collect();
    // The path of an excerpt is of no interest.
    let names =
        if a.is_excerpt() { ("recorded".to_owned(), "now".to_owned()) } else { (legend(a), legend(b)) };
    let mut figure = compare_figure(&comparison.finding(), (&names.0, &names.1), &channels);
    figure.provenance = provenance(comparison);
    let bytes = form.draw(&figure)?;
    Ok((bytes, curves.iter().map(|curve| curve.channel.name.clone()).collect()))
}

/// Returns the numeric channels that differ most relative to their tolerance; if no channel exceeds its tolerance, from all channels.
fn curves<'a>(
    (a, b): (&'a Results, &'a Results),
    comparison: &'a Comparison,
    rows: &CommonRows,
) -> Vec<Curve<'a>> {
    let differs = comparison.channels.iter().any(|channel| channel.excess() > 1.0);
    let wanted = |channel: &&ChannelDifference| !differs || channel.excess() > 1.0;
    let mut channels: Vec<&ChannelDifference> = comparison.channels.iter().filter(wanted).collect();
    channels.sort_by(|p, q| q.excess().total_cmp(&p.excess()));
    let curve = |channel: &'a ChannelDifference| {
        let (first, second) = (a.trace.numbers(&channel.name)?, b.trace.numbers(&channel.name)?);
        let at = |(i, j): &(usize, usize)| Some((*a.time().get(*i)?, second.get(*j)? - first.get(*i)?));
        let (time, difference) = rows.pairs.iter().filter_map(at).unzip();
        // Values after the end of the comparison would compress the time axis.
        let compared = |results: &'a Results, values: &'a [f64]| {
            let end = results.time().partition_point(|&t| t <= comparison.until.0);
            (&results.time()[..end], &values[..end])
        };
        Some(Curve { channel, a: compared(a, first), b: compared(b, second), time, difference })
    };
    channels.into_iter().filter_map(curve).take(SHOWN).collect()
}

/// Returns the name of a run in the legend: the last two components of its path.
fn legend(results: &Results) -> String {
    let parts: Vec<_> = results.folder.iter().map(|part| part.to_string_lossy()).collect();
    parts[parts.len().saturating_sub(2)..].join("/")
}

/// Returns the metadata of the picture.
fn provenance(comparison: &Comparison) -> Vec<(String, String)> {
    let (a, b) = (&comparison.a, &comparison.b);
    let entries = [
        ("Title", comparison.finding()),
        ("Software", this_program()),
        ("Scenario SHA-256 of A", a.scenario_sha256.clone()),
        ("Scenario SHA-256 of B", b.scenario_sha256.clone()),
    ];
    entries.map(|(key, text)| (key.to_owned(), text)).to_vec()
}
