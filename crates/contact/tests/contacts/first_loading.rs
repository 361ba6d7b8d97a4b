//! Tests of first loadings: all nine combinations of given quantities, and the force by an independent computation.

use stickslip_contact::{
    FirstLoading, FirstLoadingError, Interface, Material, NormalGiven, Pair, Profile, TangentialGiven,
};

fn law(profile: Profile) -> Interface {
    Interface::new(Pair::from_moduli(1.15e11, 0.95e11).unwrap(), profile, 0.15).unwrap()
}

fn convex() -> [Profile; 6] {
    [
        Profile::cone(0.01).unwrap(),
        Profile::paraboloid(1e-3).unwrap(),
        Profile::sphere(1e-3).unwrap(),
        Profile::foundation_power(1e9, 4.0).unwrap(),
        Profile::power(0.3, 1.7).unwrap(),
        Profile::power(4.0, 2.6).unwrap(),
    ]
}

fn stepped() -> [Profile; 2] {
    let heights: Vec<f64> = (0..300).map(|i| f64::from(i * i) * 3e-12).collect();
    [Profile::flat(1e-4).unwrap(), Profile::foundation(&heights, &vec![1e-7; 300]).unwrap()]
}

/// Difference of two states, each quantity relative to its scale (d, a, `F_N`, `u_c`, a, `μF_N`).
fn difference(law: &Interface, left: &FirstLoading, right: &FirstLoading) -> f64 {
    let scale = law.friction() * left.normal_force;
    [
        (left.d - right.d) / left.d,
        (left.a - right.a) / left.a,
        (left.normal_force - right.normal_force) / left.normal_force,
        (left.u - right.u) / law.gross_slip_displacement(left.d),
        (left.c - right.c) / left.a,
        (left.tangential_force - right.tangential_force) / scale,
    ]
    .into_iter()
    .fold(0.0, |worst, e: f64| worst.max(e.abs()))
}

/// Force by (4.39): 2∫₀ᶜ G*u dx + 2∫_c^a μE*(d-g(x)) dx, by tanh-sinh quadrature.
fn force_by_integration(law: &Interface, state: &FirstLoading) -> f64 {
    let half_pi = std::f64::consts::FRAC_PI_2;
    let stick = 2.0 * law.tangential_modulus() * state.u.abs() * state.c;
    let step = 1.0 / 64.0;
    let node = |k: i32| {
        let t = f64::from(k) * step;
        let part = 1.0 / (1.0 + (-2.0 * half_pi * t.sinh()).exp());
        let weight = half_pi * t.cosh() / (half_pi * t.sinh()).cosh().powi(2);
        let x = state.c + (state.a - state.c) * part;
        if weight > 0.0 { 0.5 * weight * (state.d - law.profile().depth(x)) } else { 0.0 }
    };
    let annulus = (-256..=256).map(node).sum::<f64>() * step * (state.a - state.c);
    state.u.signum() * (stick + 2.0 * law.friction() * law.normal_modulus() * annulus)
}

