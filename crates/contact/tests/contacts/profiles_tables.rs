//! Tests of profiles given by points: tables of (r, f) with the transform (4.20) against closed forms, and normal laws.

use stickslip_contact::{
    Apex, ContactError, Curve, FirstLoadingError, Interface, Material, Move, NormalGiven, Pair, Profile,
    ProfileError, Row, Segment, Springs,
};

/// Profile with a closed form, its f, the last radius of its table, and its kinks.
struct Specimen {
    name: &'static str,
    exact: Profile,
    gap: fn(f64) -> f64,
    end: f64,
    kinks: &'static [f64],
}

const R: f64 = 5e-3;
const FLAT: f64 = 1e-4;

fn specimens() -> [Specimen; 5] {
    let specimen = |name, exact: Result<Profile, ProfileError>, gap, end, kinks| Specimen {
        name,
        exact: exact.unwrap(),
        gap,
        end,
        kinks,
    };
    [
        specimen("paraboloid", Profile::paraboloid(R), |r| r * r / (2.0 * R), 4e-4, &[]),
        specimen("cone", Profile::cone(0.02), |r| 0.02 * r, 4e-4, &[]),
        // a/R up to a half.
        specimen("sphere", Profile::sphere(R), |r| r * r / (R + (R * R - r * r).sqrt()), 2.5e-3, &[]),
        specimen("fourth power", Profile::power(1e9, 4.0), |r| 1e9 * r.powi(4), 4e-4, &[]),
        specimen(
            "truncated cone",
            Profile::truncated_cone(FLAT, 0.02),
            |r| 0.02 * (r - FLAT).max(0.0),
            4e-4,
            &[FLAT],
        ),
    ]
}

impl Specimen {
    /// Table with `count` cells of equal width.
    fn table(&self, count: u32) -> Profile {
        let at = |k: u32| self.end * f64::from(k) / f64::from(count);
        let points: Vec<(f64, f64)> = (0..=count).map(|k| (at(k), (self.gap)(at(k)))).collect();
        Profile::table(&points, self.kinks).unwrap()
    }

    /// Largest error of g relative to its last value.
    fn error(&self, table: &Profile) -> f64 {
        let whole = self.exact.depth(self.end);
        let error = |k: u32| {
            let x = self.end * f64::from(k) / 1999.5;
            (table.depth(x) - self.exact.depth(x)).abs() / whole
        };
        (1..2000).map(error).fold(0.0, f64::max)
    }
}

#[test]
fn two_hundred_points_give_g_to_a_millionth() {
    for specimen in specimens() {
        let table = specimen.table(200);
        let error = specimen.error(&table);
        assert!(error < 1e-9, "{}: {error:e}", specimen.name);
        // The estimate has the size of the error of g at the points, apart from the error of the panels.
        let estimate = table.transform_error().unwrap() / specimen.exact.depth(specimen.end);
        let is_right = estimate < 10.0 * error && error < 10.0 * estimate + 2e-10;
        assert!(is_right, "{}: {estimate:e}", specimen.name);
    }
}

#[test]
fn the_error_of_g_falls_faster_than_the_third_power_of_the_distance() {
    for specimen in specimens() {
        // Profiles for which cubics through the points are not exact.
        let points: Vec<(f64, f64)> = [16, 32, 64, 128]
            .map(|count| (f64::from(count).ln(), specimen.error(&specimen.table(count)).ln()))
            .to_vec();
        if !["sphere", "fourth power"].contains(&specimen.name) {
            assert!(points.iter().all(|point| point.1 < 1e-9_f64.ln()), "{}: {points:?}", specimen.name);
            continue;
        }
        let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / 4.0;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let over: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let order = -over / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
        // Measured orders are 3.77 and 3.61. The theoretical order is 3 for f′, and higher by half an order or more for the integral.
        assert!(order > 3.5 && order < 4.1, "{}: {order}", specimen.name);
    }
}

