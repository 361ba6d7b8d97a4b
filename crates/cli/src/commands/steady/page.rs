//! Formats a periodic orbit as tables. The width does not depend on the terminal.

use crate::commands::info::tables::grid;
use stickslip_run::outlook::step_words;
use stickslip_run::{Job, Real, quantity};
use stickslip_study::steady::{Aftermath, Multiplier, Steady};

/// Maximum number of multipliers that are listed.
const TOLD: usize = 8;

/// Returns all tables.
pub(super) fn text(job: &Job, found: &Steady, aftermath: Option<&Aftermath>) -> String {
    let body = job.scenario.figures.body.and_then(|body| job.scenario.scene.bodies.get(body));
    let step = found.step.map(|step| step_words(Real(step), Real(found.bound), 1));
    let step = step.zip(body).map(|(step, body)| format!("{step}, {}", body.name));
    let told = |places: &[usize], words: &str| {
        (!places.is_empty()).then(|| format!("{}: {words}", found.named(places).join(", ")))
    };
    let drifts = match found.drifts {
        0 => String::new(),
        1 => ", 1 drift".to_owned(),
        count => format!(", {count} drifts"),
    };
    let rows = [
        ("period", Some(quantity(Real(found.period), "s"))),
        ("step", step),
        ("speed", found.speed().map(|speed| quantity(Real(speed), "m/s"))),
        ("stable", Some(stable(found))),
        ("ends on", aftermath.map(Aftermath::words)),
        ("unknowns", Some(format!("{}{drifts}", found.unknowns.len()))),
        ("found in", Some(format!("{} simulated periods", found.work))),
        (
            "shakedown",
            told(&found.shaken_down, "never in gross slip; the orbit found is the nearest of a family of orbits"),
        ),
        (
            "no multiplier",
            found.names_untold().map(|names| {
                format!(
                    "{names}: disturbances change the turning points in the contact memory; the multipliers do not \
                     cover these unknowns"
                )
            }),
        ),
        (
            "not in map",
            told(&found.carried, "the contact memory is not an unknown; the multipliers do not cover this memory"),
        ),
    ];
    let rows = rows.into_iter().filter_map(|(label, cell)| Some(vec![label.to_owned(), cell?]));
    let title = &job.scenario.title;
    let head = if title.is_empty() { job.name.clone() } else { format!("{}: {title}", job.name) };
    let motion = grid(["PERIODIC ORBIT", ""], rows);
    let multipliers = multipliers(&found.multipliers);
    [head, motion, multipliers].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n\n")
}

/// Describes the stability.
fn stable(found: &Steady) -> String {
    let radius = format!("{:.6}", found.radius());
    match (found.comes_back(), found.doubt()) {
        (Some(false), _) => {
            format!("no: a run leaves this orbit, largest |λ| {radius}; other unstable orbits may exist")
        }
        (None, Some(doubt)) => format!("not known: {doubt}"),
        (None, None) if !found.shaken_down.is_empty() => {
            format!(
                "neutral: the orbit is one of a family, and a disturbed run may end on another orbit of the family, largest |λ| {radius}"
            )
        }
        (None, None) if found.is_one_of_many() => {
            format!(
                "neutral: the orbit is one of a family with different steps; a disturbance neither grows nor decays, largest |λ| {radius}"
            )
        }
        (None, None) => format!("neutral: a disturbance neither grows nor decays, largest |λ| {radius}"),
        (Some(true), _) if found.radius() == 0.0 => "yes".to_owned(),
        (Some(true), _) => format!("yes, largest |λ| {radius}"),
    }
}

fn multipliers(multipliers: &[Multiplier]) -> String {
    let row = |multiplier: &Multiplier| {
        let im = if multiplier.im == 0.0 { String::new() } else { format!(" ± {:.6} i", multiplier.im) };
        let error = multiplier.doubt().map_or_else(String::new, |error| format!(" ± {error:.0e}"));
        vec![
            format!("{:.6}{im}", multiplier.re),
            format!("{:.6}{error}", multiplier.modulus()),
            format!("a disturbance {}", multiplier.words()),
        ]
    };
    let mut rows: Vec<Vec<String>> = multipliers.iter().take(TOLD).map(row).collect();
    if multipliers.len() > TOLD {
        let left = multipliers.len() - TOLD;
        rows.push(vec![format!("{left} more"), String::new(), "with smaller |λ|".to_owned()]);
    }
    grid(["MULTIPLIERS λ", "|λ|", ""], rows)
}
