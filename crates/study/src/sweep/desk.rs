//! Distribution of the parts of a study among threads.

use super::part::{self, Rows};
use super::quick::Shortcut;
use super::worker::{Fault, Worker};
use super::{Shard, Study, StudyError};
use std::collections::VecDeque;
use std::io;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use stickslip_run::{Watcher, folder};

/// Number of cases that a thread takes at a time if a case costs microseconds. A small number shortens the wait for the last thread.
const BLOCK: u64 = 32;

/// Result of a study command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ran {
    /// Number of parts that this command computed.
    pub computed: u64,
    /// Number of parts that existed before the command.
    pub there: u64,
    /// Whether the study was interrupted before all parts were finished.
    pub interrupted: bool,
}

/// Queue of parts that are not started, and of parts with unfinished results.
struct Desk {
    /// Parts not yet started.
    waiting: VecDeque<u64>,
    /// Cases of the last started part that no thread has taken.
    cases: Range<u64>,
    part: u64,
    open: Vec<Begun>,
}

/// A started part.
struct Begun {
    part: u64,
    first: u64,
    left: u64,
    rows: Rows,
}

impl Study {
    /// Computes the missing parts of a shard in a folder, on `threads` threads. The watcher receives the number of finished cases.
    ///
    /// A part is written to a temporary file and renamed when complete. The content of a part depends only on the study and the program
    /// version. Existing parts are not computed again.
    ///
    /// # Errors
    /// Fails if there are parts of another study, or the folder cannot be written. Finished parts are kept.
    pub fn run(
        &self,
        out: &Path,
        (shard, threads): (Shard, usize),
        watcher: &(dyn Watcher + Sync),
    ) -> Result<Ran, StudyError> {
        let missing: VecDeque<u64> =
            self.status(out)?.missing.into_iter().filter(|part| shard.takes(*part)).collect();
        let own = (0..self.parts()).filter(|part| shard.takes(*part)).count() as u64;
        let (due, there) = (missing.len() as u64, own - missing.len() as u64);
        if missing.is_empty() {
            return Ok(Ran { computed: 0, there, interrupted: false });
        }
        std::fs::create_dir_all(out).map_err(|source| StudyError::Disk { path: out.to_owned(), source })?;
        let shortcut = Shortcut::of(self);
        let desk = Mutex::new(Desk { waiting: missing, cases: 0..0, part: 0, open: Vec::new() });
        let (done, computed) = (AtomicU64::new(0), AtomicU64::new(0));
        let failure: Mutex<Option<StudyError>> = Mutex::new(None);
        let stop = Stop { watcher, is_over: AtomicBool::new(false) };
        let block = if shortcut.is_some() { BLOCK } else { 1 };
        let work = || {
            let mut worker = Worker::new(self, shortcut.as_ref(), &stop);
            loop {
                // The queue is locked outside of the loop condition, which would hold the lock during the body.
                let next = lock(&desk).take(self, block);
                let Some((part, cases)) = next else { break };
                let finished = match self.block(&mut worker, cases.clone()) {
                    Some(rows) => lock(&desk).give(self, part, &cases, &rows),
                    None => break,
                };
                let count =
                    done.fetch_add(cases.end - cases.start, Ordering::Relaxed) + (cases.end - cases.start);
                watcher.reached(count as f64);
                let Some(rows) = finished else { continue };
                match self.write(out, part, &rows) {
                    Ok(()) => drop(computed.fetch_add(1, Ordering::Relaxed)),
                    Err(error) => {
                        lock(&failure).get_or_insert(error);
                        stop.is_over.store(true, Ordering::Relaxed);
                    }
                }
            }
        };
        thread::scope(|scope| {
            (1..threads).for_each(|_| drop(scope.spawn(work)));
            work();
        });
        match lock(&failure).take() {
            Some(error) => Err(error),
            None => {
                let computed = computed.into_inner();
                Ok(Ran { computed, there, interrupted: computed < due })
            }
        }
    }

    /// Computes the rows of some cases, or returns `None` if interrupted.
    fn block(&self, worker: &mut Worker<'_>, cases: Range<u64>) -> Option<Rows> {
        let mut rows = Rows::default();
        let width = self.wanted.len();
        for case in cases {
            match worker.run(case, &mut rows.results) {
                Ok(()) => rows.errors.push(None),
                Err(Fault::Failed(why)) => {
                    rows.results.resize(width * (rows.errors.len() + 1), f64::NAN);
                    rows.errors.push(Some(why));
                }
                Err(Fault::Interrupted) => return None,
            }
        }
        Some(rows)
    }

    fn write(&self, out: &Path, number: u64, rows: &Rows) -> Result<(), StudyError> {
        let path = out.join(part::name(number));
        let bytes = part::bytes(self, self.part(number), rows);
        let bytes = bytes
            .map_err(|error| StudyError::Disk { path: path.clone(), source: io::Error::other(error) })?;
        folder::write(&path, &bytes).map_err(|source| StudyError::Disk { path, source })
    }
}

impl Desk {
    /// Returns the next cases for a thread, and the part that contains these cases.
    fn take(&mut self, study: &Study, block: u64) -> Option<(u64, Range<u64>)> {
        if self.cases.is_empty() {
            self.part = self.waiting.pop_front()?;
            self.cases = study.part(self.part);
            let (first, left) = (self.cases.start, self.cases.end - self.cases.start);
            let rows = Rows {
                results: vec![f64::NAN; study.wanted.len() * left as usize],
                errors: vec![None; left as usize],
            };
            self.open.push(Begun { part: self.part, first, left, rows });
        }
        let from = self.cases.start;
        self.cases.start = (from + block).min(self.cases.end);
        Some((self.part, from..self.cases.start))
    }

    /// Stores the rows of some cases in their part. Returns the rows of the part when it is complete.
    fn give(&mut self, study: &Study, part: u64, cases: &Range<u64>, rows: &Rows) -> Option<Rows> {
        let place = self.open.iter().position(|begun| begun.part == part)?;
        let begun = &mut self.open[place];
        let (width, from) = (study.wanted.len(), (cases.start - begun.first) as usize);
        let until = from + rows.errors.len();
        begun.rows.results[width * from..width * until].copy_from_slice(&rows.results);
        begun.rows.errors[from..until].clone_from_slice(&rows.errors);
        begun.left -= cases.end - cases.start;
        (begun.left == 0).then(|| self.open.swap_remove(place).rows)
    }
}

/// Watcher that stops all threads after an error.
struct Stop<'a> {
    watcher: &'a (dyn Watcher + Sync),
    is_over: AtomicBool,
}

impl Watcher for Stop<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        !self.is_over.load(Ordering::Relaxed) && self.watcher.goes_on()
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
