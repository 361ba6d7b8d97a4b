//! Tests of stresses and displacements against closed forms and independent quadrature: handbook (4.34)–(4.38).

use approx::assert_relative_eq;
use std::f64::consts::PI;
use stickslip_contact::{
    Apex, Curve, Engine, Fields, FirstLoading, FrictionMap, Interface, Memory, NormalGiven, Pair, Profile,
    Segment, SpringState, Springs, TangentialGiven, ZoneKind,
};

/// Pseudo-random numbers, the same on every machine (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    /// Random number in [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }
}

const MODULI: (f64, f64) = (3.0, 2.2);

fn interface(profile: Profile, friction: f64) -> Interface {
    Interface::new(Pair::from_moduli(MODULI.0, MODULI.1).unwrap(), profile, friction).unwrap()
}

/// Memory of a contact that is pressed to d and then moved to each of the displacements.
fn pushed(law: &Interface, d: f64, ways: &[f64]) -> Memory {
    let mut memory = Engine::Curve.memory(law, Apex { d, u: 0.0 });
    for &u in ways {
        memory.commit(law, Segment::Straight(Apex { d, u })).unwrap();
    }
    memory
}

/// Integral of f over a range by double-exponential quadrature (Takahasi and Mori 1974), suitable for end singularities.
///
/// The arguments of `f` are the position and its distances from both ends.
fn double_exponential([from, to]: [f64; 2], f: impl Fn(f64, f64, f64) -> f64) -> f64 {
    let (half, step) = (0.5 * (to - from), 1.0 / 64.0);
    let node = |k: i32| {
        let t = f64::from(k) * step;
        let s = 0.5 * PI * t.sinh();
        let (near, far) = (1.0 / (1.0 + (2.0 * s).exp()), 1.0 / (1.0 + (-2.0 * s).exp()));
        // `far` increases from 0 to 1 along the range.
        let weight = 0.5 * PI * t.cosh() / s.cosh().powi(2);
        let (left, right) = (2.0 * half * far, 2.0 * half * near);
        let value = f(if far < 0.5 { from + left } else { to - right }, left, right);
        if weight > 0.0 && value.is_finite() { weight * value } else { 0.0 }
    };
    half * step * (-250..=250).map(node).sum::<f64>()
}

/// Pressure p(r)/E* of (4.34), independent of the code under test: x² = r² + y².
fn pressure(slope: impl Fn(f64) -> f64, a: f64, r: f64) -> f64 {
    if r >= a {
        return 0.0;
    }
    double_exponential([0.0, (a * a - r * r).sqrt()], |y, _, _| {
        let x = r.hypot(y);
        slope(x) / x
    }) / PI
}

/// Integral (2/π) ∫₀ʳ u(x)/√(r²-x²) dx with corners at `corners`, by x = r sin φ.
fn surface(line: impl Fn(f64) -> f64, corners: &[f64], r: f64) -> f64 {
    let mut angles: Vec<f64> = corners.iter().filter(|c| **c < r).map(|c| (c / r).asin()).collect();
    angles.insert(0, 0.0);
    angles.push(0.5 * PI);
    let part = |pair: &[f64]| double_exponential([pair[0], pair[1]], |phi, _, _| line(r * phi.sin()));
    2.0 / PI * angles.windows(2).map(part).sum::<f64>()
}

/// Integral 2π ∫ f(r) r dr over the contact, split at the borders of its zones and at `corners`.
fn over_area(fields: &Fields<'_>, corners: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    let mut ends = vec![0.0];
    ends.extend(corners.iter().filter(|c| **c < fields.radius()));
    ends.push(fields.radius());
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let part = |pair: &[f64]| double_exponential([pair[0], pair[1]], |r, _, _| f(r) * r);
    2.0 * PI * ends.windows(2).map(part).sum::<f64>()
}

/// Power laws g = Bxⁿ: profile, B and n.
fn powers() -> Vec<(Profile, f64, f64)> {
    let of = |b: f64, n: f64| (Profile::foundation_power(b, n).unwrap(), b, n);
    let all = [1.0, 2.0, 4.0, 3.0, 6.0, 0.6, 1.5, 2.5, 2.999, 3.000_01, 7.25, 80.0];
    all.into_iter().map(|n| of(1.3, n)).collect()
}

