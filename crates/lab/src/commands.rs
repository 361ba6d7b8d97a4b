//! Implementation of the commands, one module each.

pub(crate) mod bench;
pub(crate) mod gallery;
pub(crate) mod soak;
pub(crate) mod validate;
