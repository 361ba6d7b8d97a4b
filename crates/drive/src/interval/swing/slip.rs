//! A contact in partial slip that acts on a single slider.
//!
//! The contact's normal energy is N(h) = c h^{2+1/n} Σ aₖ (h/L)ᵏ ([`RootSeries`]). With y = ⁿ√h the leading term is y^{2n+1}. Its divided
//! differences over heights yⁿ are quotients of sums of positive products. With the complete homogeneous polynomials Pₖ(a, y) = Σ aᵏ⁻ⁱyⁱ
//!
//! * f\[a, y\] = P_{2n}(a, y)/P_{n-1}(a, y),
//! * f\[a, y, c\] = Σ Cₛyˢ/[P_{n-1}(a, y) P_{n-1}(y, c) P_{n-1}(a, c)], Cₛ = Σ (ac)ᴮ P_{A-B-1}(a, c) over n ≤ A ≤ 2n, 0 ≤ B < n
//!   with A + B = 3n-1-s, 0 ≤ s < 2n.
//!
//! A product with a series V obeys Leibniz' rule: (fV)\[a, y, c\] = f\[a, y, c\]V(c) + f\[a, y\]V\[y, c\] + f(a)V\[a, y, c\].

use crate::quadrature::{each, lanes};
use stickslip_contact::RootSeries;

/// Largest number of coefficients Cₛ.
const DEGREES: usize = 8;

/// Contact in partial slip, with heights represented by their roots.
#[derive(Debug, Clone, Copy)]
pub(super) struct PartialSlip {
    law: RootSeries,
    /// Factor αc: the contact contributes gain·N' to the acceleration b.
    gain: f64,
    /// Factor λ: change of the slip front's height per displacement.
    pub(super) lean: f64,
    /// Initial height h of the slip front, m, and its n-th root.
    pub(super) height: f64,
    root: f64,
    /// Roots of the height h at both turning points. `beyond` is the negative height of a second turning point beyond the centre.
    ends: [f64; 2],
    beyond: f64,
    /// Coefficients of the numerator of K, a polynomial in the n-th root of h.
    numerator: [f64; DEGREES],
}

/// Evaluates an expression with the root exponent n of a force law as the constant N.
macro_rules! rooted {
    ($law:expr, $N:ident => $call:expr) => {
        match $law.root {
            2 => {
                const $N: usize = 2;
                $call
            }
            1 => {
                const $N: usize = 1;
                $call
            }
            3 => {
                const $N: usize = 3;
                $call
            }
            _ => {
                const $N: usize = 4;
                $call
            }
        }
    };
}

impl PartialSlip {
    /// Returns the data of a contact; `pull` is the factor of M in the acceleration b, 1/(m s²).
    pub(super) fn new(law: RootSeries, pull: f64, lean: f64, height: f64) -> Self {
        let root = rooted!(law, N => root::<N>(height));
        let gain = pull * law.factor;
        Self { law, gain, lean, height, root, ends: [root; 2], beyond: 0.0, numerator: [0.0; DEGREES] }
    }

    /// Returns whether the contact force is smooth up to the contact centre.
    pub(super) fn ends_smoothly(&self) -> bool {
        self.law.root == 1
    }

    /// Sets the turning points of the oscillation, m.
    pub(super) fn swing_between(&mut self, low: f64, high: f64) {
        rooted!(self.law, N => self.take_up::<N>(low, high));
    }

    fn take_up<const N: usize>(&mut self, low: f64, high: f64) {
        let height = |q: f64| self.height - self.lean * q;
        // A turning point beyond the centre has no root of a height.
        self.beyond = height(high).min(0.0);
        let ends = each([above(height(low)), above(height(high))], root::<N>);
        let [a, c] = ends;
        let scale = self.gain * self.lean / symmetric(N - 1, a, c);
        let mut sums = [0.0; 2 * DEGREES];
        let (mut sum, mut power) = (1.0, 1.0);
        for sums in &mut sums[..2 * N] {
            *sums = scale * sum;
            power *= c;
            sum = a * sum + power;
        }
        self.numerator = [0.0; DEGREES];
        let mut product = 1.0;
        for low in 0..N {
            for high in N..=2 * N {
                // For a negative degree both terms cancel.
                if let Some(coefficient) = (3 * N - 1).checked_sub(high + low).map(|s| &mut self.numerator[s])
                {
                    *coefficient += product * sums[high - low - 1];
                }
            }
            product *= a * c;
        }
        self.ends = ends;
    }

    /// Returns the contact's contributions to the acceleration b at the start and to its first two derivatives; m/s², 1/s², 1/(m s²).
    #[inline(always)]
    pub(super) fn start(&self) -> [f64; 3] {
        let [force, stiffness, bend] = rooted!(self.law, N => self.derivatives::<N>(self.height));
        let (power, lean) = (self.gain * self.root, -self.lean);
        [power * self.height * force, power * lean * stiffness, power * lean * lean / self.height * bend]
    }

