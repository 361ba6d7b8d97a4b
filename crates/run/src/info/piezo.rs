//! Piezo stacks: what they are, and what their drivers will make of what is commanded.

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

/// Part of a command that counts as none of it lost: the forecast walks in steps of a 8000th of a period.
const WHOLE: f64 = 2e-3;

/// A stack.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PiezoInfo {
    /// k, given or blocking force over stroke of the data sheet; k/(1 - kα²/C) of a reciprocal stack under charge control
    #[serde(rename = "stiffness_N_m")]
    pub stiffness: Real,
    /// c, given or √(k m)/Q with m the mass that it moves
    #[serde(rename = "damping_N_s_m")]
    pub damping: Real,
    /// Q, from which c follows where the scenario gives none
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quality: Option<Real>,
    /// its own mass, given or k/(2f)² of the resonance with both ends free
    #[serde(rename = "mass_kg", skip_serializing_if = "Option::is_none")]
    pub mass: Option<Real>,
    /// what of it has been added to the bodies at its ends
    #[serde(rename = "added_to_ends_kg", skip_serializing_if = "Option::is_none")]
    pub ends: Option<[Real; 2]>,
    /// α, given or stroke over voltage of the data sheet
    #[serde(rename = "stroke_per_volt_m_V", skip_serializing_if = "Option::is_none")]
    pub stroke_per_volt: Option<Real>,
    /// C, capacitance
    #[serde(rename = "capacitance_F", skip_serializing_if = "Option::is_none")]
    pub capacitance: Option<Real>,
    /// smallest step of its driver as a stroke
    #[serde(rename = "resolution_m", skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Real>,
    /// kα²/C: charge of strain as a share of the electrical energy, left out unless the driver is reciprocal
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Real>,
    /// What it is commanded.
    pub command: CommandInfo,
    /// Where a driver is asked for most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<CornerInfo>,
    /// remarks on it, in sentences
    #[serde(rename = "text")]
    pub words: Vec<String>,
}

/// What a stack is commanded, and what of it is left.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CommandInfo {
    /// smallest and largest free stroke that is commanded
    #[serde(rename = "stroke_m")]
    pub stroke: [Real; 2],
    /// smallest and largest voltage that is commanded
    #[serde(rename = "voltage_V", skip_serializing_if = "Option::is_none")]
    pub voltage: Option<[Real; 2]>,
    /// k times the largest stroke: force against a wall
    #[serde(rename = "blocking_force_N")]
    pub blocking_force: Real,
    /// smallest and largest stroke that its driver reaches when periods repeat, about
    #[serde(rename = "reached_m", skip_serializing_if = "Option::is_none")]
    pub left: Option<[Real; 2]>,
}

/// The part of a period that asks most of the driver's current.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CornerInfo {
    /// the part of a period that asks most of the driver's current
    #[serde(rename = "between_s")]
    pub between: [Real; 2],
    /// voltages at its ends
    #[serde(rename = "voltage_V")]
    pub voltage: [Real; 2],
    /// current C·|dV/dt| that it needs; null of a jump
    #[serde(rename = "needed_A")]
    pub needed: Real,
    /// current that there is
    #[serde(rename = "available_A", skip_serializing_if = "Option::is_none")]
    pub available: Option<Real>,
    /// I/C, the rate of the voltage that there is
    #[serde(rename = "slew_V_s", skip_serializing_if = "Option::is_none")]
    pub slew: Option<Real>,
    /// time that all of that change takes with it
    #[serde(rename = "takes_s", skip_serializing_if = "Option::is_none")]
    pub takes: Option<Real>,
}

/// All stacks.
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

/// What the driver cannot follow, and what it will take instead.
fn steep(name: &str, spec: &Spec, forecast: &Forecast) -> Option<String> {
    let steepest = &forecast.steepest;
    if !steepest.is_too_steep() {
        return None;
    }
    let told = |value: f64, unit: &str| quantity(Real(value), unit);
    let (from, to) = steepest.between;
    if steepest.curved {
        return Some(format!(
            "{name}: its command changes by up to {} V/us, which needs {}, and {} are there: the voltage changes by {} V/us",
            short(steepest.current.abs() / spec.capacitance / 1e6),
            told(steepest.current.abs(), "A"),
            told(steepest.available, "A"),
            short(steepest.slew(spec) / 1e6),
        ));
    }
    let needs = if steepest.current.is_finite() {
        format!("in {} needs {}", told(to - from, "s"), told(steepest.current.abs(), "A"))
    } else {
        "in no time needs a current without end".to_owned()
    };
    Some(format!(
        "{name}: going from {} to {} {needs}, and {} are there: the voltage changes by {} V/us, all of it would take {}",
        told(steepest.volts.0, "V"),
        told(steepest.volts.1, "V"),
        told(steepest.available, "A"),
        short(steepest.slew(spec) / 1e6),
        told(steepest.takes(spec), "s"),
    ))
}

/// What was told is that of the driver alone.
fn beside(piezo: &Piezo) -> Option<String> {
    let Ceramic { hysteresis, creep, compensated, idle } = &piezo.ceramic;
    if *idle || (hysteresis.is_none() && creep.is_none()) {
        return None;
    }
    let of = if *compensated { "the command before its compensation, and " } else { "" };
    Some(format!("{}: so far this is told of {of}the voltage without hysteresis and creep", piezo.name))
}

/// What is left of the stroke.
fn lost(name: &str, forecast: &Forecast) -> Option<String> {
    let ((least, most), ((low, high), periods)) = (forecast.asked, forecast.left?);
    let (asked, left) = (most - least, high - low);
    if asked - left <= WHOLE * asked {
        return None;
    }
    let told = |value: f64| quantity(Real(value), "m");
    Some(format!(
        "{name}: of the {} commanded the driver leaves {}, from {} to {}, when periods repeat (after {} of them)",
        told(asked),
        told(left),
        told(low),
        told(high),
        periods
    ))
}

/// Contacts whose zero-step stroke is larger than the stack's stroke.
fn idle(job: &Job, i: usize, name: &str, stroke: f64) -> Vec<String> {
    let ends = job.scenario.scene.actuators[i].part.between;
    let moved = |side: &Side| matches!(side, Side::Body(_)) && ends.contains(side);
    let contacts = job.scenario.scene.contacts.iter().zip(job.model.contacts()).enumerate();
    let said = contacts.filter_map(|(c, (contact, (contact_name, law)))| {
        let d = job.model.indentations(&job.start, c)?.start;
        let least = zero_step_stroke(law, d, 0.0).filter(|_| contact.part.between.iter().any(moved))?;
        (stroke > 0.0 && stroke < least).then(|| {
            format!(
                "{name}: its stroke of {} is below the zero-step stroke of {} of {contact_name}: an ideal sawtooth makes no step of it",
                quantity(Real(stroke), "m"),
                quantity(Real(least), "m"),
            )
        })
    });
    said.collect()
}

/// Four digits.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
