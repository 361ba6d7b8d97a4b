//! Keys of a run: duration, initial state, time integration and limits.

use super::Count;
use crate::quantity::{Storage, Time};
use crate::schema::{above_zero, duration_or_cycles};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;
use stickslip_drive::{Limits, Stepper};

/// Run of the simulation: its duration, initial state, stepper and limits.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = duration_or_cycles)]
pub(crate) struct RunForm {
    /// Simulated time, s, above 0; give either this or `cycles`; typical 1 ms to 10 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"100 ms", transform = above_zero)]
    pub(crate) duration: Option<Time>,
    /// Simulated time in cycles of the waveform that `figures` names, above 0; give either this or `duration`. The delay of the waveform is
    /// added to the simulated time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), example = 10)]
    pub(crate) cycles: Option<f64>,
    /// Largest relative change of the step length at which the run counts as steady and ends early, 1e-12 to 0.1; by default the run is not
    /// stopped early; typical 1e-9 to 1e-3. The step is the displacement of the free body of `figures` in one period of the waveform of
    /// `figures`. The run ends when each of the last three steps agrees with the preceding step within this change. For steps shorter than
    /// u_c, the displacement at the onset of gross slip, the change is relative to u_c. Until the run ends, it is identical to a run
    /// without this key.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1e-12, max = 0.1), example = 1e-6)]
    pub(crate) until_steady: Option<f64>,
    /// Initial state of the free coordinates: "given" by default, or "equilibrium".
    #[serde(default)]
    #[schemars(example = &"equilibrium")]
    pub(crate) start: RunStartForm,
    /// Stepper, the method of time integration. A method with a tolerance suits every scenario. A fixed step must stay below a limit set by
    /// the fastest oscillation.
    #[serde(default)]
    #[schemars(example = json!({ "event": { "tolerance": 1e-8 } }), example = json!({ "verlet": { "step": "1 us" } }))]
    pub(crate) stepper: StepperForm,
    /// Limits on the work and memory of a run.
    #[serde(default)]
    #[schemars(example = json!({ "wall": "10 min" }))]
    pub(crate) limits: LimitsForm,
}

/// Initial state of the free coordinates: "given" by default, or "equilibrium".
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RunStartForm {
    /// Each body starts from the position and velocity of its `start`.
    #[default]
    Given,
    /// The bodies start at rest in static equilibrium with the forces at t = 0. The scenario is refused if there is no equilibrium at
    /// angles up to 0.1 rad.
    Equilibrium,
}

/// Stepper, the method of time integration. A tolerance is relative to the natural scales of length, force and velocity.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StepperForm {
    /// Adaptive integration of order 8 with located events. A single slider without springs, under constant load and piecewise linear
    /// waveforms, is solved in closed form from event to event. The closed form exists for contacts whose profiles are cones, paraboloids,
    /// spheres or powers r³ and r⁴.
    #[schemars(example = json!({ "event": { "tolerance": 1e-8 } }))]
    Event(ToleranceForm),
    /// Velocity Verlet with a fixed time step.
    #[schemars(example = json!({ "verlet": { "step": "1 us" } }))]
    Verlet(StepForm),
    /// Classical Runge–Kutta of order 4 with a fixed time step.
    #[schemars(example = json!({ "rk4": { "step": "1 us" } }))]
    Rk4(StepForm),
    /// Real-time stepping in frames of equal length and bounded work. A frame has as many Runge–Kutta steps of order 4 as its accuracy
    /// needs. Steps end at corners of waveforms. A contact remembers at most 256 turning points, 1024 under a varying normal load.
    #[schemars(example = json!({ "frames": { "length": "20 us", "accuracy": 1e-3 } }))]
    Frames(FramesForm),
    /// Dormand–Prince 5(4) without located events, a plain explicit reference method.
    #[schemars(example = json!({ "dopri5": { "tolerance": 1e-8 } }))]
    Dopri5(ToleranceForm),
}

impl StepperForm {
    /// Returns the time integrator that the keys select. Its parameters are not checked yet.
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

/// Stepping with an adaptive time step.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToleranceForm {
    /// Local error per step, relative to the natural scales u_c and μF_N, 1e-13 to 1e-2; typical 1e-10 to 1e-6. u_c is the displacement at
    /// the onset of gross slip, μF_N the friction limit.
    #[serde(default = "default_tolerance")]
    #[schemars(range(min = 1e-13, max = 1e-2), example = 1e-8)]
    pub(crate) tolerance: f64,
}

/// Stepping with a fixed time step.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StepForm {
    /// Time step, s, above 0; typical 10 ns to 1 us.
    #[schemars(example = &"100 ns", transform = above_zero)]
    pub(crate) step: Time,
}

/// Stepping in frames of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FramesForm {
    /// Length of a frame, s, above 0; typical 10 us to 1 ms.
    #[schemars(example = &"50 us", transform = above_zero)]
    pub(crate) length: Time,
    /// Allowed error per stroke of the drive, as a share of the stroke, 1e-9 to 0.1; typical 1e-5 to 1e-3. A frame has as many steps as the
    /// fastest oscillation needs for this accuracy. Under a varying normal load, a frame has 3 times as many steps. `stickslip info`
    /// shows the number of steps.
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

/// Limits on the work and memory of a run.
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
    /// Maximum memory of the run, B, above 0; no limit by default. The memory is estimated before the run and counted during the run. The
    /// data for plots grow with the duration of the run.
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

/// Waveform and body from which the steps and speeds of the drive are computed.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FiguresForm {
    /// Name of the waveform whose period is one step of the drive; by default the only waveform.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"drive")]
    pub(crate) waveform: Option<String>,
    /// Name of the body whose steps and speed are computed; by default the only free body, or the only body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"slider")]
    pub(crate) body: Option<String>,
    /// Whether `run` and `info` search for the periodic motion of the drive. By default `run` spends at most a fifth of its own time steps
    /// on the search. `true` allows as many time steps as needed; `false` turns the search off. `stickslip steady` always searches.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = true)]
    pub(crate) steady_motion: Option<bool>,
}

impl FiguresForm {
    pub(crate) fn is_empty(&self) -> bool {
        self.waveform.is_none() && self.body.is_none() && self.steady_motion.is_none()
    }
}
