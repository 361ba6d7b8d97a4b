//! Studies of a scenario: parameter sweeps, periodic orbits, curves, sensitivities, fits, optima and maps.
//!
//! The crate has no terminal output and draws no plots. Results do not depend on the number of threads.
//!
//! Modules in reading order:
//! * [`sweep`]: parameter sweeps of many runs, stored in parts on disk. The modules `number` and `sketch` change parameters without parsing
//!   the scenario again; module `figure` evaluates the results of a run.
//! * [`steady`]: periodic orbits and their stability.
//! * [`curve`]: step length and velocity versus one parameter.
//! * [`sensitivity`]: derivatives of results with respect to parameters.
//! * [`fit`]: parameters fitted to a measurement.
//! * [`optimum`]: parameters with the largest or smallest result.
//! * [`map`]: a result over two parameters, and borders between slip regimes.
//! * `published`: output files of complete and interrupted studies.
//! * Helpers: `each` (parallel map), `grip` (does friction hold a body?), `interruptible` (cancellation of a run).

pub mod curve;
mod each;
mod figure;
pub mod fit;
mod grip;
mod info;
mod interruptible;
mod journal;
pub mod map;
mod number;
// Its library asks a browser for the time.
#[cfg(not(target_family = "wasm"))]
pub mod optimum;
mod published;
pub mod report;
pub mod sensitivity;
mod sketch;
pub mod steady;
pub mod sweep;

pub use info::Info;
pub use journal::Journal;
pub use report::summary;

use std::collections::HashSet;
use stickslip_quantity::{Definition, report as read};

/// Returns the definitions of all columns and keys in the output of runs, studies and `info --json`.
#[must_use]
pub fn definitions() -> Vec<Definition> {
    let mut all = stickslip_run::definitions();
    all.extend(read::<Info>("info --json"));
    all.extend(stickslip_run::theory::definitions());
    all.extend(read::<steady::Report>(stickslip_run::files::STEADY));
    all.extend(steady::continuation::definitions());
    all.extend(curve::definitions());
    all.extend(sensitivity::definitions());
    all.extend(map::definitions());
    all.extend(read::<sweep::Forecast>("study plan --json"));
    all.extend(read::<sweep::Statistics>("study run --json"));
    all.extend(read::<sweep::Indices>("study indices --json"));
    #[cfg(not(target_family = "wasm"))]
    all.extend(read::<optimum::Report>(stickslip_run::files::OPTIMUM));
    let mut met = HashSet::new();
    all.retain(|one| met.insert((one.file, one.name.clone())));
    all
}
