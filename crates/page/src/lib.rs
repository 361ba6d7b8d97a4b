//! Engine of the interactive page: scenarios, runs and contacts for a host without files, clocks and threads.
//!
//! [`Page`] contains what the engine does; the module `exports` passes it to WebAssembly, where this crate is a library of 20 functions.

mod contact;
#[cfg(target_family = "wasm")]
mod exports;
mod page;

pub use page::Page;