#[test]
fn normal_and_first_loading_fields_of_power_laws_obey_4_34_to_4_36() {
    for (profile, b, n) in powers() {
        let law = interface(profile, 0.4);
        let (a, friction) = (0.8_f64, 0.4);
        let d = b * a.powf(n);
        for share in [0.2, 0.5, 0.95] {
            let c = share * a;
            let given = TangentialGiven::StickRadius(c);
            let loading = FirstLoading::solve(&law, NormalGiven::Radius(a), given).unwrap();
            let memory = pushed(&law, d, &[loading.u]);
            let fields = Fields::of(&law, &memory).unwrap();
            let slope = |x: f64| n * b * x.powf(n - 1.0);
            let kappa = law.stick_slope();
            for r in [1e-6, 0.03, 0.3 * c, 0.999 * c, 1.001 * c, 0.5 * (a + c), 0.9999 * a] {
                let field = fields.at(r);
                let whole = MODULI.0 * pressure(slope, a, r);
                let part = MODULI.0 * pressure(slope, c, r);
                let scale = MODULI.0 * d / a;
                let close = |got: f64, want: f64, scale: f64, what: &str| {
                    assert!(
                        (got - want).abs() < 1e-10 * scale,
                        "n {n} c/a {share} r {r} {what}: {got}, {want}"
                    );
                };
                close(field.pressure, whole, whole.max(scale), "p");
                close(field.shear, friction * (whole - part), whole.max(scale), "τ");
            }
            // (4.36): u₀ up to c, then u = (2/π){u₀ arcsin(c/r) + κ∫_c^min(r,a) (d-g)/√(r²-x²) dx}.
            for r in [0.5 * c, c, 1.001 * c, 0.5 * (a + c), a, 1.0001 * a, 1.3 * a, 1.6 * a, 9.0 * a] {
                let line = |x: f64| {
                    if x < c { loading.u } else { kappa * (d - b * x.powf(n)).max(0.0) }
                };
                let want = surface(line, &[c, a], r);
                let got = fields.at(r).displacement;
                assert!((got - want).abs() < 1e-10 * loading.u, "n {n} c/a {share} r {r} u: {got}, {want}");
            }
        }
    }
}

#[test]
fn hertz_and_cattaneo_have_their_published_forms() {
    // p = p₀√(1-r²/a²), p₀ = 2E*a/(πR); τ = μp₀[√(1-r²/a²) - (c/a)√(1-r²/c²)]: Cattaneo 1938.
    let (radius, a, friction) = (2.0, 0.05, 0.3);
    let law = interface(Profile::paraboloid(radius).unwrap(), friction);
    let p0 = 2.0 * MODULI.0 * a / (PI * radius);
    for share in [0.1, 0.5, 0.9] {
        let c = share * a;
        let u = law.stick_slope() * (a * a - c * c) / radius;
        let memory = pushed(&law, a * a / radius, &[u]);
        let fields = Fields::of(&law, &memory).unwrap();
        let centre = fields.at(0.0);
        assert_relative_eq!(centre.pressure, p0, max_relative = 1e-14);
        assert_relative_eq!(centre.shear / centre.pressure, friction * (1.0 - share), max_relative = 1e-14);
        for r in [0.01 * a, 0.4 * a, 0.8 * a, 0.99 * a] {
            let root = |edge: f64| (1.0 - r * r / (edge * edge)).max(0.0).sqrt();
            let field = fields.at(r);
            assert_relative_eq!(field.pressure, p0 * root(a), max_relative = 1e-13);
            let want = friction * p0 * (root(a) - share * root(c));
            assert_relative_eq!(field.shear, want, max_relative = 1e-11);
            // Inside r < a the surface is a paraboloid: w = d - r²/2R.
            assert_relative_eq!(
                field.deflection,
                a * a / radius - r * r / (2.0 * radius),
                max_relative = 1e-13
            );
        }
        // In the ring τ = μp to the last bit.
        let field = fields.at(0.5 * (a + c));
        assert_eq!(field.shear, friction * field.pressure);
        assert_eq!(field.state, SpringState::SlipForward);
        assert_eq!(fields.at(0.5 * c).state, SpringState::Stick);
        assert_eq!(fields.at(a).pressure, 0.0);
    }
}