#[test]
fn stiffness_force_and_energy_of_a_table_are_those_of_the_shape() {
    for specimen in specimens() {
        let (table, exact) = (specimen.table(200), &specimen.exact);
        let whole = exact.depth(specimen.end);
        for share in [0.003, 0.03, 0.2, 0.71, 0.9999] {
            let h = share * whole;
            let near = |got: f64, want: f64, what: &str| {
                assert!(
                    (got / want - 1.0).abs() < 2e-6,
                    "{} {share}: {what} {got:e} {want:e}",
                    specimen.name
                );
            };
            near(table.reduced_stiffness(h), exact.reduced_stiffness(h), "m");
            near(table.reduced_force(h), exact.reduced_force(h), "M");
            near(table.reduced_energy(h), exact.reduced_energy(h), "N");
            // m, M and N are consistent to rounding for any shape.
            let force = table.reduced_force(h);
            assert!((table.height_of_reduced_force(force) / h - 1.0).abs() < 1e-13, "{}", specimen.name);
            assert!((table.depth(table.radius(h)) / h - 1.0).abs() < 1e-12, "{}", specimen.name);
            let step = 1e-5 * h;
            let slope = |f: &dyn Fn(f64) -> f64| (f(h + step) - f(h - step)) / (2.0 * step);
            let (m, force) = (slope(&|h| table.reduced_force(h)), slope(&|h| table.reduced_energy(h)));
            assert!((m / table.reduced_stiffness(h) - 1.0).abs() < 1e-8, "{}", specimen.name);
            assert!((force / table.reduced_force(h) - 1.0).abs() < 1e-8, "{}", specimen.name);
        }
        let r = 0.77 * specimen.end;
        assert!((table.gap(r).unwrap() / exact.gap(r).unwrap() - 1.0).abs() < 1e-7, "{}", specimen.name);
        assert_eq!(table.gap(1.01 * specimen.end), None);
        let slope = table.depth_slope(r) / exact.depth_slope(r) - 1.0;
        assert!(slope.abs() < 1e-5, "{}: {slope:e}", specimen.name);
        assert_eq!(table.is_strictly_convex(), exact.is_strictly_convex(), "{}", specimen.name);
    }
}

#[test]
fn a_table_ends_at_its_last_point() {
    let [paraboloid, ..] = specimens();
    let table = paraboloid.table(50);
    let reach = table.reach().unwrap();
    assert!((reach / paraboloid.exact.depth(paraboloid.end) - 1.0).abs() < 1e-12);
    assert_eq!(table.depth(1.001 * paraboloid.end), f64::INFINITY);
    // Beyond the end the functions continue with finite numbers.
    let force = table.reduced_force(2.0 * reach);
    assert!((force - table.reduced_force(reach) - 2.0 * paraboloid.end * reach).abs() < 1e-12 * force);
    assert!((table.height_of_reduced_force(force) / (2.0 * reach) - 1.0).abs() < 1e-14);
    // A trial may exceed the end; a commit fails and leaves the memory unchanged.
    let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), table.clone(), 0.3).unwrap();
    let mut curve = Curve::new(&law, Apex { d: 0.5 * reach, u: 0.0 });
    let (before, to) = (curve.clone(), Apex { d: 1.01 * reach, u: 0.0 });
    assert!(curve.trial(&law, Move::Chord(to)).force.is_finite());
    let error = curve.commit(&law, Segment::Straight(to));
    assert_eq!(error, Err(ContactError::Beyond { d: to.d, reach }));
    assert_eq!(curve, before);
    assert!(table.reduced_energy(2.0 * reach).is_finite() && table.depth_slope(1.0).is_infinite());
}

#[test]
fn the_last_point_can_be_used() {
    let law_points = [(0.0, 0.0), (5e-8, 2e-13), (1e-7, 6e-13)];
    let [paraboloid, .., truncated] = specimens();
    for profile in [paraboloid.table(50), truncated.table(60), Profile::normal_law(&law_points).unwrap()] {
        let reach = profile.reach().unwrap();
        let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), profile, 0.3).unwrap();
        let mut given = vec![
            NormalGiven::Indentation(reach),
            NormalGiven::Indentation(reach.next_up()),
            NormalGiven::Force(law.normal_force(reach)),
            NormalGiven::Force(law.normal_force(reach).next_up()),
        ];
        if law.profile().is_strictly_convex() {
            given.push(NormalGiven::Radius(law.profile().radius(reach)));
        }
        for normal in given {
            let d = normal.indentation(&law).unwrap();
            assert!(d <= reach && d >= reach * (1.0 - 1e-13), "{normal:?}: {d:e} {reach:e}");
            let mut curve = Curve::new(&law, Apex::default());
            assert!(curve.commit(&law, Segment::Straight(Apex { d, u: 0.0 })).is_ok());
        }
        let d = reach * (1.0 + 1e-9);
        let beyond = NormalGiven::Indentation(d).indentation(&law);
        assert_eq!(beyond, Err(FirstLoadingError::BeyondProfile { d, reach }));
    }
}

