//! The quantities of one fretting cycle.

use crate::series::{SeriesError, check, check_lengths, extent, mean, sum};

/// Share of the displacement range after a reversal over which the tangential stiffness is fitted.
pub const STIFFNESS_WINDOW: f64 = 0.1;
/// Share of the displacement range after a reversal through which the parabola of the tangent goes.
pub const TANGENT_WINDOW: f64 = 0.25;
/// Share of the smaller of both extremes of Q, on its two sides of 0, that Q has to reach to have passed 0.
// Of a loop of 2 000 points with noise of 0.5 % all crossings of one sense apart from all of the other gave an opening of a quarter: on
// either branch both are in the same place.
pub const PASSED: f64 = 0.3;
/// Share of δ\* below which an opening is rounding.
const ROUNDING: f64 = 1e-9;

/// The quantities of one fretting cycle, from its loop (u, Q).
///
/// Q is the force that drives the motion, so that it grows with u; the loop then runs clockwise and `E_d` and δ₀
/// are positive. A force of the opposite sign convention shows as negative `E_d` and δ₀.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Displacement amplitude δ\*: half of peak to peak, m.
    pub displacement_amplitude: f64,
    /// Force amplitude Q\*: half of peak to peak, N.
    pub force_amplitude: f64,
    /// δ₀: half opening of the loop at Q = 0, m; none where Q does not change sign. Where Q goes to and fro about 0 on its way, as with noise,
    /// it is there in the middle of all crossings ([`PASSED`]); with several such ways, the mean of the falling less that of the rising
    /// ones counts, halved.
    pub half_opening: Option<f64>,
    /// `E_d`: loop area ∮Q du, J.
    pub dissipated: f64,
    /// Tangential stiffness after the maximum of u: least-squares slope over the first tenth
    /// ([`STIFFNESS_WINDOW`]) of the displacement range, N/m; none where u does not move.
    pub stiffness_after_maximum: Option<f64>,
    /// Tangential stiffness after the minimum of u, N/m; as above.
    pub stiffness_after_minimum: Option<f64>,
}

impl Cycle {
    /// Takes the quantities of a closed or nearly closed loop, samples in the order of time; the end is joined
    /// to the start by a chord. Between samples the loop is straight: N samples evenly spread over a smooth
    /// loop cost a relative error of order 1/N² of the area.
    ///
    /// # Errors
    /// Fewer than 3 samples, series of different lengths, values that are not finite.
    pub fn of_loop(u: &[f64], q: &[f64]) -> Result<Self, SeriesError> {
        check_lengths(("q", q), ("u", u))?;
        check("u", u, 3)?;
        check("q", q, 3)?;
        let (u_range, q_range) = (extent(u), extent(q));
        // Halved first: the difference of two large numbers may overflow.
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

    /// `E_t = 4Q*δ*`, J: the area of the rectangle around the loop.
    pub fn enclosing_energy(&self) -> f64 {
        4.0 * self.force_amplitude * self.displacement_amplitude
    }

    /// A = `E_d/E_t`; none for a loop without extent.
    pub fn energy_ratio(&self) -> Option<f64> {
        quotient(self.dissipated, self.enclosing_energy())
    }

    /// B = `E_d/(4Q*δ₀)`: independent of a compliance in series; none without opening, which a billionth of δ\* is not.
    pub fn system_free_ratio(&self) -> Option<f64> {
        quotient(self.dissipated, 4.0 * self.force_amplitude * self.opening()?)
    }

    /// D = δ₀/δ\*: the slip ratio; none for a loop without extent.
    pub fn slip_ratio(&self) -> Option<f64> {
        quotient(self.half_opening?, self.displacement_amplitude)
    }

    /// Energy coefficient of friction `μ_e` = `E_d/(4Pδ₀)` under a mean normal force P, N; none without opening or
    /// normal force. Equals Coulomb's μ for a rectangular loop.
    pub fn friction_coefficient(&self, normal_force: f64) -> Option<f64> {
        quotient(self.dissipated, 4.0 * normal_force * self.opening()?)
    }

    /// δ₀ where it is more than rounding: a quotient of two roundings may be anything.
    fn opening(&self) -> Option<f64> {
        self.half_opening.filter(|opening| opening.abs() > ROUNDING * self.displacement_amplitude)
    }
}

/// a/b where that is a number.
fn quotient(a: f64, b: f64) -> Option<f64> {
    Some(a / b).filter(|ratio| b != 0.0 && ratio.is_finite())
}

/// ∮q du of the closed polygon, about its mean: the rectangle of the means would cancel only on paper.
///
/// The straight part q = ku encloses nothing and is taken out as well (a shear keeps areas), so that the narrow
/// loop of a small amplitude is not the difference of two large triangles.
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

/// Half the distance between falling and rising passages of Q through 0.
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

/// Least-squares slope from the reversal at `extreme` over the first tenth of the range. The point where the
/// tenth ends is interpolated, so that a coarse or jumping record still has a slope.
fn stiffness_after(u: &[f64], q: &[f64], (low, high): (f64, f64), extreme: f64) -> Option<f64> {
    let n = u.len();
    let window = STIFFNESS_WINDOW * (high - low);
    if !(window > 0.0 && window.is_finite()) {
        return None;
    }
    // The last sample before the motion turns, where it dwells at the extreme.
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

/// Tangent of the loop at its reversals, N/m: of least-squares parabolas through the first [`TANGENT_WINDOW`] of the way after the maximum and
/// after the minimum of u, the mean of their slopes at the reversal. None of a loop that does not move, or has fewer than 4 points there.
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

/// Slope of the least-squares line.
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
        // The other sign convention, and the loop run backwards, are told apart by the sign.
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
        // An elastic line as a computer adds it up: E_d and δ₀ are rounding, and their quotient was told as B.
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

    /// A parallelogram of 4 000 points under noise of 2 %, and the same with a small loop across 0 on its way up: opening 0.8 as without.
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
        // On the side from (-1, -1) to (-0.6, 1), which is at 0 in -0.8.
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
