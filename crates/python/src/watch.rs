//! Python signals during long computations: Ctrl-C ends them within a tenth of a second.

use pyo3::prelude::*;
use std::cell::{Cell, RefCell};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};
use stickslip_run::Watcher;

/// Interval at which Python's signals are checked.
const EVERY: Duration = Duration::from_millis(20);

thread_local! {
    /// True while Python's signal handlers run on this thread, which may hold a lock.
    static HANDLES: Cell<bool> = const { Cell::new(false) };
}

/// Whether the caller is Python's main thread. Other threads get no signals and may outlive the interpreter.
pub(crate) fn is_main(py: Python<'_>) -> PyResult<bool> {
    let threading = py.import("threading")?;
    let [own, main] = ["current_thread", "main_thread"].map(|name| threading.call_method0(name));
    Ok(own?.is(&main?))
}

/// Locks a mutex. In a signal handler it returns an error instead of waiting, as its own thread may hold the lock.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> PyResult<MutexGuard<'_, T>> {
    if !HANDLES.get() {
        return Ok(mutex.lock().unwrap_or_else(PoisonError::into_inner));
    }
    match mutex.try_lock() {
        Ok(guard) => Ok(guard),
        Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
        Err(TryLockError::WouldBlock) => {
            Err(crate::RunError::new_err("the run is busy: a signal arrived during a call"))
        }
    }
}

fn check() -> PyResult<()> {
    HANDLES.set(true);
    let checked = Python::attach(|py| py.check_signals());
    HANDLES.set(false);
    checked
}

/// Watcher of a run on the thread that Python called.
pub(crate) struct Signals {
    is_main: bool,
    asked: Cell<Instant>,
    raised: RefCell<Option<PyErr>>,
}

impl Signals {
    pub(crate) fn new(is_main: bool) -> Self {
        Self { is_main, asked: Cell::new(Instant::now()), raised: RefCell::new(None) }
    }

    /// Returns the exception that a signal handler raised, if any.
    pub(crate) fn take(&self) -> PyResult<()> {
        self.raised.borrow_mut().take().map_or(Ok(()), Err)
    }

    /// Whether the computation continues.
    pub(crate) fn goes_on(&self) -> bool {
        if self.is_main && self.asked.get().elapsed() > EVERY {
            self.asked.set(Instant::now());
            if let Err(error) = check() {
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

/// Stop flag of a computation on several threads.
#[derive(Default)]
pub(crate) struct Flag(AtomicBool);

impl Watcher for Flag {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        !self.0.load(Ordering::Relaxed)
    }
}

/// Runs `work` on another thread without the interpreter lock, while this one checks for signals.
pub(crate) fn wait<T: Send>(py: Python<'_>, work: impl FnOnce(&Flag) -> T + Send) -> PyResult<T> {
    let (flag, is_main) = (Flag::default(), is_main(py)?);
    py.detach(|| {
        std::thread::scope(|scope| {
            let (done, result) = channel();
            let worker = &flag;
            scope.spawn(move || done.send(work(worker)));
            let mut raised = None;
            loop {
                match result.recv_timeout(EVERY) {
                    Ok(value) => return raised.map_or(Ok(value), Err),
                    Err(RecvTimeoutError::Timeout) if is_main && raised.is_none() => {
                        if let Err(error) = check() {
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
