//! Preallocated memory whose pages have been accessed, so that later accesses cause no page faults.

/// Returns a vector of `count` values whose pages have been written to.
///
/// The first access to a page causes a page fault, which must not happen within a frame. `other` must differ from `value`, the final value.
pub(crate) fn touched<T: Copy>(other: T, value: T, count: usize) -> Vec<T> {
    let mut values = vec![other; count];
    // Without this call, the compiler could omit the first write.
    std::hint::black_box(&mut values);
    values.fill(value);
    values
}

/// Returns an empty vector with capacity for `count` numbers in touched pages.
pub(crate) fn room(count: usize) -> Vec<f64> {
    let mut values = touched(1.0, 0.0, count);
    values.clear();
    values
}
