//! Evaluation of one fretting cycle.

use crate::series::{SeriesError, check, check_lengths, extent, mean, sum};

/// Fraction of the displacement range after a reversal over which the tangential stiffness is fitted.
pub const STIFFNESS_WINDOW: f64 = 0.1;
/// Fraction of the displacement range after a reversal over which the tangent parabola is fitted.
pub const TANGENT_WINDOW: f64 = 0.25;
/// Hysteresis threshold for a sign change of the force Q, relative to the smaller of its two extremes.
// With noise, Q crosses 0 several times on each branch. The threshold groups these crossings.
pub const PASSED: f64 = 0.3;
/// Opening, relative to δ\*, below which it counts as a rounding error.
const ROUNDING: f64 = 1e-9;

/// Results of one fretting cycle, computed from its loop (u, Q).
///
/// Q is the force that drives the motion, so it increases with u. The loop then runs clockwise, and `E_d` and δ₀ are positive. A force with
/// the opposite sign convention gives negative `E_d` and δ₀.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Displacement amplitude δ\*, half of peak to peak, m.
    pub displacement_amplitude: f64,
    /// Force amplitude Q\*, half of peak to peak, N.
    pub force_amplitude: f64,
    /// Half opening δ₀ of the loop at Q = 0, m. `None` if Q does not change sign.
    ///
    /// Several crossings of 0 on one branch, which noise causes, are averaged (see [`PASSED`]). With several branches, δ₀ is half the
    /// difference between the means of the falling and the rising branches.
    pub half_opening: Option<f64>,
    /// Dissipated energy `E_d`, the loop area ∮Q du, J.
    pub dissipated: f64,
    /// Tangential stiffness after the maximum of u, N/m. `None` if u is constant.
    ///
    /// The stiffness is the least-squares slope over the first tenth ([`STIFFNESS_WINDOW`]) of the displacement range.
    pub stiffness_after_maximum: Option<f64>,
    /// Tangential stiffness after the minimum of u, N/m, computed in the same way.
    pub stiffness_after_minimum: Option<f64>,
}

impl Cycle {
    /// Evaluates a closed or nearly closed loop with samples in order of time. A chord connects its end to its start.
    ///
    /// Linear interpolation between N samples that are evenly spread over a smooth loop gives a relative error of the area of order 1/N².
    ///
    /// # Errors
    /// Fewer than 3 samples, series of different lengths, or values that are not finite.
    pub fn of_loop(u: &[f64], q: &[f64]) -> Result<Self, SeriesError> {
        check_lengths(("q", q), ("u", u))?;
        check("u", u, 3)?;
        check("q", q, 3)?;
        let (u_range, q_range) = (extent(u), extent(q));
        // The values are halved first, because the difference of two large numbers may overflow.
        let half = |(low, high): (f64, f64)| high / 2.0 - low / 2.0;
        Ok(Self {
            displacement_amplitude: half(u_range),
            force_amplitude: half(q_range),
            half_opening: half_opening(u, q),
            dissipated: loop_area(u, q),
            stiffness_after_maximum: stiffness_after(u, q, u_range, u_range.1),
            stiffness_after_minimum: stiffness_after(u, q, u_range, u_range.0),
        })
    }

    /// Returns the energy `E_t = 4Q*δ*` of the rectangle that encloses the loop, J.
    pub fn enclosing_energy(&self) -> f64 {
        4.0 * self.force_amplitude * self.displacement_amplitude
    }

    /// Returns the energy ratio A = `E_d/E_t`. Returns `None` for a loop without extent.
    pub fn energy_ratio(&self) -> Option<f64> {
        quotient(self.dissipated, self.enclosing_energy())
    }

    /// Returns the system-free ratio B = `E_d/(4Q*δ₀)`, which is independent of a compliance in series. Returns `None` without an opening.
    pub fn system_free_ratio(&self) -> Option<f64> {
        quotient(self.dissipated, 4.0 * self.force_amplitude * self.opening()?)
    }

    /// Returns the slip ratio D = δ₀/δ\*. Returns `None` for a loop without extent.
    pub fn slip_ratio(&self) -> Option<f64> {
        quotient(self.half_opening?, self.displacement_amplitude)
    }

