//! Matrix of extreme scenarios. One parameter of a simple drive at a time takes extreme values, with all steppers and tolerances.
//!
//! Every cell must be right, compared with a second method, or end with a typed error with advice. [`matrix`] judges all cells;
//! [`write_record`] writes a page with plot and table.
//!
//! Reading order: `family` (scenarios), `cell` (scenario with stepper), `verify` (judgement), `record` and `picture` (output).

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

/// Wall time after which a cell is abandoned. The time includes its run, its reference and the runs for the growth factor.
const GIVEN_UP: Duration = Duration::from_secs(200);

/// Returns the number of cells.
pub fn size() -> usize {
    cell::Cells::new().count()
}

/// Returns the scenario of a cell as the text of a file, or `None` beyond the last cell.
pub fn scenario(cell: u64) -> Option<String> {
    cell::Cells::new().get(cell).map(|cell| cell.text())
}

/// Judges cells. The watcher receives the number of judged cells.
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
