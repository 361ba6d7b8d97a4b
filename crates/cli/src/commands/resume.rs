//! `stickslip resume`: runs that go on from their checkpoints.

use crate::arguments::ResumeArguments;
use crate::commands::run::{Beginning, Task, conduct};
use std::collections::HashSet;
use std::path::PathBuf;
use stickslip_console::verdict::Verdict;
use stickslip_run::checkpoint::{CheckpointError, Resumption};

/// Goes on with all runs; the worst ending counts. A folder that is refused does not keep the others from going on.
pub(crate) fn resume(arguments: &ResumeArguments) -> Verdict {
    conduct(&arguments.conduct, false, || prepare(arguments))
}

/// Reads and checks all checkpoints before the first run goes on.
fn prepare(arguments: &ResumeArguments) -> Vec<Result<Task, CheckpointError>> {
    let mut taken = HashSet::new();
    let mut prepare = |folder: &PathBuf| {
        let (job, resumption) = Resumption::read(folder, &arguments.set)?;
        // Two runs in one folder would cut each other's journal.
        if !taken.insert(folder.canonicalize().unwrap_or_else(|_| folder.clone())) {
            return Err(CheckpointError::Twice(folder.clone()));
        }
        Ok((job, Beginning::Resumed(Box::new(resumption), arguments.checkpoint_every)))
    };
    arguments.folders.iter().map(&mut prepare).collect()
}
