//! Sentences about hysteresis and creep of a piezo stack.

use stickslip_piezo::creep::Creep;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;
use stickslip_scenario::{Ceramic, Hysteresis, Piezo};

/// Returns one sentence for each of hysteresis, creep and compensation.
pub(super) fn words(piezo: &Piezo) -> Vec<String> {
    let Ceramic { hysteresis, creep, compensated, idle } = &piezo.ceramic;
    let laws = hysteresis.as_ref().map(law).into_iter().chain(creep.as_ref().map(creeps));
    let mut words: Vec<String> = laws.map(|law| format!("{}: {law}", piezo.name)).collect();
    if *idle && !words.is_empty() {
        words.push(format!(
            "{}: hysteresis and creep have no effect, because the charge is controlled",
            piezo.name
        ));
    } else if *compensated {
        words.push(format!("{}: the command passes the inverse model first", piezo.name));
    }
    words
}

fn law(hysteresis: &Hysteresis) -> String {
    match hysteresis {
        Hysteresis::Plays(plays, Some(stroke)) => format!(
            "hysteresis of {} play operators, loop width {} % at a stroke of {}",
            plays.count(),
            short(100.0 * plays.width(*stroke) / stroke),
            quantity(Real(*stroke), "m")
        ),
        Hysteresis::Plays(plays, None) => format!("hysteresis of {} play operators", plays.count()),
        Hysteresis::BoucWen(law) => {
            format!("Bouc–Wen hysteresis, with up to {} of stroke", quantity(Real(law.limit()), "m"))
        }
    }
}

fn creeps(creep: &Creep) -> String {
    let [first, last] =
        [creep.times().first(), creep.times().last()].map(|time| time.copied().unwrap_or(0.0));
    format!(
        "creep by {} exponentials of {} to {}; the deviation from the logarithm is {} of a stroke",
        creep.times().len(),
        quantity(Real(first), "s"),
        quantity(Real(last), "s"),
        short(creep.misfit())
    )
}

/// Rounds to three significant digits.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
