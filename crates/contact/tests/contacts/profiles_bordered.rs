//! Tests of profiles with a border (truncated, rounded, tipped) and sums of powers.
//!
//! References are values with 50 digits, an independent quadrature of the transform (4.20), and limits of the parameters.

use std::f64::consts::FRAC_PI_2;
use stickslip_contact::{Apex, Curve, Interface, Pair, Profile, ProfileError, Row, Segment, Springs};

const B: f64 = 2e-5;
const SLOPE: f64 = 0.01;
const R: f64 = 5e-3;
const TERMS: [(f64, f64); 4] = [(0.0003, 0.7), (2.0, 1.5), (100.0, 2.0), (3e8, 4.25)];

/// Kind, h, a, M, N, by mpmath with 50 digits.
///
/// a is found by bisection of the handbook's g. M = 2∫(h-g)dx and N = ∫(h-g)²dx over 0…a are computed by quadrature.
const VALUES: [(&str, f64, f64, f64, f64); 42] = [
    ("TruncatedCone", 2.0000000000000002e-19, 2e-05, 8.000000000000001e-24, 8.000000000000002e-43),
    (
        "TruncatedCone",
        2.0000000000000003e-13,
        2.000000000001e-05,
        8.000000000001335e-18,
        8.00000000000067e-31,
    ),
    (
        "TruncatedCone",
        2.0000000000000003e-10,
        2.0000009999994168e-05,
        8.000001333332868e-15,
        8.000000666666514e-25,
    ),
    ("TruncatedCone", 1e-08, 2.0024963645895295e-05, 4.001665211313651e-13, 2.0004164239838576e-21),
    ("TruncatedCone", 8e-08, 2.1473080379100348e-05, 3.2810889702725407e-12, 1.296484572461806e-19),
    (
        "TruncatedCone",
        2.0000000000000002e-07,
        2.706048207599063e-05,
        9.057749663574939e-12,
        8.564388601961683e-19,
    ),
    (
        "TruncatedCone",
        5.000000000000001e-07,
        4.502433776066305e-05,
        3.0579859977011593e-11,
        6.531353926010031e-18,
    ),
    (
        "TruncatedCone",
        8.000000000000001e-06,
        0.000522031330168685,
        4.280580255491906e-09,
        1.1698608459479612e-14,
    ),
    ("TruncatedCone", 0.02, 1.2732522771306105, 0.025465300193067607, 0.00016977036564045866),
    ("TruncatedParaboloid", 8.000000000000001e-20, 2e-05, 3.2000000000000005e-24, 1.2800000000000004e-43),
    (
        "TruncatedParaboloid",
        8.000000000000001e-14,
        2.000000000001e-05,
        3.200000000000534e-18,
        1.2800000000001071e-31,
    ),
    (
        "TruncatedParaboloid",
        8.000000000000001e-11,
        2.00000099999875e-05,
        3.200000533332934e-15,
        1.2800001066666136e-25,
    ),
    ("TruncatedParaboloid", 4e-09, 2.002492228255625e-05, 1.6006654213310262e-13, 3.2006658356678187e-22),
    ("TruncatedParaboloid", 3.2e-08, 2.135708242006183e-05, 1.3107907163818347e-12, 2.0734384061912446e-20),
    (
        "TruncatedParaboloid",
        8.000000000000001e-08,
        2.5440392990281383e-05,
        3.5522033885712664e-12,
        1.3586200677669381e-19,
    ),
    (
        "TruncatedParaboloid",
        2.0000000000000002e-07,
        3.492569115591783e-05,
        1.084056926369886e-11,
        9.766730810791873e-19,
    ),
    (
        "TruncatedParaboloid",
        3.2000000000000003e-06,
        0.0001272841307908244,
        5.497831192589973e-10,
        7.122121698858026e-16,
    ),
    (
        "TruncatedParaboloid",
        0.008000000000000002,
        0.0063245711317448244,
        6.746242938071863e-05,
        2.1588085340099593e-07,
    ),
    (
        "RoundedFlat",
        8.000000000000001e-20,
        2.0000000208008383e-05,
        3.200000019968805e-24,
        1.2800000059906415e-43,
    ),
    (
        "RoundedFlat",
        8.000000000000001e-14,
        2.0002080004508263e-05,
        3.200199682608149e-18,
        1.2800599051087577e-31,
    ),
    (
        "RoundedFlat",
        8.000000000000001e-11,
        2.0207223953075894e-05,
        3.219914882275019e-15,
        1.285977681346582e-25,
    ),
    ("RoundedFlat", 4e-09, 2.2695720786459993e-05, 1.7310141698048785e-13, 3.3977770180045737e-22),
    ("RoundedFlat", 3.2e-08, 2.9776656776590372e-05, 1.6685560874268828e-12, 2.5229039198138464e-20),
    (
        "RoundedFlat",
        8.000000000000001e-08,
        3.6714729630677214e-05,
        4.882993492015927e-12,
        1.7982508481232648e-19,
    ),
    (
        "RoundedFlat",
        2.0000000000000002e-07,
        4.801407517141307e-05,
        1.5147429721842502e-11,
        1.3547837098452072e-18,
    ),
    (
        "RoundedFlat",
        3.2000000000000003e-06,
        0.00014238238569562998,
        6.423886332778904e-10,
        8.560996200620546e-16,
    ),
    (
        "RoundedFlat",
        0.008000000000000002,
        0.0063402669787206625,
        6.771336885073788e-05,
        2.1688409344129698e-07,
    ),
    (
        "TippedParaboloid",
        8.000000000000001e-20,
        1.2732395447351627e-17,
        1.0185916357881302e-36,
        2.7162443621016812e-56,
    ),
    (
        "TippedParaboloid",
        7.200000000000001e-08,
        1.1459155902616464e-05,
        8.250592249883856e-13,
        1.9801421399721256e-20,
    ),
    (
        "TippedParaboloid",
        1.2000000000000002e-07,
        1.9098593171027442e-05,
        2.291831180523293e-12,
        9.167324722093174e-20,
    ),
    ("TippedParaboloid", 1.25664e-07, 2.000004672583275e-05, 2.5132858771418987e-12, 1.0527651882172028e-19),
    (
        "TippedParaboloid",
        1.2640000000000002e-07,
        2.011212997572178e-05,
        2.5428091524966367e-12,
        1.0713715168711952e-19,
    ),
    (
        "TippedParaboloid",
        1.6000000000000003e-07,
        2.418836450557565e-05,
        4.037994502048272e-12,
        2.169340096446358e-19,
    ),
    ("TippedParaboloid", 5.6e-07, 5.0963768893437e-05, 3.540635369754385e-11, 7.411609385861126e-18),
    (
        "TippedParaboloid",
        2.4000000000000004e-05,
        0.0003461212855284213,
        1.1057431612736859e-08,
        1.0597472439262833e-13,
    ),
    (
        "TippedParaboloid",
        0.008000000000000002,
        0.006324539508915518,
        6.746141745355391e-05,
        2.1587545647409488e-07,
    ),
    ("Powers", 1e-15, 2.4357745781427946e-17, 2.0059320059255953e-32, 5.850635017896944e-48),
    ("Powers", 1e-10, 3.3834151702178086e-10, 2.7866272363649495e-20, 8.128104875964339e-31),
    ("Powers", 1e-08, 2.2957638264247288e-07, 1.9260353450938674e-15, 5.673810831816471e-24),
    ("Powers", 1e-06, 2.8717235375131657e-05, 3.204532194947533e-11, 1.131664294742803e-17),
    ("Powers", 0.0001, 0.0005001314364115314, 6.45707388120726e-08, 2.5151433004905646e-12),
    ("Powers", 0.01, 0.002579055571882673, 4.02536014566156e-05, 1.7538913847229388e-07),
];

