//! Keys of piezo stacks: data of the stack, commanded stroke or voltage, driver, hysteresis and creep.

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

/// Piezo stack: a spring and a damper with a free stroke s. The stack acts on the second body with the force k(s-e) + c(ṡ-ė). The
/// elongation e is x(second) - x(first) at the ends of the stack, or z(second) - z(first). Data-sheet values are enough to describe a
/// stack: see docs/how/data_sheet.md.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = stroke_or_voltage)]
pub(crate) struct ActuatorForm {
    /// Names of the first and the second body; the fixed `ground` counts as a body.
    #[schemars(extend("uniqueItems" = true), example = json!(["ground", "slider"]))]
    pub(crate) between: Two,
    /// Direction in which the stack acts: "x", along the slide, by default, or "z", normal to the slide.
    #[serde(default)]
    #[schemars(example = &"z")]
    pub(crate) direction: DirectionForm,
    /// End point of the stack on each body by body name, relative to the body's reference point; by default the reference point itself.
    #[serde(default, skip_serializing_if = "Points::is_empty")]
    #[schemars(example = json!({ "slider": { "x": "5 mm" } }))]
    pub(crate) at: Points,
    /// Stiffness k, N/m, above 0; by default that of `data_sheet`; typical 1 N/um to 500 N/um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 N/um", transform = above_zero)]
    pub(crate) stiffness: Option<Stiffness>,
    /// Damping c, N s/m, at least 0; typical 0.1 N s/m to 100 N s/m. By default the damping is 0 for a stack without `voltage`,
    /// `data_sheet` and `mass`. For other stacks the default is √(k m)/50, with the reduced mass m = m₁m₂/(m₁ + m₂) of the bodies at the
    /// ends. A body that is not free counts as infinitely heavy. The default gives the quality factor 50 of a soft piezo ceramic with
    /// electrodes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.5 N s/m", transform = at_least_zero)]
    pub(crate) damping: Option<Damping>,
    /// Mass m of the stack itself, kg, above 0; none by default unless `data_sheet` gives a resonance. If one end is held, 4m/π² is added
    /// to the free body at the other end. If both ends are free, 2m/π² is added to each body. These shares reproduce the first resonance of
    /// the stack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 g", transform = above_zero)]
    pub(crate) mass: Option<Mass>,
    /// Free stroke s, m; give either this or `voltage`; typical 10 nm to 100 um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "follows": "drive" }))]
    pub(crate) stroke: Option<Moving<dimension::Length>>,
    /// Commanded voltage, V; give either this or `stroke`; typical 10 V to 200 V. Without hysteresis and creep, the free stroke is
    /// `stroke_per_volt` times the output voltage of the driver.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "follows": "drive" }))]
    pub(crate) voltage: Option<Moving<dimension::Voltage>>,
    /// Free stroke per voltage, m/V, above 0; by default that of `data_sheet`; typical 1 nm/V to 200 nm/V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"38 nm/V", transform = above_zero)]
    pub(crate) stroke_per_volt: Option<StrokePerVoltage>,
    /// Capacitance C, F, above 0; needed with a `driver`; by default that of `data_sheet`; typical 10 nF to 10 uF. Give the capacitance at
    /// the amplitude of the drive voltage, which is up to twice the capacitance at 1 V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"7.2 uF", transform = above_zero)]
    pub(crate) capacitance: Option<Capacitance>,
    /// Values of the manufacturer's data sheet; none by default. Missing keys of the stack are computed from these values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "stroke": "4.6 um", "voltage": "120 V", "blocking_force": "460 N", "capacitance": "7.2 uF" }))]
    pub(crate) data_sheet: Option<DataSheetForm>,
    /// Driver electronics that turn the command into the voltage of the stack; an ideal voltage source by default.
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
    /// Feedforward compensation: whether inverse models of hysteresis and creep correct the command before the driver; false by default.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[schemars(example = true)]
    pub(crate) compensate: bool,
}

/// Values of the data sheet of a stack. Values that determine the same quantity must agree within 1 %.
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
    /// First resonance without a load, both ends free, Hz, above 0; unknown by default; typical 10 kHz to 500 kHz. This frequency
    /// determines the mass of the stack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"120 kHz", transform = above_zero)]
    pub(crate) free_resonance: Option<Frequency>,
    /// First resonance without a load, one end held, Hz, above 0; unknown by default. This frequency is half of `free_resonance` and also
    /// determines the mass of the stack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"60 kHz", transform = above_zero)]
    pub(crate) held_resonance: Option<Frequency>,
}

/// Driver electronics between the command and the stack. A limit is inactive if its key is missing.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DriverForm {
    /// Smallest and largest voltage, V, to which the commanded voltage is limited; unlimited by default. The range may be unipolar, such as
    /// 0 V to 120 V, or bipolar.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["-20 V", "120 V"]))]
    pub(crate) window: Option<[Voltage; 2]>,
    /// Largest current I into the stack, A, above 0; no limit by default; typical 10 mA to 20 A. The voltage changes no faster than I/C.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 A", transform = above_zero)]
    pub(crate) current: Option<Current>,
    /// Largest current out of the stack, A, above 0; by default the same as `current`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 A", transform = above_zero)]
    pub(crate) sink_current: Option<Current>,
    /// Resistance R between driver and stack, Ω, at least 0; none by default; typical 1 ohm to 1 kohm. The voltage of the stack follows the
    /// driver with the time constant RC.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 ohm", transform = at_least_zero)]
    pub(crate) resistance: Option<Resistance>,
    /// Bandwidth, Hz, above 0; no limit by default; typical 100 Hz to 100 kHz. The bandwidth is the natural frequency of a second-order
    /// low-pass before the output stage.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 kHz", transform = above_zero)]
    pub(crate) bandwidth: Option<Frequency>,
    /// Damping ratio ζ of the low-pass with the natural frequency `bandwidth`, 0.05 to 10; 1/√2 by default. At 1/√2 and above, the
    /// frequency response has no resonance peak.
    #[serde(default = "no_peak")]
    #[schemars(extend("minimum" = 0.05, "maximum" = 10), example = 0.5)]
    pub(crate) damping_ratio: f64,
    /// Resolution, the smallest step of the voltage, V, above 0; none by default; typical 1 mV to 50 mV. `info` shows the resolution as a
    /// stroke. The simulated voltage is not quantised.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 mV", transform = above_zero)]
    pub(crate) resolution: Option<Voltage>,
    /// Controlled quantity of the driver: the "voltage" by default, or the "charge" C·V. Under charge control the stack has no hysteresis
    /// and no creep.
    #[serde(default)]
    #[schemars(example = &"charge")]
    pub(crate) control: ControlForm,
    /// Direct piezoelectric effect: whether a change of length of the stack generates electric charge; false by default. The charge of the
    /// stack is then Q = CV + kα(e - αV), with stiffness k, elongation e, voltage V and free stroke per volt α. C is the capacitance of the
    /// stack without a force. The driver supplies this charge. Under charge control, the effect increases the stiffness from k to k/(1 -
    /// kα²/C). `info` shows the coupling kα²/C.
    #[serde(default)]
    #[schemars(example = true)]
    pub(crate) reciprocal: bool,
}

/// Controlled quantity of a driver.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ControlForm {
    /// The voltage.
    #[default]
    Voltage,
    /// The charge C·V.
    Charge,
}

fn no_peak() -> f64 {
    FRAC_1_SQRT_2
}
