//! How a scene is run.

use super::Count;
use crate::quantity::{Storage, Time};
use crate::schema::{above_zero, duration_or_cycles};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;
use stickslip_drive::{Limits, Stepper};

/// How long, from where and by which stepper.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = duration_or_cycles)]
pub(crate) struct RunForm {
    /// Simulated time, s, above 0; give either this or `cycles`; typical 1 ms to 10 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"100 ms", transform = above_zero)]
    pub(crate) duration: Option<Time>,
    /// Simulated time in cycles of the waveform of `figures`, above 0, after its delay; give either this or `duration`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), example = 10)]
    pub(crate) cycles: Option<f64>,
    /// Largest change of the step from period to period at which the run ends early as steady, a share of the step, 1e-12 to
    /// 0.1; by default the run is not stopped early; typical 1e-9 to 1e-3. The step is that of the body and the waveform of `figures`,
    /// a free one and one with a period. The end is that of the period with which three steps running are as long as the one
    /// before; where steps are shorter than u_c, the share is one of that. Until then the run is the same to the last bit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1e-12, max = 0.1), example = 1e-6)]
    pub(crate) until_steady: Option<f64>,
    /// How the free coordinates start.
    #[serde(default)]
    #[schemars(example = &"equilibrium")]
    pub(crate) start: RunStartForm,
    /// Time stepping; a tolerance suits every scenario, a fixed step must stay below its fastest oscillation.
    #[serde(default)]
    #[schemars(example = json!({ "event": { "tolerance": 1e-8 } }), example = json!({ "verlet": { "step": "1 us" } }))]
    pub(crate) stepper: StepperForm,
    /// Guards against endless work.
    #[serde(default)]
    #[schemars(example = json!({ "wall": "10 min" }))]
    pub(crate) limits: LimitsForm,
}

/// How the free coordinates start.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RunStartForm {
    /// Where the bodies say.
    #[default]
    Given,
    /// In static equilibrium under what acts at t = 0, at rest; refused where there is none at angles up to 0.1 rad.
    Equilibrium,
}

/// Time stepping. A tolerance is relative to the natural scales of length, force and velocity.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StepperForm {
    /// Order 8 with located events; in closed form from event to event where a single slider swings among cones, paraboloids, powers
    /// r³ and r⁴ or spheres under constant load that straight waveforms drag.
    #[schemars(example = json!({ "event": { "tolerance": 1e-8 } }))]
    Event(ToleranceForm),
    /// Velocity Verlet at a fixed step.
    #[schemars(example = json!({ "verlet": { "step": "1 us" } }))]
    Verlet(StepForm),
    /// Classical Runge–Kutta of order 4 at a fixed step.
    #[schemars(example = json!({ "rk4": { "step": "1 us" } }))]
    Rk4(StepForm),
    /// Frames of one length and bounded work, each of so many Runge–Kutta steps of order 4 that an accuracy is kept: for real
    /// time. Steps end at corners of waveforms; contacts remember no more than 256 turning points, 1024 where a normal moves.
    #[schemars(example = json!({ "frames": { "length": "20 us", "accuracy": 1e-3 } }))]
    Frames(FramesForm),
    /// Dormand–Prince 5(4) without events: the plain explicit reference.
    #[schemars(example = json!({ "dopri5": { "tolerance": 1e-8 } }))]
    Dopri5(ToleranceForm),
}

impl StepperForm {
    /// The stepper asked for, its number not yet checked.
    pub(crate) fn asked(&self) -> Stepper {
        match self {
            Self::Event(form) => Stepper::Event { tolerance: form.tolerance },
            Self::Verlet(form) => Stepper::Verlet { step: form.step.si },
            Self::Rk4(form) => Stepper::Rk4 { step: form.step.si },
            Self::Frames(form) => Stepper::Frames { length: form.length.si, accuracy: form.accuracy },
            Self::Dopri5(form) => Stepper::Dopri5 { tolerance: form.tolerance },
        }
    }
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
    /// Local error per step, relative to the natural scales u_c and μF_N, 1e-13 to 1e-2; typical 1e-10 to 1e-6.
    #[serde(default = "default_tolerance")]
    #[schemars(range(min = 1e-13, max = 1e-2), example = 1e-8)]
    pub(crate) tolerance: f64,
}

/// Stepping at a fixed step.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StepForm {
    /// Step, s, above 0; typical 10 ns to 1 us.
    #[schemars(example = &"100 ns", transform = above_zero)]
    pub(crate) step: Time,
}

/// Stepping in frames.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FramesForm {
    /// Frame, s, above 0; typical 10 us to 1 ms.
    #[schemars(example = &"50 us", transform = above_zero)]
    pub(crate) length: Time,
    /// What may be lost of a stroke in a stroke, 1e-9 to 0.1; typical 1e-5 to 1e-3. A frame has as many steps as the fastest
    /// oscillation of the scenario needs for it, 4.5 times as many where the normal of a contact moves; `stickslip info` says how many.
    #[serde(default = "default_accuracy")]
    #[schemars(range(min = 1e-9, max = 0.1), example = 1e-3)]
    pub(crate) accuracy: f64,
}

fn default_accuracy() -> f64 {
    1e-3
}

fn default_tolerance() -> f64 {
    1e-8
}

/// Guards against endless work.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LimitsForm {
    /// Maximum number of accepted and rejected steps, at least 1.
    #[serde(default = "default_steps")]
    #[schemars(range(min = 1), example = 1_000_000)]
    pub(crate) steps: Count,
    /// Maximum number of located events, at least 1.
    #[serde(default = "default_events")]
    #[schemars(range(min = 1), example = 100_000)]
    pub(crate) events: Count,
    /// Maximum wall-clock time, s, above 0; no limit by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 min", transform = above_zero)]
    pub(crate) wall: Option<Time>,
    /// Maximum memory that the run may keep, B, above 0: estimated before it starts, counted while it runs; no limit by
    /// default. The data for the plots grow with the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"512 MB", transform = above_zero)]
    pub(crate) memory: Option<Storage>,
}

impl Default for LimitsForm {
    fn default() -> Self {
        Self { steps: default_steps(), events: default_events(), wall: None, memory: None }
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
    /// Name of a waveform with a period; by default the only waveform.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"drive")]
    pub(crate) waveform: Option<String>,
    /// Name of a body that moves; the only free one, or the only one, by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"slider")]
    pub(crate) body: Option<String>,
    /// Whether `run` and `info` look for the motion that the drive would settle on, beside the run. By default `run` spends at most a fifth
    /// of its own steps on it; `true` lets it take as many as it needs; `false` saves that work. `stickslip steady` looks for it all the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = true)]
    pub(crate) steady_motion: Option<bool>,
}

impl FiguresForm {
    pub(crate) fn is_empty(&self) -> bool {
        self.waveform.is_none() && self.body.is_none() && self.steady_motion.is_none()
    }
}
