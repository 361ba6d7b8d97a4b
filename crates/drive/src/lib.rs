//! Rigid bodies, actuators, waveforms and frictional contacts as equations of motion, and their runs.
//!
//! A [`Scene`] says what is there; [`Model::new`] checks it and assembles the constants. A run is the sentence
//! that joins four things: the [`Model`] (constant), the [`State`] (all that the future depends on), a
//! workspace (scratch) and a [`Record`] (output): [`Model::start`] makes the state, [`run`] moves it along a
//! [`Plan`] to its end; a [`Run`] is held by its caller and moved from moment to moment.
//!
//! In reading order: [`Scene`], [`Waveform`], [`Plan`]; [`Model`] and its small motions, [`Linearised`]; [`State`]; the
//! equations of motion; guards and events; the runs, event-aware, at fixed step and by the plain reference; what is written down;
//! [`facts`], which are told before anything runs.
//!
//! Coordinates are x, z and the small pitch of each body, displacements from the position drawn, in SI: free, fixed or
//! following a waveform. Where no force depends on a velocity the runs take a Runge–Kutta–Nyström method, elsewhere,
//! and before singular moments, Dormand and Prince's of order 8.

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
