//! Profile given by its normal law F_N(d): m = F_N′/E\*.
//!
//! Between the points M consists of one or two parabolas, so that m is piecewise linear and does not decrease: Schumaker's spline
//! (SIAM J. Numer. Anal. 20, 1983). Unlike a cubic spline, it is convex for every convex set of points.

use super::chart::{Chart, Ends};
use super::{Profile, ProfileError, Shape};
use std::sync::Arc;

impl Profile {
    /// Creates a profile with the normal law M(h) = F_N/E\* through points (h in m, M in m²).
    ///
    /// The first point is (0, 0). Both coordinates increase, and the secants between neighbouring points do not decrease. The profile ends
    /// at the last point ([`Self::reach`]) and has no gap, because many shapes have the same normal law.
    ///
    /// # Errors
    ///
    /// Returns the index of the first invalid point.
    pub fn normal_law(points: &[(f64, f64)]) -> Result<Self, ProfileError> {
        let secants = secants(points)?;
        let stiffness = stiffnesses(points, &secants);
        let mut panels = Vec::with_capacity(2 * secants.len());
        for (i, &secant) in secants.iter().enumerate() {
            let (from, to) = (points[i].0, points[i + 1].0);
            let (low, high) = (stiffness[i], stiffness[i + 1]);
            if low < secant && secant < high {
                // At the breakpoint, the mean of both linear functions is the secant.
                let bend = from + (to - from) * ((high - secant) / (high - low));
                panels.push(straight([from, bend], [low, secant]));
                panels.push(straight([bend, to], [secant, high]));
            } else {
                panels.push(straight([from, to], [secant, secant]));
            }
        }
        panels.retain(|panel| panel.height[0] < panel.height[1]);
        let mut borders: Vec<f64> =
            panels.iter().map(|panel| panel.radius[0]).filter(|radius| *radius > 0.0).collect();
        borders.dedup();
        Ok(Self { shape: Shape::Chart(Arc::new(Chart::new(&panels, borders, None))) })
    }
}

/// Returns a panel in which m is linear from one height to the next.
fn straight(height: [f64; 2], stiffness: [f64; 2]) -> Ends {
    let radius = stiffness.map(|m| 0.5 * m);
    Ends {
        radius,
        radius_slope: [radius[1] - radius[0]; 2],
        height,
        height_slope: [height[1] - height[0]; 2],
    }
}

/// Returns the stiffness between neighbouring points, m.
fn secants(points: &[(f64, f64)]) -> Result<Vec<f64>, ProfileError> {
    if points.len() < 2 {
        return Err(ProfileError::Points(points.len()));
    }
    if points[0] != (0.0, 0.0) {
        return Err(ProfileError::Origin { radius: points[0].0, value: points[0].1 });
    }
    let mut secants: Vec<f64> = Vec::with_capacity(points.len() - 1);
    for (i, pair) in points.windows(2).enumerate() {
        let index = i + 1;
        let (width, rise) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        if !(width > 0.0 && width.is_finite()) {
            return Err(ProfileError::Order { index });
        }
        let secant = rise / width;
        if !(secant > 0.0 && secant.is_finite()) {
            return Err(ProfileError::Fall { index });
        }
        // A decrease within the rounding of the points is accepted.
        let before = secants.last().copied().unwrap_or(0.0);
        if secant < before * (1.0 - 1e-9) {
            return Err(ProfileError::Softening { index });
        }
        secants.push(secant.max(before));
    }
    Ok(secants)
}

/// Largest relative difference of two secants that are treated as equal, so that their points lie on a straight line.
const ALIKE: f64 = 1e-9;

/// Returns whether three points lie on a straight line, so that the stiffness must be the secant throughout.
fn are_alike(left: f64, right: f64) -> bool {
    right - left <= ALIKE * right
}

/// Returns the stiffness at each point, m: the slope of the parabola through its neighbours, which is between both secants.
///
/// At the end of a straight line the stiffness is the secant of that line.
// Where two straight lines meet, the stiffness jumps.
fn stiffnesses(points: &[(f64, f64)], secants: &[f64]) -> Vec<f64> {
    let is_straight = |cell: usize| {
        let own = secants[cell];
        cell > 0 && are_alike(secants[cell - 1], own)
            || secants.get(cell + 1).is_some_and(|next| are_alike(own, *next))
    };
    let inner = secants.windows(2).enumerate().map(|(i, pair)| {
        if is_straight(i) {
            return pair[0];
        }
        if is_straight(i + 1) {
            return pair[1];
        }
        let (left, right) = (points[i + 1].0 - points[i].0, points[i + 2].0 - points[i + 1].0);
        (pair[0] + (pair[1] - pair[0]) * (left / (left + right))).clamp(pair[0], pair[1])
    });
    let inner: Vec<f64> = inner.collect();
    let (first, last) = (secants[0], secants[secants.len() - 1]);
    let start = inner.first().map_or(first, |next| (2.0 * first - next).max(0.0));
    let end = inner.last().map_or(last, |before| 2.0 * last - before);
    [start].into_iter().chain(inner).chain([end]).collect()
}
