//! Comparison with a measurement: fretting with a normal load that varies in phase with the displacement.

use crate::check::{Check, rms};
use crate::data;
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, points};
use crate::subject::ValidationError;
use crate::table::{Table, places};
use serde::Deserialize;
use stickslip_plot::{Figure, Ink, Label, Panel};
use stickslip_run::{Job, Summary, Watcher};
use stickslip_scenario::Scenario;

pub(crate) const NAME: &str = "fretting_load";

const SCENARIO: &str = include_str!("../data/fretting_load.json");
const FILE: &str = "crates/validation/data/fretting_load.json";
/// Maximum load, N; half opening for which the drive is set, m; coefficient of friction; stiffness of the rig, N/m.
const LOAD: f64 = 8528.0;
const OPENING: f64 = 75e-6;
const FRICTION: f64 = 0.65;
const RIG: f64 = 116.699e6;

/// Measured energies relative to those at constant load, by load ratio (minimum divided by maximum).
#[derive(Deserialize)]
struct Known {
    source: String,
    ratio: Vec<(f64, f64)>,
}

/// Dissipated energy per cycle, J, and half opening at Q = 0, m.
struct Loop {
    lost: f64,
    opening: f64,
}

/// Returns the overrides for a load ratio. The amplitude gives a half opening of [`OPENING`] at constant mean load.
fn set(ratio: f64) -> [(String, String); 3] {
    let mean = 0.5 * LOAD * (1.0 + ratio);
    [
        ("waveforms.press.sine.amplitude", 0.5 * LOAD * (1.0 - ratio)),
        ("waveforms.press.sine.offset", mean),
        ("waveforms.shake.sine.amplitude", OPENING + FRICTION * mean / RIG),
    ]
    .map(|(path, value)| (path.to_owned(), format!("{value:.6e}")))
}

fn cycle(ratio: f64, watcher: &dyn Watcher) -> Result<Loop, ValidationError> {
    let set = set(ratio);
    let values: Vec<(&str, &str)> = set.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
    let scenario = Scenario::from_str_with(SCENARIO, FILE, "", &values)?;
    let job = Job::new(scenario, NAME.to_owned(), std::path::PathBuf::new())?;
    let outcome = job.run(watcher);
    let summary = serde_json::to_value(Summary::new(&job, &outcome))?;
    if let Some(error) = outcome.error {
        return Err(error.into());
    }
    let number = |key: &str| summary["contacts"]["pads"]["fretting"][key].as_f64().unwrap_or(f64::NAN);
    Ok(Loop { lost: number("dissipated_J"), opening: number("half_opening_m") })
}

pub(crate) fn page(watcher: &dyn Watcher) -> Result<Page, ValidationError> {
    let known: Known = data::read(data::FRETTING_LOAD)?;
    let whole = cycle(1.0, watcher)?.lost;
    let mut table = Table::new(
        "Dissipated energy of a cycle relative to constant load:",
        &["load ratio", "measured", "program", "off by", "half opening at Q = 0, \u{b5}m"],
    );
    let mut off = Vec::new();
    for &(ratio, measured) in &known.ratio {
        let Loop { lost, opening } = cycle(ratio, watcher)?;
        let own = lost / whole;
        off.push(own - measured);
        let cells = [ratio, measured, own, own - measured].map(|value| places(value, 3));
        table.row(cells.into_iter().chain([places(1e6 * opening, 1)]));
    }
    let smooth: Vec<(f64, f64)> = (1..=10)
        .map(|k| 0.1 * f64::from(k))
        .map(|ratio| Ok((ratio, cycle(ratio, watcher)?.lost / whole)))
        .collect::<Result<_, ValidationError>>()?;
    let arguments = set(0.1).map(|(path, value)| format!("--set {path}={value}"));
    Ok(Page {
        name: NAME,
        title: "Fretting under a varying normal load: measurement",
        setup: SETUP.to_owned(),
        command: format!(
            "Command for the load ratio 0.1:\n\n```sh\nstickslip run {FILE} {}\n```",
            arguments.join(" ")
        ),
        reference: format!("{REFERENCE}\n\nSource: {}.", known.source),
        kind: vec![Kind::Measurement],
        checks: vec![Check::new("rms of the relative dissipated energy, 4 load ratios", "", rms(off), 0.10)],
        figure: figure(&known.ratio, &smooth),
        shows: SHOWS.to_owned(),
        tables: vec![table],
        limits: LIMITS.to_owned(),
    })
}

const SETUP: &str = "Two pads of Ti-6Al-4V (E 119 GPa, \u{3bd} 0.29, friction 0.65) are tested in fretting on a rig with a stiffness of 116.7 N/\u{b5}m. The normal load \
varies in phase with the displacement. Its maximum is 8528 N; the load ratio is the minimum divided by the maximum. The amplitude is set \
so that a loop under the mean load has a half opening of 75 \u{b5}m at Q = 0. No parameter is fitted. The scenario has a ram with \
prescribed motion, a spring, a balanced pad and a flat contact. The normal load follows a waveform.";
const REFERENCE: &str =
    "The measured quantity is the dissipated energy of a cycle relative to that under constant load.";
const SHOWS: &str = "The dissipated energy falls with the mean load, as the friction limit does. It falls further, because force and load reach \
their minima together. At all four load ratios the program dissipates 0.05 to 0.08 more than the measurement. This is an error of the model or \
of the rig data, not scatter.";
const LIMITS: &str = "The friction coefficient does not depend on the load. The pads are almost rigid relative to the rig. At the smallest load ratio \
the half opening is below 75 \u{b5}m, because the contact does not slide where the force passes 0. With 75 \u{b5}m the result would be \
0.488.";

fn figure(measured: &[(f64, f64)], own: &[(f64, f64)]) -> Figure<'static> {
    let panel = Panel {
        x: axis("least over largest load", ""),
        y: axis("E_d over that at constant load", ""),
        series: vec![
            curve("stickslip", own.iter().copied(), Ink::Palette(0)),
            points("measured", measured.iter().copied(), Ink::Palette(1)),
        ],
        ..Panel::default()
    };
    let title = Label::plain("Ti-6Al-4V, load in phase with the shake: nothing fitted");
    Figure { title, panels: vec![panel], size: (1200, 800), ..Figure::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference: an independent simulation of the same rig.
    #[test]
    fn the_losses_are_those_of_another_computation() {
        let whole = cycle(1.0, &()).unwrap().lost;
        for (ratio, other) in [(0.1, 0.476), (0.25, 0.578), (0.5, 0.732), (0.75, 0.871)] {
            let own = cycle(ratio, &()).unwrap().lost / whole;
            assert!((own - other).abs() < 1.5e-3, "{ratio}: {own}");
        }
    }
}
