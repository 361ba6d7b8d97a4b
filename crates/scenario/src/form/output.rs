//! What is written down.

use super::Count;
use crate::quantity::Time;
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// What is written down.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputForm {
    /// Interval of the rows of the trace, s, above 0; by default only the first and the last row; typical a thousandth
    /// of the period.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 us", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Columns of the trace; all by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["slider.x_m", "ball.fx_N"]))]
    pub(crate) channels: Option<Vec<String>>,
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
}

impl OutputForm {
    pub(crate) fn is_empty(&self) -> bool {
        let Self { every, channels, springs, memory } = self;
        every.is_none() && channels.is_none() && springs.is_none() && memory.is_none()
    }
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

/// When the memory curves are written; by default at six moments, evenly spread over the last period or, without one,
/// over the run; of a run that may end steady, over each of the first hundred periods as well.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("maxProperties" = 1))]
pub(crate) struct MemoryOutputForm {
    /// Interval of the moments, s, above 0; this or `at`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 ms", transform = above_zero)]
    pub(crate) every: Option<Time>,
    /// Moments, s, ascending, within the run; this or `every`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1), transform = at_least_zero, example = json!(["91 ms", "95 ms", "100 ms"]))]
    pub(crate) at: Option<Vec<Time>>,
}
