//! Run times.

use std::time::Instant;

/// Times of one run, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Times {
    /// Processor time of this thread, which other processes on the machine do not increase.
    pub(crate) processor: f64,
    /// Wall time.
    pub(crate) wall: f64,
}

/// Running stopwatch.
pub(crate) struct Stopwatch {
    wall: Instant,
    processor: Option<f64>,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self { wall: Instant::now(), processor: processor() }
    }

    /// Returns the times since the start, divided by the number of runs.
    pub(crate) fn each(&self, runs: u32) -> Times {
        let spent = processor().zip(self.processor).map(|(now, then)| now - then);
        let wall = self.wall.elapsed().as_secs_f64();
        let processor = spent.unwrap_or(wall);
        Times { processor: processor / f64::from(runs), wall: wall / f64::from(runs) }
    }
}

impl Times {
    /// Returns the smaller of both times.
    pub(crate) fn shorter(self, other: Self) -> Self {
        Self { processor: self.processor.min(other.processor), wall: self.wall.min(other.wall) }
    }
}

/// Returns the processor time of this thread, s, if the system provides it.
#[cfg(unix)]
fn processor() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Some(time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64)
}

#[cfg(not(unix))]
fn processor() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sleeping_costs_no_processor_time() {
        let watch = Stopwatch::start();
        std::thread::sleep(std::time::Duration::from_millis(40));
        let times = watch.each(2);
        assert!(times.wall >= 0.02, "{times:?}");
        assert!(!cfg!(unix) || times.processor < 0.01, "{times:?}");
    }
}