    /// Returns the energy coefficient of friction `μ_e` = `E_d/(4Pδ₀)` under a mean normal force P, N.
    ///
    /// For a rectangular loop, `μ_e` equals Coulomb's coefficient of friction. Returns `None` without an opening or a normal force.
    pub fn friction_coefficient(&self, normal_force: f64) -> Option<f64> {
        quotient(self.dissipated, 4.0 * normal_force * self.opening()?)
    }

    /// Returns the half opening δ₀ if it exceeds the rounding error.
    fn opening(&self) -> Option<f64> {
        self.half_opening.filter(|opening| opening.abs() > ROUNDING * self.displacement_amplitude)
    }
}

/// Returns the quotient a/b if it is finite.
fn quotient(a: f64, b: f64) -> Option<f64> {
    Some(a / b).filter(|ratio| b != 0.0 && ratio.is_finite())
}

/// Returns ∮q du of the closed polygon.
///
/// Means are subtracted first. Then the linear part q = ku is subtracted, which does not change the area. This avoids the cancellation of
/// large terms for narrow loops.
fn loop_area(u: &[f64], q: &[f64]) -> f64 {
    let (u_mean, q_mean) = (mean(u), mean(q));
    let centred = |i: usize| (u[i] - u_mean, q[i] - q_mean);
    let moment = sum((0..u.len()).map(|i| centred(i).0 * centred(i).1));
    let spread = sum((0..u.len()).map(|i| centred(i).0.powi(2)));
    let slope = quotient(moment, spread).unwrap_or(0.0);
    let rest = |i: usize| {
        let (u, q) = centred(i);
        (u, q - slope * u)
    };
    sum((0..u.len()).map(|i| {
        let (u0, q0) = rest(i);
        let (u1, q1) = rest((i + 1) % u.len());
        0.5 * (q0 + q1) * (u1 - u0)
    }))
}

/// Returns half the distance in u between the falling and the rising zero crossings of Q.
fn half_opening(u: &[f64], q: &[f64]) -> Option<f64> {
    let (low, high) = extent(q);
    if !(low < 0.0 && high >= 0.0) {
        return None;
    }
    let far = PASSED * high.min(-low);
    let start = q.iter().position(|q| *q == high)?;
    let (mut falling, mut rising, mut crossings) = (Vec::new(), Vec::new(), Vec::new());
    let mut is_above = true;
    for k in 0..u.len() {
        let (i, j) = ((start + k) % u.len(), (start + k + 1) % u.len());
        if (q[i] < 0.0) != (q[j] < 0.0) {
            let share = q[i] / (q[i] - q[j]);
            crossings.push(u[i] + share * (u[j] - u[i]));
        }
        if q[j] <= -far && q[j] < 0.0 {
            if is_above {
                falling.push(mean(&crossings));
            }
            is_above = false;
            crossings.clear();
        } else if q[j] >= far {
            if !is_above {
                rising.push(mean(&crossings));
            }
            is_above = true;
            crossings.clear();
        }
    }
    if falling.is_empty() || rising.is_empty() {
        return None;
    }
    Some((mean(&falling) - mean(&rising)) / 2.0)
}

/// Returns the least-squares slope over the first tenth of the range after the reversal at `extreme`.
///
/// The end point of this tenth is interpolated, so that coarse records have a slope, too.
fn stiffness_after(u: &[f64], q: &[f64], (low, high): (f64, f64), extreme: f64) -> Option<f64> {
    let n = u.len();
    let window = STIFFNESS_WINDOW * (high - low);
    if !(window > 0.0 && window.is_finite()) {
        return None;
    }
    // If u is constant at the extreme for some samples, the last of them is used.
    let start = (0..n).find(|&i| u[i] == extreme && u[(i + 1) % n] != extreme)?;
    let mut points = vec![(u[start], q[start])];
    for k in 1..n {
        let (before, i) = ((start + k - 1) % n, (start + k) % n);
        let way = (u[i] - extreme).abs();
        if way < window {
            points.push((u[i], q[i]));
            continue;
        }
        let from = (u[before] - extreme).abs();
        let share = (window - from) / (way - from);
        points.push((u[before] + share * (u[i] - u[before]), q[before] + share * (q[i] - q[before])));
        break;
    }
    slope(&points)
}

