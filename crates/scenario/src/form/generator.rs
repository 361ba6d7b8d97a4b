//! Generators: waveforms made inside, whose parameters a caller commands.

use super::Count;
use super::input::Bounds;
use crate::quantity::{AnyQuantity, Frequency, Time};
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Generator: cycles that a caller commands while they run. A cycle begins and ends at 0 and takes the stroke, frequency and
/// heading that are in force when it begins; with nothing to do it rests at 0, and a command begins a cycle at once.
/// `stickslip run`, where there is no caller, uses the values given here. It has no phase, no delay and no number of
/// cycles: a caller says when, and `steps` how many.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GeneratorForm {
    /// Form of a cycle.
    #[schemars(example = json!({ "sawtooth": { "flyback": "10 us" } }))]
    pub(crate) shape: CycleForm,
    /// Peak-to-peak value at first, in the unit of the driven quantity, within its range; 0 is rest; typical 10 nm to 10 um.
    #[schemars(example = &"200 nm")]
    pub(crate) stroke: AnyQuantity,
    /// Frequency at first, Hz, at least 0, within its range; 0 is rest; typical 1 Hz to 10 kHz.
    #[schemars(example = &"100 Hz", transform = at_least_zero)]
    pub(crate) frequency: Frequency,
    /// Which way in time a cycle runs at first: "forward" or "backward".
    #[serde(default)]
    #[schemars(example = &"backward")]
    pub(crate) heading: HeadingForm,
    /// Number of cycles at first, a whole number, after which it rests; 0 rests until it is commanded; without end by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = 10)]
    pub(crate) steps: Option<Count>,
    /// What a caller may command. Checks before a run cover the whole time.
    #[schemars(example = json!({ "stroke": ["0 nm", "300 nm"], "frequency": ["0 Hz", "2 kHz"] }))]
    pub(crate) range: CommandsForm,
}

/// Form of a cycle.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CycleForm {
    /// From 0 straight to the stroke, straight back in the flyback; backward the other way round in time.
    #[schemars(example = json!({ "sawtooth": { "flyback": "10 us" } }))]
    Sawtooth(SawtoothCycleForm),
    /// From 0 straight to the stroke in half a period, straight back: the same in both headings.
    Triangle,
}

/// Sawtooth cycle.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SawtoothCycleForm {
    /// Duration of the fast way at all frequencies, s, above 0 and below the period of the largest frequency in range; typical
    /// 1 us to 100 us.
    #[schemars(example = &"10 us", transform = above_zero)]
    pub(crate) flyback: Time,
}

/// Which way in time a cycle runs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HeadingForm {
    /// Slowly up, fast back.
    #[default]
    Forward,
    /// The cycle reversed in time, fast up and slowly back: values stay between 0 and the stroke.
    Backward,
}

/// What a caller may command of a generator.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CommandsForm {
    /// Smallest and largest stroke, in the unit of the driven quantity.
    #[schemars(example = json!(["0 nm", "300 nm"]))]
    pub(crate) stroke: Bounds<AnyQuantity>,
    /// Smallest and largest frequency, Hz, at least 0; periods are longer than the flyback.
    #[schemars(example = json!(["0 Hz", "2 kHz"]), transform = at_least_zero)]
    pub(crate) frequency: Bounds<Frequency>,
}
