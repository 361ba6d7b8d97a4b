//! Equations of motion of rigid bodies, actuators, waveforms and frictional contacts, and their simulation.
//!
//! A [`Scene`] describes bodies, contacts and drives; [`Model::new`] checks it and computes constants. A run connects the
//! [`Model`] (constant), the [`State`] (all that the future depends on), a workspace (scratch) and a [`Record`] (output).
//! [`Model::start`] creates the state. [`run`] advances it along a [`Plan`] to the end; a [`Run`] advances on request.
//!
//! Contents: [`Scene`], [`Waveform`], [`Plan`]; [`Model`] and its linearisation [`Linearised`]; [`State`]; equations of motion;
//! event functions and events; runs with event location, with fixed steps and by a reference method; records; [`facts`],
//! properties known before a run.
//!
//! The coordinates are x, z and the small pitch of each body, as displacements from the reference position in SI units. A
//! coordinate is free, fixed, balanced or follows a waveform. If no force depends on a velocity, runs use a Runge–Kutta–Nyström
//! method. Otherwise, and before singular moments, they use the Dormand–Prince method of order 8; stiff models use Radau IIA.

pub mod component;
mod contact;
mod equations;
mod equilibrium;
mod error;
mod event;
pub mod facts;
mod interval;
mod linearised;
mod method;
mod model;
mod plan;
mod quadrature;
mod record;
mod run;
pub mod scene;
mod schedule;
pub mod section;
mod sine;
mod state;
mod wall;
mod watcher;
mod waveform;

pub use error::{Field, Part, RunError, SceneError, SceneFault};
pub use event::{Event, EventKind, Source};
pub use linearised::{Indentations, LinearInput, Linearised, NormalMode};
pub use method::{Expected, Method, Tally, Treatment, Why};
pub use model::{Model, NaturalScale, Pressing, Spared};
pub use plan::{Accuracy, Limits, Plan, Stepper, UntilSteady};
pub use record::{Channel, Extent, Record, Trace, state_name};
pub use run::{Run, VariantError, Variants, WALK_TOLERANCE, run};
pub use scene::Scene;
pub use schedule::{Moments, Schedule};
pub use state::{BytesError, CommandError, Counts, Generated, InputError, State};
pub use wall::Wall;
pub use watcher::{Unrecorded, Watcher};
pub use waveform::{
    Command, Cycle, Generator, Harmonic, Heading, Interpolation, Piece, Sample, Section, Shape, Steps, Sweep,
    Timing, Waveform, WaveformError,
};
