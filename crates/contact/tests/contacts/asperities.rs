//! Exponential and Gaussian asperities against their closed forms, and against sums over single tips.

use approx::assert_relative_eq;
use stickslip_contact::{Apex, Engine, Heights, Interface, Pair, Profile, Segment};

const SCALE: f64 = 1e-6;
const RADIUS: f64 = 50e-6;
const COUNT: f64 = 1e5;
const MU: f64 = 0.3;

fn law(profile: Profile) -> Interface {
    Interface::new(Pair::from_moduli(1e11, 8e10).unwrap(), profile, MU).unwrap()
}

fn tips(heights: Heights, endless: bool) -> Profile {
    Profile::asperities(heights, SCALE, RADIUS, COUNT, endless).unwrap()
}

/// F_N = n√(πR) E\* l^{3/2} e^{-t}; F_x = μF_N(1 - e^{-u/l'}) with l' = κl whatever the load; S₀ = 2 l' ln 2; the loop of amplitude l'.
#[test]
fn exponential_heights_have_one_length_whatever_the_load() {
    let law = law(tips(Heights::Exponential, true));
    let length = law.stick_slope() * SCALE;
    for force in [1e-6, 1e-2, 10.0] {
        let d = law.indentation(force);
        let mut memory = Engine::Curve.memory(&law, Apex { d, u: 0.0 });
        assert_relative_eq!(law.normal_force(d), force, max_relative = 1e-12);
        assert_relative_eq!(law.normal_energy(d), force * SCALE, max_relative = 1e-12);
        assert_relative_eq!(law.normal_stiffness(d), force / SCALE, max_relative = 1e-12);
        for u in [0.01, 0.3, 1.0, 5.0].map(|share| share * length) {
            let found = memory.force(&law, Apex { d, u });
            assert_relative_eq!(
                found,
                MU * force * (1.0 - (-u / length).exp()),
                epsilon = 1e-12 * MU * force
            );
        }
        // The zero-step stroke S₀ = 2u with F_x(u) = μF_N/2.
        let half = 0.5 * MU * force;
        let stroke = 2.0 * length * 2.0_f64.ln();
        assert_relative_eq!(stroke, 1.386_294_36 * length, max_relative = 1e-8);
        assert_relative_eq!(memory.force(&law, Apex { d, u: 0.5 * stroke }), half, max_relative = 1e-12);
        let amplitude = length;
        let mut lost = 0.0;
        for u in [amplitude, -amplitude, amplitude] {
            lost = memory.commit(&law, Segment::Straight(Apex { d, u })).unwrap();
        }
        assert_relative_eq!(2.0 * lost, 0.414_553_29 * MU * force * length, max_relative = 3e-8);
        // By Masing's rules W = 8∫₀^U F du - 4U F(U) with the first loading F.
        let first = MU * force * (amplitude - length * (1.0 - (-1.0_f64).exp()));
        let masing = 8.0 * first - 4.0 * amplitude * MU * force * (1.0 - (-1.0_f64).exp());
        assert_relative_eq!(2.0 * lost, masing, max_relative = 1e-11);
    }
}

/// A rough line of 10⁵ exponential heights has the same law.
#[test]
fn a_rough_line_with_exponential_heights_is_near() {
    let count = 100_000;
    let heights: Vec<f64> =
        (0..count).map(|i| -SCALE * (1.0 - (f64::from(i) + 0.5) / f64::from(count)).ln()).collect();
    let law = law(Profile::rough(&heights, 1e-6).unwrap());
    let length = law.stick_slope() * SCALE;
    let force = 2000.0;
    let d = law.indentation(force);
    let memory = Engine::Curve.memory(&law, Apex { d, u: 0.0 });
    for u in [0.1, 0.5, 1.0, 2.0].map(|share| share * length) {
        let found = memory.force(&law, Apex { d, u }) / (MU * force);
        assert!((found - (1.0 - (-u / length).exp())).abs() < 1e-4, "{found}");
    }
}

/// Midpoint sums over 4·10⁶ tips of equal probability distance, each a paraboloid: M = Σ(4/3)√R(h-y)^{3/2}.
#[test]
fn the_force_is_the_sum_over_the_tips() {
    for heights in [Heights::Exponential, Heights::Gaussian] {
        for endless in [false, true] {
            let profile = tips(heights, endless);
            let zero = profile.height_of_reduced_force(1e-14);
            for rise in [0.5, 2.0, 5.0] {
                let h = zero + rise * SCALE;
                let [m, force, energy] =
                    [profile.reduced_stiffness(h), profile.reduced_force(h), profile.reduced_energy(h)];
                // The functions are integrals of each other, here by Simpson's rule.
                let n = 4000;
                let step = h / f64::from(n);
                let simpson = |f: &dyn Fn(f64) -> f64| {
                    let inner = (1..n).map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * f(step * f64::from(i)));
                    step / 3.0 * (inner.sum::<f64>() + f(h))
                };
                assert_relative_eq!(simpson(&|h| profile.reduced_stiffness(h)), force, max_relative = 1e-9);
                assert_relative_eq!(simpson(&|h| profile.reduced_force(h)), energy, max_relative = 1e-9);
                assert_relative_eq!(profile.height_of_reduced_force(force), h, max_relative = 1e-12);
                assert_relative_eq!(profile.depth(0.5 * m), h, max_relative = 1e-10);
            }
        }
        // The endless tail at the expected highest tip and four scales below it.
        let (cut, endless) = (tips(heights, false), tips(heights, true));
        let density = |z: f64| match heights {
            Heights::Exponential => (-z).exp(),
            Heights::Gaussian => (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt(),
        };
        let n = 4_000_000;
        for t in [0.5, 1.5, 3.0] {
            let width = 40.0;
            let sum: f64 = (0..n)
                .map(|i| {
                    let x = width * (f64::from(i) + 0.5) / f64::from(n);
                    x.powf(1.5) * density(t + x) * width / f64::from(n)
                })
                .sum();
            let known = 4.0 / 3.0 * COUNT * RADIUS.sqrt() * SCALE.powf(1.5) * sum;
            let h = endless.height_of_reduced_force(known);
            let beyond = if heights == Heights::Exponential { COUNT.ln() + 50.0 } else { h / SCALE + t };
            assert_relative_eq!(h / SCALE, beyond - t, epsilon = 1e-4);
            assert!(cut.height_of_reduced_force(known) < h);
        }
    }
}

#[test]
fn a_number_of_tips_out_of_range_is_refused() {
    for count in [0.0, 9.0, 1e16, f64::NAN] {
        assert!(Profile::asperities(Heights::Gaussian, SCALE, RADIUS, count, true).is_err());
    }
    for bad in [0.0, -1.0, f64::INFINITY] {
        assert!(Profile::asperities(Heights::Gaussian, bad, RADIUS, COUNT, true).is_err());
        assert!(Profile::asperities(Heights::Exponential, SCALE, bad, COUNT, true).is_err());
    }
}
