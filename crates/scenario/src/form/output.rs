//! Keys of the output tables of a run.

use super::{Count, EventsOutputForm, StatesForm, StepsOutputForm, WindowForm};
use crate::quantity::{Length, Time};
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Output tables of a run.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputForm {
    /// Time interval between rows of `trace.csv`, s, above 0; typical a thousandth of the period. By default only the first and the last
    /// row are written. In a scenario without `output`, the program chooses an interval that resolves the motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 us", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Columns of `trace.csv`, called channels; all by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["slider.x_m", "ball.fx_N"]))]
    pub(crate) channels: Option<Vec<String>>,
    /// Events written to `events.csv`: `all`, `off`, or a selection of kinds or contacts. By default the first 100 000 events are written,
    /// or fewer with more than 50 contacts. A decreasing share of later events is written. Results are computed from all events in any
    /// case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"off", example = json!({ "kinds": ["gross slip", "gross slip ends"] }))]
    pub(crate) events: Option<EventsOutputForm>,
    /// Steps of a drive written to `steps.csv`, and of single pulses of a burst or a sequence to `pulses.csv`: `all` (default) or `off`.
    /// Results are computed from all steps in any case.
    #[serde(default, skip_serializing_if = "StepsOutputForm::is_all")]
    #[schemars(example = &"off")]
    pub(crate) steps: StepsOutputForm,
    /// Time window in which rows and events are written; by default the whole run; give this or `last`. The first and the last row are
    /// always written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "from": "90 ms" }))]
    pub(crate) window: Option<WindowForm>,
    /// Number of periods at the end of the run in which rows and events are written, above 0; by default the whole run; give this or
    /// `window`. The periods are periods of the waveform that `figures` names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), example = 2)]
    pub(crate) last: Option<f64>,
    /// Significant digits of the numbers in `trace.csv` and `events.csv`, 1 to 17; by default as many digits as are needed to read back
    /// exactly the same numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 17), example = 9)]
    pub(crate) float: Option<Count>,
    /// States of contacts in the tables: as words (default), or as numbers 0 open, 1 stick, 2 partial, 3 slip.
    #[serde(default, skip_serializing_if = "StatesForm::is_words")]
    #[schemars(example = &"numbers")]
    pub(crate) states: StatesForm,
    /// State, stretch and forces of every spring of every contact over time, in `springs.csv`. By default they are written only if the plot
    /// `state` is drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "count": 201, "every": "100 us" }))]
    pub(crate) springs: Option<SpringsOutputForm>,
    /// Memory curves of all contacts at some moments, in `memory.csv`. By default they are written only if the plot `memory` or
    /// `substitute` is drawn. A contact on a row of springs has no memory curve.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "at": ["91 ms", "95 ms", "100 ms"] }))]
    pub(crate) memory: Option<MemoryOutputForm>,
    /// Stress and displacement fields of all contacts at some moments, in `fields.csv`, and the friction work per area up to these moments,
    /// in `friction.csv`. By default they are written only if the plot `fields` or `friction` is drawn. A contact whose profile is a list
    /// of springs or a normal law has no fields.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "at": ["91 ms", "95 ms", "100 ms"], "radii": 200 }))]
    pub(crate) fields: Option<FieldsOutputForm>,
}

/// Output of every spring of every contact over time.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringsOutputForm {
    /// Number of springs written for a contact with the engine "curve", 1 to 1 000 000; 101 by default. These springs lie at the midpoints
    /// of equal cells over the largest known contact width. For a contact on a row of springs or with a foundation, the springs of the
    /// contact itself are written.
    #[serde(default = "default_count")]
    #[schemars(range(min = 1, max = 1_000_000), example = 201)]
    pub(crate) count: Count,
    /// Time interval of the output, s, above 0; by default the interval of the rows, or a 400th of the run if there are no rows.
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

/// Radii and moments at which stress and displacement are written. By default the moments are those of the memory curves.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("not" = { "required": ["every", "at"] }))]
pub(crate) struct FieldsOutputForm {
    /// Number of radii, 2 to 10 000, evenly spaced from 0 to `extent`; 151 by default. While the contact moves, friction work is computed
    /// at each radius, not only at the written moments.
    #[serde(default = "default_radii")]
    #[schemars(range(min = 2, max = 10_000), example = 200)]
    pub(crate) radii: Count,
    /// Largest radius of the output, m, above 0; by default 1.5 times the largest known contact radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 um", transform = above_zero)]
    pub(crate) extent: Option<Length>,
    /// Time interval of the output, s, above 0; give either this or `at`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 ms", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Moments of the output, s, ascending, within the run; give either this or `every`.
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

/// Moments at which the memory curves are written. By default six moments are spread evenly over the last period, or over the run if there
/// is no period. A run with `until_steady` also has six moments in each of the first hundred periods.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("maxProperties" = 1))]
pub(crate) struct MemoryOutputForm {
    /// Time interval of the output, s, above 0; give either this or `at`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 ms", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Moments of the output, s, ascending, within the run; give either this or `every`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1), transform = at_least_zero, example = json!(["91 ms", "95 ms", "100 ms"]))]
    pub(crate) at: Option<Vec<Time>>,
}
