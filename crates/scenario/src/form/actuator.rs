//! Piezo stacks: what they are, what they follow, and what drives them.

use super::{CreepForm, DirectionForm, HysteresisForm, Moving, Points, Two};
use crate::quantity::{
    Capacitance, Current, Damping, Force, Frequency, Length, Mass, Resistance, Stiffness, StrokePerVoltage,
    Voltage, dimension,
};
use crate::schema::{above_zero, at_least_zero, stroke_or_voltage};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::f64::consts::FRAC_1_SQRT_2;

/// Piezo stack: force on the second body k(s-e) + c(ṡ-ė), e = x(second) - x(first) at its ends, or
/// z(second) - z(first), s the free stroke. Numbers of a data sheet suffice: see docs/piezo.md.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = stroke_or_voltage)]
pub(crate) struct ActuatorForm {
    /// First and second body; `ground` is one too.
    #[schemars(extend("uniqueItems" = true), example = json!(["ground", "slider"]))]
    pub(crate) between: Two,
    /// Along x or z.
    #[serde(default)]
    #[schemars(example = &"z")]
    pub(crate) direction: DirectionForm,
    /// Its end on each body by the body's name, relative to the body's reference point, which it is by default.
    #[serde(default, skip_serializing_if = "Points::is_empty")]
    #[schemars(example = json!({ "slider": { "x": "5 mm" } }))]
    pub(crate) at: Points,
    /// Stiffness k, N/m, above 0; by default that of `data_sheet`; typical 1 N/um to 500 N/um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 N/um", transform = above_zero)]
    pub(crate) stiffness: Option<Stiffness>,
    /// Damping c, N s/m, at least 0; typical 0.1 N s/m to 100 N s/m. By default 0 where the scenario says nothing of the stack
    /// but its stiffness and stroke, else √(k m)/50: the quality factor 50 of a soft ceramic with its electrodes, m the mass
    /// that it moves, m₁m₂/(m₁ + m₂) of the bodies at its ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.5 N s/m", transform = at_least_zero)]
    pub(crate) damping: Option<Damping>,
    /// Its own mass m, kg, above 0; none by default. Of this mass 4m/π² is added to an end whose body is free where the other end is held,
    /// 2m/π² to each of two free ends: so its first resonance comes out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 g", transform = above_zero)]
    pub(crate) mass: Option<Mass>,
    /// Free stroke s, m; give either this or `voltage`; typical 10 nm to 100 um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "follows": "drive" }))]
    pub(crate) stroke: Option<Moving<dimension::Length>>,
    /// Voltage, V, that is commanded: the free stroke is `stroke_per_volt` times the voltage that the driver makes of it; this or
    /// `stroke`; typical 10 V to 200 V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "follows": "drive" }))]
    pub(crate) voltage: Option<Moving<dimension::Voltage>>,
    /// Free stroke per voltage, m/V, above 0; by default that of `data_sheet`; typical 1 nm/V to 200 nm/V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"38 nm/V", transform = above_zero)]
    pub(crate) stroke_per_volt: Option<StrokePerVoltage>,
    /// Capacitance C, F, above 0, at the fields it is driven with; needed by a driver; by default that of `data_sheet`; typical 10 nF to
    /// 10 uF.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"7.2 uF", transform = above_zero)]
    pub(crate) capacitance: Option<Capacitance>,
    /// Values of the manufacturer's data sheet, none by default; missing keys of the stack follow from them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "stroke": "4.6 um", "voltage": "120 V", "blocking_force": "460 N", "capacitance": "7.2 uF" }))]
    pub(crate) data_sheet: Option<DataSheetForm>,
    /// Driver electronics that turn the command into the voltage of the stack; an ideal source by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "window": ["0 V", "120 V"], "current": "2 A" }))]
    pub(crate) driver: Option<DriverForm>,
    /// Hysteresis of the stroke; none by default, and none under charge control.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "loop": { "percent": 12 } }))]
    pub(crate) hysteresis: Option<HysteresisForm>,
    /// Creep of the stroke; none by default, and none under charge control.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "per_decade": 0.015 }))]
    pub(crate) creep: Option<CreepForm>,
    /// Whether the command is led through the inverses of hysteresis and creep before the driver; not by default.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[schemars(example = true)]
    pub(crate) compensate: bool,
}

