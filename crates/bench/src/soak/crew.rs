//! Judges seeds on several threads, and abandons those that do not finish.

use super::finding::{Finding, Verdict};
use super::{judge, kinds};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashSet};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use stickslip_run::Watcher;

/// Time between two checks for seeds that do not finish.
const PAUSE: Duration = Duration::from_millis(200);
/// Wall time after which a scenario is abandoned. The time includes all runs of the scenario, each of which has a limit of twenty seconds.
const GIVEN_UP: Duration = Duration::from_secs(400);

/// Seeds to judge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seeds {
    /// Seeds; each occurs once.
    pub seeds: Vec<u64>,
    /// Number of seeds, from the first on, that are also compared with rows of springs.
    pub rows: u64,
    /// Number of threads.
    pub threads: usize,
}

/// Judges seeds. The watcher receives the number of judged seeds.
///
/// A scenario that does not finish is abandoned. The thread continues, because threads cannot be stopped, and a new thread takes its place.
pub fn soak(seeds: &Seeds, watcher: &dyn Watcher) -> Vec<Finding> {
    let rows = usize::try_from(seeds.rows).unwrap_or(usize::MAX);
    let rowed: HashSet<u64> = seeds.seeds.iter().take(rows).copied().collect();
    let work = Work {
        seeds: seeds.seeds.clone(),
        judge: Box::new(move |seed| judge::judge(seed, rowed.contains(&seed))),
        kind: |seed| kinds::scenario(seed).0.name(),
        given_up: GIVEN_UP,
    };
    conduct(work, seeds.threads, watcher)
}

/// Work of the threads.
pub(super) struct Work {
    /// Seeds; each occurs once.
    pub(super) seeds: Vec<u64>,
    /// Judges a seed.
    pub(super) judge: Box<dyn Fn(u64) -> Finding + Send + Sync>,
    /// Returns the kind of a seed that gives no finding.
    pub(super) kind: fn(u64) -> &'static str,
    /// Wall time after which a seed is abandoned.
    pub(super) given_up: Duration,
}

/// Data shared by the threads.
struct Shared {
    next: AtomicUsize,
    over: AtomicBool,
    work: Work,
    /// Current seed of each thread, with its start time.
    at: Mutex<Vec<Option<(u64, Instant)>>>,
}

thread_local! {
    /// Position and message of the last panic of this thread.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Executes work on threads. Returns the findings in the order of the seeds; after an interruption, those available.
pub(super) fn conduct(work: Work, threads: usize, watcher: &dyn Watcher) -> Vec<Finding> {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(remember));
    let findings = gather(work, threads, watcher);
    panic::set_hook(hook);
    findings
}

fn gather(work: Work, threads: usize, watcher: &dyn Watcher) -> Vec<Finding> {
    let (sender, receiver) = mpsc::channel();
    let (next, at) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let shared = Arc::new(Shared { next, over: AtomicBool::new(false), work, at });
    (0..threads.max(1)).for_each(|_| hire(&shared, &sender));
    let mut findings: BTreeMap<u64, Finding> = BTreeMap::new();
    while findings.len() < shared.work.seeds.len() && watcher.goes_on() {
        match receiver.recv_timeout(PAUSE) {
            // An abandoned seed stays abandoned even if it finishes later.
            Ok(finding) => {
                findings.entry(finding.seed).or_insert(finding);
            }
            Err(RecvTimeoutError::Timeout) => {
                for seed in shared.given_up() {
                    findings.insert(seed, shared.lost(seed));
                    hire(&shared, &sender);
                }
            }
            Err(RecvTimeoutError::Disconnected) => break,
        }
        watcher.reached(findings.len() as f64);
    }
    shared.over.store(true, Ordering::Relaxed);
    findings.into_values().collect()
}

/// Starts one more thread.
fn hire(shared: &Arc<Shared>, sender: &Sender<Finding>) {
    let (shared, sender) = (Arc::clone(shared), sender.clone());
    let place = {
        let mut at = shared.at.lock().unwrap_or_else(PoisonError::into_inner);
        at.push(None);
        at.len() - 1
    };
    let work = move || {
        while let Some(seed) = shared.take(place) {
            let caught = catch_unwind(AssertUnwindSafe(|| (shared.work.judge)(seed)));
            let finding = caught.unwrap_or_else(|_| shared.panicked(seed));
            if sender.send(finding).is_err() {
                return;
            }
        }
    };
    // If no thread can be started, the others do its work.
    let _ = thread::Builder::new().name("soak".to_owned()).spawn(work);
}

impl Shared {
    /// Returns the next seed.
    fn take(&self, place: usize) -> Option<u64> {
        let next = self.next.fetch_add(1, Ordering::Relaxed);
        let seed = self.work.seeds.get(next).filter(|_| !self.over.load(Ordering::Relaxed)).copied();
        let mut at = self.at.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = at.get_mut(place) {
            *at = seed.map(|seed| (seed, Instant::now()));
        }
        seed
    }

    /// Returns the seeds that exceed the time limit, each once.
    fn given_up(&self) -> Vec<u64> {
        let mut at = self.at.lock().unwrap_or_else(PoisonError::into_inner);
        let is_lost = |at: &Option<(u64, Instant)>| {
            at.as_ref().is_some_and(|(_, since)| since.elapsed() > self.work.given_up)
        };
        at.iter_mut().filter(|at| is_lost(at)).filter_map(Option::take).map(|(seed, _)| seed).collect()
    }

    fn lost(&self, seed: u64) -> Finding {
        let mut finding = Finding::new(seed, (self.work.kind)(seed));
        let limit = self.work.given_up.as_secs_f64();
        finding.turns(Verdict::Hung, || format!("not finished after {limit} s; no limit stopped the run"));
        finding
    }

    fn panicked(&self, seed: u64) -> Finding {
        let words = PANIC.with(|panic| panic.borrow().clone());
        // The panic may have occurred while the scenario was drawn.
        let kind = catch_unwind(AssertUnwindSafe(|| (self.work.kind)(seed))).unwrap_or("undrawn");
        let mut finding = Finding::new(seed, kind);
        finding.turns(Verdict::Panicked, || words);
        finding
    }
}

fn remember(info: &PanicHookInfo<'_>) {
    let place = info.location().map_or(String::new(), |at| format!("{}:{}", at.file(), at.line()));
    let payload = info.payload();
    let words = payload.downcast_ref::<&str>().copied();
    let words = words.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let words = words.unwrap_or("a panic without a message");
    PANIC.with(|panic| *panic.borrow_mut() = format!("{place}: {words}"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_panics_or_never_comes_back_is_found_all_the_same() {
        let judge = |seed| {
            assert_ne!(seed, 2, "two is too many");
            if seed == 3 {
                thread::sleep(Duration::from_secs(60));
            }
            Finding::new(seed, "slider")
        };
        let given_up = Duration::from_millis(300);
        let work = Work { seeds: vec![1, 2, 3, 4, 5], judge: Box::new(judge), kind: |_| "slider", given_up };
        let findings = conduct(work, 1, &());
        let verdicts: Vec<Verdict> = findings.iter().map(|finding| finding.verdict).collect();
        let expected = [Verdict::Right, Verdict::Panicked, Verdict::Hung, Verdict::Right, Verdict::Right];
        assert_eq!(verdicts, expected);
        assert!(findings[1].note.contains("crew.rs") && findings[1].note.contains("two is too many"));
    }
}