#[test]
fn a_row_pressed_beyond_the_points_says_so_and_one_outgrown_before_says_that() {
    let [paraboloid, ..] = specimens();
    let table = paraboloid.table(50);
    let reach = table.reach().unwrap();
    let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), table, 0.3).unwrap();
    let to = |d| Segment::Straight(Apex { d, u: 0.0 });
    let wide = Springs::new(law.profile(), 64, 4.0 * paraboloid.end).unwrap();
    let narrow = Springs::new(law.profile(), 64, paraboloid.end).unwrap();
    let (mut row, d) = (Row::new(&wide), 1.01 * reach);
    assert!(row.commit(&wide, &law, to(reach)).is_ok());
    assert_eq!(row.commit(&wide, &law, to(d)), Err(ContactError::Beyond { d, reach }));
    let mut row = Row::new(&narrow);
    assert_eq!(row.commit(&narrow, &law, to(d)), Err(ContactError::Beyond { d, reach }));
    let outgrown = row.commit(&narrow, &law, to(0.9 * reach));
    assert!(matches!(outgrown, Err(ContactError::Outgrown { .. })), "{outgrown:?}");
}

#[test]
fn uneven_points_and_hidden_flats_are_no_trouble() {
    // Truncated paraboloid with points that are denser towards its edge.
    let mut points = vec![(0.0, 0.0), (0.5 * FLAT, 0.0), (FLAT, 0.0)];
    points.extend((0..60).map(|k| {
        let r = FLAT + 3e-4 * 0.8_f64.powi(59 - k);
        (r, (r - FLAT) * (r + FLAT) / (2.0 * R))
    }));
    let table = Profile::table(&points, &[FLAT]).unwrap();
    let exact = Profile::truncated_paraboloid(FLAT, R).unwrap();
    for x in [1.001 * FLAT, 1.1 * FLAT, 2.0 * FLAT, 3.9 * FLAT] {
        assert!((table.depth(x) - exact.depth(x)).abs() < 1e-8 * exact.depth(4e-4), "{x:e}");
    }
    assert_eq!((table.depth(FLAT), table.radius(1e-30)), (0.0, FLAT));
    // Tables of three points, of two, and with a bend down for which g still increases.
    let cone = Profile::table(&[(0.0, 0.0), (1e-4, 1e-6)], &[]).unwrap();
    assert!((cone.depth(7e-5) / (0.7e-6 * std::f64::consts::FRAC_PI_2) - 1.0).abs() < 1e-12);
    assert!(Profile::table(&[(0.0, 0.0), (1e-4, 1e-6), (2e-4, 1.6e-6)], &[]).is_ok());
}

#[test]
fn curve_and_row_of_a_table_agree_through_histories() {
    let mut draws = 5_u64;
    let mut draw = || {
        draws = draws.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (draws >> 11) as f64 / (1u64 << 53) as f64
    };
    let profiles = specimens().map(|specimen| (specimen.name, specimen.table(100)));
    let law = Profile::normal_law(&hertz(60)).unwrap();
    for (name, profile) in profiles.into_iter().chain([("normal law", law)]) {
        let deepest = 0.9 * profile.reach().unwrap();
        let span = 2.0 * profile.radius(deepest);
        let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), profile, 0.3).unwrap();
        let springs = Springs::new(law.profile(), 100_000, span).unwrap();
        let u = law.gross_slip_displacement(deepest);
        let limit = law.friction() * law.normal_force(deepest);
        let (mut curve, mut row) = (Curve::new(&law, Apex::default()), Row::new(&springs));
        let (mut worst, mut booked, mut work) = (0.0_f64, 0.0, 0.0);
        for _ in 0..60 {
            let to = Apex { d: deepest * (1.1 * draw() - 0.1), u: 2.0 * u * (draw() - 0.5) };
            booked += curve.commit(&law, Segment::Straight(to)).unwrap();
            work += row.commit(&springs, &law, Segment::Straight(to)).unwrap();
            worst = worst.max((curve.force(&law) - row.force(&springs, &law, to)).abs() / limit);
        }
        assert!(worst < 3e-8, "{name}: {worst:e}");
        assert!((booked / work - 1.0).abs() < 1e-7, "{name}: {booked:e} {work:e}");
    }
}

