//! Time on the wall: asked for only where somebody wants to know, so that a run needs no clock.

use std::time::Instant;

/// A clock that began when it was made, or none.
#[derive(Debug, Clone, Copy)]
pub struct Wall(Option<Instant>);

impl Wall {
    /// Begins now where that is wanted, and where there is a clock.
    #[must_use]
    pub fn begin(is_wanted: bool) -> Self {
        let has_clock = !cfg!(all(target_family = "wasm", target_os = "unknown"));
        Self((is_wanted && has_clock).then(Instant::now))
    }

    /// Time since then, s; 0 without a clock.
    #[must_use]
    pub fn elapsed(&self) -> f64 {
        self.0.map_or(0.0, |begun| begun.elapsed().as_secs_f64())
    }
}
