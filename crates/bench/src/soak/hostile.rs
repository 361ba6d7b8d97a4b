//! A matrix of hostile scenes: one thing of a plain drive at a time goes to its extremes, by every stepper and tolerance.
//!
//! Every cell ends right, judged by a second method, or in a typed error that says what to try. [`matrix`] judges all of them,
//! [`write_record`] tells of it: a page with its picture and table.
//!
//! In reading order: `family` (the scenes), `cell` (a scene with its stepper), `verify` (how one is judged), `record` and
//! `picture` (what is written).

mod cell;
mod family;
mod picture;
mod record;
mod verify;

use super::crew::{Work, conduct};
use super::finding::Finding;
use std::time::Duration;
use stickslip_run::Watcher;

pub use record::write_record;

/// Wall time after which a cell that no limit has ended is given up: its own run, its reference and what sensitivity asks.
const GIVEN_UP: Duration = Duration::from_secs(200);

/// Number of cells.
pub fn size() -> usize {
    cell::Cells::new().count()
}

/// The scenario of a cell, as the text of its file; none beyond the last cell.
pub fn scenario(cell: u64) -> Option<String> {
    cell::Cells::new().get(cell).map(|cell| cell.text())
}

/// Judges these cells; the watcher is told how many there are.
pub fn matrix(cells: Vec<u64>, threads: usize, watcher: &dyn Watcher) -> Vec<Finding> {
    let judge = verify::Judge::new(cell::Cells::new());
    let work = Work {
        seeds: cells,
        judge: Box::new(move |seed| judge.judge(seed)),
        kind: |seed| cell::Cells::new().get(seed).map_or("beyond", |cell| cell.family.name),
        given_up: GIVEN_UP,
    };
    conduct(work, threads, watcher)
}
