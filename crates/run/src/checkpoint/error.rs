//! Why a run cannot go on from its checkpoint.

use crate::complaint::words;
use crate::program::this_program;
use std::io;
use std::path::PathBuf;
use stickslip_drive::BytesError;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why a run cannot go on from its checkpoint.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// No run has left one.
    #[error("{}: has no checkpoint\n   help: a run leaves one with `stickslip run FILE --checkpoint-every \"30 s\"`", .0.display())]
    None(PathBuf),
    /// A file that cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Files that cannot be written.
    #[error("{}: cannot be written: {}", .path.display(), words(.source))]
    Write {
        /// Where.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something else under the name of a checkpoint.
    #[error("{}: expected a checkpoint of stickslip, found something else", .0.display())]
    Foreign(PathBuf),
    /// A checkpoint in another form.
    #[error("{}: written by {program}, in a form that this program, {}, does not know", .path.display(), this_program())]
    Newer {
        /// Which file.
        path: PathBuf,
        /// The program that wrote it.
        program: String,
    },
    /// A checkpoint of another program, whose steps may have other bits.
    #[error("{}: written by {program}, this is {}: it would not be the same run\n   help: go on with that program, or run the scenario anew", .path.display(), this_program())]
    OtherProgram {
        /// Which file.
        path: PathBuf,
        /// The program that wrote it.
        program: String,
    },
    /// A part of a checkpoint.
    #[error("{}: is cut short: {found} bytes of {expected}", .path.display())]
    Short {
        /// Which file.
        path: PathBuf,
        /// Its length, bytes.
        expected: u64,
        /// What is there of it, bytes.
        found: u64,
    },
    /// A checkpoint that has changed since it was written.
    #[error("{}: is damaged: its bytes do not have the SHA-256 that they were written with", .0.display())]
    Damaged(PathBuf),
    /// A journal that is not the one of its checkpoint.
    #[error("{}: is damaged, or not the journal of the checkpoint beside it", .0.display())]
    Journal(PathBuf),
    /// A state that makes none of this model.
    #[error("{}: {source}", .path.display())]
    State {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        source: BytesError,
    },
    /// The scenario of the run.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A scenario that is not the one of the run.
    #[error("{}: is not the scenario of the checkpoint beside it: more than its end has changed", .0.display())]
    OtherScenario(PathBuf),
    /// Something other than the end is to change.
    #[error(
        "--set {0}  a run that goes on is the same run: only its end can be changed, by {1}, and run.limits\n   help: run the scenario anew to change anything else"
    )]
    NotTheEnd(String, &'static str),
    /// The other of the two keys that can give a run its end.
    #[error("--set {0}  the scenario of this run gives its end by {1}\n   help: --set {1}=…")]
    OtherEnd(String, &'static str),
    /// An end that the run has passed.
    #[error("{}: the run has come to t = {reached:e} s, it cannot end at {end:e} s\n   help: give a later end, or run the scenario anew", .folder.display())]
    Passed {
        /// The folder of the results.
        folder: PathBuf,
        /// Time reached, s.
        reached: f64,
        /// The end asked for, s.
        end: f64,
    },
    /// A look into the contacts that is too late now.
    #[error("{}: with this end the run would look into its contacts at t = {t:e} s, which it has passed without a look\n   help: give another end, or run the scenario anew with moments for output.memory and output.springs", .folder.display())]
    Unseen {
        /// The folder of the results.
        folder: PathBuf,
        /// The moment, s.
        t: f64,
    },
    /// Rows and events of the last periods that were written, or were not, before these were known.
    #[error("{}: with this end the last periods (output.last) begin at another time than those that the run has come to\n   help: give the end it had, or run the scenario anew", .0.display())]
    LastPeriods(PathBuf),
    /// One folder for two runs.
    #[error("{}: is named twice", .0.display())]
    Twice(PathBuf),
}
