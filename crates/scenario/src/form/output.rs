//! What is written down.

use super::{Count, EventsOutputForm, StatesForm, StepsOutputForm, WindowForm};
use crate::quantity::{Length, Time};
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// What is written down.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputForm {
    /// Interval of the rows of the trace, s, above 0; by default only the first and the last row, in a scenario without `output` an
    /// interval that shows the motion; typical a thousandth of the period.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 us", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Columns of the trace; all by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["slider.x_m", "ball.fx_N"]))]
    pub(crate) channels: Option<Vec<String>>,
    /// Events written to `events.csv`: `all`, `off`, or some kinds or contacts; by default the first 100 000 of the run, in
    /// scenarios of more than 50 contacts fewer, and ever fewer of those that follow. Figures are taken from all of them whatever is written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"off", example = json!({ "kinds": ["gross slip", "gross slip ends"] }))]
    pub(crate) events: Option<EventsOutputForm>,
    /// Whether `steps.csv` has every step of a drive: `all` (default) or `off`. Figures are taken from all of them whatever is written.
    #[serde(default, skip_serializing_if = "StepsOutputForm::is_all")]
    #[schemars(example = &"off")]
    pub(crate) steps: StepsOutputForm,
    /// Rows and events only within these times, by default all the way; the first and the last row are written anyway. This or
    /// `last`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "from": "90 ms" }))]
    pub(crate) window: Option<WindowForm>,
    /// Rows and events only in so many periods of the waveform of `figures` at the end of the run, above 0; by default all the way. This
    /// or `window`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), example = 2)]
    pub(crate) last: Option<f64>,
    /// Significant digits of the numbers in `trace.csv` and `events.csv`, 1 to 17; by default as many as it takes to read back the same
    /// bits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 17), example = 9)]
    pub(crate) float: Option<Count>,
    /// States of contacts as words (default), or as numbers: 0 open, 1 stick, 2 partial, 3 slip.
    #[serde(default, skip_serializing_if = "StatesForm::is_words")]
    #[schemars(example = &"numbers")]
    pub(crate) states: StatesForm,
    /// What every spring of every contact does over time, in `springs.csv`; not by default, but the plot `state` asks for
    /// it by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "count": 201, "every": "100 us" }))]
    pub(crate) springs: Option<SpringsOutputForm>,
    /// The memory curves of all contacts at some moments, in `memory.csv`; not by default, but the plot `memory` asks for
    /// it by itself. A contact on a row of springs has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "at": ["91 ms", "95 ms", "100 ms"] }))]
    pub(crate) memory: Option<MemoryOutputForm>,
    /// Stress and displacement under all contacts at some moments, in `fields.csv`, and where friction has done its work until
    /// then, in `friction.csv`; not by default, but the plots `fields` and `friction` ask for it by themselves. A contact
    /// whose profile is a list of springs has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "at": ["91 ms", "95 ms", "100 ms"], "radii": 200 }))]
    pub(crate) fields: Option<FieldsOutputForm>,
}

/// What every spring of every contact does over time.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringsOutputForm {
    /// Springs shown of a contact on the curve, 1 to 1 000 000: midpoints of equal cells over the largest width that is
    /// known. A contact on a row of springs, and a foundation, show their own.
    #[serde(default = "default_count")]
    #[schemars(range(min = 1, max = 1_000_000), example = 201)]
    pub(crate) count: Count,
    /// Interval of the moments, s, above 0; by default that of the rows, and without rows a 400th of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"100 us", transform = above_zero)]
    pub(crate) every: Option<Time>,
}

impl Default for SpringsOutputForm {
    fn default() -> Self {
        Self { count: default_count(), every: None }
    }
}

fn default_count() -> Count {
    Count(101)
}

/// Where and when stress and displacement are written; by default at the moments at which memory curves are by default.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("not" = { "required": ["every", "at"] }))]
pub(crate) struct FieldsOutputForm {
    /// Distances from the axis, 2 to 10 000, evenly from 0 to `extent`. Wherever the contact moves friction is followed at
    /// each of them, not only at the moments written.
    #[serde(default = "default_radii")]
    #[schemars(range(min = 2, max = 10_000), example = 200)]
    pub(crate) radii: Count,
    /// Largest radius of the output, m, above 0; by default 1.5 times the largest known contact radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 um", transform = above_zero)]
    pub(crate) extent: Option<Length>,
    /// Interval of the moments, s, above 0; give either this or `at`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 ms", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Moments, s, ascending, within the run; give either this or `every`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1), transform = at_least_zero, example = json!(["91 ms", "95 ms", "100 ms"]))]
    pub(crate) at: Option<Vec<Time>>,
}

impl Default for FieldsOutputForm {
    fn default() -> Self {
        Self { radii: default_radii(), extent: None, every: None, at: None }
    }
}

fn default_radii() -> Count {
    Count(151)
}

/// When the memory curves are written; by default at six moments, evenly spread over the last period or, without one,
/// over the run; of a run that may end steady, over each of the first hundred periods as well.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("maxProperties" = 1))]
pub(crate) struct MemoryOutputForm {
    /// Interval of the moments, s, above 0; give either this or `at`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 ms", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Moments, s, ascending, within the run; give either this or `every`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1), transform = at_least_zero, example = json!(["91 ms", "95 ms", "100 ms"]))]
    pub(crate) at: Option<Vec<Time>>,
}
