//! Piezo stacks: properties, commands, and a forecast of the strokes and currents that their drivers reach.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::Waveform;
use stickslip_drive::facts::zero_step_stroke;
use stickslip_drive::scene::{Side, Varying};
use stickslip_piezo::driver::Spec;
use stickslip_piezo::forecast::{Forecast, forecast};
use stickslip_quantity::Real;
use stickslip_quantity::quantity;
use stickslip_scenario::{Ceramic, Piezo};

/// Relative loss of stroke below which the forecast reports no loss. The forecast uses time steps of 1/8000 of a period.
const WHOLE: f64 = 2e-3;

/// Properties of a stack.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PiezoInfo {
    /// k, stiffness: given, or blocking force divided by stroke of the data sheet. With charge control and a reciprocal
    /// stack: k/(1 - kα²/C).
    #[serde(rename = "stiffness_N_m")]
    pub stiffness: Real,
    /// c, damping: given, or √(k m)/Q with the mass m that the stack moves
    #[serde(rename = "damping_N_s_m")]
    pub damping: Real,
    /// Q, quality factor from which the damping follows. Absent if the scenario gives the damping.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quality: Option<Real>,
    /// mass of the stack: given, or k/(2f)² from its resonance frequency f with both ends free. Absent if it has none.
    #[serde(rename = "mass_kg", skip_serializing_if = "Option::is_none")]
    pub mass: Option<Real>,
    /// masses added to the first and second body to represent the mass of the stack. Absent if it has none.
    #[serde(rename = "added_to_ends_kg", skip_serializing_if = "Option::is_none")]
    pub ends: Option<[Real; 2]>,
    /// α, stroke per volt: given, or stroke divided by voltage of the data sheet. Absent if unknown.
    #[serde(rename = "stroke_per_volt_m_V", skip_serializing_if = "Option::is_none")]
    pub stroke_per_volt: Option<Real>,
    /// C, capacitance. Absent if unknown.
    #[serde(rename = "capacitance_F", skip_serializing_if = "Option::is_none")]
    pub capacitance: Option<Real>,
    /// voltage resolution of the driver as a stroke. Absent if the scenario gives none.
    #[serde(rename = "resolution_m", skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Real>,
    /// electromechanical coupling kα²/C: share of the electrical energy due to the charge caused by strain. Absent
    /// unless the driver is reciprocal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Real>,
    /// Commanded stroke and voltage.
    pub command: CommandInfo,
    /// Part of the period with the largest demand on the driver.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<CornerInfo>,
    /// remarks about the stack and its driver, in sentences
    #[serde(rename = "text")]
    pub words: Vec<String>,
}

/// Commanded and reached strokes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CommandInfo {
    /// smallest and largest commanded free stroke
    #[serde(rename = "stroke_m")]
    pub stroke: [Real; 2],
    /// smallest and largest commanded voltage. Absent if the command is no voltage.
    #[serde(rename = "voltage_V", skip_serializing_if = "Option::is_none")]
    pub voltage: Option<[Real; 2]>,
    /// blocking force of the largest commanded stroke: k times this stroke
    #[serde(rename = "blocking_force_N")]
    pub blocking_force: Real,
    /// estimated smallest and largest stroke that the driver reaches in repeated periods. Absent without a forecast.
    #[serde(rename = "reached_m", skip_serializing_if = "Option::is_none")]
    pub left: Option<[Real; 2]>,
}

/// Part of the period with the largest demand on the driver's current.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CornerInfo {
    /// start and end time of the section of the period that needs the largest fraction of the driver's current
    #[serde(rename = "between_s")]
    pub between: [Real; 2],
    /// voltages at the start and end of the section between_s
    #[serde(rename = "voltage_V")]
    pub voltage: [Real; 2],
    /// current C·|dV/dt| needed in the section between_s. null for a jump.
    #[serde(rename = "needed_A")]
    pub needed: Real,
    /// current limit of the driver in the section between_s. Absent without a limit.
    #[serde(rename = "available_A", skip_serializing_if = "Option::is_none")]
    pub available: Option<Real>,
    /// largest rate of the voltage at the current limit, I/C. Absent without a limit.
    #[serde(rename = "slew_V_s", skip_serializing_if = "Option::is_none")]
    pub slew: Option<Real>,
    /// time that the voltage change of the section between_s takes at the current limit. Absent without a limit, and
    /// for curved waveforms.
    #[serde(rename = "takes_s", skip_serializing_if = "Option::is_none")]
    pub takes: Option<Real>,
}

/// Returns the properties of all stacks.
pub fn piezos(job: &Job) -> Parts<PiezoInfo> {
    let stacks = job.scenario.stacks.iter().enumerate();
    Parts(stacks.map(|(i, piezo)| (piezo.name.clone(), of(job, i, piezo))).collect())
}

