//! Errors before and after a real-time loop.

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

/// Reason why there is no loop or no report.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The scenario is invalid with this integrator.
    #[error("--stepper {stepper}: {message}")]
    Unfit {
        /// Integrator as given.
        stepper: String,
        /// Error message.
        message: String,
    },
    /// The integrator is unknown.
    #[error(
        "--stepper {0}: expected frames, frames:ACCURACY, event, event:TOLERANCE, verlet, verlet:STEP, rk4 or rk4:STEP, such as verlet:\"1 us\""
    )]
    Stepper(String),
    /// The model has no oscillation that determines a time step.
    #[error(
        "--stepper {0}: the model has no oscillation that determines a time step; give one, such as {0}:\"1 us\""
    )]
    NoStep(String),
    /// The model cannot be simulated.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Inputs or outputs are invalid.
    #[error(transparent)]
    Channels(#[from] ChannelError),
    /// The scenario has no inputs.
    #[error(
        "{0}: the scenario has no waveform of kind \"input\" or \"generator\"; add one, such as {{ \"input\": {{ \"initial\": 0, \"range\": [\"-1 um\", \"1 um\"] }} }}"
    )]
    NoInputs(&'static str),
    /// The address is not local or the port is in use.
    #[error("--inputs udp:{address}: {}", words(source))]
    Address {
        /// Address given for the inputs.
        address: SocketAddr,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The destination of the outputs is unknown.
    #[error(
        "--outputs udp: without --inputs udp:HOST:PORT the destination is not known; give --outputs udp:HOST:PORT"
    )]
    NobodyToAnswer,
    /// Inputs and outputs name different shared memories.
    #[error("--outputs shm: the inputs use another shared memory; give the same name for both")]
    TwoMemories,
    /// The shared memory cannot be used.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The recording cannot be replayed.
    #[error("--inputs replay: {0}")]
    Recording(#[from] RecordingError),
    /// The recording is too short.
    #[error("--for: the recording has {recorded} frames, {asked} are needed")]
    Short {
        /// Number of recorded frames.
        recorded: u64,
        /// Number of requested frames.
        asked: u64,
    },
    /// The number of frames is invalid.
    #[error("--for: expected a time of 1 to 1.4e12 frames, got {0:e} frames")]
    Frames(f64),
    /// A frame has too many time steps.
    #[error(
        "--stepper {stepper}: time steps of {step} give {steps} time steps per frame of {period}, expected at most {most}\n   help: {help}"
    )]
    TooManySteps {
        /// Integrator as given.
        stepper: String,
        /// Time step.
        step: String,
        /// Time steps per frame.
        steps: f64,
        /// Period.
        period: String,
        /// Maximum number of time steps.
        most: f64,
        /// Advice for the user.
        help: String,
    },
    /// The machine is too slow for this period.
    #[error(
        "--period: this machine cannot keep {period:.3} µs: of {frames} frames computed without waiting, the \
         median took {median:.3} µs, the longest {worst:.3} µs\n   help: use a period of {help:.0} µs or \
         more, another stepper or a coarser tolerance; --force starts anyway, --unpaced runs without a clock"
    )]
    TooShort {
        /// Period, µs.
        period: f64,
        /// Number of computed frames.
        frames: u64,
        /// Median computing time, µs.
        median: f64,
        /// Longest computing time, µs.
        worst: f64,
        /// Recommended period, µs.
        help: f64,
    },
    /// No valid input arrived.
    #[error(
        "--inputs: no valid input arrived within {wait} s{refused}; nothing was computed\n   help: start the client first, or wait longer with --wait; --wait 0 starts without an input"
    )]
    NoInput {
        /// Waiting time, s.
        wait: f64,
        /// Description of refused packets.
        refused: String,
    },
    /// A file cannot be created.
    #[error("{}: {}", path.display(), words(source))]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The path is a device, a pipe or a link.
    #[error("{}: this is a device, a pipe or a link; give the name of a file", .0.display())]
    NoPlainFile(PathBuf),
    /// The command reads this file.
    #[error("{}: this command reads this file; give another name", .0.display())]
    IsRead(PathBuf),
    /// Two options name the same file.
    #[error("{}: two options name this file; give another name", .0.display())]
    Twice(PathBuf),
    /// A file could not be completed.
    #[error("not all outputs could be written: {0}")]
    Cut(String),
    /// The report cannot be written.
    #[error("the report cannot be written: {}", words(.0))]
    Report(#[from] io::Error),
    /// A plot fails.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The report cannot be serialised.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

impl Failure {
    /// Returns the exit status of the command.
    pub(crate) fn verdict(&self) -> Verdict {
        match self {
            Self::Cut(_) | Self::Report(_) | Self::Figure(_) | Self::Json(_) => Verdict::Stopped,
            _ => Verdict::BadInput,
        }
    }
}
