//! Tests of profiles against closed forms, values with 80 digits, and the quadrature of m.

use approx::assert_relative_eq;
use stickslip_contact::{Profile, ProfileError};

/// Values (η, s, M/R², N/R³) of the sphere, by mpmath with 80 digits.
///
/// η = h/R is the double nearest to the decimal shown, and s = a/R the root of s artanh s = η. M/R² = (s²+1) artanh s - s and N/R³ =
/// ∫₀ˢ(η - x artanh x)²dx by quadrature.
const SPHERE: [(f64, f64, f64, f64); 16] = [
    (1e-16, 1e-08, 1.3333333333333332e-24, 5.333333333333333e-41),
    (1e-12, 9.999999999998333e-07, 1.3333333333332e-18, 5.3333333333329525e-31),
    (1e-08, 9.999999983333333e-05, 1.333333332e-12, 5.33333332952381e-21),
    (1e-06, 0.0009999998333333306, 1.3333331999999983e-09, 5.333332952380948e-16),
    (0.0001, 0.009999833333055578, 1.333319999984128e-06, 5.333295238059967e-11),
    (0.001, 0.03161750605114484, 4.215948571520063e-05, 1.6864276165878644e-08),
    (0.01, 0.09983330577455851, 0.0013319998422425818, 5.329523458557981e-06),
    (0.1, 0.3109492333119661, 0.0417415947104409, 0.0016744907300565728),
    (0.3, 0.5202352285144897, 0.2124975565849336, 0.02572599801744035),
    (0.499, 0.6473882425885434, 0.44644789807545315, 0.09045542663064354),
    (0.5, 0.6479182290296027, 0.44774320469430284, 0.09090252209369735),
    (0.501, 0.6484473332433016, 0.44903957040342024, 0.09135091339306219),
    (0.8, 0.7748775678489188, 0.8774456497125936, 0.28778519318101975),
    (1.5, 0.9248876110689465, 2.0842624806342105, 1.3123152868919086),
    (2.6, 0.9896075024412516, 4.210676256941766, 4.762070499017774),
    (3.79, 0.998987207683175, 6.581016683844104, 11.18107962710801),
];

fn profiles() -> Vec<(&'static str, Profile)> {
    vec![
        ("flat", Profile::flat(2e-3).unwrap()),
        ("cone", Profile::cone(0.01).unwrap()),
        ("paraboloid", Profile::paraboloid(1e-3).unwrap()),
        ("sphere", Profile::sphere(1e-3).unwrap()),
        ("cubic", Profile::power(7.0, 3.0).unwrap()),
        ("fourth power", Profile::foundation_power(1e9, 4.0).unwrap()),
        ("power 1.7", Profile::power(0.3, 1.7).unwrap()),
        ("power 0.6", Profile::power(1e-3, 0.6).unwrap()),
        (
            "list",
            Profile::foundation(&[3e-7, 0.0, 1e-8, 3e-7, 2e-7], &[1e-6, 2e-6, 3e-6, 1e-6, 4e-6]).unwrap(),
        ),
    ]
}

/// Integral ∫₀ʰ f by tanh-sinh quadrature, suitable for the root of m at 0.
fn integral(f: impl Fn(f64) -> f64, h: f64) -> f64 {
    let half_pi = std::f64::consts::FRAC_PI_2;
    let step = 1.0 / 64.0;
    let node = |k: i32| {
        let t = f64::from(k) * step;
        let e = (2.0 * half_pi * t.sinh()).exp();
        let x = if e.is_infinite() { 1.0 } else { e / (1.0 + e) };
        let weight = half_pi * t.cosh() / (half_pi * t.sinh()).cosh().powi(2);
        if weight.is_finite() { 0.5 * weight * f(h * x) } else { 0.0 }
    };
    (-256..=256).map(node).sum::<f64>() * step * h
}