#[test]
fn the_cone_has_its_closed_forms() {
    // Handbook 2.5.2: p = (E* tanθ/2) arcosh(a/r); w outside = d (2/π)[arcsin s - (1-√(1-s²))/s], s = a/r.
    let (slope, a) = (0.1, 0.7);
    let law = interface(Profile::cone(slope).unwrap(), 0.5);
    let d = 0.5 * PI * slope * a;
    let memory = pushed(&law, d, &[0.4 * law.stick_slope() * d]);
    let fields = Fields::of(&law, &memory).unwrap();
    for r in [1e-9, 0.1, 0.4, 0.69] {
        let want: f64 = 0.5 * MODULI.0 * slope * (a / r).acosh();
        assert_relative_eq!(fields.at(r).pressure, want, max_relative = 1e-12);
    }
    for r in [0.71, 0.9, 1.5, 20.0] {
        let s: f64 = a / r;
        let want = d * 2.0 / PI * (s.asin() - (1.0 - (1.0 - s * s).sqrt()) / s);
        assert_relative_eq!(fields.at(r).deflection, want, max_relative = 1e-10);
    }
    // At the tip both pressures are infinite, but τ = μ(E*/π)(π/2)tanθ ln(a/c) is finite.
    let tip = fields.at(0.0);
    assert_eq!(tip.pressure, f64::INFINITY);
    let want = 0.5 * 0.5 * MODULI.0 * slope * (1.0_f64 / 0.6).ln();
    assert_relative_eq!(tip.shear, want, max_relative = 1e-12);
}

#[test]
fn a_stuck_punch_is_boussinesq_twice() {
    // p = E*d/(π√(b²-r²)), τ = G*u/(π√(b²-r²)); w = d(2/π) arcsin(b/r) outside.
    let b = 0.3;
    let law = interface(Profile::flat(b).unwrap(), 0.4);
    let (d, u) = (0.01, 0.002);
    let memory = pushed(&law, d, &[u]);
    let fields = Fields::of(&law, &memory).unwrap();
    for r in [0.0, 0.1, 0.29999] {
        let root = PI * ((b - r) * (b + r)).sqrt();
        let field = fields.at(r);
        assert_relative_eq!(field.pressure, MODULI.0 * d / root, max_relative = 1e-13);
        assert_relative_eq!(field.shear, MODULI.1 * u / root, max_relative = 1e-13);
        assert_relative_eq!(field.displacement, u, max_relative = 1e-14);
        assert_eq!(field.state, SpringState::Stick);
    }
    assert_relative_eq!(fields.at(0.6).displacement, u / 3.0, max_relative = 1e-13);
    assert_eq!(fields.zones().len(), 1);
    let slid = pushed(&law, d, &[1.0]);
    let fields = Fields::of(&law, &slid).unwrap();
    let field = fields.at(0.1);
    assert_eq!((field.shear, field.state), (0.4 * field.pressure, SpringState::SlipForward));
}

#[test]
fn stresses_add_up_to_the_forces() {
    let profiles = powers().into_iter().map(|(profile, ..)| profile);
    for profile in profiles.chain([Profile::sphere(1.5).unwrap()]) {
        let law = interface(profile, 0.4);
        let d = law.profile().depth(0.5);
        let u_c = law.gross_slip_displacement(d);
        let memory = pushed(&law, d, &[0.7 * u_c, -0.1 * u_c, 0.3 * u_c]);
        let fields = Fields::of(&law, &memory).unwrap();
        let zones = fields.zones();
        assert_eq!(zones.len(), 4, "{zones:?}");
        let kinds: Vec<ZoneKind> = zones.iter().map(|zone| zone.kind).collect();
        assert_eq!(kinds, [ZoneKind::Stick, ZoneKind::Frozen(1), ZoneKind::Frozen(-1), ZoneKind::Slip(1)]);
        let corners: Vec<f64> = zones.iter().map(|zone| zone.to).collect();
        let normal = over_area(&fields, &corners, |r| fields.at(r).pressure);
        assert_relative_eq!(normal, law.normal_force(d), max_relative = 1e-10);
        let shear = over_area(&fields, &corners, |r| fields.at(r).shear);
        let force = memory.force(&law, memory.apex());
        assert!((shear - force).abs() < 1e-10 * law.friction() * normal, "{shear}, {force}");
    }
}