    /// Returns the first three derivatives of N at a height, divided by c h^{1+1/n}, c h^{1/n} and c h^{1/n-1}.
    #[inline(always)]
    fn derivatives<const N: usize>(&self, height: f64) -> [f64; 3] {
        let e = 2.0 + 1.0 / N as f64;
        if self.law.terms.len() == 1 {
            return [e, e * (e - 1.0), e * (e - 1.0) * (e - 2.0)];
        }
        // V, h dV/dh and half of h² d²V/dh². The third derivative of V is neglected, as the result serves for guesses only.
        let [value, slope, bend] = self.law.divided([height; 3]);
        let (slope, bend) = (height * slope, height * height * bend);
        [
            e * value + slope,
            e * (e - 1.0) * value + 2.0 * (e * slope + bend),
            e * (e - 1.0) * ((e - 2.0) * value + 3.0 * slope) + 6.0 * e * bend,
        ]
    }

    /// Returns the contact's contribution to K at q, 1/s².
    #[inline(always)]
    pub(super) fn stiffness<const L: usize>(&self, q: [f64; L]) -> [f64; L] {
        let heights = each(q, |q| above(self.height - self.lean * q));
        // One branch for all nodes keeps the usual case fast.
        if self.beyond < 0.0 {
            return rooted!(self.law, N => self.stiffness_beyond::<N, L>(heights));
        }
        if self.law.terms.len() > 1 {
            return self.stiffness_of_series(heights);
        }
        rooted!(self.law, N => each(heights, |height| self.leading_stiffness::<N>(root::<N>(height))))
    }

    /// Returns the contribution of the leading term to K, for V = 1.
    #[inline(always)]
    fn leading_stiffness<const N: usize>(&self, y: f64) -> f64 {
        let [a, c] = self.ends;
        let numerator = self.numerator[..2 * N].iter().rev().fold(0.0, |sum, term| sum * y + term);
        numerator / (symmetric(N - 1, a, y) * symmetric(N - 1, y, c))
    }

    /// Returns the contribution of a spherical contact to K.
    fn stiffness_of_series<const L: usize>(&self, heights: [f64; L]) -> [f64; L] {
        let ([a, c], scale) = (self.ends, self.gain * self.lean);
        let (first, last) = (a * a, c * c);
        each(heights, |height| {
            let y = height.sqrt();
            let [value, slope, bend] = self.law.divided([last, height, first]);
            let differences = mean_power::<2>(a, y) * slope + first * first * a * bend;
            self.leading_stiffness::<2>(y) * value + scale * differences
        })
    }

    /// Returns the contribution to K if the turning point lies beyond the contact centre.
    fn stiffness_beyond<const N: usize, const L: usize>(&self, heights: [f64; L]) -> [f64; L] {
        let (a, roots) = (self.ends[0], each(heights, root::<N>));
        let first = a.powi(N as i32);
        let mut inner = each(roots, |y| mean_power::<N>(a, y));
        let mut outer: [f64; L] = lanes(|i| heights[i] * heights[i] * roots[i] / (heights[i] - self.beyond));
        if self.law.terms.len() > 1 {
            for i in 0..L {
                let [value, slope, _] = self.law.divided([heights[i], first, 0.0]);
                (inner[i], outer[i]) = (inner[i] * value + first * first * a * slope, outer[i] * value);
            }
        }
        let scale = self.gain * self.lean / (first - self.beyond);
        lanes(|i| scale * (inner[i] - outer[i]))
    }

    /// Returns the contact's contributions to the mean of b up to q, to b and to db/dq; m/s², m/s², 1/s².
    #[inline(always)]
    pub(super) fn pull<const L: usize>(&self, q: [f64; L]) -> [[f64; L]; 3] {
        let heights = each(q, |q| self.height - self.lean * q);
        let inside = each(heights, above);
        // Beyond the centre the force is zero.
        let share = |i: usize| if heights[i] < 0.0 { self.height / (self.height - heights[i]) } else { 1.0 };
        let shares: [f64; L] = lanes(share);
        rooted!(self.law, N => self.pull_inside::<N, L>(inside, shares))
    }

    #[inline(always)]
    fn pull_inside<const N: usize, const L: usize>(
        &self,
        inside: [f64; L],
        shares: [f64; L],
    ) -> [[f64; L]; 3] {
        let roots = each(inside, root::<N>);
        let mut means = each(roots, |y| mean_power::<N>(self.root, y));
        let e = 2.0 + 1.0 / N as f64;
        let (mut forces, mut stiffness) = ([e; L], [e * (e - 1.0); L]);
        if self.law.terms.len() > 1 {
            for i in 0..L {
                let [value, slope, _] = self.law.divided([inside[i], self.height, 0.0]);
                means[i] = means[i] * value + self.height * self.height * self.root * slope;
                [forces[i], stiffness[i], _] = self.derivatives::<N>(inside[i]);
            }
        }
        [
            lanes(|i| self.gain * means[i] * shares[i]),
            lanes(|i| forces[i] * self.gain * roots[i] * inside[i]),
            lanes(|i| -stiffness[i] * self.gain * self.lean * roots[i]),
        ]
    }
}

