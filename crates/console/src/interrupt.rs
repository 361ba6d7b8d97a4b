//! Signals: Ctrl-C, and a limit on the size of files.

use crate::answer::complain;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use stickslip_run::Watcher;

/// What comes so soon after a signal is the same wish: a shell, a terminal or a timer may send it to the process and to its group.
const ONE_WISH: Duration = Duration::from_secs(1);

/// Tells whether somebody asked the program to stop.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on. The first signal asks for a tidy end with the results so far; another one, a second later or more, ends at once.
    pub fn install() -> Self {
        let interrupt = Self::default();
        let flag = Arc::clone(&interrupt.0);
        // Without a handler a signal ends the program at once: worse, but no reason not to run.
        let mut first: Option<Instant> = None;
        let _ = ctrlc::set_handler(move || {
            flag.store(true, Ordering::Relaxed);
            if first.get_or_insert_with(Instant::now).elapsed() > ONE_WISH {
                complain(format_args!("ended at once, by a second signal: what was not written is lost"));
                std::process::exit(i32::from(crate::verdict::Verdict::Interrupted.code()));
            }
        });
        interrupt.raise_where_signals_arrive();
        interrupt
    }

    /// Raises it in the signal's own handler: the thread that listens may get its turn only many short frames later on a busy machine.
    fn raise_where_signals_arrive(&self) {
        #[cfg(unix)]
        for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
            // Without it the signal is heard a little later.
            let _ = signal_hook::flag::register(signal, Arc::clone(&self.0));
        }
    }

    /// Whether to stop.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Takes the system's answer to a write beyond a limit on the size of files (`ulimit -f`) as one that a full disk gives: without this
/// the program would end in the middle of its work, its drafts left behind.
pub fn outlive_file_limits() {
    #[cfg(unix)]
    // Without it such a limit ends the program: worse, but no reason not to run.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Whoever may end work that no bar is shown of.
pub struct Interrupted<'a>(pub &'a Interrupt);

impl Watcher for Interrupted<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        !self.0.is_raised()
    }
}
