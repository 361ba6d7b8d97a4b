//! Plots of user-selected channels over another channel.

use super::{Kind, Sources, Undrawn};
use crate::look::{Pen, Picture, own_name};
use stickslip_plot::{Arrangement, Axis, Figure, Label, Panel, Series as Curve};
use stickslip_quantity::names::unit;
use stickslip_run::{Job, Series};
use stickslip_scenario::OwnPlot;

pub(super) const KIND: Kind = Kind { shows: "channels over another channel", needs, draw };

/// Height of each panel after the first, px.
const MORE: u32 = 500;

/// Draws one figure per selection: `xy-1`, `xy-2` and so on.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, series) = (sources.job, &sources.kept.series);
    if job.scenario.own_plots.is_empty() {
        return Err(Undrawn::Unnamed);
    }
    let mut pictures = Vec::new();
    for (number, plot) in (1..).zip(&job.scenario.own_plots) {
        let (from, to) = plot.span;
        let is_part = from > 0.0 || to.is_finite();
        let part = is_part.then(|| series.part((from, to.min(sources.kept.end()))));
        pictures.extend(pen.draw_as(&own_name(number), figure(job, plot, part.as_ref().unwrap_or(series)))?);
    }
    Ok(pictures)
}

/// Returns the columns that the plots require.
fn needs(job: &Job) -> Vec<String> {
    let of = |plot: &OwnPlot| [std::slice::from_ref(&plot.x), &plot.y[..]].concat();
    job.scenario.own_plots.iter().flat_map(of).collect()
}

/// Returns the figure with one panel per unit, in the order of the channels.
fn figure<'a>(job: &Job, plot: &'a OwnPlot, series: &'a Series) -> Figure<'a> {
    let mut units: Vec<&str> = Vec::new();
    for name in &plot.y {
        if !units.contains(&unit(name)) {
            units.push(unit(name));
        }
    }
    let panel = |shared: &&str| {
        let names: Vec<&String> = plot.y.iter().filter(|name| unit(name) == *shared).collect();
        let curve = |name: &&'a String| {
            // A single curve is named by its axis.
            let label = if names.len() == 1 { String::new() } else { spoken(name) };
            Curve::new(label, series.named(&plot.x), series.named(name))
        };
        Panel {
            x: Axis { tight: plot.x == TIME, ..axis(&plot.x) },
            y: match &names[..] {
                [only] => axis(only),
                several => Axis::new(Label::plain(common(several)), shared),
            },
            series: names.iter().map(curve).collect(),
            absence: Label::plain("no rows in this time range"),
            ..Panel::default()
        }
    };
    let panels: Vec<Panel<'_>> = units.iter().map(panel).collect();
    let (width, height) = Figure::DEFAULT_SIZE;
    let more = u32::try_from(panels.len().saturating_sub(1)).unwrap_or(u32::MAX).saturating_mul(MORE);
    Figure {
        title: Label::plain(job.title()),
        panels,
        arrangement: Arrangement::Column { share_x: true },
        size: (width, height.saturating_add(more).min(Figure::MOST)),
        ..Figure::default()
    }
}

/// Name of the time channel.
const TIME: &str = "time_s";

fn axis(channel: &str) -> Axis {
    Axis::new(Label::plain(&spoken(channel)), unit(channel))
}

/// Returns the name of a channel without its unit, which the axis shows with a prefix.
fn spoken(channel: &str) -> String {
    let end = format!("_{}", unit(channel).replace(['/', ' '], "_"));
    channel.strip_suffix(&end).unwrap_or(channel).replacen('.', " ", 1)
}

/// Returns the common quantity of channels with one unit; empty if they differ.
fn common(channels: &[&String]) -> &'static str {
    let quantity = |channel: &String| channel.rsplit('.').next().unwrap_or_default().to_owned();
    let first = channels.first().map(|channel| quantity(channel)).unwrap_or_default();
    let are_alike = channels.iter().all(|channel| quantity(channel) == first);
    QUANTITIES.iter().find(|(name, _)| are_alike && *name == first).map_or("", |(_, words)| words)
}

/// Quantities with a name for the axis.
const QUANTITIES: [(&str, &str); 6] = [
    ("x_m", "position x"),
    ("z_m", "height z"),
    ("u_m", "displacement u"),
    ("d_m", "indentation d"),
    ("fx_N", "tangential force"),
    ("fn_N", "normal force"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_say_what_a_channel_is_without_its_unit() {
        let said = ["ball.fx_N", "slider.vx_m_s", "stage.vpitch_rad_s", "time_s", "drive.value"].map(spoken);
        assert_eq!(said, ["ball fx", "slider vx", "stage vpitch", "time", "drive value"]);
    }
}