/// M of a paraboloid of 5 mm radius at `count` + 1 indentations up to 4 µm.
fn hertz(count: u32) -> Vec<(f64, f64)> {
    let ball = Profile::paraboloid(R).unwrap();
    let at = |k: u32| 4e-6 * f64::from(k) / f64::from(count);
    (0..=count).map(|k| (at(k), ball.reduced_force(at(k)))).collect()
}

#[test]
fn a_normal_law_is_met_at_its_points_and_tends_to_the_profile() {
    let ball = Profile::paraboloid(R).unwrap();
    let mut errors = Vec::new();
    for count in [20, 40, 80] {
        let points = hertz(count);
        let law = Profile::normal_law(&points).unwrap();
        for &(h, force) in &points[1..] {
            assert!((law.reduced_force(h) / force - 1.0).abs() < 1e-13, "{h:e}");
        }
        let error = |k: u32| {
            let h = 1e-6 + 3e-9 * f64::from(k);
            (law.reduced_stiffness(h) / ball.reduced_stiffness(h) - 1.0).abs()
        };
        errors.push((0..1000).map(error).fold(0.0, f64::max));
        let mut before = 0.0;
        for k in 1..4000 {
            let m = law.reduced_stiffness(1e-9 * f64::from(k));
            assert!(m >= before, "the stiffness falls at {k} nm");
            before = m;
        }
        assert!((law.depth(law.radius(2.3e-6)) / 2.3e-6 - 1.0).abs() < 1e-12);
        assert_eq!((law.gap(1e-5), law.reach(), law.transform_error()), (None, Some(4e-6), None));
    }
    assert!(errors[1] < errors[0] / 3.0 && errors[2] < errors[1] / 3.0, "second order: {errors:?}");
    assert!(errors[2] < 1e-3, "{errors:?}");
    // A linear normal law is a flat punch; a stiffness above 0 at the start is a flat.
    let flat = Profile::normal_law(&[(0.0, 0.0), (1e-6, 4e-9), (2e-6, 8e-9)]).unwrap();
    assert_eq!((flat.radius(5e-7), flat.depth(1e-3), flat.is_strictly_convex()), (2e-3, 0.0, false));
    assert!((flat.reduced_energy(1.5e-6) / (0.5 * 4e-3 * 1.5e-6 * 1.5e-6) - 1.0).abs() < 1e-14);
}

#[test]
fn the_stiffness_of_a_normal_law_jumps_only_where_two_straight_lines_meet() {
    // Secants, and whether they require a jump of the stiffness.
    let cases: [(&[f64], bool); 8] = [
        (&[1.0, 1.0, 2.0], false),
        (&[1.0, 2.0, 2.0], false),
        (&[0.5, 1.0, 1.0, 1.0, 3.0], false),
        (&[1.0, 1.0, 1.5, 2.0, 2.0], false),
        (&[1.0, 1.0 + 1e-12, 2.0, 3.0], false),
        (&[1.0, 5.0], false),
        (&[1.0, 1.0], false),
        (&[1.0, 1.0, 2.0, 2.0], true),
    ];
    for (secants, has_kinks) in cases {
        let mut points = vec![(0.0, 0.0)];
        for (k, secant) in secants.iter().enumerate() {
            points.push((1.0 + k as f64, points[k].1 + secant));
        }
        let law = Profile::normal_law(&points).unwrap();
        assert_eq!(law.has_kinks(), has_kinks, "{secants:?}");
        let mut largest = 0.0_f64;
        for (k, &(h, force)) in points.iter().enumerate().skip(1) {
            assert!((law.reduced_force(h) / force - 1.0).abs() < 1e-9, "{secants:?} {k}");
            let beside = [h * (1.0 - 1e-9), h * (1.0 + 1e-9)].map(|h| law.reduced_stiffness(h));
            largest = largest.max(beside[1] - beside[0]);
        }
        // Linear parts with slopes up to 20 per unit change by at most 4e-7.
        assert_eq!(largest > 1e-6, has_kinks, "{secants:?}: {largest:e}");
    }
}