/// Returns a height, limited to at least 0.
#[inline(always)]
fn above(height: f64) -> f64 {
    if height > 0.0 { height } else { 0.0 }
}

/// Returns the N-th root of a non-negative number.
#[inline(always)]
fn root<const N: usize>(x: f64) -> f64 {
    match N {
        1 => x,
        2 => x.sqrt(),
        3 => math::cbrt(x),
        _ => x.sqrt().sqrt(),
    }
}

/// Returns the complete homogeneous polynomial Pₖ(a, b) of the given degree k.
#[inline(always)]
fn symmetric(degree: usize, a: f64, b: f64) -> f64 {
    let (mut sum, mut power) = (1.0, 1.0);
    for _ in 0..degree {
        power *= b;
        sum = a * sum + power;
    }
    sum
}

/// Returns f\[a, b\] = (a^{2N+1} - b^{2N+1})/(aᴺ - bᴺ) of two roots, not both zero, without cancellation.
#[inline(always)]
fn mean_power<const N: usize>(a: f64, b: f64) -> f64 {
    if N == 2 {
        let (a2, b2, ab) = (a * a, b * b, a * b);
        return (a2 * a2 + b2 * b2 + ab * (a2 + ab + b2)) / (a + b);
    }
    symmetric(2 * N, a, b) / symmetric(N - 1, a, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_contact::Profile;

    /// Power laws with N = h^{2+1/n}, and a sphere of 2 m.
    fn laws() -> [RootSeries; 5] {
        let power = |root| RootSeries { root, factor: 1.0, curvature: 0.0, terms: &[1.0] };
        let sphere = Profile::sphere(2.0).unwrap().root_series(0.9).unwrap();
        [power(1), power(2), power(3), power(4), sphere]
    }

    /// Returns the energy N, whose divided differences the closed forms are; zero for negative heights.
    fn energy(law: &RootSeries, h: f64) -> f64 {
        let h = h.max(0.0);
        let sum = law.terms.iter().rev().fold(0.0, |sum, term| sum * (law.curvature * h) + term);
        law.factor * h.powf(2.0 + f64::from(law.root).recip()) * sum
    }

    fn divided(law: &RootSeries, a: f64, b: f64) -> f64 {
        (energy(law, a) - energy(law, b)) / (a - b)
    }

    #[test]
    fn stiffness_is_a_second_divided_difference() {
        for law in laws() {
            // Turning points inside, at and beyond the centre, h = 0.8 - 0.5 q.
            for (low, high) in [(-0.2, 1.2), (0.0, 1.6), (-0.1, 3.0)] {
                let mut slip = PartialSlip::new(law, 3.0, 0.5, 0.8);
                slip.swing_between(low, high);
                let height = |q: f64| 0.8 - 0.5 * q;
                for q in [-0.05, 0.1, 0.6, 1.1] {
                    let (a, h, c) = (height(low), height(q), height(high));
                    let exact = 3.0 * 0.5 * (divided(&law, a, h) - divided(&law, h, c)) / (a - c);
                    let [stiffness] = slip.stiffness([q]);
                    let off = (stiffness / exact - 1.0).abs();
                    assert!(off < 3e-14, "{} {low} {high} {q}: {off:e}", law.root);
                }
            }
        }
    }

    /// Amplitude of 1e-12 of the height: differences of powers would keep four digits only.
    #[test]
    fn no_swing_is_too_small_for_its_digits() {
        for law in laws() {
            let mut slip = PartialSlip::new(law, 3.0, 0.5, 0.8);
            let [_, bend, _] = slip.start();
            slip.swing_between(-1e-12, 1e-12);
            let [stiffness] = slip.stiffness([3e-13]);
            assert!((2.0 * stiffness / -bend - 1.0).abs() < 1e-11, "{}", law.root);
        }
    }

    #[test]
    fn pull_is_mean_value_and_slope_of_the_force() {
        for law in laws() {
            let slip = PartialSlip::new(law, 3.0, 0.5, 0.8);
            for q in [-0.2, 0.3, 1.5, 2.5] {
                let (h, step) = (0.8 - 0.5 * q, 1e-4);
                // Central differences of N, of second order.
                let [less, same, more] = [h - step, h, h + step].map(|h| energy(&law, h));
                let (force, bend) =
                    ((more - less) / (2.0 * step), (more - 2.0 * same + less) / (step * step));
                let exact = [3.0 * divided(&law, 0.8, h), 3.0 * force, -1.5 * bend];
                for (k, (found, exact)) in slip.pull([q]).as_flattened().iter().zip(exact).enumerate() {
                    let limit = [1e-14, 1e-6, 1e-5][k] * (1.0 + exact.abs());
                    assert!((found - exact).abs() < limit, "{} {q}: {found} {exact}", law.root);
                }
            }
            let ([force, bend, _], [_, [again], [slope]]) = (slip.start(), slip.pull([0.0]));
            assert!((force / again - 1.0).abs() < 1e-15 && (bend / slope - 1.0).abs() < 1e-15);
        }
    }
}
