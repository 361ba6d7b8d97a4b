//! Heights of a profilometer line: resampling at equal distances, cropping, and removal of tilt or form.

use nalgebra::{DMatrix, DVector};

/// Relative deviation of distances from their mean up to which positions count as equidistant.
const EVEN: f64 = 1e-3;

/// Returns the spacing and heights at equal distances, by linear interpolation of rows (position, height). Returns `None` if positions do
/// not ascend.
pub(super) fn even(rows: &[[f64; 2]]) -> Option<(f64, Vec<f64>)> {
    let (first, last) = (rows.first()?[0], rows.last()?[0]);
    let spacing = (last - first) / (rows.len().checked_sub(1)?) as f64;
    if spacing <= 0.0 || rows.windows(2).any(|two| two[1][0] <= two[0][0]) {
        return None;
    }
    if rows.windows(2).all(|two| ((two[1][0] - two[0][0]) / spacing - 1.0).abs() < EVEN) {
        return Some((spacing, rows.iter().map(|row| row[1]).collect()));
    }
    let at = |k: usize| {
        let x = first + spacing * k as f64;
        let after = rows.partition_point(|row| row[0] < x).clamp(1, rows.len() - 1);
        let ([a, za], [b, zb]) = (rows[after - 1], rows[after]);
        za + ((x - a) / (b - a)).clamp(0.0, 1.0) * (zb - za)
    };
    Some((spacing, (0..rows.len()).map(at).collect()))
}

/// Returns the heights between two positions, measured from the first height. Returns `None` for fewer than three heights.
pub(super) fn within(heights: &[f64], spacing: f64, [from, to]: [f64; 2]) -> Option<Vec<f64>> {
    // Includes heights at the bounds despite rounding.
    let first = (from / spacing - 1e-6).ceil().max(0.0) as usize;
    let last = ((to / spacing + 1e-6).floor() as usize).min(heights.len().checked_sub(1)?);
    (last >= first + 2).then(|| heights[first..=last].to_vec())
}

/// Subtracts the least-squares polynomial of this order from the heights.
pub(super) fn level(heights: &mut [f64], order: usize) {
    let half = 0.5 * (heights.len().max(2) - 1) as f64;
    let place = |row: usize| (row as f64 - half) / half;
    let powers = DMatrix::from_fn(heights.len(), order + 1, |row, power| place(row).powi(power as i32));
    let right = DVector::from_column_slice(heights);
    if let Ok(shape) = powers.clone().svd(true, true).solve(&right, 1e-12) {
        let fitted = powers * shape;
        heights.iter_mut().zip(fitted.iter()).for_each(|(height, own)| *height -= own);
    }
}
