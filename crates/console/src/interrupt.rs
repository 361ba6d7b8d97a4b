//! Signal handling: interruption of a command (Ctrl-C) and limits on file sizes.

use crate::answer::complain;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use stickslip_run::Watcher;

/// Time after the first signal during which further signals are ignored. A shell may send a signal both to the process and to its group.
const ONE_WISH: Duration = Duration::from_secs(1);

/// Flag that is raised when the user interrupts the program.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Installs the signal handlers and returns the flag.
    ///
    /// The first signal raises the flag, and the program ends with the results computed so far. A signal that arrives more than a second
    /// later ends the program immediately; unwritten results are lost.
    pub fn install() -> Self {
        let interrupt = Self::default();
        let flag = Arc::clone(&interrupt.0);
        // If no handler can be installed, a signal ends the program immediately. Runs are possible nevertheless.
        let mut first: Option<Instant> = None;
        let _ = ctrlc::set_handler(move || {
            flag.store(true, Ordering::Relaxed);
            if first.get_or_insert_with(Instant::now).elapsed() > ONE_WISH {
                complain(format_args!("ended at once by a second signal: unwritten results are lost"));
                std::process::exit(i32::from(crate::verdict::Verdict::Interrupted.code()));
            }
        });
        interrupt.raise_where_signals_arrive();
        interrupt
    }

    /// Lets the signal handler itself raise the flag, too. On a busy machine, the thread that waits for signals may be scheduled late.
    fn raise_where_signals_arrive(&self) {
        #[cfg(unix)]
        for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
            // If the registration fails, the waiting thread raises the flag slightly later.
            let _ = signal_hook::flag::register(signal, Arc::clone(&self.0));
        }
    }

    /// Returns whether the flag is raised.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Ignores the signal SIGXFSZ, so that a write beyond the file size limit (`ulimit -f`) returns an error.
///
/// Without this function, such a write would end the program and leave temporary files behind.
pub fn outlive_file_limits() {
    #[cfg(unix)]
    // If the registration fails, the signal ends the program. Runs are possible nevertheless.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Watcher that stops work on an interrupt and shows no progress bar.
pub struct Interrupted<'a>(pub &'a Interrupt);

impl Watcher for Interrupted<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        !self.0.is_raised()
    }
}
