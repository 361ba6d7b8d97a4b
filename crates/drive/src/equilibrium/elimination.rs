//! Linear systems of weakly coupled coordinates.

use nalgebra::{DMatrix, DVector};

/// Returns the solution of A x = b; `None` if the matrix A is singular.
///
/// The method is Gaussian elimination with partial pivoting that skips zeros; results are identical to LU decomposition by `nalgebra`.
pub(super) fn solve(mut a: DMatrix<f64>, mut b: DVector<f64>) -> Option<DVector<f64>> {
    let n = b.len();
    let (mut rows, mut columns) = (Vec::with_capacity(n), Vec::with_capacity(n));
    for k in 0..n {
        let pivot = largest(&a, k);
        if a[(pivot, k)] == 0.0 {
            return None;
        }
        if pivot != k {
            a.swap_rows(pivot, k);
            b.swap_rows(pivot, k);
        }
        rows.clear();
        rows.extend((k + 1..n).filter(|i| a[(*i, k)] != 0.0));
        if rows.is_empty() {
            continue;
        }
        columns.clear();
        columns.extend((k + 1..n).filter(|j| a[(k, *j)] != 0.0));
        let inverse = 1.0 / a[(k, k)];
        for &i in &rows {
            a[(i, k)] *= inverse;
        }
        for &j in &columns {
            let above = -a[(k, j)];
            for &i in &rows {
                a[(i, j)] += above * a[(i, k)];
            }
        }
    }
    forward(&a, &mut b);
    backward(&a, &mut b);
    Some(b)
}

/// Returns the row with the largest entry of column `k` on or below the diagonal; the first of equal entries.
fn largest(a: &DMatrix<f64>, k: usize) -> usize {
    let mut pivot = k;
    for i in k + 1..a.nrows() {
        if a[(i, k)].abs() > a[(pivot, k)].abs() {
            pivot = i;
        }
    }
    pivot
}

/// Solves L x = b with ones on the diagonal.
fn forward(a: &DMatrix<f64>, b: &mut DVector<f64>) {
    let n = b.len();
    for k in 0..n {
        let known = -b[k];
        if known != 0.0 {
            (k + 1..n).for_each(|i| b[i] += known * a[(i, k)]);
        }
    }
}

/// Solves U x = b.
fn backward(a: &DMatrix<f64>, b: &mut DVector<f64>) {
    for k in (0..b.len()).rev() {
        b[k] /= a[(k, k)];
        let known = -b[k];
        if known != 0.0 {
            (0..k).for_each(|i| b[i] += known * a[(i, k)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The solution has the same bits as that of a dense solver.
        #[test]
        fn it_has_the_digits_of_a_dense_solver(
            n in 1_usize..9,
            entries in prop::collection::vec((-1.0_f64..1.0, 0_u8..3), 64),
            right in prop::collection::vec(-1.0_f64..1.0, 8),
        ) {
            let entry = |i: usize, j: usize| {
                let (value, kind) = entries[8 * i + j];
                if kind == 0 || i == j { value } else { 0.0 }
            };
            let (a, b) = (DMatrix::from_fn(n, n, entry), DVector::from_fn(n, |i, _| right[i]));
            let (own, dense) = (solve(a.clone(), b.clone()), a.lu().solve(&b));
            prop_assert_eq!(own.is_some(), dense.is_some());
            if let (Some(own), Some(dense)) = (own, dense) {
                // Zeros may differ in sign.
                let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || *a == 0.0 && *b == 0.0;
                prop_assert!(own.iter().zip(dense.iter()).all(same), "{} {}", own, dense);
            }
        }
    }

    #[test]
    fn a_pivot_below_is_swapped_and_no_inverse_is_said() {
        let a = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 4.0, 0.0]);
        assert_eq!(solve(a, DVector::from_vec(vec![6.0, 8.0])), Some(DVector::from_vec(vec![2.0, 3.0])));
        let a = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]);
        assert_eq!(solve(a, DVector::from_vec(vec![1.0, 1.0])), None);
    }
}