#[test]
fn the_sphere_by_quadrature_is_what_its_foundation_says() {
    let radius = 1.5;
    let law = interface(Profile::sphere(radius).unwrap(), 0.4);
    for a in [1e-3, 0.2, 0.9] {
        let d = law.profile().depth(a);
        let memory = pushed(&law, d, &[0.5 * law.gross_slip_displacement(d)]);
        let fields = Fields::of(&law, &memory).unwrap();
        let slope = |x: f64| (x / radius).atanh() + x * radius / (radius * radius - x * x);
        for r in [0.0, 0.3 * a, 0.9 * a, 0.99999 * a] {
            let field = fields.at(r);
            let want = MODULI.0 * pressure(slope, a, r);
            assert_relative_eq!(field.pressure, want, max_relative = 1e-10);
            assert!(field.error[0] <= 1e-6 * want, "{:?}", field.error);
        }
        let line = |x: f64| (d - law.profile().depth(x)).max(0.0);
        for r in [0.5 * a, a, 1.2 * a, 3.0 * a] {
            assert_relative_eq!(fields.at(r).deflection, surface(line, &[a], r), max_relative = 1e-9);
        }
    }
}

/// Random walk in the (d, u) plane.
fn walk(law: &Interface, memory: &mut Memory, depth: f64, corners: usize, random: &mut Random) {
    let reach = 1.5 * law.gross_slip_displacement(depth);
    for _ in 0..corners {
        let to = Apex { d: depth * random.between(0.05, 1.0), u: reach * random.between(-1.0, 1.0) };
        memory.commit(law, Segment::Straight(to)).unwrap();
    }
}

#[test]
fn every_other_profile_has_fields_by_quadrature_that_add_up() {
    // Tests integrals for profiles with a worn edge, a kink or a tip: ∫p = F_N, ∫τ = F_x, u and w by (4.25), w = d - f inside.
    let table: Vec<(f64, f64)> = (0..=12).map(|k| f64::from(k) / 12.0).map(|r| (r, r * r / 3.0)).collect();
    let profiles = [
        ("truncated cone", Profile::truncated_cone(0.2, 0.5), 1e-9),
        ("truncated paraboloid", Profile::truncated_paraboloid(0.2, 1.5), 1e-9),
        ("rounded flat", Profile::rounded_flat(0.2, 1.5), 1e-9),
        ("tipped paraboloid", Profile::tipped_paraboloid(1.5, 0.2), 1e-9),
        ("powers", Profile::powers(&[(0.3, 1.0), (0.2, 2.5), (1.0, 6.0)]), 1e-9),
        ("table", Profile::table(&table, &[]), 1e-8),
    ];
    for (name, profile, within) in profiles {
        let law = interface(profile.unwrap(), 0.4);
        let d = law.profile().depth(0.5);
        let u_c = law.gross_slip_displacement(d);
        let memory = pushed(&law, d, &[0.7 * u_c, -0.1 * u_c, 0.3 * u_c]);
        let fields = Fields::of(&law, &memory).unwrap();
        let mut corners: Vec<f64> = fields.zones().iter().map(|zone| zone.to).collect();
        corners.extend(law.profile().borders());
        let normal = over_area(&fields, &corners, |r| fields.at(r).pressure);
        assert_relative_eq!(normal, law.normal_force(d), max_relative = within, epsilon = 0.0);
        let shear = over_area(&fields, &corners, |r| fields.at(r).shear);
        let force = memory.force(&law, memory.apex());
        assert!((shear - force).abs() < within * law.friction() * normal, "{name}: {shear}, {force}");
        let Memory::Curve(curve) = &memory else { unreachable!() };
        corners.push(fields.radius());
        corners.sort_by(f64::total_cmp);
        for r in [0.1, 0.26, 0.37, 0.49, 0.51, 0.9] {
            let field = fields.at(r);
            let want = surface(|x| curve.stretch(law.profile().depth(x)), &corners, r);
            assert!(
                (field.displacement - want).abs() < 10.0 * within * u_c,
                "{name} r {r}: {field:?}, {want}"
            );
            let want = surface(|x| (d - law.profile().depth(x)).max(0.0), &corners, r);
            assert!((field.deflection - want).abs() < 10.0 * within * d, "{name} r {r}: {field:?}, {want}");
            assert!(field.shear.abs() <= law.friction() * field.pressure * (1.0 + 1e-9), "{name} r {r}");
        }
    }
}

