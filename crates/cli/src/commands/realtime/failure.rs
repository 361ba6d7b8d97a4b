//! Why a loop does not begin, or what it cannot write.

use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_figures::FigureError;
use stickslip_realtime::memory::MemoryError;
use stickslip_realtime::plant::ChannelError;
use stickslip_realtime::source::RecordingError;
use stickslip_run::Refusal;
use stickslip_run::complaint::words;
use thiserror::Error;

/// Why there is no loop, or no report.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// The file.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The scenario, which was good, with this stepper.
    #[error("--stepper {stepper}: {message}")]
    Unfit {
        /// As it was asked for.
        stepper: String,
        /// What does not fit.
        message: String,
    },
    /// The stepper's name.
    #[error(
        "--stepper {0}: expected frames, frames:ACCURACY, event, event:TOLERANCE, verlet, verlet:STEP, rk4 or rk4:STEP, such as verlet:\"1 us\""
    )]
    Stepper(String),
    /// A step that cannot be found.
    #[error(
        "--stepper {0}: nothing in the scene swings, so that it says no step; give one, such as {0}:\"1 us\""
    )]
    NoStep(String),
    /// The drive.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Channels.
    #[error(transparent)]
    Channels(#[from] ChannelError),
    /// Inputs for a scene without any.
    #[error(
        "{0}: nothing in the scene is fed from outside; a waveform of the kind \"input\" or \"generator\" is, such as {{ \"input\": {{ \"initial\": 0, \"range\": [\"-1 um\", \"1 um\"] }} }}"
    )]
    NoInputs(&'static str),
    /// No address of this machine, or a port in use.
    #[error("--inputs udp:{address}: {}", words(source))]
    Address {
        /// The address.
        address: SocketAddr,
        /// What the system says.
        source: io::Error,
    },
    /// Nobody to send to.
    #[error(
        "--outputs udp: without --inputs udp:HOST:PORT nobody speaks who could be answered; give udp:HOST:PORT"
    )]
    NobodyToAnswer,
    /// Shared memory of two names.
    #[error("--outputs shm: the inputs have other shared memory; both lie in one")]
    TwoMemories,
    /// Shared memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// What is replayed.
    #[error("--inputs replay: {0}")]
    Recording(#[from] RecordingError),
    /// A recording that ends before.
    #[error("--for: the recording has {recorded} frames, {asked} are asked for")]
    Short {
        /// What it has.
        recorded: u64,
        /// What is asked for.
        asked: u64,
    },
    /// No frame, or more than anybody can wait for.
    #[error("--for: expected 1 to 1.4e12 frames of the period, got {0:e}")]
    Frames(f64),
    /// More steps in a frame than anybody waits for.
    #[error(
        "--stepper {stepper}: steps of {step} make {steps} steps a frame of {period}, expected at most {most}\n   help: {help}"
    )]
    TooManySteps {
        /// As it was asked for.
        stepper: String,
        /// Its step.
        step: String,
        /// Steps of a frame.
        steps: f64,
        /// The period.
        period: String,
        /// How many there may be.
        most: f64,
        /// What might do.
        help: String,
    },
    /// More than the machine can do.
    #[error(
        "--period: this machine cannot keep {period:.3} µs: of {frames} frames computed without waiting the median took {median:.3} µs, the \
         longest {worst:.3} µs\n   help: use a period of {help:.0} µs or more, another stepper or a coarser tolerance; --force starts \
         anyway, --unpaced runs without a clock"
    )]
    TooShort {
        /// The period, µs.
        period: f64,
        /// Frames computed.
        frames: u64,
        /// The median, µs.
        median: f64,
        /// The longest, µs.
        worst: f64,
        /// What might do, µs.
        help: f64,
    },
    /// The input never came.
    #[error(
        "--inputs: no good input came within {wait} s{refused}; nothing was computed\n   help: start the client before, or wait longer with --wait; --wait 0 starts without"
    )]
    NoInput {
        /// How long was waited, s.
        wait: f64,
        /// What came and was refused, in words.
        refused: String,
    },
    /// A file cannot be begun.
    #[error("{}: {}", path.display(), words(source))]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something else than a file, which a file would replace.
    #[error("{}: it is a device, a pipe or a link; give the name of a file", .0.display())]
    NoPlainFile(PathBuf),
    /// What the command reads.
    #[error("{}: it is read by this command; give another name", .0.display())]
    IsRead(PathBuf),
    /// A file for two things.
    #[error("{}: it is asked for twice; give another name", .0.display())]
    Twice(PathBuf),
    /// A file could not be written to its end.
    #[error("not all could be written: {0}")]
    Cut(String),
    /// The report cannot be written.
    #[error("the report cannot be written: {}", words(.0))]
    Report(#[from] io::Error),
    /// A picture.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The report is no JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

impl Failure {
    /// How the command ends.
    pub(crate) fn verdict(&self) -> Verdict {
        match self {
            Self::Cut(_) | Self::Report(_) | Self::Figure(_) | Self::Json(_) => Verdict::Stopped,
            _ => Verdict::BadInput,
        }
    }
}
