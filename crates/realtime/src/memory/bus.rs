//! Handling of the signal SIGBUS for memory mappings whose file another process may truncate.
//!
//! An access to a missing page causes SIGBUS, which ends the process unless it is handled. This handler replaces the mapping by zeros, and
//! the access is repeated. Checking the file length before each access would leave a race condition. File reads and writes instead of a
//! mapping would have no compare-exchange, which clients and loop need.

use rustix::mm::{MapFlags, ProtFlags, mmap_anonymous};
use std::io;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Maximum number of mappings of a process. A loop needs one mapping.
const MOST: usize = 32;

/// Address ranges of the mappings. Atomics are used, because a signal handler must not take a lock.
static PLACES: [Place; MOST] =
    [const { Place { start: AtomicUsize::new(0), end: AtomicUsize::new(0) } }; MOST];

/// Previous handler of SIGBUS. `None` if no handler can be installed.
static FORMER: OnceLock<Option<libc::sigaction>> = OnceLock::new();

/// Address range of a mapping. A start of 0 marks an unused entry.
struct Place {
    start: AtomicUsize,
    end: AtomicUsize,
}

/// Guard that protects a mapping from SIGBUS. The guard must be dropped before the mapping.
pub(super) struct Guard(&'static Place);

impl Guard {
    /// Registers the mapping with this start address and size for the signal handler.
    pub(super) fn over(start: usize, bytes: usize) -> io::Result<Self> {
        if FORMER.get_or_init(take_signal).is_none() {
            return Err(io::Error::other("SIGBUS cannot be handled"));
        }
        let is_free = |place: &&Place| {
            place.start.compare_exchange(0, start, Ordering::AcqRel, Ordering::Relaxed).is_ok()
        };
        let place = PLACES.iter().find(is_free).ok_or(io::ErrorKind::OutOfMemory)?;
        place.end.store(start + bytes, Ordering::Release);
        Ok(Self(place))
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        self.0.end.store(0, Ordering::Release);
        self.0.start.store(0, Ordering::Release);
    }
}

/// Installs the signal handler and returns the previous handler.
fn take_signal() -> Option<libc::sigaction> {
    #[allow(unsafe_code, reason = "rustix has no sigaction")]
    // SAFETY: both actions are plain data on this stack, for which zero is a valid value. The handler has the signature that SA_SIGINFO
    // requires, takes no lock and allocates nothing.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        let mut former: libc::sigaction = std::mem::zeroed();
        let handler: extern "C" fn(libc::c_int, *mut libc::siginfo_t, *mut libc::c_void) = replace;
        action.sa_sigaction = handler as usize;
        action.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK;
        (libc::sigaction(libc::SIGBUS, &raw const action, &raw mut former) == 0).then_some(former)
    }
}

/// Signal handler that replaces the accessed mapping by zeros.
///
/// If the address belongs to no mapping, the previous handler is restored and the signal is raised again.
extern "C" fn replace(_: libc::c_int, info: *mut libc::siginfo_t, _: *mut libc::c_void) {
    #[allow(unsafe_code, reason = "the address is in what the system hands over")]
    // SAFETY: the system passes a complete siginfo_t to a handler with SA_SIGINFO. For SIGBUS it contains the address.
    let at = unsafe { (*info).si_addr() } as usize;
    for place in &PLACES {
        let (start, end) = (place.start.load(Ordering::Acquire), place.end.load(Ordering::Acquire));
        if (start..end).contains(&at) {
            let access = ProtFlags::READ | ProtFlags::WRITE;
            let flags = MapFlags::PRIVATE | MapFlags::FIXED;
            #[allow(unsafe_code, reason = "memory at the place of a mapping that is lost")]
            // SAFETY: the address range is a mapping of `Mapping`, which lives as long as its guard. It is replaced completely by memory
            // with the same access rights.
            let made = unsafe { mmap_anonymous(start as *mut _, end - start, access, flags) };
            if made.is_ok() {
                return;
            }
        }
    }
    #[allow(unsafe_code, reason = "rustix has no sigaction")]
    // SAFETY: `former` is the action that the system returned. Otherwise the default action is restored.
    unsafe {
        match FORMER.get() {
            Some(Some(former)) => drop(libc::sigaction(libc::SIGBUS, former, std::ptr::null_mut())),
            _ => drop(libc::signal(libc::SIGBUS, libc::SIG_DFL)),
        }
    }
}
