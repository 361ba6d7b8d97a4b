//! Parts on several cores.

use std::sync::{Mutex, PoisonError};
use std::thread;

/// Does something to all of a list, on several cores; nothing depends on which of them does what.
pub(super) fn side_by_side<T: Send>(threads: usize, list: &mut [T], work: impl Fn(&mut T) + Sync) {
    if threads < 2 {
        return list.iter_mut().for_each(work);
    }
    let threads = threads.min(list.len());
    let left = Mutex::new(list.iter_mut());
    let next = || left.lock().unwrap_or_else(PoisonError::into_inner).next();
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(item) = next() {
                    work(item);
                }
            });
        }
    });
}