#[test]
fn the_sphere_agrees_with_80_digit_values() {
    for radius in [1.0, 3.0e-4] {
        let sphere = Profile::sphere(radius).unwrap();
        for (eta, ratio, reduced_force, reduced_energy) in SPHERE {
            let h = eta * radius;
            assert_relative_eq!(sphere.radius(h), ratio * radius, max_relative = 2e-15);
            assert_relative_eq!(
                sphere.reduced_force(h),
                reduced_force * radius * radius,
                max_relative = 4e-15
            );
            assert_relative_eq!(
                sphere.reduced_energy(h),
                reduced_energy * radius.powi(3),
                max_relative = 5e-15
            );
            assert_relative_eq!(sphere.depth(ratio * radius), h, max_relative = 2e-15 / (1.0 - ratio));
            assert_relative_eq!(
                sphere.height_of_reduced_force(reduced_force * radius * radius),
                h,
                max_relative = 4e-15
            );
        }
    }
}

#[test]
fn the_sphere_is_not_the_paraboloid() {
    // s artanh s = s²(1 + s²/3 + …) instead of s²: at equal indentation a differs by s²/6.
    let (sphere, paraboloid) = (Profile::sphere(1.0).unwrap(), Profile::paraboloid(1.0).unwrap());
    let d = sphere.depth(0.01);
    let difference = paraboloid.radius(d) / sphere.radius(d) - 1.0;
    assert_relative_eq!(difference, 1e-4 / 6.0, max_relative = 1e-4);
}

#[test]
fn power_laws_have_their_closed_forms() {
    let h = 1.8e-7_f64;
    let paraboloid = Profile::paraboloid(1e-3).unwrap();
    assert_relative_eq!(
        paraboloid.reduced_force(h),
        4.0 / 3.0 * 1e-3_f64.sqrt() * h.powf(1.5),
        max_relative = 1e-15
    );
    assert_relative_eq!(
        paraboloid.reduced_energy(h),
        8.0 / 15.0 * 1e-3_f64.sqrt() * h.powf(2.5),
        max_relative = 1e-15
    );
    let cone = Profile::cone(0.01).unwrap();
    let slope = std::f64::consts::FRAC_PI_2 * 0.01;
    assert_relative_eq!(cone.reduced_force(h), h * h / slope, max_relative = 1e-15);
    assert_relative_eq!(cone.reduced_energy(h), h * h * h / (3.0 * slope), max_relative = 1e-15);
    assert_relative_eq!(cone.depth(2e-5), slope * 2e-5, max_relative = 1e-15);
    let fourth = Profile::foundation_power(1e9, 4.0).unwrap();
    assert_relative_eq!(fourth.reduced_stiffness(h), 2.0 * (h / 1e9).powf(0.25), max_relative = 1e-15);
    assert_eq!(
        (cone.exponent(), paraboloid.exponent(), fourth.exponent()),
        (Some(1.0), Some(2.0), Some(4.0))
    );
    // f = Ar² is the paraboloid of radius 1/2A.
    let square = Profile::power(500.0, 2.0).unwrap();
    assert_relative_eq!(square.reduced_force(h), paraboloid.reduced_force(h), max_relative = 1e-15);
}

#[test]
fn odd_exponents_keep_their_last_digits_at_small_heights() {
    // mpmath, 60 digits, the inputs as doubles: 2(h/B)^(1/n) and its integral.
    let cases = [
        (1000000000.0, 3.0, 1e-18, 2e-09, 1.5e-27),
        (0.3, 1.7, 1e-12, 3.546354928495595e-07, 2.2328901401638935e-19),
        (20000.0, 2.5, 3.7e-10, 6.4253780749078484e-06, 1.6981356340827885e-15),
        (0.001, 0.6, 1.8e-07, 1.1476712547172192e-06, 7.74678096934123e-14),
        (5000000000000.0, 6.0, 4.4e-09, 0.0006191232418226784, 2.33497908344553e-12),
        (1.0, 7.3, 1e-30, 0.00015539640039207797, 1.3667394251351438e-34),
    ];
    for (coefficient, exponent, h, length, reduced_force) in cases {
        let profile = Profile::foundation_power(coefficient, exponent).unwrap();
        assert_relative_eq!(profile.reduced_stiffness(h), length, max_relative = 9e-16);
        assert_relative_eq!(profile.reduced_force(h), reduced_force, max_relative = 9e-16);
        assert_relative_eq!(profile.height_of_reduced_force(reduced_force), h, max_relative = 9e-16);
    }
}

