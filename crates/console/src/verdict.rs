//! Exit codes of the commands.

/// Outcome of a command. If a command performs several tasks, the largest outcome is its exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Everything succeeded.
    Done,
    /// A comparison found a difference.
    Differs,
    /// The input is invalid.
    BadInput,
    /// A run stopped itself, or its results could not be written.
    Stopped,
    /// The user interrupted the command.
    Interrupted,
}

impl Verdict {
    /// Returns the exit code.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Differs => 1,
            Self::BadInput => 2,
            Self::Stopped => 3,
            // 128 + SIGINT, the convention of shells.
            Self::Interrupted => 130,
        }
    }
}