/// Numbers of a stack's data sheet. Those that say the same must agree within 1 %.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DataSheetForm {
    /// Nominal free stroke, m, above 0, at `voltage`; unknown by default; typical 1 um to 100 um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"4.6 um", transform = above_zero)]
    pub(crate) stroke: Option<Length>,
    /// Nominal voltage, V, above 0; unknown by default; typical 60 V to 1000 V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"120 V", transform = above_zero)]
    pub(crate) voltage: Option<Voltage>,
    /// Stiffness, N/m, above 0; by default `blocking_force` over `stroke`; typical 1 N/um to 500 N/um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"100 N/um", transform = above_zero)]
    pub(crate) stiffness: Option<Stiffness>,
    /// Blocking force at the nominal voltage, N, above 0: stiffness times stroke; unknown by default; typical 10 N to 5 kN.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"460 N", transform = above_zero)]
    pub(crate) blocking_force: Option<Force>,
    /// Capacitance, F, above 0; unknown by default; typical 10 nF to 10 uF.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"7.2 uF", transform = above_zero)]
    pub(crate) capacitance: Option<Capacitance>,
    /// First resonance without a load, Hz, above 0, both ends free; it gives the mass of the stack; unknown by default; typical 10 kHz to 500 kHz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"120 kHz", transform = above_zero)]
    pub(crate) free_resonance: Option<Frequency>,
    /// The same with one end held, Hz, above 0, half of that; unknown by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"60 kHz", transform = above_zero)]
    pub(crate) held_resonance: Option<Frequency>,
}

/// Driver electronics between the command and the stack. What is not given does not limit.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DriverForm {
    /// Smallest and largest voltage, V: the commanded voltage is limited to this range; unlimited by default. Unipolar such as 0 V to 120 V, or bipolar.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["-20 V", "120 V"]))]
    pub(crate) window: Option<[Voltage; 2]>,
    /// Largest current I, A, above 0: the voltage changes no faster than I/C; no limit by default; typical 10 mA to 20 A.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 A", transform = above_zero)]
    pub(crate) current: Option<Current>,
    /// Largest current out of the stack, A, above 0; by default the same as `current`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 A", transform = above_zero)]
    pub(crate) sink_current: Option<Current>,
    /// Resistance R between driver and stack, Ω, at least 0, none by default: the voltage follows with the time constant RC; typical 1 ohm to 1 kohm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 ohm", transform = at_least_zero)]
    pub(crate) resistance: Option<Resistance>,
    /// Bandwidth, Hz, above 0: the natural frequency of a second-order low-pass before the output stage; no limit by default; typical 100 Hz to 100 kHz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 kHz", transform = above_zero)]
    pub(crate) bandwidth: Option<Frequency>,
    /// Damping ratio ζ of that low-pass, 0.05 to 10; 1/√2, no overshoot in frequency, by default.
    #[serde(default = "no_peak")]
    #[schemars(extend("minimum" = 0.05, "maximum" = 10), example = 0.5)]
    pub(crate) damping_ratio: f64,
    /// Smallest step of the voltage, V, above 0: `info` shows it as a stroke; none by default; the voltage itself is not quantised; typical 1 mV to
    /// 50 mV.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 mV", transform = above_zero)]
    pub(crate) resolution: Option<Voltage>,
    /// What the driver controls: the voltage, or the charge C·V, which a stack follows without hysteresis and creep.
    #[serde(default)]
    #[schemars(example = &"charge")]
    pub(crate) control: ControlForm,
    /// Whether the charge kα(e - αV) that strain makes is there, C being the capacitance of the free stack: it flows through the driver and,
    /// under charge control, stiffens the stack to k/(1 - kα²/C); false by default. `info` shows kα²/C.
    #[serde(default)]
    #[schemars(example = true)]
    pub(crate) reciprocal: bool,
}

/// What a driver controls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ControlForm {
    /// The voltage.
    #[default]
    Voltage,
    /// The charge.
    Charge,
}

fn no_peak() -> f64 {
    FRAC_1_SQRT_2
}