#[test]
fn a_sum_of_powers_is_the_sum_of_its_fields_also_at_its_tip() {
    // p of Σ Bₖxⁿ is Σ of (4.34): at r = 0 (E*/π) Σ n/(n-1) B aⁿ⁻¹, finite for n > 1 however blunt.
    for terms in [vec![(0.4, 1.2), (0.3, 2.0)], vec![(0.4, 1.5), (1.0, 6.0)], vec![(0.3, 1.0), (0.5, 2.0)]] {
        let law = interface(Profile::powers(&terms).unwrap(), 0.4);
        let (a, d) = (0.5, law.profile().depth(0.5));
        let memory = pushed(&law, d, &[0.5 * law.gross_slip_displacement(d)]);
        let fields = Fields::of(&law, &memory).unwrap();
        let c = fields.stick_radius();
        // The terms are given as f = A rⁿ; a profile with one term provides B.
        let foundation =
            |(coefficient, n): (f64, f64)| (Profile::power(coefficient, n).unwrap().depth(1.0), n);
        let parts: Vec<(f64, f64)> = terms.iter().copied().map(foundation).collect();
        let between = |from: f64, r: f64| -> f64 {
            let part = |&(b, n): &(f64, f64)| match r {
                0.0 if n == 1.0 => b * (a / from).ln(),
                0.0 => n / (n - 1.0) * b * (a.powf(n - 1.0) - from.powf(n - 1.0)),
                _ => {
                    PI * (pressure(|x| n * b * x.powf(n - 1.0), a, r)
                        - pressure(|x| n * b * x.powf(n - 1.0), from, r))
                }
            };
            parts.iter().map(part).sum()
        };
        for r in [0.0, 1e-12, 1e-3, 0.2, 0.45] {
            let field = fields.at(r);
            let has_tip = r == 0.0 && parts.iter().any(|(_, n)| *n <= 1.0);
            if has_tip {
                assert_eq!(field.pressure, f64::INFINITY);
            } else if r != 1e-12 {
                assert_relative_eq!(field.pressure, MODULI.0 / PI * between(0.0, r), max_relative = 1e-9);
            }
            if r < c {
                let want = 0.4 * MODULI.0 / PI * between(c, r.max(0.0).min(if r < 1e-6 { 0.0 } else { r }));
                assert_relative_eq!(field.shear, want, max_relative = 1e-8);
            }
        }
    }
}

