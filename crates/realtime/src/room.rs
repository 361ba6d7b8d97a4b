//! Memory that is there before it is needed.

/// So many values, whose pages have been written to: the system hands out zeros when they are first touched, and that is a page
/// fault, which no frame should have.
pub(crate) fn touched<T: Copy>(other: T, value: T, count: usize) -> Vec<T> {
    let mut values = vec![other; count];
    // Whoever knows that both are overwritten could leave the first out.
    std::hint::black_box(&mut values);
    values.fill(value);
    values
}

/// Room for so many numbers, touched.
pub(crate) fn room(count: usize) -> Vec<f64> {
    let mut values = touched(1.0, 0.0, count);
    values.clear();
    values
}
