//! Gaussian elimination with partial pivoting in fixed storage.

/// Square matrix, factored into triangular matrices, row by row.
#[derive(Debug, Clone, Default)]
pub(super) struct Elimination {
    order: usize,
    entries: Vec<f64>,
    /// Row with which each row was exchanged.
    exchanged: Vec<usize>,
}

impl Elimination {
    pub(super) fn new(order: usize) -> Self {
        Self { order, entries: vec![0.0; order * order], exchanged: vec![0; order] }
    }

    /// Sets all entries by row and column and factors the matrix. Returns false if the matrix is singular or not finite.
    pub(super) fn factor(&mut self, entry: impl Fn(usize, usize) -> f64) -> bool {
        let n = self.order;
        for (place, to) in self.entries.iter_mut().enumerate() {
            *to = entry(place / n, place % n);
        }
        (0..n).all(|column| self.eliminate(column))
    }

    /// Moves the largest entry of a column to the diagonal and eliminates the column from the rows below. Returns false if the
    /// pivot is zero or not finite.
    fn eliminate(&mut self, column: usize) -> bool {
        let n = self.order;
        let size = |row: usize| self.entries[row * n + column].abs();
        let pivot = (column + 1..n).fold(column, |most, row| if size(row) > size(most) { row } else { most });
        self.exchanged[column] = pivot;
        // A sum with NaN is NaN.
        if !(size(pivot) > 0.0 && (column..n).map(size).sum::<f64>().is_finite()) {
            return false;
        }
        if pivot != column {
            (0..n).for_each(|k| self.entries.swap(pivot * n + k, column * n + k));
        }
        let (above, below) = self.entries.split_at_mut((column + 1) * n);
        let head = &above[column * n..];
        let inverse = head[column].recip();
        for row in below.chunks_exact_mut(n) {
            let factor = row[column] * inverse;
            row[column] = factor;
            if factor != 0.0 {
                row[column + 1..].iter_mut().zip(&head[column + 1..]).for_each(|(to, of)| *to -= factor * of);
            }
        }
        true
    }

    /// Solves the linear system in place.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let n = self.order;
        for column in 0..n {
            x.swap(column, self.exchanged[column]);
        }
        for (i, row) in self.entries.chunks_exact(n).enumerate() {
            x[i] -= row[..i].iter().zip(&x[..i]).map(|(a, x)| a * x).sum::<f64>();
        }
        for (i, row) in self.entries.chunks_exact(n).enumerate().rev() {
            let known: f64 = row[i + 1..].iter().zip(&x[i + 1..n]).map(|(a, x)| a * x).sum();
            x[i] = (x[i] - known) / row[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hilbert matrix of order 5 with permuted rows, and its integer inverse.
    #[test]
    fn rows_are_exchanged_and_solutions_found() {
        let row = |i: usize| (i * 3 + 2) % 5;
        let mut matrix = Elimination::new(5);
        assert!(matrix.factor(|i, j| ((row(i) + j + 1) as f64).recip()));
        let mut x: [f64; 5] = std::array::from_fn(|i| if row(i) == 0 { 1.0 } else { 0.0 });
        matrix.solve(&mut x);
        for (x, exact) in x.iter().zip([25.0, -300.0, 1050.0, -1400.0, 630.0]) {
            assert!((x - exact).abs() < 1e-9, "{x} {exact}");
        }
    }

    #[test]
    fn singular_and_not_finite_are_told() {
        let mut matrix = Elimination::new(2);
        assert!(!matrix.factor(|i, j| (i * 2 + j * 2) as f64 * 0.0 + 1.0));
        assert!(!matrix.factor(|i, _| if i == 0 { 1.0 } else { f64::NAN }));
        assert!(matrix.factor(|i, j| if i == j { 0.0 } else { 1.0 }));
    }
}