#[test]
fn nothing_that_is_told_is_not_a_number() {
    // Tips, worn edges and punches; without shear, without friction, in partial and gross slip; at every border and in the centre.
    let profiles = [
        Profile::cone(0.1),
        Profile::power(1.0, 0.5),
        Profile::flat(0.5),
        Profile::sphere(2.0),
        Profile::truncated_cone(0.2, 0.5),
        Profile::truncated_paraboloid(0.2, 1.5),
        Profile::rounded_flat(0.2, 1.5),
        Profile::tipped_paraboloid(1.5, 0.2),
        Profile::powers(&[(0.3, 1.0), (0.2, 2.5)]),
        Profile::table(&[(0.0, 0.0), (0.3, 0.1), (0.6, 0.3), (1.0, 0.7)], &[]),
    ];
    for profile in profiles.map(Result::unwrap) {
        for friction in [0.0, 0.4] {
            let law = interface(profile.clone(), friction);
            let d = 0.2;
            for u in [0.0, 0.5 * law.gross_slip_displacement(d), 1.0] {
                let memory = pushed(&law, d, &[u]);
                let fields = Fields::of(&law, &memory).unwrap();
                let mut radii = vec![0.0, 1e-300, 0.1, fields.stick_radius(), fields.radius(), 0.9];
                radii.extend(law.profile().borders());
                for &r in &radii {
                    let field = fields.at(r);
                    let told =
                        [field.pressure, field.shear, field.displacement, field.slip, field.deflection];
                    assert!(
                        told.iter().all(|value| !value.is_nan()),
                        "{profile:?} μ {friction} u {u}: {field:?}"
                    );
                    assert!(field.shear == 0.0 || friction > 0.0 && u > 0.0, "{field:?}");
                }
                let mut map = FrictionMap::new(radii);
                for to in [Apex { d, u: -1.0 }, Apex { d: 0.1, u: 0.3 }] {
                    map.follow(&law, &memory, Segment::Straight(to));
                }
                assert!(
                    map.work().iter().all(|work| *work >= 0.0),
                    "{profile:?} μ {friction} u {u}: {map:?}"
                );
            }
        }
    }
}

#[test]
fn what_has_no_shape_has_no_fields() {
    let points: Vec<(f64, f64)> = (0..=10).map(|k| f64::from(k) / 10.0).map(|d| (d, d.powf(1.5))).collect();
    let shapeless = [
        Profile::normal_law(&points),
        Profile::foundation(&[0.0, 0.1], &[0.5, 0.5]),
        Profile::rough(&[0.0, 0.1, 0.05], 0.5),
    ];
    for profile in shapeless {
        let law = interface(profile.unwrap(), 0.4);
        let memory = pushed(&law, 0.5, &[0.1]);
        assert!(!law.profile().has_shape() && law.peak_pressure(0.5).is_none());
        assert!(Fields::of(&law, &memory).is_none(), "{:?}", law.profile());
    }
    assert!(Profile::flat(0.1).unwrap().has_shape() && Profile::cone(0.1).unwrap().has_shape());
}

#[test]
fn ten_thousand_random_histories_add_up_and_keep_the_limit() {
    let mut random = Random(15);
    let mut rings = 0;
    for k in 0..10_000 {
        let n = [1.0, 2.0, 3.0, 4.0, 1.7][k % 5];
        let law = interface(Profile::foundation_power(1.0, n).unwrap(), 0.3);
        let mut memory = Engine::Curve.memory(&law, Apex { d: 1.0, u: 0.0 });
        walk(&law, &mut memory, 1.0, 1 + (11.0 * random.unit()) as usize, &mut random);
        let fields = Fields::of(&law, &memory).unwrap();
        let Memory::Curve(curve) = &memory else { unreachable!() };
        let mut corners: Vec<f64> = curve.knots().map(|(h, _)| law.profile().radius(h)).collect();
        corners.retain(|r| *r > 0.0);
        for share in 1..20 {
            let r = fields.radius() * f64::from(share) / 20.0;
            let field = fields.at(r);
            let limit = law.friction() * field.pressure;
            assert!(field.shear.abs() <= limit * (1.0 + 1e-12), "{} {limit}", field.shear);
            if matches!(field.state, SpringState::SlipForward | SpringState::SlipBackward) {
                assert_eq!(field.shear.abs(), limit);
                rings += 1;
            }
        }
        if k % 20 == 0 {
            let force = memory.force(&law, memory.apex());
            let shear = over_area(&fields, &corners, |r| fields.at(r).shear);
            let limit = law.friction() * law.normal_force(memory.apex().d);
            assert!((shear - force).abs() < 1e-9 * limit, "{k}: {shear}, {force}");
        }
        let slipping = fields.zones().iter().filter(|zone| matches!(zone.kind, ZoneKind::Slip(_))).count();
        assert!(slipping <= 1);
    }
    assert!(rings > 10_000, "{rings}");
}

