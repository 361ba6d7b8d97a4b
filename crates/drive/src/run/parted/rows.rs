//! Rows of a part, side by side.

/// Rows in the order of time.
#[derive(Default)]
pub(super) struct Rows {
    values: Vec<f64>,
    next: usize,
}

impl Rows {
    /// The last row that is not after a time, s, or else the first one.
    pub(super) fn until(&mut self, t: f64, width: usize) -> Option<&[f64]> {
        while self.values.get(self.next + width).is_some_and(|at| *at <= t) {
            self.next += width;
        }
        self.values.get(self.next..self.next + width)
    }

    /// The last one.
    pub(super) fn last(&self, width: usize) -> Option<&[f64]> {
        let from = self.values.len().checked_sub(width)?;
        self.values.get(from..)
    }

    pub(super) fn push(&mut self, values: &[f64]) {
        self.values.extend_from_slice(values);
    }

    pub(super) fn clear(&mut self) {
        self.values.clear();
        self.next = 0;
    }
}
