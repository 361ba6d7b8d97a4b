//! Signals of Python during long work: Ctrl-C ends it within a tenth of a second.

use pyo3::prelude::*;
use std::cell::{Cell, RefCell};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use stickslip_run::Watcher;

/// How often Python is asked for signals.
const EVERY: Duration = Duration::from_millis(20);
/// Calls between two looks at the clock.
const CALLS: u32 = 64;

/// Watches a run on the thread that Python called.
pub(crate) struct Signals {
    calls: Cell<u32>,
    asked: Cell<Instant>,
    raised: RefCell<Option<PyErr>>,
}

impl Signals {
    pub(crate) fn new() -> Self {
        Self { calls: Cell::new(0), asked: Cell::new(Instant::now()), raised: RefCell::new(None) }
    }

    /// What Python raised meanwhile.
    pub(crate) fn take(&self) -> PyResult<()> {
        self.raised.borrow_mut().take().map_or(Ok(()), Err)
    }

    /// Whether the work continues.
    pub(crate) fn goes_on(&self) -> bool {
        let calls = self.calls.get().wrapping_add(1);
        self.calls.set(calls);
        if calls.is_multiple_of(CALLS) && self.asked.get().elapsed() > EVERY {
            self.asked.set(Instant::now());
            if let Err(error) = Python::attach(|py| py.check_signals()) {
                self.raised.borrow_mut().replace(error);
            }
        }
        self.raised.borrow().is_none()
    }
}

impl Watcher for Signals {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        Self::goes_on(self)
    }
}

/// Asked by all threads of a study whether it continues.
#[derive(Default)]
pub(crate) struct Flag(AtomicBool);

impl Watcher for Flag {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        !self.0.load(Ordering::Relaxed)
    }
}

/// Does work on a thread of its own without the interpreter's lock, while this one waits for signals.
pub(crate) fn wait<T: Send>(py: Python<'_>, work: impl FnOnce(&Flag) -> T + Send) -> PyResult<T> {
    let flag = Flag::default();
    py.detach(|| {
        std::thread::scope(|scope| {
            let (done, result) = channel();
            let worker = &flag;
            scope.spawn(move || done.send(work(worker)));
            let mut raised = None;
            loop {
                match result.recv_timeout(EVERY) {
                    Ok(value) => return raised.map_or(Ok(value), Err),
                    Err(RecvTimeoutError::Timeout) if raised.is_none() => {
                        if let Err(error) = Python::attach(|py| py.check_signals()) {
                            flag.0.store(true, Ordering::Relaxed);
                            raised = Some(error);
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(crate::RunError::new_err("the computation ended without a result"));
                    }
                }
            }
        })
    })
}
