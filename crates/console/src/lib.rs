//! Console input and output of the commands: messages, progress bars, tables, interrupts and exit codes.

pub mod answer;
pub mod interrupt;
pub mod place;
pub mod progress;
pub mod table;
pub mod verdict;
pub mod visible;
