//! Many runs of one scene: variants side by side, steady motion found directly, the curves of a machine.
//!
//! Knows no terminal and draws nothing, so that any door can stand on it. What it computes does not depend on the number of
//! threads.
//!
//! In reading order: [`sweep`], many runs in parts on disk, with `number` (numbers of a scene that are set without reading it again),
//! `sketch` (those of its waveforms) and `figure` (what is kept of such a run); [`steady`], the motion that repeats itself every period, and how it
//! comes back when it is disturbed; [`curve`], what that motion makes of a number that is varied; [`sensitivity`], by how much a
//! figure changes with each number of the scenario; [`fit`], numbers that fit what was measured; [`optimum`], where a result is largest or smallest; [`map`], a result over two numbers,
//! and borders between slip regimes; `published`, the files of curves, branches and derivatives, whole or interrupted.
//! `each` does many things side by side, `grip` tells whether something holds a body, `interruptible` lets a run be given up.

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

/// What every column and key of runs and studies is, and what `info --json` prints.
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
    all.extend(read::<optimum::Report>(stickslip_run::files::OPTIMUM));
    let mut met = HashSet::new();
    all.retain(|one| met.insert((one.file, one.name.clone())));
    all
}