#[test]
fn u_after_any_history_is_the_transform_of_the_springs() {
    let mut random = Random(4);
    for n in [1.0, 2.0, 4.0, 1.3] {
        let law = interface(Profile::foundation_power(0.7, n).unwrap(), 0.3);
        for _ in 0..20 {
            let mut memory = Engine::Curve.memory(&law, Apex { d: 1.0, u: 0.0 });
            walk(&law, &mut memory, 1.0, 6, &mut random);
            let fields = Fields::of(&law, &memory).unwrap();
            let Memory::Curve(curve) = &memory else { unreachable!() };
            let corners: Vec<f64> =
                curve.knots().map(|(h, _)| law.profile().radius(h)).filter(|r| *r > 0.0).collect();
            for share in [0.2, 0.7, 0.99, 1.1, 2.0] {
                let r = share * fields.radius();
                let want = surface(|x| curve.stretch(law.profile().depth(x)), &corners, r);
                let got = fields.at(r).displacement;
                assert!((got - want).abs() < 1e-9 * law.stick_slope(), "n {n} r {r}: {got}, {want}");
            }
        }
    }
}

#[test]
fn a_row_has_the_fields_of_the_curve_as_far_as_its_springs_go() {
    let law = interface(Profile::paraboloid(1.0).unwrap(), 0.3);
    let d = 1e-2;
    let springs = Springs::new(law.profile(), 20_000, 2.0 * law.profile().radius(d)).unwrap();
    let mut row = Engine::Row(springs.into()).memory(&law, Apex { d, u: 0.0 });
    let mut curve = Memory::Curve(Curve::new(&law, Apex { d, u: 0.0 }));
    let u_c = law.gross_slip_displacement(d);
    for u in [0.8 * u_c, -0.3 * u_c] {
        for memory in [&mut row, &mut curve] {
            memory.commit(&law, Segment::Straight(Apex { d, u })).unwrap();
        }
    }
    let (rows, curves) = (Fields::of(&law, &row).unwrap(), Fields::of(&law, &curve).unwrap());
    for share in [0.0, 0.3, 0.6, 0.8, 0.95] {
        let r = share * curves.radius();
        let (got, want) = (rows.at(r), curves.at(r));
        let scale = law.friction() * curves.at(0.0).pressure;
        assert!((got.shear - want.shear).abs() < 2e-3 * scale, "{r}: {got:?} {want:?}");
        assert!((got.displacement - want.displacement).abs() < 1e-4 * u_c, "{r}: {got:?} {want:?}");
    }
}

#[test]
fn an_open_contact_has_fields_that_are_nothing_and_a_list_has_none() {
    let law = interface(Profile::paraboloid(1.0).unwrap(), 0.3);
    let open = Engine::Curve.memory(&law, Apex { d: -1.0, u: 0.5 });
    let fields = Fields::of(&law, &open).unwrap();
    let field = fields.at(0.3);
    assert_eq!((field.pressure, field.shear, field.displacement), (0.0, 0.0, 0.0));
    assert_eq!((field.state, fields.radius(), fields.zones().len()), (SpringState::Open, 0.0, 0));
    let list = interface(Profile::foundation(&[0.0, 1e-5], &[1e-3, 1e-3]).unwrap(), 0.3);
    assert!(Fields::of(&list, &Engine::Curve.memory(&list, Apex { d: 1e-6, u: 0.0 })).is_none());
}

/// Nodes and weights of ∫ … 2πr dr over the ranges between borders, by double-exponential quadrature.
fn rings(mut borders: Vec<f64>, points: i32) -> (Vec<f64>, Vec<f64>) {
    borders.push(0.0);
    borders.sort_by(f64::total_cmp);
    borders.dedup();
    let (mut radii, mut weights) = (Vec::new(), Vec::new());
    for pair in borders.windows(2) {
        let half = 0.5 * (pair[1] - pair[0]);
        let step = 3.2 / f64::from(points);
        for k in -points..=points {
            let t = f64::from(k) * step;
            let s = 0.5 * PI * t.sinh();
            let r = pair[0] + 2.0 * half / (1.0 + (-2.0 * s).exp());
            radii.push(r);
            weights.push(2.0 * PI * r * half * step * 0.5 * PI * t.cosh() / s.cosh().powi(2));
        }
    }
    (radii, weights)
}

