//! Gaussian elimination for many right-hand sides.

/// Number of values that are processed together (SIMD).
const LANES: usize = 4;

/// Returns the length of a row of the linear system with its right-hand sides, a multiple of [`LANES`].
pub(super) fn wide_of(size: usize, count: usize) -> usize {
    (size + count).next_multiple_of(LANES)
}

/// Solves a linear system of order `size` with `count` right-hand sides at the end of its rows. Returns false if the matrix is singular or
/// not finite.
pub(super) fn solve(system: &mut [f64], size: usize, count: usize, solution: &mut Vec<f64>) -> bool {
    let wide = wide_of(size, count);
    for k in 0..size {
        let height = |i: usize| system[i * wide + k].abs();
        let mut pivot = (k, height(k));
        for i in k + 1..size {
            // NaN counts as the largest.
            if height(i).total_cmp(&pivot.1).is_gt() {
                pivot = (i, height(i));
            }
        }
        if pivot.1 == 0.0 || !pivot.1.is_finite() {
            return false;
        }
        let (above, below) = system.split_at_mut((k + 1) * wide);
        let line = &mut above[k * wide + k..];
        if let Some(row) = pivot.0.checked_sub(k + 1) {
            line.swap_with_slice(&mut below[row * wide + k..(row + 1) * wide]);
        }
        let value = line[0];
        // In whole lanes: columns before the pivot are no longer needed.
        let (lines, _) = above[k * wide..].as_chunks::<LANES>();
        let from = (k + 1) / LANES;
        for row in below.chunks_exact_mut(wide) {
            if row[k] != 0.0 {
                let factor = row[k] / value;
                let (row, _) = row.as_chunks_mut::<LANES>();
                for (row, line) in row[from..].iter_mut().zip(&lines[from..]) {
                    row.iter_mut().zip(line).for_each(|(x, a)| *x -= factor * a);
                }
            }
        }
    }
    solution.clear();
    solution.resize(size * count, 0.0);
    for (k, line) in system.chunks_exact(wide).enumerate().rev() {
        let (row, right) = line.split_at(size);
        let right = &right[..count];
        let (rest, below) = solution.split_at_mut((k + 1) * count);
        let sides = &mut rest[k * count..];
        sides.copy_from_slice(right);
        for (a, solved) in row[k + 1..].iter().zip(below.chunks_exact(count)) {
            sides.iter_mut().zip(solved).for_each(|(x, solved)| *x -= a * solved);
        }
        let share = row[k].recip();
        sides.iter_mut().for_each(|x| *x *= share);
    }
    true
}