/// Returns the tangent stiffness of the loop at its reversals, N/m, as the mean of both reversals.
///
/// At each reversal, a parabola is fitted to the first [`TANGENT_WINDOW`] of the displacement range. Returns `None` if u is constant or
/// both fits have fewer than 4 points.
#[must_use]
pub fn reversal_stiffness(u: &[f64], q: &[f64]) -> Option<f64> {
    let (low, high) = extent(u);
    let after = |extreme: f64| {
        let start = u.iter().position(|u| *u == extreme)?;
        let way = |k: usize| (u[(start + k) % u.len()] - extreme).abs() / (high - low);
        let force = |k: usize| q[(start + k) % u.len()];
        let points: Vec<[f64; 2]> =
            (0..u.len()).take_while(|k| way(*k) <= TANGENT_WINDOW).map(|k| [way(k), force(k)]).collect();
        if points.len() < 4 {
            return None;
        }
        let rows = nalgebra::DMatrix::from_fn(points.len(), 3, |i, j| points[i][0].powi(j as i32));
        let right = nalgebra::DVector::from_iterator(points.len(), points.iter().map(|point| point[1]));
        let fit = rows.svd(true, true).solve(&right, 1e-9).ok()?;
        let slope = fit[1] / (high - low);
        Some(if extreme == high { -slope } else { slope }).filter(|slope| slope.is_finite())
    };
    if high <= low {
        return None;
    }
    match (after(high), after(low)) {
        (Some(a), Some(b)) => Some(0.5 * (a + b)),
        (one, other) => one.or(other),
    }
}

