//! Errors of resuming a run from its checkpoint.

use crate::complaint::words;
use crate::program::this_program;
use std::io;
use std::path::PathBuf;
use stickslip_drive::BytesError;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Reason why a run cannot be resumed from its checkpoint.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The folder contains no checkpoint.
    #[error("{}: has no checkpoint\n   help: `stickslip run FILE --checkpoint-every \"30 s\"` writes checkpoints", .0.display())]
    None(PathBuf),
    /// A file cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("{}: cannot be written: {}", .path.display(), words(.source))]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file is not a checkpoint.
    #[error("{}: is not a checkpoint of stickslip", .0.display())]
    Foreign(PathBuf),
    /// The format of the checkpoint is unknown.
    #[error("{}: written by {program} in a format that this program, {}, does not know", .path.display(), this_program())]
    Newer {
        /// Path of the file.
        path: PathBuf,
        /// Program that wrote the file.
        program: String,
    },
    /// Another program version wrote the checkpoint. Time steps of different versions may differ in rounding.
    #[error("{}: written by {program}, this is {}: the results could differ\n   help: resume with that program, or run the scenario again", .path.display(), this_program())]
    OtherProgram {
        /// Path of the file.
        path: PathBuf,
        /// Program that wrote the file.
        program: String,
    },
    /// The checkpoint is truncated.
    #[error("{}: is truncated: {found} bytes of {expected}", .path.display())]
    Short {
        /// Path of the file.
        path: PathBuf,
        /// Expected length, bytes.
        expected: u64,
        /// Actual length, bytes.
        found: u64,
    },
    /// The checkpoint was changed after it was written.
    #[error("{}: is damaged: its SHA-256 does not match", .0.display())]
    Damaged(PathBuf),
    /// The journal does not belong to the checkpoint.
    #[error("{}: is damaged, or does not belong to the checkpoint in this folder", .0.display())]
    Journal(PathBuf),
    /// The state does not fit the model.
    #[error("{}: {source}", .path.display())]
    State {
        /// Path of the file.
        path: PathBuf,
        /// Cause.
        source: BytesError,
    },
    /// The scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The scenario differs from that of the interrupted run in more than its end.
    #[error("{}: is not the scenario of the checkpoint: more than its end has changed", .0.display())]
    OtherScenario(PathBuf),
    /// A setting other than the end of the run was changed.
    #[error(
        "--set {0}  a resumed run can only change its end, by {1}, and run.limits\n   help: run the scenario again to change other keys"
    )]
    NotTheEnd(String, &'static str),
    /// The scenario gives the end of the run by `run.duration` and the change by `run.cycles`, or vice versa.
    #[error("--set {0}  the end of this run is given by {1}\n   help: --set {1}=…")]
    OtherEnd(String, &'static str),
    /// The run has already passed the new end.
    #[error("{}: the run has reached t = {reached:e} s and cannot end at {end:e} s\n   help: give a later end, or run the scenario again", .folder.display())]
    Passed {
        /// Folder of the results.
        folder: PathBuf,
        /// Time reached, s.
        reached: f64,
        /// New end, s.
        end: f64,
    },
    /// With the new end, contact states would be written at a time that has already passed.
    #[error("{}: with this end the run would write contact states at t = {t:e} s, which it has already passed\n   help: give another end, or run the scenario again with times for output.memory and output.springs", .folder.display())]
    Unseen {
        /// Folder of the results.
        folder: PathBuf,
        /// Time of the contact states, s.
        t: f64,
    },
    /// With the new end, the window of the last periods (`output.last`) would differ.
    #[error("{}: with this end the last periods (output.last) would begin at another time\n   help: keep the end, or run the scenario again", .0.display())]
    LastPeriods(PathBuf),
    /// A folder is named twice.
    #[error("{}: is named twice", .0.display())]
    Twice(PathBuf),
}