#[test]
fn what_is_no_profile_is_refused() {
    let table = |points: &[(f64, f64)]| Profile::table(points, &[]).unwrap_err();
    assert_eq!(table(&[]), ProfileError::Points(0));
    assert_eq!(table(&[(0.0, 0.0)]), ProfileError::Points(1));
    assert_eq!(table(&[(0.0, 1e-9), (1.0, 1.0)]), ProfileError::Origin { radius: 0.0, value: 1e-9 });
    assert_eq!(table(&[(-1.0, 0.0), (1.0, 1.0)]), ProfileError::Origin { radius: -1.0, value: 0.0 });
    assert_eq!(table(&[(0.0, 0.0), (2.0, 1.0), (1.0, 2.0)]), ProfileError::Order { index: 2 });
    assert_eq!(table(&[(0.0, 0.0), (-2.0, 1.0)]), ProfileError::Order { index: 1 });
    assert_eq!(table(&[(0.0, 0.0), (f64::NAN, 1.0)]), ProfileError::Order { index: 1 });
    assert_eq!(table(&[(0.0, 0.0), (1.0, 2.0), (2.0, 1.0)]), ProfileError::Fall { index: 2 });
    assert_eq!(table(&[(0.0, 0.0), (1.0, f64::NAN)]), ProfileError::Fall { index: 1 });
    assert_eq!(table(&[(0.0, 0.0), (1.0, 0.0)]), ProfileError::NoRise);
    // A cone that ends in a plane: beyond its edge g decreases.
    let edge: Vec<(f64, f64)> = (0..=20).map(|k| (f64::from(k), f64::from(k.min(10)))).collect();
    let error = Profile::table(&edge, &[10.0]).unwrap_err();
    assert_eq!(error, ProfileError::NotRising { index: 11, radius: 11.0 });
    let many: Vec<(f64, f64)> = (0..=4000).map(|k| (f64::from(k), f64::from(k))).collect();
    assert_eq!(table(&many), ProfileError::TooMany(4001));
    for kink in [0.0, 5.5, 20.0, f64::NAN] {
        let error = Profile::table(&edge, &[10.0, kink]).unwrap_err();
        assert!(matches!(error, ProfileError::Kink { index: 1, .. }), "{kink}: {error}");
    }
    let law = |points: &[(f64, f64)]| Profile::normal_law(points).unwrap_err();
    assert_eq!(law(&[(0.0, 0.0)]), ProfileError::Points(1));
    assert_eq!(law(&[(0.1, 0.0), (1.0, 1.0)]), ProfileError::Origin { radius: 0.1, value: 0.0 });
    assert_eq!(law(&[(0.0, 0.0), (1.0, 1.0), (2.0, 1.5)]), ProfileError::Softening { index: 2 });
    assert_eq!(law(&[(0.0, 0.0), (1.0, 1.0), (1.0, 3.0)]), ProfileError::Order { index: 2 });
    assert_eq!(law(&[(0.0, 0.0), (1.0, 0.0), (2.0, 3.0)]), ProfileError::Fall { index: 1 });
}

/// Points of a sphere of 1 mm, rounded like measured values, give the Hertz pressure 2E\*d/(πa) within the error of the rounding.
#[test]
fn a_ball_by_rounded_points_has_no_tip() {
    let pair = Pair::new(Material::new(210e9, 0.3).unwrap(), Material::new(210e9, 0.3).unwrap());
    for (quantum, all) in
        [(1e-10, &[10, 20, 25, 30, 40, 50, 60, 70, 80, 100][..]), (1e-9, &[10, 15, 20, 25, 30])]
    {
        for &parts in all {
            let point = |k: u32| {
                let r = 20e-6 * f64::from(k) / f64::from(parts);
                (r, (r * r / 2e-3 / quantum).round() * quantum)
            };
            let points: Vec<(f64, f64)> = (0..=parts).map(point).collect();
            let law = Interface::new(pair, Profile::table(&points, &[]).unwrap(), 0.3).unwrap();
            let d = 1e-7;
            let peak = law.peak_pressure(d).unwrap();
            let hertz = 2.0 * law.normal_modulus() * d / (std::f64::consts::PI * (d * 1e-3).sqrt());
            assert!((peak / hertz - 1.0).abs() < 0.1, "{quantum:e} {parts}: {peak:e} {hertz:e}");
        }
    }
    // A real tip is kept for any number of points.
    for parts in [6, 20, 21, 50, 200] {
        let point = |k: u32| {
            let r = 20e-6 * f64::from(k) / f64::from(parts);
            (r, 5e-3 * r + r * r / 2e-3)
        };
        let points: Vec<(f64, f64)> = (0..=parts).map(point).collect();
        let law = Interface::new(pair, Profile::table(&points, &[]).unwrap(), 0.3).unwrap();
        assert_eq!(law.peak_pressure(1e-7), Some(f64::INFINITY), "{parts}");
    }
}