#[test]
fn the_map_of_the_first_loading_is_4_41_and_sums_to_4_42() {
    // Local work μ p s with s = u₀ - u(r), u(r) of (4.36); (4.42): 2G*κ²∫_c^a [d-g][g-d(c)] dx.
    for (profile, b, n) in powers().into_iter().filter(|(_, _, n)| *n < 20.0) {
        let law = interface(profile, 0.4);
        let (a, c) = (0.8_f64, 0.3_f64);
        let (d, core) = (b * a.powf(n), b * c.powf(n));
        let (kappa, u) = (law.stick_slope(), law.stick_slope() * (d - core));
        let untouched = pushed(&law, d, &[]);
        let to = Segment::Straight(Apex { d, u });
        let (radii, weights) = rings(vec![c, a], 40);
        let mut map = FrictionMap::new(radii);
        map.follow(&law, &untouched, to);
        let memory = pushed(&law, d, &[u]);
        let fields = Fields::of(&law, &memory).unwrap();
        for (&r, &work) in map.radii().iter().zip(map.work()).step_by(9) {
            let field = fields.at(r);
            let want = if r > c { law.friction() * field.pressure * (u - field.displacement) } else { 0.0 };
            assert!(
                (work - want).abs() < 1e-10 * law.friction() * MODULI.0 * d / a * u,
                "n {n} r {r}: {work} {want}"
            );
        }
        let total: f64 = map.work().iter().zip(&weights).map(|(work, weight)| work * weight).sum();
        let local = |x: f64| (d - b * x.powf(n)) * (b * x.powf(n) - core);
        let want = 2.0 * MODULI.1 * kappa * kappa * double_exponential([c, a], |x, _, _| local(x));
        assert_relative_eq!(total, want, max_relative = 1e-9);
    }
}

#[test]
#[ignore = "takes long: .ci/full"]
fn the_map_of_any_history_sums_to_its_friction_work() {
    let mut random = Random(41);
    let mut worst: f64 = 0.0;
    for k in 0..300 {
        let n = [1.0, 2.0, 4.0, 1.7][k % 4];
        let law = interface(Profile::foundation_power(1.0, n).unwrap(), 0.3);
        let mut memory = Engine::Curve.memory(&law, Apex { d: 1.0, u: 0.0 });
        walk(&law, &mut memory, 1.0, random.between(1.0, 6.0) as usize, &mut random);
        let from = memory.apex();
        // Slip at constant load, growing load with slip, falling load, and opening.
        let (d, u) =
            (random.between(-0.3, 1.2), random.between(-1.5, 1.5) * law.gross_slip_displacement(1.0));
        let to = match k % 3 {
            0 => Apex { d: from.d, u },
            1 => Apex { d, u },
            // Both limit lines could slip.
            _ => Apex { d, u: from.u + random.between(-1.0, 1.0) * law.stick_slope() * (d - from.d).abs() },
        };
        let corners = |memory: &Memory| {
            let Memory::Curve(curve) = memory else { unreachable!() };
            curve.knots().map(|(h, _)| law.profile().radius(h)).collect::<Vec<_>>()
        };
        let before = corners(&memory);
        let mut after = memory.clone();
        let work = after.commit(&law, Segment::Straight(to)).unwrap();
        let mut borders = [before, corners(&after)].concat();
        borders.push(law.profile().radius(to.d));
        // Where the pressure approaches 0 during slip, the map has kinks.
        let widest = borders.iter().copied().fold(0.0, f64::max);
        borders.extend((1..100).map(|k| widest * f64::from(k) / 100.0));
        let (radii, weights) = rings(borders, 14);
        let mut map = FrictionMap::new(radii);
        map.follow(&law, &memory, Segment::Straight(to));
        let total: f64 = map.work().iter().zip(&weights).map(|(work, weight)| work * weight).sum();
        let scale = law.friction() * law.normal_force(1.0) * law.gross_slip_displacement(1.0);
        let off = (total - work).abs() / scale;
        worst = worst.max(off);
        assert!(off < 1e-8, "{k}: n {n}, {from:?} to {to:?}: {total}, {work}: {off:e}");
    }
    // Some cases have no slip, others gross slip.
    assert!(worst > 0.0);
}
