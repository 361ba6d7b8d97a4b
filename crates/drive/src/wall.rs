//! Optional wall clock, so that a run also works on platforms without a clock.

use std::time::Instant;

/// Clock that starts at its creation, or none.
#[derive(Debug, Clone, Copy)]
pub struct Wall(Option<Instant>);

impl Wall {
    /// Starts a clock if requested and available on the platform.
    #[must_use]
    pub fn begin(is_wanted: bool) -> Self {
        let has_clock = !cfg!(all(target_family = "wasm", target_os = "unknown"));
        Self((is_wanted && has_clock).then(Instant::now))
    }

    /// Returns the elapsed time, s; 0 without a clock.
    #[must_use]
    pub fn elapsed(&self) -> f64 {
        self.0.map_or(0.0, |begun| begun.elapsed().as_secs_f64())
    }
}