/// Returns the slope of the least-squares line.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let x_mean = sum(points.iter().map(|p| p.0)) / n;
    let y_mean = sum(points.iter().map(|p| p.1)) / n;
    let moment = sum(points.iter().map(|p| (p.0 - x_mean) * (p.1 - y_mean)));
    let spread = sum(points.iter().map(|p| (p.0 - x_mean).powi(2)));
    quotient(moment, spread)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    #[test]
    fn a_rectangle_is_its_own_enclosure() {
        // Rigid Coulomb friction: μ_e = μ, A = B = D = 1.
        let cycle = Cycle::of_loop(&[-2.0, 2.0, 2.0, -2.0], &[3.0, 3.0, -3.0, -3.0]).unwrap();
        assert_eq!((cycle.displacement_amplitude, cycle.force_amplitude), (2.0, 3.0));
        assert_relative_eq!(cycle.dissipated, 24.0, max_relative = 1e-15);
        assert_eq!(cycle.half_opening, Some(2.0));
        assert_relative_eq!(cycle.friction_coefficient(10.0).unwrap(), 0.3, max_relative = 1e-15);
        for ratio in [cycle.energy_ratio(), cycle.system_free_ratio(), cycle.slip_ratio()] {
            assert_relative_eq!(ratio.unwrap(), 1.0, max_relative = 1e-15);
        }
    }

    #[test]
    fn a_parallelogram_has_its_side_as_stiffness() {
        // Elastic-plastic element: stiffness 5 N/m up to 1 N, amplitude 1 m. Reversal at (1, 1), slip from
        // (0.6, -1). Area = 4·1·(1 - 0.2), opening at Q = 0 from -0.8 to 0.8.
        let (u, q) = ([1.0, 0.6, -1.0, -0.6], [1.0, -1.0, -1.0, 1.0]);
        let cycle = Cycle::of_loop(&u, &q).unwrap();
        assert_relative_eq!(cycle.dissipated, 3.2, max_relative = 1e-14);
        assert_relative_eq!(cycle.half_opening.unwrap(), 0.8, max_relative = 1e-14);
        assert_relative_eq!(cycle.stiffness_after_maximum.unwrap(), 5.0, max_relative = 1e-14);
        assert_relative_eq!(cycle.stiffness_after_minimum.unwrap(), 5.0, max_relative = 1e-14);
        // The other sign convention and the reversed loop differ in sign.
        let turned = Cycle::of_loop(&u, &q.map(|q| -q)).unwrap();
        assert_relative_eq!(turned.dissipated, -3.2, max_relative = 1e-14);
        assert_relative_eq!(turned.half_opening.unwrap(), -0.8, max_relative = 1e-14);
    }

    #[test]
    fn a_far_origin_costs_no_digits_of_the_area() {
        // An ellipse u = cos, q = k u + b sin sampled N-fold has the area of the polygon, π b · sinc(2π/N);
        // offsets of 1e6 leave the data's own rounding, 1e6 ε = 1e-10 of the amplitude.
        let n = 4096;
        let phase = |i: usize| -std::f64::consts::TAU * i as f64 / n as f64;
        let u: Vec<f64> = (0..n).map(|i| 1e6 + phase(i).cos()).collect();
        let q: Vec<f64> = (0..n).map(|i| -1e6 + 50.0 * phase(i).cos() + 1e-3 * phase(i).sin()).collect();
        let step = std::f64::consts::TAU / n as f64;
        let polygon = 1e-3 * std::f64::consts::PI * step.sin() / step;
        assert_abs_diff_eq!(
            Cycle::of_loop(&u, &q).unwrap().dissipated,
            polygon,
            epsilon = 2.0 * 50.0 * 1e-10
        );
    }

    #[test]
    fn a_line_has_no_area_and_a_point_no_ratio() {
        let line = Cycle::of_loop(&[-1.0, 0.0, 1.0, 0.0], &[-2.0, 0.0, 2.0, 0.0]).unwrap();
        assert_eq!((line.dissipated, line.half_opening), (0.0, Some(0.0)));
        assert_eq!(
            (line.energy_ratio(), line.system_free_ratio(), line.slip_ratio()),
            (Some(0.0), None, Some(0.0))
        );
        assert_relative_eq!(line.stiffness_after_maximum.unwrap(), 2.0, max_relative = 1e-15);
        // An elastic line with rounding errors: E_d and δ₀ are rounding, so B is undefined.
        let (u, q) = ([-1.0, 0.1, 1.0, -0.1], [-0.3, 0.1 * 0.3 + 1e-17, 0.3, -0.1 * 0.3 + 2e-17]);
        let elastic = Cycle { dissipated: 3e-17, ..Cycle::of_loop(&u, &q).unwrap() };
        assert!(elastic.half_opening.is_some_and(|opening| opening.abs() < 1e-15));
        assert_eq!((elastic.system_free_ratio(), elastic.friction_coefficient(1.0)), (None, None));
        let point = Cycle::of_loop(&[1.0; 3], &[1.0; 3]).unwrap();
        assert_eq!(
            (point.energy_ratio(), point.slip_ratio(), point.stiffness_after_maximum),
            (None, None, None)
        );
    }

    /// A parallelogram of 4 000 points with 2 % noise, without and with a small inner loop across 0: the opening is 0.8.
    #[test]
    fn noise_and_loops_across_zero_leave_the_opening() {
        let corners = [(1.0, 1.0), (0.6, -1.0), (-1.0, -1.0), (-0.6, 1.0), (1.0, 1.0)];
        let points = 4000;
        let on = |i: usize| {
            let (side, share) = (4 * i / points, (4 * i % points) as f64 / points as f64);
            let ((u0, q0), (u1, q1)) = (corners[side], corners[side + 1]);
            (u0 + share * (u1 - u0), q0 + share * (q1 - q0))
        };
        let noise = |i: usize| 0.02 * (2.4 * i as f64).sin();
        let (u, q): (Vec<f64>, Vec<f64>) = (0..points).map(on).unzip();
        let noisy: Vec<f64> = q.iter().enumerate().map(|(i, q)| q + noise(i)).collect();
        assert!(noisy.windows(2).filter(|q| q[0] * q[1] < 0.0).count() > 10);
        assert_abs_diff_eq!(Cycle::of_loop(&u, &noisy).unwrap().half_opening.unwrap(), 0.8, epsilon = 1e-3);
        // On the side from (-1, -1) to (-0.6, 1), which crosses 0 at -0.8.
        let looped: Vec<f64> = (0..points)
            .map(|i| if i % 1000 > 480 && i % 1000 < 520 && i > 2000 && i < 3000 { -q[i] } else { q[i] })
            .collect();
        assert_abs_diff_eq!(Cycle::of_loop(&u, &looped).unwrap().half_opening.unwrap(), 0.8, epsilon = 1e-3);
    }

    #[test]
    fn what_is_no_loop_is_refused() {
        assert!(matches!(Cycle::of_loop(&[], &[]), Err(SeriesError::TooShort { .. })));
        assert!(matches!(Cycle::of_loop(&[1.0; 4], &[1.0; 3]), Err(SeriesError::Lengths { .. })));
        assert!(matches!(
            Cycle::of_loop(&[1.0, f64::NAN, 0.0], &[1.0; 3]),
            Err(SeriesError::NotFinite { series: "u", index: 1, .. })
        ));
    }
}