#[test]
fn nine_queries_find_one_state() {
    for profile in convex() {
        let law = law(profile);
        for d in [2e-9, 1.8e-7, 2e-6] {
            for part in [0.03, 0.4, 0.8, 0.999] {
                let u = part * law.gross_slip_displacement(d);
                let first =
                    FirstLoading::solve(&law, NormalGiven::Indentation(d), TangentialGiven::Displacement(u))
                        .unwrap();
                let normals = [
                    NormalGiven::Indentation(first.d),
                    NormalGiven::Radius(first.a),
                    NormalGiven::Force(first.normal_force),
                ];
                let tangentials = [
                    TangentialGiven::Displacement(first.u),
                    TangentialGiven::StickRadius(first.c),
                    TangentialGiven::Force(first.tangential_force),
                ];
                for normal in normals {
                    for tangential in tangentials {
                        let again = FirstLoading::solve(&law, normal, tangential).unwrap();
                        let worst = difference(&law, &first, &again);
                        assert!(worst < 1e-12, "{normal:?} {tangential:?}: {worst:e}\n{first:?}\n{again:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn stepped_profiles_answer_to_depths_and_forces() {
    for profile in stepped() {
        let law = law(profile);
        for part in [0.1, 0.5, -0.9] {
            let d = 1.8e-7;
            let u = part * law.gross_slip_displacement(d);
            let normal = NormalGiven::Indentation(d);
            let first = FirstLoading::solve(&law, normal, TangentialGiven::Displacement(u)).unwrap();
            for normal in [normal, NormalGiven::Force(first.normal_force)] {
                for tangential in
                    [TangentialGiven::Displacement(u), TangentialGiven::Force(first.tangential_force)]
                {
                    let again = FirstLoading::solve(&law, normal, tangential).unwrap();
                    assert!(difference(&law, &first, &again) < 1e-12, "{again:?}");
                }
            }
            let by_radius = FirstLoading::solve(&law, NormalGiven::Radius(1e-5), TangentialGiven::Force(0.0));
            assert_eq!(by_radius, Err(FirstLoadingError::Undetermined));
            let by_stick = FirstLoading::solve(&law, normal, TangentialGiven::StickRadius(1e-6));
            assert_eq!(by_stick, Err(FirstLoadingError::Undetermined));
        }
    }
}

#[test]
fn the_two_ways_to_the_force_agree() {
    // Superposition (4.38) in the library is compared with the integral (4.39), by quadrature over x.
    for profile in convex() {
        let law = law(profile);
        for part in [-0.95, -0.2, 0.05, 0.5, 0.9, 1.0, 1.7] {
            let u = part * law.gross_slip_displacement(1.8e-7);
            let state =
                FirstLoading::solve(&law, NormalGiven::Indentation(1.8e-7), TangentialGiven::Displacement(u))
                    .unwrap();
            // Beyond u_c the stick radius c is 0.
            let other = force_by_integration(&law, &state);
            let error = (state.tangential_force - other) / (law.friction() * state.normal_force);
            assert!(error.abs() < 1e-12, "{part}: {error:e}");
        }
    }
}

#[test]
fn power_laws_have_their_closed_forms() {
    // F_x = μF_N[1-(1-u/u_c)^p], c/a = (1-u/u_c)^{1/n}.
    for (n, profile) in [(1.0, 0), (2.0, 1), (4.0, 3), (1.7, 4)].map(|(n, i)| (n, convex()[i].clone())) {
        let law = law(profile);
        for part in [0.1, 0.6, 0.97] {
            let u = part * law.gross_slip_displacement(1.8e-7);
            let state =
                FirstLoading::solve(&law, NormalGiven::Indentation(1.8e-7), TangentialGiven::Displacement(u))
                    .unwrap();
            let exact = 1.0 - (1.0 - part).powf((n + 1.0) / n);
            assert!((state.tangential_force / (law.friction() * state.normal_force) - exact).abs() < 1e-14);
            assert!((state.c / state.a - (1.0 - part).powf(1.0 / n)).abs() < 1e-14);
        }
    }
}

#[test]
fn it_meets_the_boundary_element_program_contact() {
    // Two bodies G = 200, ν = .42, R = 50 effective, F_N = 9.1954023, μ = .4, F_x = .875μF_N (mm, N):
    // d = .02, a = 1, u = 8.17241e-3, c = .5a; CONTACT itself prints d .01998, u 8.155e-3.
    let material = Material::new(2.0 * 200.0 * 1.42, 0.42).unwrap();
    let law = Interface::new(Pair::new(material, material), Profile::paraboloid(50.0).unwrap(), 0.4).unwrap();
    let force = 0.875 * 0.4 * 9.1954023;
    let state =
        FirstLoading::solve(&law, NormalGiven::Force(9.1954023), TangentialGiven::Force(force)).unwrap();
    assert!((state.d - 0.02).abs() < 1e-9 && (state.a - 1.0).abs() < 1e-8, "{state:?}");
    assert!((state.u - 8.17241e-3).abs() < 5e-9 && (state.c - 0.5).abs() < 1e-8, "{state:?}");
}

#[test]
fn signs_mirror_and_gross_slip_ends_it() {
    let law = law(Profile::paraboloid(1e-3).unwrap());
    let normal = NormalGiven::Indentation(1.8e-7);
    let solve = |tangential| FirstLoading::solve(&law, normal, tangential).unwrap();
    let limit = law.friction() * law.normal_force(1.8e-7);
    let u_c = law.gross_slip_displacement(1.8e-7);
    let (plus, minus) =
        (solve(TangentialGiven::Displacement(0.3 * u_c)), solve(TangentialGiven::Displacement(-0.3 * u_c)));
    assert_eq!((minus.tangential_force, minus.u, minus.c), (-plus.tangential_force, -plus.u, plus.c));
    let back = solve(TangentialGiven::Force(-0.4 * limit));
    assert_eq!(back.u, -solve(TangentialGiven::Force(0.4 * limit)).u);
    for part in [1.0, -1.0, 3.0, -3.0] {
        let slid = solve(TangentialGiven::Displacement(part * u_c));
        assert_eq!((slid.c, slid.tangential_force), (0.0, limit * part.signum()));
        assert_eq!(slid.u, part * u_c);
    }
    assert_eq!(solve(TangentialGiven::Force(limit)).u, u_c);
    assert_eq!(solve(TangentialGiven::StickRadius(0.0)).u, u_c);
    let rest = solve(TangentialGiven::Force(0.0));
    assert_eq!((rest.u, rest.c, rest.tangential_force), (0.0, rest.a, 0.0));
    assert_eq!(solve(TangentialGiven::StickRadius(rest.a)).u, 0.0);
}

#[test]
fn an_open_contact_carries_nothing() {
    let law = law(Profile::sphere(1e-3).unwrap());
    for normal in [NormalGiven::Indentation(-1e-9), NormalGiven::Force(0.0), NormalGiven::Radius(0.0)] {
        for tangential in [
            TangentialGiven::Displacement(1e-9),
            TangentialGiven::StickRadius(0.0),
            TangentialGiven::Force(0.0),
        ] {
            let state = FirstLoading::solve(&law, normal, tangential).unwrap();
            assert_eq!((state.a, state.c, state.normal_force, state.tangential_force), (0.0, 0.0, 0.0, 0.0));
        }
        assert!(FirstLoading::solve(&law, normal, TangentialGiven::Force(1e-9)).is_err());
    }
}

#[test]
fn without_friction_no_force_is_carried() {
    let pair = Pair::from_moduli(1e11, 1e11).unwrap();
    let law = Interface::new(pair, Profile::paraboloid(1e-3).unwrap(), 0.0).unwrap();
    let normal = NormalGiven::Indentation(1e-7);
    let state = FirstLoading::solve(&law, normal, TangentialGiven::Displacement(1e-9)).unwrap();
    assert_eq!((state.tangential_force, state.c), (0.0, 0.0));
    let rest = FirstLoading::solve(&law, normal, TangentialGiven::Force(0.0)).unwrap();
    assert_eq!((rest.tangential_force, rest.u, rest.c), (0.0, 0.0, rest.a));
}

#[test]
fn what_does_not_fit_is_refused() {
    let law = law(Profile::paraboloid(1e-3).unwrap());
    let rest = TangentialGiven::Force(0.0);
    let normal = NormalGiven::Indentation(1.8e-7);
    let limit = law.friction() * law.normal_force(1.8e-7);
    let a = law.profile().radius(1.8e-7);
    let solve = |normal, tangential| FirstLoading::solve(&law, normal, tangential);
    assert_eq!(solve(NormalGiven::Force(-1.0), rest), Err(FirstLoadingError::NormalForce(-1.0)));
    assert_eq!(solve(NormalGiven::Radius(-1.0), rest), Err(FirstLoadingError::Radius(-1.0)));
    assert!(solve(NormalGiven::Indentation(f64::NAN), rest).is_err());
    let force = 1.01 * limit;
    let refused = solve(normal, TangentialGiven::Force(force));
    assert_eq!(refused, Err(FirstLoadingError::TangentialForce { force, limit }));
    assert_eq!(
        solve(normal, TangentialGiven::StickRadius(2.0 * a)),
        Err(FirstLoadingError::StickRadius { c: 2.0 * a, a })
    );
    assert!(solve(normal, TangentialGiven::Displacement(f64::INFINITY)).is_err());
    assert!(solve(normal, TangentialGiven::Force(f64::NAN)).is_err());
    assert!(solve(normal, TangentialGiven::StickRadius(f64::NAN)).is_err());
    let sphere =
        Interface::new(Pair::from_moduli(1.0, 1.0).unwrap(), Profile::sphere(1.0).unwrap(), 0.1).unwrap();
    assert_eq!(
        FirstLoading::solve(&sphere, NormalGiven::Radius(1.0), rest),
        Err(FirstLoadingError::Radius(1.0))
    );
    let reach = sphere.profile().reach().unwrap();
    let beyond = Err(FirstLoadingError::BeyondProfile { d: reach, reach });
    assert_eq!(NormalGiven::Indentation(reach).indentation(&sphere), beyond);
    assert!(NormalGiven::Force(1.0001 * sphere.normal_force(reach)).indentation(&sphere).is_err());
    assert!(NormalGiven::Radius(0.9995).indentation(&sphere).is_err());
    for inside in
        [NormalGiven::Indentation(0.999 * reach), NormalGiven::Force(0.999 * sphere.normal_force(reach))]
    {
        assert!(inside.indentation(&sphere).is_ok(), "{inside:?}");
    }
    assert_eq!(NormalGiven::Radius(0.5).indentation(&sphere), Ok(sphere.profile().depth(0.5)));
}
