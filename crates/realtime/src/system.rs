//! What is asked of the operating system: the clock, the sleep, and the favours that a loop in real time may be granted.
//!
//! On Linux the sleep has an absolute deadline on the monotonic clock, so that what passes between a look at the clock and the
//! sleep delays nothing. Elsewhere it is that of the standard library, which is relative, and no favour is granted.

use thiserror::Error;

/// Why a favour was not granted; the loop goes on without it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Denied {
    /// By the system.
    #[error("{favour}: {words}; going on without")]
    Refused {
        /// What was asked for.
        favour: String,
        /// What the system says.
        words: String,
    },
    /// Not to be had on this system.
    #[error("{favour}: not to be had on this system; going on without")]
    Unknown {
        /// What was asked for.
        favour: String,
    },
}

/// What a loop in real time may ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Favours {
    /// The processor to stay on.
    pub cpu: Option<usize>,
    /// The priority among real-time threads, 1 to 99, first in first out.
    pub priority: Option<u8>,
    /// Whether all memory stays in memory.
    pub lock: bool,
}

pub use imp::{now, sleep_until};

impl Favours {
    /// Asks for each of them for the calling thread (memory: for the process); what was not granted comes back.
    #[must_use]
    pub fn ask(self) -> Vec<Denied> {
        let mut denied = Vec::new();
        // Deadlines are met to 50 µs by default, for the sake of batteries; a thread with a real-time priority has no slack.
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

    /// The monotonic clock, ns. Not a system call where the kernel lets the process read it.
    #[inline]
    pub fn now() -> u64 {
        let time = rustix::time::clock_gettime(ClockId::Monotonic);
        // The clock begins at 0 when the machine does.
        time.tv_sec as u64 * SECOND + time.tv_nsec as u64
    }

    /// Sleeps until a moment of [`now`]; not at all where that has passed.
    pub fn sleep_until(moment: u64) {
        let request = Timespec { tv_sec: (moment / SECOND) as _, tv_nsec: (moment % SECOND) as _ };
        // A signal may wake it: the deadline is absolute, so it sleeps on.
        while now() < moment && clock_nanosleep_absolute(ClockId::Monotonic, &request).is_err() {}
    }

    pub(super) fn sharpen() {
        // Without it deadlines are met later, and the histogram says so.
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
        // SAFETY: the pointer is to a whole sched_param on this stack, which the call only reads; 0 is the calling thread.
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

    /// The monotonic clock, ns since it was first looked at.
    pub fn now() -> u64 {
        // 584 years are enough.
        u64::try_from(BEGINNING.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
    }

    /// Sleeps until a moment of [`now`], by a relative sleep: what delays its beginning delays its end.
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
