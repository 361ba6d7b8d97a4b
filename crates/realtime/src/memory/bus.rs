//! Mappings whose file another process may make shorter.
//!
//! Where such memory is touched the system sends the thread SIGBUS, which ends the process unless it is taken. Here the lost mapping is
//! replaced by zeros, and the instruction comes again. A look at the file's length before each touch would leave a moment between the
//! two, and reading and writing the file instead of mapping it has no compare-exchange, by which clients and loop share a record.

use rustix::mm::{MapFlags, ProtFlags, mmap_anonymous};
use std::io;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Mappings that a process may have at once: a loop has one.
const MOST: usize = 32;

/// Where mappings lie, for whoever handles the signal: it may take no lock.
static PLACES: [Place; MOST] =
    [const { Place { start: AtomicUsize::new(0), end: AtomicUsize::new(0) } }; MOST];

/// Who handled the signal before, or nothing where it cannot be handled.
static FORMER: OnceLock<Option<libc::sigaction>> = OnceLock::new();

/// Where a mapping lies; nobody's where its start is 0.
struct Place {
    start: AtomicUsize,
    end: AtomicUsize,
}

/// Keeps a mapping from ending the process, until it is dropped: before the mapping goes.
pub(super) struct Guard(&'static Place);

impl Guard {
    /// Of a mapping that begins at this address and has so many bytes.
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

/// From now on the signal is handled here; who had it before.
fn take_signal() -> Option<libc::sigaction> {
    #[allow(unsafe_code, reason = "rustix has no sigaction")]
    // SAFETY: both actions are plain data, whole and on this stack, for which zeros are values. The handler has the signature that
    // SA_SIGINFO asks for, takes no lock and allocates nothing.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        let mut former: libc::sigaction = std::mem::zeroed();
        let handler: extern "C" fn(libc::c_int, *mut libc::siginfo_t, *mut libc::c_void) = replace;
        action.sa_sigaction = handler as usize;
        action.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK;
        (libc::sigaction(libc::SIGBUS, &raw const action, &raw mut former) == 0).then_some(former)
    }
}

/// Puts zeros in the place of the mapping that was touched. Where it is none of these, the signal is given back to who had it before, and
/// comes again.
extern "C" fn replace(_: libc::c_int, info: *mut libc::siginfo_t, _: *mut libc::c_void) {
    #[allow(unsafe_code, reason = "the address is in what the system hands over")]
    // SAFETY: the system hands a whole siginfo_t to a handler of SA_SIGINFO, that of SIGBUS with an address.
    let at = unsafe { (*info).si_addr() } as usize;
    for place in &PLACES {
        let (start, end) = (place.start.load(Ordering::Acquire), place.end.load(Ordering::Acquire));
        if (start..end).contains(&at) {
            let access = ProtFlags::READ | ProtFlags::WRITE;
            let flags = MapFlags::PRIVATE | MapFlags::FIXED;
            #[allow(unsafe_code, reason = "memory at the place of a mapping that is lost")]
            // SAFETY: what lies there is a mapping of `Mapping`, which lives as long as its guard has the place: it is replaced whole,
            // by memory of the same access.
            let made = unsafe { mmap_anonymous(start as *mut _, end - start, access, flags) };
            if made.is_ok() {
                return;
            }
        }
    }
    #[allow(unsafe_code, reason = "rustix has no sigaction")]
    // SAFETY: `former` is what the system gave out, or its own default.
    unsafe {
        match FORMER.get() {
            Some(Some(former)) => drop(libc::sigaction(libc::SIGBUS, former, std::ptr::null_mut())),
            _ => drop(libc::signal(libc::SIGBUS, libc::SIG_DFL)),
        }
    }
}
