//! Who looks on while a run goes on.

/// Somebody who is told how far a run has come and may end it: a progress bar, a signal, a window.
///
/// Told at every row and asked every so many steps, by the thread that runs: an answer should take nanoseconds.
pub trait Watcher {
    /// The run has come to time `t`, s.
    fn reached(&self, t: f64);

    /// Whether the run is to go on.
    fn goes_on(&self) -> bool;
}

/// Nobody: the run goes on to its end.
impl Watcher for () {
    #[inline]
    fn reached(&self, _: f64) {}

    #[inline]
    fn goes_on(&self) -> bool {
        true
    }
}
