//! Between commands and whoever called them: what is printed, how far a run has come, who wants it to stop, how it ended.

pub mod answer;
pub mod interrupt;
pub mod place;
pub mod progress;
pub mod table;
pub mod verdict;
pub mod visible;
