//! Plan of a run: duration, stepper and output.

use crate::linearised::Reach;
use crate::{Field, Part, SceneError, SceneFault};

/// Plan of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Simulated time, s, above 0.
    pub duration: f64,
    /// Stepper.
    pub stepper: Stepper,
    /// Limits of a run.
    pub limits: Limits,
    /// Time between two rows of the trace, s. None writes only the first and the last row.
    pub every: Option<f64>,
    /// Early end of the run at a steady step length, if requested.
    pub until_steady: Option<UntilSteady>,
}

/// Early end of a run at a steady step length: each of the last three steps of the drive agrees with the previous one. The run ends with a
/// period of the waveform; results up to that time are identical to those of a full run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UntilSteady {
    /// Index in [`Scene::waveforms`](crate::Scene::waveforms) of the waveform whose periods are counted from its delay. A waveform without
    /// a period causes no early end.
    pub waveform: usize,
    /// Index in [`Scene::bodies`](crate::Scene::bodies) of the body whose displacement along x per period is the step length. The body must
    /// be free.
    pub body: usize,
    /// Allowed change of the step length, above 0, relative to the step length or to the natural length of the body (u_c of its contacts),
    /// whichever is longer.
    pub change: f64,
}

impl Plan {
    /// Checks the ranges of all numbers; [`Model::start`](crate::Model::start) calls it.
    ///
    /// # Errors
    ///
    /// [`SceneError`]: the first number out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        let above_zero = |field: Field, value: f64| {
            if value > 0.0 && value.is_finite() {
                return Ok(());
            }
            Err(SceneFault::NotAboveZero(value).of(Part::Run, field))
        };
        above_zero(Field::Duration, self.duration)?;
        self.every.map_or(Ok(()), |every| above_zero(Field::Interval, every))?;
        self.until_steady.map_or(Ok(()), |steady| above_zero(Field::SteadyChange, steady.change))?;
        match self.stepper.accuracy() {
            Accuracy::Tolerance(tolerance) => above_zero(Field::Tolerance, tolerance),
            Accuracy::Step(step) => above_zero(Field::Step, step),
            Accuracy::Frame { length, error } => {
                above_zero(Field::Frame, length)?;
                above_zero(Field::FrameAccuracy, error)
            }
        }
    }
}

/// Stepper. Tolerances are relative to natural scales (u_c, μF_N and the corresponding velocities).
///
/// With fixed steps or the reference method, contacts follow one straight path per step; under slip the order is at most 2. Fixed steps end
/// at corners and jumps of waveforms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepper {
    /// Methods of order 8 and closed forms, with event location.
    Event {
        /// Local error per step, relative to natural scales, 1e-13 to 1e-2.
        tolerance: f64,
    },
    /// Velocity Verlet with a fixed step.
    Verlet {
        /// Step length, s.
        step: f64,
    },
    /// Classical Runge–Kutta method of order 4 with a fixed step.
    Rk4 {
        /// Step length, s.
        step: f64,
    },
    /// Frames (time intervals of fixed length) with a bounded number of Runge–Kutta steps of order 4, for real-time simulation.
    ///
    /// The number of reversals in a slip memory is limited. The number of steps in a frame is a constant of the model:
    /// [`Model::substeps`](crate::Model::substeps).
    Frames {
        /// Length of a frame, s.
        length: f64,
        /// Allowed error per stroke, relative to the stroke, 1e-9 to 1e-1.
        accuracy: f64,
    },
    /// Dormand–Prince 5(4) without events, as a reference.
    Dopri5 {
        /// Local error per step, relative to natural scales, 1e-13 to 1e-2.
        tolerance: f64,
    },
}

/// Parameter that determines the accuracy of a stepper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Accuracy {
    /// Local error per step, relative to natural scales, of an adaptive stepper.
    Tolerance(f64),
    /// Step length, s.
    Step(f64),
    /// Frames of fixed length; the number of steps in a frame follows from an allowed error.
    Frame {
        /// Length of a frame, s.
        length: f64,
        /// Allowed error per stroke, relative to the stroke.
        error: f64,
    },
}

/// Properties of a stepper.
struct Facts {
    name: &'static str,
    accuracy: Accuracy,
    locates_events: bool,
    /// Stability limits; none for adaptive steppers.
    reach: Option<Reach>,
}

impl Stepper {
    /// Returns the properties of a stepper.
    fn facts(self) -> Facts {
        let adaptive = |name, tolerance, locates_events| Facts {
            name,
            accuracy: Accuracy::Tolerance(tolerance),
            locates_events,
            reach: None,
        };
        let fixed = |name, step, reach| Facts {
            name,
            accuracy: Accuracy::Step(step),
            locates_events: false,
            reach: Some(reach),
        };
        match self {
            Self::Event { tolerance } => adaptive("event", tolerance, true),
            Self::Verlet { step } => fixed("verlet", step, Reach::VERLET),
            Self::Rk4 { step } => fixed("rk4", step, Reach::RK4),
            Self::Frames { length, accuracy } => Facts {
                accuracy: Accuracy::Frame { length, error: accuracy },
                ..fixed("frames", length, Reach::RK4)
            },
            Self::Dopri5 { tolerance } => adaptive("dopri5", tolerance, false),
        }
    }

    /// Returns the name of the stepper in scenarios and results.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Returns the tolerance, step or frame of the stepper.
    pub fn accuracy(self) -> Accuracy {
        self.facts().accuracy
    }

    /// Whether steps of this stepper end at events, including jumps of waveforms.
    pub fn locates_events(self) -> bool {
        self.facts().locates_events
    }

    /// Whether contacts follow a jump of a waveform on a separate path.
    pub fn follows_jumps(self) -> bool {
        !matches!(self, Self::Dopri5 { .. })
    }

    /// Returns the stability limits of the stepper; none for adaptive steppers.
    pub(crate) fn reach(self) -> Option<Reach> {
        self.facts().reach
    }
}

/// Limits of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest number of attempted steps.
    pub steps: u64,
    /// Largest number of located events.
    pub events: u64,
    /// Largest wall-clock time, s.
    pub wall: Option<f64>,
}

impl Default for Limits {
    fn default() -> Self {
        Self { steps: 2_000_000_000, events: 200_000_000, wall: None }
    }
}
