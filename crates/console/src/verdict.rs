//! How a command ended, as the exit code says it.

/// How a command ended; of several the largest counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Everything was done.
    Done,
    /// A comparison found a difference.
    Differs,
    /// Something in the input is wrong.
    BadInput,
    /// A run stopped itself, or its results could not be written.
    Stopped,
    /// Somebody interrupted it.
    Interrupted,
}

impl Verdict {
    /// The exit code.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Differs => 1,
            Self::BadInput => 2,
            Self::Stopped => 3,
            // 128 + SIGINT, as shells have it.
            Self::Interrupted => 130,
        }
    }
}
