//! Between commands and whoever called them: what is printed, how far a run has come, who wants it to stop, how it ended.

pub(crate) mod answer;
pub(crate) mod interrupt;
pub(crate) mod pace;
pub(crate) mod place;
pub(crate) mod progress;
pub(crate) mod table;
pub(crate) mod verdict;
pub(crate) mod visible;