#[test]
fn area_and_volume_are_the_integrals_of_length() {
    for (name, profile) in profiles() {
        if name == "list" {
            continue;
        }
        for h in [1e-12, 3e-9, 1.8e-7, 4e-4] {
            let reduced_force = integral(|y| profile.reduced_stiffness(y), h);
            let reduced_energy = integral(|y| profile.reduced_force(y), h);
            assert_relative_eq!(profile.reduced_force(h), reduced_force, max_relative = 2e-14);
            assert_relative_eq!(profile.reduced_energy(h), reduced_energy, max_relative = 2e-14);
        }
    }
}

/// The exponent of the force at small h is that of the last decade: hm/M.
#[test]
fn forces_begin_with_their_first_power() {
    let others = [
        ("powers", Profile::powers(&[(1.0, 4.0), (2.0, 1.5)]).unwrap()),
        ("worn cone", Profile::truncated_cone(1e-4, 0.1).unwrap()),
        ("worn ball", Profile::truncated_paraboloid(1e-4, 1e-2).unwrap()),
        ("tip", Profile::tipped_paraboloid(1e-2, 1e-4).unwrap()),
        ("table", Profile::table(&[(0.0, 0.0), (1e-4, 1e-6), (2e-4, 4e-6), (3e-4, 9e-6)], &[]).unwrap()),
        ("law", Profile::normal_law(&[(0.0, 0.0), (1e-6, 1e-10), (2e-6, 4e-10)]).unwrap()),
    ];
    for (name, profile) in profiles().into_iter().chain(others) {
        let h = 1e-13;
        let power = h * profile.reduced_stiffness(h) / profile.reduced_force(h);
        let told = profile.first_power();
        assert!((told / power - 1.0).abs() < 1e-4, "{name}: {told} instead of {power}");
    }
}

#[test]
fn inverses_give_back_what_went_in() {
    for (name, profile) in profiles() {
        for h in [1e-9, 1.8e-7, 3e-6] {
            assert_relative_eq!(
                profile.height_of_reduced_force(profile.reduced_force(h)),
                h,
                max_relative = 2e-15
            );
            if name != "flat" && name != "list" {
                assert_relative_eq!(profile.depth(profile.radius(h)), h, max_relative = 4e-15);
                assert_relative_eq!(
                    profile.height_of_reduced_stiffness(profile.reduced_stiffness(h)),
                    h,
                    max_relative = 4e-15
                );
            }
        }
    }
}

#[test]
fn the_slope_of_the_depth_is_its_derivative() {
    // dg/da by a central difference of fourth order.
    for (name, profile) in profiles() {
        for a in [1e-6, 3e-5, 4e-4] {
            let step = 1e-3 * a;
            let g = |k: f64| profile.depth(a + k * step);
            let slope = (8.0 * (g(1.0) - g(-1.0)) - (g(2.0) - g(-2.0))) / (12.0 * step);
            let expected = if profile.is_strictly_convex() { slope } else { 0.0 };
            assert_relative_eq!(profile.depth_slope(a), expected, max_relative = 1e-10);
            assert_eq!(profile.is_strictly_convex(), name != "flat" && name != "list");
        }
    }
}

