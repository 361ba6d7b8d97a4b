//! How a scene is run: how long, by which stepper, what is written down.

use crate::linearised::Reach;
use crate::{Field, Part, SceneError, SceneFault};

/// How a scene is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Simulated time, s, above 0.
    pub duration: f64,
    /// Time stepping.
    pub stepper: Stepper,
    /// Guards against endless work.
    pub limits: Limits,
    /// Interval of the rows of the trace, s; none: only the first and the last row.
    pub every: Option<f64>,
    /// Whether the run may end before its time, with the steps of a drive constant.
    pub until_steady: Option<UntilSteady>,
}

/// An early end: that of the period with which the steps of a periodic drive are constant, each of the last three as long
/// as the one before it. Up to there the run is the same to the last bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UntilSteady {
    /// Place in [`Scene::waveforms`](crate::Scene::waveforms) of the waveform whose periods are counted, from its delay on;
    /// without a period nothing ends.
    pub waveform: usize,
    /// Place in [`Scene::bodies`](crate::Scene::bodies) of the body whose way along x in a period is the step; unless that
    /// is free nothing ends.
    pub body: usize,
    /// How much "as long" allows, above 0: a share of the step or, if that is longer, of the natural length of the body,
    /// u_c of its contacts.
    pub change: f64,
}

impl Plan {
    /// Whether its numbers lie in their ranges; what starts a run asks.
    ///
    /// # Errors
    /// The first number that does not.
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

/// Time stepping. Tolerances are relative to natural scales (u_c, μF_N and the velocities they make).
///
/// Fixed steps and the reference follow chords: of second order at best where contacts slip, whatever the
/// order of the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepper {
    /// Embedded pair of order 8 with located events.
    Event {
        /// Local error per step, 1e-13 to 1e-2.
        tolerance: f64,
    },
    /// Velocity Verlet at a fixed step.
    Verlet {
        /// Step, s.
        step: f64,
    },
    /// Classical Runge–Kutta of order 4 at a fixed step.
    Rk4 {
        /// Step, s.
        step: f64,
    },
    /// Frames of one length, each of a bounded number of Runge–Kutta steps of order 4, for whoever has to keep real time.
    ///
    /// Steps end where waveforms have corners; jumps of waveforms are taken. Memories of contacts stay small. How many steps
    /// a frame has is a constant of the model: [`Model::substeps`](crate::Model::substeps).
    Frames {
        /// Frame, s.
        length: f64,
        /// What may be lost of a stroke in a stroke, 1e-9 to 1e-1.
        accuracy: f64,
    },
    /// Dormand–Prince 5(4), without events: the plain explicit reference.
    Dopri5 {
        /// Local error per step, 1e-13 to 1e-2.
        tolerance: f64,
    },
}

/// The number that sets how exact a stepper is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Accuracy {
    /// Local error per step, relative to natural scales: the stepper chooses its steps.
    Tolerance(f64),
    /// Fixed step, s.
    Step(f64),
    /// Steps of one length, so many a frame that an error is kept.
    Frame {
        /// Frame, s.
        length: f64,
        /// What may be lost of a stroke in a stroke.
        error: f64,
    },
}

/// What is known of a stepper without a model.
struct Facts {
    name: &'static str,
    accuracy: Accuracy,
    locates_events: bool,
    /// How long its steps may be; steppers with a tolerance find it themselves.
    reach: Option<Reach>,
}

impl Stepper {
    /// The table of all steppers.
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

    /// Its name, in scenario files and results.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Its tolerance or its step.
    pub fn accuracy(self) -> Accuracy {
        self.facts().accuracy
    }

    /// Whether its steps end at events, jumps of waveforms among them; others step across them.
    pub fn locates_events(self) -> bool {
        self.facts().locates_events
    }

    /// Whether its steps end where waveforms have corners, so that a jump is a path of its own.
    pub fn ends_at_corners(self) -> bool {
        self.locates_events() || matches!(self, Self::Frames { .. })
    }

    /// How long its steps may be; none of steppers that choose them.
    pub(crate) fn reach(self) -> Option<Reach> {
        self.facts().reach
    }
}

/// Guards against endless work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Most accepted and rejected steps of a run.
    pub steps: u64,
    /// Most located events of a run.
    pub events: u64,
    /// Most wall-clock time, s.
    pub wall: Option<f64>,
}

impl Default for Limits {
    fn default() -> Self {
        Self { steps: 2_000_000_000, events: 200_000_000, wall: None }
    }
}