fn of(job: &Job, i: usize, piezo: &Piezo) -> PiezoInfo {
    let scene = &job.scenario.scene;
    let waveform = match piezo.command {
        Varying::Constant(_) => None,
        Varying::Follows(w) => scene.waveforms.get(w).map(|waveform| &waveform.part),
    };
    let (low, high) = match piezo.command {
        Varying::Constant(value) => (value, value),
        Varying::Follows(_) => waveform.map_or((0.0, 0.0), Waveform::range),
    };
    let stack = piezo.stack;
    let stiffness = scene.actuators[i].part.stiffness;
    let volts = |stroke: f64| stack.stroke_per_volt.map(|gain| Real(stroke / gain));
    let seen =
        piezo.driver.zip(waveform).and_then(|(spec, waveform)| Some((spec, forecast(&spec, waveform)?)));
    let left = seen.and_then(|(_, forecast)| Some(forecast.left?.0));
    let mut words = Vec::new();
    if let Some((spec, forecast)) = &seen {
        words.extend(steep(&piezo.name, spec, forecast));
        words.extend(lost(&piezo.name, forecast));
        if !words.is_empty() {
            words.extend(beside(piezo));
        }
    }
    let stroke = left.map_or(high - low, |(low, high)| high - low);
    words.extend(idle(job, i, &piezo.name, stroke));
    words.extend(super::ceramic::words(piezo));
    PiezoInfo {
        stiffness: Real(stiffness),
        damping: Real(scene.actuators[i].part.damping),
        quality: piezo.quality.map(Real),
        mass: Some(stack.mass).filter(|mass| *mass > 0.0).map(Real),
        ends: Some(piezo.ends.map(Real)).filter(|_| stack.mass > 0.0),
        stroke_per_volt: stack.stroke_per_volt.map(Real),
        capacitance: stack.capacitance.map(Real),
        resolution: piezo.resolution.zip(stack.stroke_per_volt).map(|(volts, gain)| Real(volts * gain)),
        coupling: stack.coupling().map(Real),
        command: CommandInfo {
            stroke: [low, high].map(Real),
            voltage: volts(low).zip(volts(high)).filter(|_| piezo.by_voltage).map(|(low, high)| [low, high]),
            blocking_force: Real(stiffness * low.abs().max(high.abs())),
            left: left.map(|(low, high)| [low, high].map(Real)),
        },
        corner: seen.as_ref().map(|(spec, forecast)| corner(spec, forecast)),
        words,
    }
}

fn corner(spec: &Spec, forecast: &Forecast) -> CornerInfo {
    let steepest = &forecast.steepest;
    let limited = |value: f64| Some(Real(value)).filter(|_| spec.current.is_some());
    CornerInfo {
        between: [steepest.between.0, steepest.between.1].map(Real),
        voltage: [steepest.volts.0, steepest.volts.1].map(Real),
        needed: Real(steepest.current.abs()),
        available: limited(steepest.available),
        slew: limited(steepest.slew(spec)),
        takes: limited(steepest.takes(spec)).filter(|_| !steepest.curved),
    }
}

/// Returns the sentence about a command that is too fast for the driver.
fn steep(name: &str, spec: &Spec, forecast: &Forecast) -> Option<String> {
    let steepest = &forecast.steepest;
    if !steepest.is_too_steep() {
        return None;
    }
    let told = |value: f64, unit: &str| quantity(Real(value), unit);
    let (from, to) = steepest.between;
    if steepest.curved {
        return Some(format!(
            "{name}: the command changes by up to {} V/us, which needs {}, but the driver supplies {}: the voltage changes by {} V/us",
            short(steepest.current.abs() / spec.capacitance / 1e6),
            told(steepest.current.abs(), "A"),
            told(steepest.available, "A"),
            short(steepest.slew(spec) / 1e6),
        ));
    }
    let needs = if steepest.current.is_finite() {
        format!("in {} needs {}", told(to - from, "s"), told(steepest.current.abs(), "A"))
    } else {
        "instantly needs an infinite current".to_owned()
    };
    Some(format!(
        "{name}: the change from {} to {} {needs}, but the driver supplies {}: the voltage changes by {} V/us, and the whole change takes {}",
        told(steepest.volts.0, "V"),
        told(steepest.volts.1, "V"),
        told(steepest.available, "A"),
        short(steepest.slew(spec) / 1e6),
        told(steepest.takes(spec), "s"),
    ))
}

/// Returns the sentence that the forecast does not include hysteresis and creep.
fn beside(piezo: &Piezo) -> Option<String> {
    let Ceramic { hysteresis, creep, compensated, idle } = &piezo.ceramic;
    if *idle || (hysteresis.is_none() && creep.is_none()) {
        return None;
    }
    let of = if *compensated { "the command before its compensation and " } else { "" };
    Some(format!("{}: the numbers above are for {of}the voltage without hysteresis and creep", piezo.name))
}

/// Returns the sentence about the loss of stroke.
fn lost(name: &str, forecast: &Forecast) -> Option<String> {
    let ((least, most), ((low, high), periods)) = (forecast.asked, forecast.left?);
    let (asked, left) = (most - least, high - low);
    if asked - left <= WHOLE * asked {
        return None;
    }
    let told = |value: f64| quantity(Real(value), "m");
    Some(format!(
        "{name}: the commanded stroke is {}, the driver leaves {}, from {} to {}, in a repeating period (after {} periods)",
        told(asked),
        told(left),
        told(low),
        told(high),
        periods
    ))
}

/// Returns sentences about contacts whose zero-step stroke exceeds the stroke of the stack.
fn idle(job: &Job, i: usize, name: &str, stroke: f64) -> Vec<String> {
    let ends = job.scenario.scene.actuators[i].part.between;
    let moved = |side: &Side| matches!(side, Side::Body(_)) && ends.contains(side);
    let contacts = job.scenario.scene.contacts.iter().zip(job.model.contacts()).enumerate();
    let said = contacts.filter_map(|(c, (contact, (contact_name, law)))| {
        let d = job.model.indentations(&job.start, c)?.start;
        let least = zero_step_stroke(law, d, 0.0).filter(|_| contact.part.between.iter().any(moved))?;
        (stroke > 0.0 && stroke < least).then(|| {
            format!(
                "{name}: the stroke of {} is below the zero-step stroke of {} of {contact_name}: an ideal sawtooth makes no step",
                quantity(Real(stroke), "m"),
                quantity(Real(least), "m"),
            )
        })
    });
    said.collect()
}

/// Rounds to four significant digits.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
