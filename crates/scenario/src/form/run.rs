//! How a scene is run.

use super::Count;
use crate::quantity::Time;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_drive::Limits;

/// How long, from where and by which stepper.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RunForm {
    /// Simulated time, s, above 0; this or `cycles`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) duration: Option<Time>,
    /// Simulated time in cycles of the waveform of `figures`, above 0, after its delay; this or `duration`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) cycles: Option<f64>,
    /// How the free coordinates start.
    #[serde(default)]
    pub(crate) start: RunStartForm,
    /// Time stepping.
    #[serde(default)]
    pub(crate) stepper: StepperForm,
    /// Guards against endless work.
    #[serde(default)]
    pub(crate) limits: LimitsForm,
}

/// How the free coordinates start.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RunStartForm {
    /// Where the bodies say.
    #[default]
    Given,
    /// In static equilibrium under what acts at t = 0, at rest.
    Equilibrium,
}

/// Time stepping. A tolerance is relative to the scene's natural scales of length, force and velocity.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StepperForm {
    /// Order 8 with located events.
    Event(ToleranceForm),
    /// Velocity Verlet at a fixed step.
    Verlet(StepForm),
    /// Classical Runge–Kutta of order 4 at a fixed step.
    Rk4(StepForm),
    /// Dormand–Prince 5(4) without events: the plain explicit reference.
    Dopri5(ToleranceForm),
}

impl Default for StepperForm {
    fn default() -> Self {
        Self::Event(ToleranceForm { tolerance: default_tolerance() })
    }
}

/// Adaptive stepping.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToleranceForm {
    /// Local error per step, 1e-13 to 1e-2.
    #[serde(default = "default_tolerance")]
    #[schemars(range(min = 1e-13, max = 1e-2))]
    pub(crate) tolerance: f64,
}

/// Stepping at a fixed step.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StepForm {
    /// Step, s, above 0.
    pub(crate) step: Time,
}

fn default_tolerance() -> f64 {
    1e-8
}

/// Guards against endless work.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LimitsForm {
    /// Most accepted and rejected steps, at least 1.
    #[serde(default = "default_steps")]
    #[schemars(range(min = 1))]
    pub(crate) steps: Count,
    /// Most located events, at least 1.
    #[serde(default = "default_events")]
    #[schemars(range(min = 1))]
    pub(crate) events: Count,
    /// Most wall-clock time, s, above 0; without end by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) wall: Option<Time>,
}

impl Default for LimitsForm {
    fn default() -> Self {
        Self { steps: default_steps(), events: default_events(), wall: None }
    }
}

fn default_steps() -> Count {
    Count(Limits::default().steps)
}

fn default_events() -> Count {
    Count(Limits::default().events)
}

/// Whose period and whose motion make steps and speeds.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FiguresForm {
    /// Name of a waveform; the only one there is by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) waveform: Option<String>,
    /// Name of a body; the only free one, or the only one, by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) body: Option<String>,
}

impl FiguresForm {
    pub(crate) fn is_empty(&self) -> bool {
        self.waveform.is_none() && self.body.is_none()
    }
}
