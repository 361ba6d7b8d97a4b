//! Operating system services: clock, sleep and privileges of a real-time loop.
//!
//! On Linux the sleep has an absolute deadline on the monotonic clock. A delay between reading the clock and sleeping therefore has no
//! effect. On other systems the sleep is relative, and no privilege is available.

use thiserror::Error;

/// Reason why a privilege is missing. The loop runs without this privilege.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Denied {
    /// The operating system refused the privilege.
    #[error("{favour}: {words}; the loop runs without it")]
    Refused {
        /// Name of the privilege.
        favour: String,
        /// Error of the operating system.
        words: String,
    },
    /// The privilege does not exist on this operating system.
    #[error("{favour}: not available on this system; the loop runs without it")]
    Unknown {
        /// Name of the privilege.
        favour: String,
    },
}

/// Privileges that a real-time loop may request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Favours {
    /// Processor to which the thread is pinned.
    pub cpu: Option<usize>,
    /// Priority of the first-in-first-out real-time scheduler, from 1 to 99.
    pub priority: Option<u8>,
    /// Whether all memory of the process is locked, so that it is not swapped out.
    pub lock: bool,
}

pub use imp::{now, sleep_until};

impl Favours {
    /// Requests the privileges for the calling thread, and memory locking for the process. Returns the privileges that were denied.
    #[must_use]
    pub fn ask(self) -> Vec<Denied> {
        let mut denied = Vec::new();
        // The default timer slack is 50 µs. Threads with real-time priority have no timer slack.
        imp::sharpen();
        if self.lock {
            denied.extend(imp::lock().err());
        }
        if let Some(cpu) = self.cpu {
            denied.extend(imp::pin(cpu).err());
        }
        if let Some(priority) = self.priority {
            denied.extend(imp::raise(priority).err());
        }
        denied
    }
}

#[cfg(target_os = "linux")]
mod imp {
    use super::Denied;
    use rustix::mm::{MlockAllFlags, mlockall};
    use rustix::thread::{
        ClockId, CpuSet, Timespec, clock_nanosleep_absolute, sched_setaffinity, set_current_timer_slack,
    };
    use std::num::NonZeroU64;

    const SECOND: u64 = 1_000_000_000;

    /// Returns the time of the monotonic clock, ns. Reading this clock usually needs no system call.
    #[inline]
    pub fn now() -> u64 {
        let time = rustix::time::clock_gettime(ClockId::Monotonic);
        // The clock starts at 0 at system start, so the time is not negative.
        time.tv_sec as u64 * SECOND + time.tv_nsec as u64
    }

    /// Sleeps until a time of [`now`], ns. Returns at once if the time has passed.
    pub fn sleep_until(moment: u64) {
        let request = Timespec { tv_sec: (moment / SECOND) as _, tv_nsec: (moment % SECOND) as _ };
        // A signal may interrupt the sleep. The deadline is absolute, so the sleep is repeated.
        while now() < moment && clock_nanosleep_absolute(ClockId::Monotonic, &request).is_err() {}
    }

    pub(super) fn sharpen() {
        // If the call fails, the latencies are larger.
        let _ = set_current_timer_slack(NonZeroU64::new(1));
    }

    fn refused(favour: &str) -> impl FnOnce(rustix::io::Errno) -> Denied {
        let favour = favour.to_owned();
        move |errno| Denied::Refused { favour, words: std::io::Error::from(errno).to_string() }
    }

    pub(super) fn lock() -> Result<(), Denied> {
        mlockall(MlockAllFlags::CURRENT | MlockAllFlags::FUTURE)
            .map_err(refused("locking the memory (--lock)"))
    }

    pub(super) fn pin(cpu: usize) -> Result<(), Denied> {
        let favour = format!("staying on processor {cpu} (--cpu)");
        if cpu >= CpuSet::MAX_CPU {
            return Err(Denied::Refused { favour, words: "there is no such processor".to_owned() });
        }
        let mut set = CpuSet::new();
        set.set(cpu);
        sched_setaffinity(None, &set).map_err(refused(&favour))
    }

    pub(super) fn raise(priority: u8) -> Result<(), Denied> {
        let param = libc::sched_param { sched_priority: i32::from(priority) };
        #[allow(unsafe_code, reason = "rustix has no sched_setscheduler")]
        // SAFETY: the pointer refers to a complete sched_param on this stack, which the call only reads. 0 is the calling thread.
        let result = unsafe { libc::sched_setscheduler(0, libc::SCHED_FIFO, &raw const param) };
        if result == 0 {
            return Ok(());
        }
        let words = std::io::Error::last_os_error().to_string();
        Err(Denied::Refused { favour: format!("real-time priority {priority} (--priority)"), words })
    }
}

#[cfg(not(target_os = "linux"))]
mod imp {
    use super::Denied;
    use std::sync::OnceLock;
    use std::time::{Duration, Instant};

    static BEGINNING: OnceLock<Instant> = OnceLock::new();

    /// Returns the time of the monotonic clock, ns since the first call.
    pub fn now() -> u64 {
        // The time overflows after 584 years.
        u64::try_from(BEGINNING.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
    }

    /// Sleeps until a time of [`now`], ns, by a relative sleep. A delay at the start of the sleep delays its end.
    pub fn sleep_until(moment: u64) {
        std::thread::sleep(Duration::from_nanos(moment.saturating_sub(now())));
    }

    pub(super) fn sharpen() {}

    fn unknown(favour: String) -> Result<(), Denied> {
        Err(Denied::Unknown { favour })
    }

    pub(super) fn lock() -> Result<(), Denied> {
        unknown("locking the memory (--lock)".to_owned())
    }

    pub(super) fn pin(cpu: usize) -> Result<(), Denied> {
        unknown(format!("staying on processor {cpu} (--cpu)"))
    }

    pub(super) fn raise(priority: u8) -> Result<(), Denied> {
        unknown(format!("real-time priority {priority} (--priority)"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nobody_wakes_before_the_deadline() {
        for ahead in [0, 1_000, 300_000, 2_000_000] {
            let deadline = now() + ahead;
            sleep_until(deadline);
            assert!(now() >= deadline);
        }
        let long_ago = now() - 1;
        sleep_until(long_ago);
    }

    #[test]
    fn a_processor_that_is_not_there_is_told() {
        let denied = Favours { cpu: Some(1 << 20), ..Favours::default() }.ask();
        assert_eq!(denied.len(), 1);
        assert!(denied[0].to_string().contains("processor 1048576 (--cpu)"), "{}", denied[0]);
    }
}