#[test]
fn a_gap_has_its_foundation() {
    // (4.20): g(x) = |x| ∫₀ˣ f'(r)/√(x²-r²) dr = x ∫₀^{π/2} f'(x sin φ) dφ, f' by differences.
    let half_pi = std::f64::consts::FRAC_PI_2;
    for (name, profile) in profiles().into_iter().filter(|(name, _)| !["flat", "list"].contains(name)) {
        let slope = |r: f64| {
            let step = 1e-4 * r;
            (profile.gap(r + step).unwrap() - profile.gap(r - step).unwrap()) / (2.0 * step)
        };
        for x in [1e-5, 1e-4, 7e-4] {
            let foundation = x * integral(|phi| slope(x * phi.sin().max(1e-30)), half_pi);
            assert_relative_eq!(foundation, profile.depth(x), max_relative = 1e-7);
        }
        assert_eq!((profile.gap(0.0), profile.gap(-1e-6)), (Some(0.0), None), "{name}");
    }
    let gap = |profile: Profile, r: f64| profile.gap(r);
    assert_relative_eq!(gap(Profile::paraboloid(2e-3).unwrap(), 1e-4).unwrap(), 2.5e-6, max_relative = 1e-15);
    assert_eq!(gap(Profile::sphere(2e-3).unwrap(), 2e-3), Some(2e-3));
    assert_eq!(gap(Profile::sphere(2e-3).unwrap(), 2.01e-3), None);
    let flat = Profile::flat(2e-3).unwrap();
    assert_eq!((flat.gap(2e-3), flat.gap(2.1e-3)), (Some(0.0), None));
    assert_eq!(gap(Profile::foundation(&[0.0], &[1e-6]).unwrap(), 0.0), None);
}

#[test]
fn a_list_counts_its_springs_by_hand() {
    let list = &profiles()[8].1;
    // Ascending: 0 (2 µm), 10 nm (3), 200 nm (4), 300 nm (1 + 1). A spring at h = g(x) does not touch yet.
    let lengths = [(0.0, 0.0), (1e-8, 2e-6), (1.1e-8, 5e-6), (2e-7, 5e-6), (3e-7, 9e-6), (4e-7, 11e-6)];
    for (h, length) in lengths {
        assert_relative_eq!(list.reduced_stiffness(h), length, max_relative = 1e-15);
    }
    // M(250 nm) = 250·2 + 240·3 + 50·4 nm·µm; N is half the sum with squares.
    assert_relative_eq!(list.reduced_force(2.5e-7), 1420e-15, max_relative = 1e-15);
    let reduced_energy = 0.5 * (250.0 * 250.0 * 2.0 + 240.0 * 240.0 * 3.0 + 50.0 * 50.0 * 4.0) * 1e-24;
    assert_relative_eq!(list.reduced_energy(2.5e-7), reduced_energy, max_relative = 1e-15);
    assert_relative_eq!(list.height_of_reduced_force(1420e-15), 2.5e-7, max_relative = 1e-15);
    assert_eq!(
        (list.height_of_reduced_stiffness(4.9e-6), list.height_of_reduced_stiffness(5.1e-6)),
        (1e-8, 2e-7)
    );
    assert_eq!(list.height_of_reduced_stiffness(12e-6), f64::INFINITY);
}

#[test]
fn a_long_list_tends_to_the_smooth_profile() {
    // Midpoints of equal cells under a paraboloid: second order in the cell.
    let paraboloid = Profile::paraboloid(1e-3).unwrap();
    let (count, span) = (20_000, 4e-5);
    let cell = span / f64::from(count);
    let heights: Vec<f64> = (0..count)
        .map(|i| paraboloid.depth((f64::from(i) + 0.5 - 0.5 * f64::from(count)).abs() * cell))
        .collect();
    let list = Profile::foundation(&heights, &vec![cell; heights.len()]).unwrap();
    for h in [5e-8, 1.8e-7, 3e-7] {
        assert_relative_eq!(list.reduced_force(h), paraboloid.reduced_force(h), max_relative = 1e-7);
        assert_relative_eq!(list.reduced_energy(h), paraboloid.reduced_energy(h), max_relative = 1e-7);
    }
}

#[test]
fn nothing_touches_at_or_below_zero() {
    for (_, profile) in profiles() {
        for h in [0.0, -0.0, -1e-9, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(profile.reduced_stiffness(h), 0.0);
            assert_eq!(profile.reduced_force(h), 0.0);
            assert_eq!(profile.reduced_energy(h), 0.0);
            assert_eq!(profile.radius(h), 0.0);
            assert_eq!(profile.depth(h), 0.0);
            assert_eq!(profile.height_of_reduced_force(h), 0.0);
        }
    }
}

