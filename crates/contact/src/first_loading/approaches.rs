//! Independent computations of a first loading, as tests of the difference of two normal forces (4.38).

use super::FirstLoading;
use crate::quadrature::kronrod;
use crate::{Apex, Curve, Interface, Outcome};

/// Error tolerance of the integral, relative to μF_N.
const ACCURACY: f64 = 1e-14;
/// Largest number of bisections of a part between two borders of the profile.
const DEEPEST: u32 = 40;

impl FirstLoading {
    /// Returns `F_x` as the integral of the line load over the springs (4.39), N, and an estimate of its error.
    ///
    /// `F_x` = 2 ∫₀ᵃ q_x dx with q_x = μE\*[d-g(c)] for x < c and q_x = μE\*[d-g(x)] for x > c (4.31). The quadrature uses g only. For a
    /// list of springs the integral is a sum. An interface [on a row of springs](Interface::on_springs) is evaluated with its profile.
    // g' is not used, because some profiles have none.
    pub fn force_by_integral(&self, law: &Interface) -> (f64, f64) {
        let slope = law.stick_slope();
        if self.d <= 0.0 || slope == 0.0 || self.u == 0.0 {
            return (0.0, 0.0);
        }
        let limit = self.u.signum() * law.friction() * law.normal_modulus();
        let core = (self.d - self.u.abs() / slope).clamp(0.0, self.d);
        let profile = law.profile();
        if let Some(list) = profile.as_foundation() {
            let springs = list.heights().iter().zip(list.lengths());
            let sum: f64 = springs.map(|(h, length)| length * (self.d - h.max(core)).max(0.0)).sum();
            return (limit * sum, 0.0);
        }
        let inside = profile.borders().iter().copied().filter(|border| (self.c..self.a).contains(border));
        let ends: Vec<f64> = std::iter::once(self.c).chain(inside).chain([self.a]).collect();
        let load = |x: f64| (self.d - profile.depth(x)).max(0.0);
        let wanted = ACCURACY * self.d * self.a;
        let (mut sum, mut error) = ((self.d - core) * self.c, 0.0);
        for pair in ends.windows(2) {
            // The substitution x = from + width·t²(3-2t) makes root singularities at both ends smooth.
            let (from, width) = (pair[0], pair[1] - pair[0]);
            let smooth = |t: f64| load(from + width * t * t * (3.0 - 2.0 * t)) * 6.0 * t * (1.0 - t) * width;
            let part = adaptive([0.0, 1.0], wanted, DEEPEST, &smooth);
            (sum, error) = (sum + part.0, error + part.1);
        }
        (2.0 * limit * sum, (2.0 * limit * error).abs())
    }

    /// Returns force, tangential elastic energy and friction work from the memory curve.
    ///
    /// Up to the onset of gross slip the friction work is 2G\*κ² ∫_c^a (d-g)(g-g(c)) dx (4.42). In gross slip each metre adds μ`F_N`.
    /// The work is integrated over the slip zone, so that small amounts are accurate, too.
    pub fn outcome(&self, law: &Interface) -> Outcome {
        Curve::new(law, Apex { d: self.d, u: 0.0 }).preview(law, Apex { d: self.d, u: self.u })
    }
}

/// Integrates f over a range by bisection until the error estimate is below `wanted`.
fn adaptive(range: [f64; 2], wanted: f64, halvings: u32, f: &impl Fn(f64) -> f64) -> (f64, f64) {
    let (value, error) = kronrod(range, f);
    if error <= wanted || halvings == 0 {
        return (value, error);
    }
    let middle = 0.5 * (range[0] + range[1]);
    let half = |range| adaptive(range, 0.5 * wanted, halvings - 1, f);
    let (low, high) = (half([range[0], middle]), half([middle, range[1]]));
    (low.0 + high.0, low.1 + high.1)
}

#[cfg(test)]
mod tests {
    use crate::{FirstLoading, Interface, NormalGiven, Pair, Profile, TangentialGiven};

    fn law(profile: Profile) -> Interface {
        Interface::new(Pair::from_moduli(3.0, 2.0).unwrap(), profile, 0.3).unwrap()
    }

    /// First loading of a profile, at a depth and a fraction of `u_c`.
    fn loaded(law: &Interface, d: f64, share: f64) -> FirstLoading {
        let u = TangentialGiven::Displacement(share * law.gross_slip_displacement(d));
        FirstLoading::solve(law, NormalGiven::Indentation(d), u).unwrap()
    }

    #[test]
    fn the_integral_is_the_difference_of_normal_forces() {
        let profiles = [
            Profile::paraboloid(0.7).unwrap(),
            Profile::cone(0.4).unwrap(),
            Profile::sphere(0.1).unwrap(),
            Profile::power(5.0, 0.5).unwrap(),
            Profile::power(5.0, 4.0).unwrap(),
            Profile::flat(0.02).unwrap(),
            Profile::foundation(&[0.0, 1e-3, 4e-3, 2e-3], &[1e-2; 4]).unwrap(),
        ];
        for law in profiles.map(law) {
            for share in [-0.7, 1e-3, 0.5, 1.0, 2.0] {
                let loading = loaded(&law, 3e-3, share);
                let (integral, error) = loading.force_by_integral(&law);
                let limit = law.friction() * loading.normal_force;
                assert!((integral - loading.tangential_force).abs() <= 1e-12 * limit, "{:?}", law.profile());
                assert!(error <= 1e-12 * limit, "{:?}: {error:e}", law.profile());
            }
        }
    }

    #[test]
    fn the_friction_work_is_that_of_a_paraboloid_in_closed_form() {
        // (4.42) with g = x²/R and s = c/a: 2G*κ²d²a ∫_s^1 (1-t²)(t²-s²) dt = 2G*κ²d²a [2/15 - 2s²/3 + 2s³/3 - 2s⁵/15].
        let law = law(Profile::paraboloid(0.7).unwrap());
        for share in [0.01_f64, 0.3, 0.9] {
            let loading = loaded(&law, 3e-3, share);
            let s = (1.0 - share).sqrt();
            let bracket = 2.0 / 15.0 - 2.0 * s * s / 3.0 + 2.0 * s.powi(3) / 3.0 - 2.0 * s.powi(5) / 15.0;
            let scale =
                2.0 * law.tangential_modulus() * law.gross_slip_displacement(3e-3).powi(2) * loading.a;
            let got = loading.outcome(&law).friction;
            assert!((got - scale * bracket).abs() <= 1e-15 * scale, "{share}: {got:e} {:e}", scale * bracket);
        }
        // In gross slip each metre costs μF_N.
        let [at, beyond] = [1.0, 1.5].map(|share| loaded(&law, 3e-3, share));
        let more = law.friction() * at.normal_force * (beyond.u - at.u);
        let work = beyond.outcome(&law).friction - at.outcome(&law).friction;
        assert!((work / more - 1.0).abs() < 1e-12);
    }
}
