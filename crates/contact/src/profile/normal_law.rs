//! A profile given by its normal law F_N(d): m = F_N′/E\*, and nothing else of the shape is ever needed for forces.
//!
//! Between the points M is a parabola or two, so that m goes straight from point to point and never falls: Schumaker's spline (SIAM J.
//! Numer. Anal. 20, 1983). Other than a cubic it keeps every convex set of points convex.

use super::chart::{Chart, Ends};
use super::{Profile, ProfileError, Shape};
use std::sync::Arc;

impl Profile {
    /// The profile with the normal law M(h) = F_N/E\* through points (h in m, M in m²): the first (0, 0), both rising, and
    /// the stiffness from point to point not falling, as that of no contact does.
    ///
    /// It stands up to the last point ([`Self::reach`]) and has no gap: many shapes have one law.
    ///
    /// # Errors
    ///
    /// With the index of the first point that does not fit.
    pub fn normal_law(points: &[(f64, f64)]) -> Result<Self, ProfileError> {
        let secants = secants(points)?;
        let stiffness = stiffnesses(points, &secants);
        let mut panels = Vec::with_capacity(2 * secants.len());
        for (i, &secant) in secants.iter().enumerate() {
            let (from, to) = (points[i].0, points[i + 1].0);
            let (low, high) = (stiffness[i], stiffness[i + 1]);
            if low < secant && secant < high {
                // The bend is where the two straight lines have the secant for their mean.
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

/// A panel in which m goes straight from one height to another.
fn straight(height: [f64; 2], stiffness: [f64; 2]) -> Ends {
    let radius = stiffness.map(|m| 0.5 * m);
    Ends {
        radius,
        radius_slope: [radius[1] - radius[0]; 2],
        height,
        height_slope: [height[1] - height[0]; 2],
    }
}

/// Stiffness from each point to the next, m.
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
        // Digits that the points do not have are no softening.
        let before = secants.last().copied().unwrap_or(0.0);
        if secant < before * (1.0 - 1e-9) {
            return Err(ProfileError::Softening { index });
        }
        secants.push(secant.max(before));
    }
    Ok(secants)
}

/// Two secants that differ by no more are one: points in a straight line, but for their digits.
const ALIKE: f64 = 1e-9;

/// Whether three points lie in a straight line, so that the stiffness is their secant throughout: any other that never falls would
/// miss a point.
fn are_alike(left: f64, right: f64) -> bool {
    right - left <= ALIKE * right
}

/// Stiffness at each point, m: of the parabola through its neighbours, which lies between the secants beside it; at an end of a
/// straight line the secant of that.
// Where two straight lines meet no stiffness is both: there it jumps, and whoever steps over it is told so.
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