/// Profile, its f′, and the kink of f′.
struct Specimen {
    name: &'static str,
    profile: Profile,
    slope: fn(f64) -> f64,
    border: Option<f64>,
}

fn specimens() -> Vec<Specimen> {
    let specimen = |name, profile: Result<Profile, ProfileError>, slope, border| Specimen {
        name,
        profile: profile.unwrap(),
        slope,
        border,
    };
    let powers = |r: f64| TERMS.iter().map(|(a, n)| a * n * r.powf(n - 1.0)).sum();
    vec![
        specimen(
            "TruncatedCone",
            Profile::truncated_cone(B, SLOPE),
            |r| if r < B { 0.0 } else { SLOPE },
            Some(B),
        ),
        specimen(
            "TruncatedParaboloid",
            Profile::truncated_paraboloid(B, R),
            |r| if r < B { 0.0 } else { r / R },
            Some(B),
        ),
        specimen("RoundedFlat", Profile::rounded_flat(B, R), |r| (r - B).max(0.0) / R, Some(B)),
        specimen("TippedParaboloid", Profile::tipped_paraboloid(R, B), |r| r.max(B) / R, Some(B)),
        specimen("Powers", Profile::powers(&TERMS), powers, None),
    ]
}

/// Asserts that two values agree relative to their size. The macros of `approx` would compare absolutely far below 1.
#[track_caller]
fn close(got: f64, want: f64, tolerance: f64) {
    assert!(
        (got - want).abs() <= tolerance * want.abs(),
        "{got:e} is not {want:e}: {:.1e}",
        got / want - 1.0
    );
}