/// The smallest positive height must give finite results for a steep power.
#[test]
fn steep_powers_have_lengths_at_the_least_heights() {
    for exponent in [2.5, 4.91, 5.0, 6.0, 8.0] {
        for coefficient in [1e5, 2e22, 1e60] {
            let profile = Profile::power(coefficient, exponent).unwrap();
            for h in [f64::MIN_POSITIVE, 1e-320, 1e-200] {
                let [m, force] = [profile.reduced_stiffness(h), profile.reduced_force(h)];
                let bound = 2.0 * (h / coefficient).powf(1.0 / exponent);
                assert!(
                    (0.0..=bound).contains(&m) && force >= 0.0,
                    "{coefficient} r^{exponent} at {h}: {m}, {force}"
                );
            }
        }
    }
}

#[test]
fn a_flat_punch_touches_at_once_and_a_sphere_has_an_end() {
    let flat = Profile::flat(2e-3).unwrap();
    assert_eq!(flat.reduced_stiffness(1e-30), 4e-3);
    assert_relative_eq!(flat.reduced_force(1e-9), 4e-12, max_relative = 1e-15);
    assert_relative_eq!(flat.reduced_energy(2e-9), 8e-21, max_relative = 1e-15);
    assert_eq!((flat.depth(2e-3), flat.depth(2.1e-3)), (0.0, f64::INFINITY));
    assert_eq!((flat.exponent(), flat.reach()), (None, None));
    let sphere = Profile::sphere(2.0).unwrap();
    // 0.999 artanh 0.999 = 3.79640096608295 (mpmath)
    assert_relative_eq!(sphere.reach().unwrap(), 2.0 * 3.79640096608295, max_relative = 1e-13);
    assert_eq!(sphere.depth(2.0), f64::INFINITY);
    assert!(
        sphere.reduced_force(1e6).is_finite()
            && sphere.reduced_energy(1e6).is_finite()
            && sphere.radius(1e6) <= 2.0
    );
    assert_relative_eq!(sphere.height_of_reduced_force(sphere.reduced_force(1e6)), 1e6, max_relative = 1e-14);
}

#[test]
fn what_is_out_of_range_is_refused() {
    for bad in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(Profile::flat(bad), Err(ProfileError::Radius(bad)));
        assert_eq!(Profile::paraboloid(bad), Err(ProfileError::Radius(bad)));
        assert_eq!(Profile::sphere(bad), Err(ProfileError::Radius(bad)));
        assert_eq!(Profile::cone(bad), Err(ProfileError::Slope(bad)));
        assert_eq!(Profile::power(bad, 2.0), Err(ProfileError::Coefficient(bad)));
        assert_eq!(Profile::power(1.0, bad), Err(ProfileError::Exponent(bad)));
        assert_eq!(Profile::foundation_power(bad, 2.0), Err(ProfileError::Coefficient(bad)));
        assert_eq!(
            Profile::foundation(&[0.0, 1.0], &[1.0, bad]),
            Err(ProfileError::Length { index: 1, value: bad })
        );
    }
    assert!(Profile::sphere(f64::NAN).is_err() && Profile::foundation(&[f64::NAN], &[1.0]).is_err());
    assert!(Profile::foundation_power(1e-310, 2.0).is_err(), "its reciprocal is infinite");
    assert_eq!(Profile::foundation(&[], &[]), Err(ProfileError::Empty));
    assert_eq!(Profile::foundation(&[0.0], &[]), Err(ProfileError::Unpaired { heights: 1, lengths: 0 }));
    assert_eq!(Profile::foundation(&[-1.0], &[1.0]), Err(ProfileError::Height { index: 0, value: -1.0 }));
    let said = ProfileError::Radius(-1.0).to_string();
    assert_eq!(said, "expected a radius above 0 m, got -1");
}
