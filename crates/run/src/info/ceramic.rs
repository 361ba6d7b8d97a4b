//! Hysteresis and creep of a stack, in words.

use stickslip_piezo::creep::Creep;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;
use stickslip_scenario::{Ceramic, Hysteresis, Piezo};

/// What its ceramic makes of a stack's voltage, a sentence for each.
pub(super) fn words(piezo: &Piezo) -> Vec<String> {
    let Ceramic { hysteresis, creep, compensated, idle } = &piezo.ceramic;
    let laws = hysteresis.as_ref().map(law).into_iter().chain(creep.as_ref().map(creeps));
    let mut words: Vec<String> = laws.map(|law| format!("{}: {law}", piezo.name)).collect();
    if *idle && !words.is_empty() {
        words.push(format!("{}: its charge is controlled, and neither comes in", piezo.name));
    } else if *compensated {
        words.push(format!("{}: the command is led through their inverses first", piezo.name));
    }
    words
}

fn law(hysteresis: &Hysteresis) -> String {
    match hysteresis {
        Hysteresis::Plays(plays, Some(stroke)) => format!(
            "hysteresis of {} plays, a loop {} % wide at a stroke of {}",
            plays.count(),
            short(100.0 * plays.width(*stroke) / stroke),
            quantity(Real(*stroke), "m")
        ),
        Hysteresis::Plays(plays, None) => format!("hysteresis of {} plays", plays.count()),
        Hysteresis::BoucWen(law) => {
            format!("hysteresis of Bouc and Wen, which keeps back up to {}", quantity(Real(law.limit()), "m"))
        }
    }
}

fn creeps(creep: &Creep) -> String {
    let [first, last] =
        [creep.times().first(), creep.times().last()].map(|time| time.copied().unwrap_or(0.0));
    format!(
        "creep by {} exponentials of {} to {}, {} of a stroke off the logarithm",
        creep.times().len(),
        quantity(Real(first), "s"),
        quantity(Real(last), "s"),
        short(creep.misfit())
    )
}

/// Three digits.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