/// Integral of f by tanh-sinh quadrature, suitable for roots at the ends. The arguments of f are the distances from both ends.
fn integral(f: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    let step = 1.0 / 64.0;
    let node = |k: i32| {
        let t = f64::from(k) * step;
        let e = (2.0 * FRAC_PI_2 * t.sinh()).exp();
        let x = if e.is_infinite() { 1.0 } else { e / (1.0 + e) };
        let weight = FRAC_PI_2 * t.cosh() / (FRAC_PI_2 * t.sinh()).cosh().powi(2);
        if weight.is_finite() && weight > 1e-30 { 0.5 * weight * f(from + (to - from) * x) } else { 0.0 }
    };
    (-256..=256).map(node).sum::<f64>() * step * (to - from)
}

#[test]
fn they_agree_with_50_digit_values() {
    for Specimen { name, profile, .. } in specimens() {
        let rows: Vec<_> = VALUES.iter().filter(|row| row.0 == name).collect();
        assert!(rows.len() >= 6, "{name}");
        for &&(_, h, a, force, energy) in &rows {
            close(profile.radius(h), a, 4e-15);
            close(profile.reduced_force(h), force, 1e-14);
            close(profile.reduced_energy(h), energy, 2e-14);
            close(profile.height_of_reduced_force(force), h, 1e-14);
            if a > 1.001 * B {
                close(profile.depth(a), h, 1e-12);
            }
        }
    }
}

#[test]
fn g_is_the_transform_of_f() {
    for Specimen { name, profile, slope, border } in specimens() {
        for x in [0.3 * B, 1.01 * B, 1.7 * B, 12.0 * B, 400.0 * B] {
            // Substitution r = x sinθ, split at the kink of f′.
            let part = |from, to| integral(|angle: f64| slope(x * angle.max(1e-30).sin()), [from, to]);
            let kink = border.filter(|b| *b < x).map_or(0.0, |b| (b / x).asin());
            let transform = x * (part(0.0, kink) + part(kink, FRAC_PI_2));
            close(profile.depth(x), transform, 2e-13);
            if transform == 0.0 {
                continue;
            }
            // f by its slope, and dg/da by differences.
            let kink = border.filter(|b| *b < x).unwrap_or(0.0);
            let above = |r: f64| slope(r.max(1e-40));
            let gap = integral(above, [0.0, kink]) + integral(above, [kink, x]);
            close(profile.gap(x).unwrap(), gap, 1e-13);
            let step = 1e-5 * (x - border.map_or(0.0, |b| if b < x { b } else { 0.0 }));
            let difference = (profile.depth(x + step) - profile.depth(x - step)) / (2.0 * step);
            close(profile.depth_slope(x), difference, 1e-7);
        }
        assert_eq!(profile.borders(), border.as_slice(), "{name}");
        assert_eq!((profile.gap(0.0), profile.gap(-1e-6)), (Some(0.0), None), "{name}");
    }
}

