//! One room for each command.

pub(crate) mod bench;
pub(crate) mod gallery;
pub(crate) mod soak;
pub(crate) mod validate;
