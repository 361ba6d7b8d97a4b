//! Equations of motion of rigid bodies, actuators, waveforms and frictional contacts, and their simulation.
//!
//! A [`Scene`] describes bodies, contacts and drives; [`Model::new`] checks this description and computes constants. A run connects the
//! [`Model`] (constant), the [`State`] (all that determines the future motion), scratch memory and a [`Record`] (output). [`Model::start`]
//! creates the state. [`run`] integrates the motion to the end, with the settings of a [`Plan`]; a [`Run`] advances on request.
//!
//! The crate contains [`Scene`], [`Waveform`], [`Plan`], [`Model`] with its linearisation [`Linearised`], and [`State`]. Runs are
//! integrated with event location, with fixed steps or by a reference method, and write records. [`facts`] computes properties known before
//! a run.
//!
//! The coordinates are x, z and the small pitch of each body, as displacements from the reference position in SI units. A coordinate is
//! free, fixed, balanced (quasi-static) or follows a waveform. If no force depends on a velocity, a Runge–Kutta–Nyström method is used.
//! Otherwise, and near singular moments, the Dormand–Prince method of order 8 is used; stiff models use Radau IIA.

pub mod component;
mod contact;
mod equations;
mod equilibrium;
mod error;
mod event;
pub mod facts;
pub mod inputs;
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
pub use record::{Channel, Due, Entry, EventDetail, Extent, Record, Trace, Wants, state_code, state_name};
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