#[test]
fn stiffness_force_and_energy_are_derivatives_of_each_other() {
    for Specimen { name, profile, .. } in specimens() {
        // Heights on every scale of the borders.
        for k in -24..40 {
            let h = 1e-9 * 10f64.powf(f64::from(k) / 8.0);
            let step = 1e-4 * h;
            let slope = |f: &dyn Fn(f64) -> f64| (f(h + step) - f(h - step)) / (2.0 * step);
            let (m, force) = (profile.reduced_stiffness(h), profile.reduced_force(h));
            close(slope(&|h| profile.reduced_force(h)), m, 1e-7);
            close(slope(&|h| profile.reduced_energy(h)), force, 1e-7);
            let forward = integral(|y| profile.reduced_stiffness(y), [0.0, h]);
            if name != "TippedParaboloid" {
                close(force, forward, 2e-13);
            }
            close(profile.height_of_reduced_force(force), h, 1e-14);
            // Immediately beyond a border, a radius has few significant digits for the distance from the border.
            if profile.borders().is_empty() || profile.radius(h) > 1.001 * B {
                close(profile.depth(profile.radius(h)), h, 1e-12);
            }
        }
    }
}

#[test]
fn at_the_ends_of_their_parameters_they_are_what_is_known() {
    let near = |profile: &Profile, other: &Profile, h: f64, tolerance: f64| {
        close(profile.reduced_stiffness(h), other.reduced_stiffness(h), tolerance);
        close(profile.reduced_force(h), other.reduced_force(h), tolerance);
        close(profile.reduced_energy(h), other.reduced_energy(h), tolerance);
    };
    let (tiny, h) = (1e-12, 1e-6);
    // Without a flat or tip the results are those of cone and paraboloid, to order b/a for a rounded flat and (b/a)² for a truncated
    // paraboloid.
    near(&Profile::truncated_cone(tiny, SLOPE).unwrap(), &Profile::cone(SLOPE).unwrap(), h, 1e-7);
    let ball = Profile::paraboloid(R).unwrap();
    near(&Profile::truncated_paraboloid(tiny, R).unwrap(), &ball, h, 1e-14);
    near(&Profile::rounded_flat(tiny, R).unwrap(), &ball, h, 1e-7);
    near(&Profile::tipped_paraboloid(R, tiny).unwrap(), &ball, h, 1e-7);
    // At small indentation a truncated profile is a flat punch, and a tip a cone.
    let flat = Profile::flat(B).unwrap();
    near(&Profile::truncated_cone(B, SLOPE).unwrap(), &flat, 1e-15, 1e-14);
    near(&Profile::truncated_paraboloid(B, R).unwrap(), &flat, 1e-16, 1e-14);
    near(&Profile::rounded_flat(B, R).unwrap(), &flat, 1e-25, 1e-8);
    near(&Profile::tipped_paraboloid(R, B).unwrap(), &Profile::cone(B / R).unwrap(), 1e-8, 1e-15);
    // A single term with a coefficient above 0 is a power law.
    let one = Profile::powers(&[(0.0, 0.3), (7.0, 3.0)]).unwrap();
    assert_eq!(one, Profile::power(7.0, 3.0).unwrap());
    // Two equal terms are one power law.
    near(&Profile::powers(&[(3.5, 3.0), (3.5, 3.0)]).unwrap(), &one, h, 3e-15);
    near(&Profile::powers(&[(3.5, 2.7), (3.5, 2.7)]).unwrap(), &Profile::power(7.0, 2.7).unwrap(), h, 3e-15);
}

#[test]
fn units_are_of_no_account() {
    // Lengths scaled by 2⁴⁰ or 2⁻⁴⁰ give identical digits.
    for scale in [2f64.powi(40), 2f64.powi(-40)] {
        let pairs = [
            (Profile::truncated_cone(B, SLOPE), Profile::truncated_cone(scale * B, SLOPE)),
            (Profile::truncated_paraboloid(B, R), Profile::truncated_paraboloid(scale * B, scale * R)),
            (Profile::rounded_flat(B, R), Profile::rounded_flat(scale * B, scale * R)),
            (Profile::tipped_paraboloid(R, B), Profile::tipped_paraboloid(scale * R, scale * B)),
        ];
        for (own, scaled) in pairs.map(|(own, scaled)| (own.unwrap(), scaled.unwrap())) {
            for h in [1e-12, 1e-8, 1e-5] {
                let (force, energy) = (scaled.reduced_force(scale * h), scaled.reduced_energy(scale * h));
                close(force, scale * scale * own.reduced_force(h), 1e-14);
                close(energy, scale.powi(3) * own.reduced_energy(h), 1e-14);
            }
        }
    }
}

