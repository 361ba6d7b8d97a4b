//! Keys of generators: waveforms of cycles whose parameters a calling program commands during the run.

use super::Count;
use super::input::Bounds;
use crate::quantity::{AnyQuantity, Frequency, Time};
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Generator: a waveform of cycles whose parameters a calling program commands during the run. A cycle begins and ends at 0. A cycle has
/// the stroke, frequency and heading that are commanded when the cycle begins. After the commanded number of cycles, the generator rests at
/// 0, and a new command begins a cycle at once. `stickslip run` has no calling program and uses the values given here. A generator has no
/// phase, no delay and no key `cycles`: the calling program sets the start, and `steps` gives the number of cycles.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GeneratorForm {
    /// Shape of a cycle: a sawtooth or a triangle.
    #[schemars(example = json!({ "sawtooth": { "flyback": "10 us" } }))]
    pub(crate) shape: CycleForm,
    /// Initial peak-to-peak value, in the unit of the driven quantity, within `range`; at 0 the generator rests; typical 10 nm to 10 um.
    #[schemars(example = &"200 nm")]
    pub(crate) stroke: AnyQuantity,
    /// Initial frequency, Hz, at least 0, within `range`; at 0 the generator rests; typical 1 Hz to 10 kHz.
    #[schemars(example = &"100 Hz", transform = at_least_zero)]
    pub(crate) frequency: Frequency,
    /// Initial direction of a cycle in time: "forward", slow to the stroke and fast back, by default, or "backward", reversed in time.
    #[serde(default)]
    #[schemars(example = &"backward")]
    pub(crate) heading: HeadingForm,
    /// Initial number of cycles, a whole number; without end by default. After these cycles the generator rests at 0 until the next
    /// command. With 0 cycles the generator rests from the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = 10)]
    pub(crate) steps: Option<Count>,
    /// Ranges of the stroke and frequency that a calling program may command. The checks before a run cover these ranges.
    #[schemars(example = json!({ "stroke": ["0 nm", "300 nm"], "frequency": ["0 Hz", "2 kHz"] }))]
    pub(crate) range: CommandsForm,
}

/// Shape of a cycle: a sawtooth or a triangle.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CycleForm {
    /// Sawtooth cycle: a linear rise from 0 to the stroke and a linear fall in the flyback. The heading "backward" reverses the cycle in
    /// time.
    #[schemars(example = json!({ "sawtooth": { "flyback": "10 us" } }))]
    Sawtooth(SawtoothCycleForm),
    /// Triangle cycle: a linear rise from 0 to the stroke in half a period and a linear fall. The cycle is the same for both headings.
    Triangle,
}

/// Sawtooth cycle.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SawtoothCycleForm {
    /// Duration of the flyback at all frequencies, s, above 0 and below the period of the largest frequency in range; typical 1 us to 100
    /// us.
    #[schemars(example = &"10 us", transform = above_zero)]
    pub(crate) flyback: Time,
}

/// Direction of a cycle in time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HeadingForm {
    /// The value runs slowly to the stroke and fast back to 0.
    #[default]
    Forward,
    /// The cycle is reversed in time: the value runs fast to the stroke and slowly back to 0. All values stay between 0 and the stroke.
    Backward,
}

/// Ranges of the values that a calling program may command.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CommandsForm {
    /// Smallest and largest stroke, in the unit of the driven quantity.
    #[schemars(example = json!(["0 nm", "300 nm"]))]
    pub(crate) stroke: Bounds<AnyQuantity>,
    /// Smallest and largest frequency, Hz, at least 0; the period at the largest frequency is longer than the flyback.
    #[schemars(example = json!(["0 Hz", "2 kHz"]), transform = at_least_zero)]
    pub(crate) frequency: Bounds<Frequency>,
}