#[test]
fn curve_and_row_agree_through_histories() {
    let mut draws = 11_u64;
    let mut draw = || {
        draws = draws.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (draws >> 11) as f64 / (1u64 << 53) as f64
    };
    for Specimen { name, profile, .. } in specimens() {
        let deepest = profile.depth(3.0 * B);
        let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), profile, 0.3).unwrap();
        let springs = Springs::new(law.profile(), 100_000, 6.0 * B).unwrap();
        let u = law.gross_slip_displacement(deepest);
        let mut curve = Curve::new(&law, Apex::default());
        let mut row = Row::new(&springs);
        let limit = law.friction() * law.normal_force(deepest);
        let mut worst = 0.0_f64;
        for _ in 0..60 {
            let to = Apex { d: deepest * (1.1 * draw() - 0.1), u: 2.0 * u * (draw() - 0.5) };
            curve.commit(&law, Segment::Straight(to)).unwrap();
            row.commit(&springs, &law, Segment::Straight(to)).unwrap();
            worst = worst.max((curve.force(&law) - row.force(&springs, &law, to)).abs() / limit);
        }
        // Cells of 1/100 000 of the width; the edge of a flat may lie within a cell.
        assert!(worst < 3e-8, "{name}: {worst:e}");
    }
}

/// At constant indentation a straight path and its parts have the same slip and the same friction work. The test includes thin strips
/// at a border, where differences of M or N would have no accuracy.
#[test]
fn chords_across_a_border_lose_what_one_does() {
    for Specimen { name, profile, border, .. } in specimens() {
        let deepest = border.map_or(1e-7, |border| profile.depth(1.5 * border));
        let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), profile, 0.3).unwrap();
        let (start, end) = (Apex { d: deepest, u: 0.0 }, 0.99 * law.gross_slip_displacement(deepest));
        let work = |chords: u32| -> f64 {
            let mut curve = Curve::new(&law, start);
            let at = |k| Apex { u: end * f64::from(k) / f64::from(chords), ..start };
            (1..=chords).map(|k| curve.commit(&law, Segment::Straight(at(k))).unwrap()).sum()
        };
        let whole = work(1);
        for chords in [30, 100, 1000] {
            let off = (work(chords) / whole - 1.0).abs();
            assert!(off < 1e-12, "{name}, {chords} chords: {off:e}");
        }
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    for bad in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(Profile::truncated_cone(bad, 1.0), Err(ProfileError::Flat(bad)));
        assert_eq!(Profile::truncated_cone(1.0, bad), Err(ProfileError::Slope(bad)));
        assert_eq!(Profile::truncated_paraboloid(bad, 1.0), Err(ProfileError::Flat(bad)));
        assert_eq!(Profile::truncated_paraboloid(1.0, bad), Err(ProfileError::Radius(bad)));
        assert_eq!(Profile::rounded_flat(bad, 1.0), Err(ProfileError::Flat(bad)));
        assert_eq!(Profile::rounded_flat(1.0, bad), Err(ProfileError::Radius(bad)));
        assert_eq!(Profile::tipped_paraboloid(bad, 1.0), Err(ProfileError::Radius(bad)));
        assert_eq!(Profile::tipped_paraboloid(1.0, bad), Err(ProfileError::Tip(bad)));
        let exponent = Err(ProfileError::TermExponent { index: 1, value: bad });
        assert_eq!(Profile::powers(&[(1.0, 1.0), (1.0, bad)]), exponent);
    }
    let coefficient = Err(ProfileError::TermCoefficient { index: 1, value: -2.0 });
    assert_eq!(Profile::powers(&[(1.0, 1.0), (-2.0, 2.0)]), coefficient);
    assert!(Profile::powers(&[(f64::NAN, 1.0)]).is_err());
    assert_eq!(Profile::powers(&[]), Err(ProfileError::NoTerm));
    assert_eq!(Profile::powers(&[(0.0, 2.0)]), Err(ProfileError::NoTerm));
}
