//! Robustness tests of the memory curve: random histories on every scale, NaN, overflowing stacks, and very many steps.

use proptest::prelude::*;
use stickslip_contact::{Apex, ContactError, Curve, Interface, Move, Pair, Profile, Segment, SpringState};

const E: f64 = 1.15e11;
const G: f64 = 0.95e11;
const EPS: f64 = f64::EPSILON;

fn law(profile: Profile, friction: f64) -> Interface {
    Interface::new(Pair::from_moduli(E, G).unwrap(), profile, friction).unwrap()
}

fn paraboloid() -> Interface {
    law(Profile::paraboloid(1e-3).unwrap(), 0.15)
}

fn to(d: f64, u: f64) -> Segment {
    Segment::Straight(Apex { d, u })
}

fn profile(kind: usize, scale: f64) -> Profile {
    let heights: Vec<f64> = (0..40).map(|i| scale * 0.03 * f64::from((i * 7) % 40)).collect();
    match kind {
        0 => Profile::flat(1e-4),
        1 => Profile::cone(0.01),
        2 => Profile::paraboloid(1e-3),
        3 => Profile::sphere(5e-2),
        4 => Profile::power(0.3, 1.7),
        _ => Profile::foundation(&heights, &[1e-6; 40]),
    }
    .unwrap()
}

/// A shift by a power of two just below u causes no rounding, so that all later results are identical to the last bit.
#[test]
fn a_shift_of_the_origin_changes_nothing() {
    for kind in 0..6 {
        let law = law(profile(kind, 1e-6), 0.15);
        let mut here = Curve::new(&law, Apex { d: 1e-6, u: 0.0 });
        for (d, u) in [(1e-6, 9.0e-6), (1.2e-6, 8.9e-6), (1.1e-6, 9.0e-6), (1.1e-6, 8.95e-6)] {
            here.commit(&law, to(d, u)).unwrap();
        }
        let by = -(2.0_f64).powi(-17);
        let mut there = here.clone();
        there.shift(by);
        assert_eq!(there.apex().u, here.apex().u + by);
        assert_eq!((there.force(&law), there.elastic(&law)), (here.force(&law), here.elastic(&law)));
        let (a, b) = (here.commit(&law, to(1.1e-6, 8.97e-6)), there.commit(&law, to(1.1e-6, 8.97e-6 + by)));
        assert!((a.unwrap() - b.unwrap()).abs() <= 1e-9 * law.normal_force(1e-6) * 1e-8);
        assert!((there.force(&law) / here.force(&law) - 1.0).abs() < 1e-9);
    }
}

/// Random move, independent of the state of the contact.
#[derive(Debug, Clone, Copy)]
struct Throw {
    kind: u8,
    x: f64,
    y: f64,
}

fn throws() -> impl Strategy<Value = Vec<Throw>> {
    let throw = (0u8..14, -1.0..1.0, -1.0..1.0).prop_map(|(kind, x, y)| Throw { kind, x, y });
    prop::collection::vec(throw, 1..60)
}

/// Random history: scale of d (m), initial u (m), μ, and moves.
#[derive(Debug, Clone)]
struct Game {
    law: Interface,
    scale: f64,
    offset: f64,
    throws: Vec<Throw>,
}

fn games() -> impl Strategy<Value = Game> {
    let frictions = prop::sample::select(vec![0.0, 1e-6, 0.01, 0.15, 1.0, 50.0, 1000.0]);
    let offsets = prop::sample::select(vec![0.0, 0.0, 1e-9, -1e-3, 1.0, -1e3]);
    (0usize..6, frictions, -15.0..-2.0, offsets, throws()).prop_map(
        |(kind, friction, scale, offset, throws)| {
            let scale = 10f64.powf(scale);
            Game { law: law(profile(kind, scale), friction), scale, offset, throws }
        },
    )
}

/// Target of a random move.
fn target(game: &Game, curve: &Curve, throw: Throw) -> Apex {
    let (at, Throw { x, y, .. }) = (curve.apex(), throw);
    let slide = 2.0 * game.law.stick_slope() * game.scale;
    let knots: Vec<(f64, f64)> = curve.knots().collect();
    let knot = knots.get(((0.5 + 0.5 * y) * knots.len() as f64) as usize).copied().unwrap_or((at.d, at.u));
    match throw.kind {
        0 => Apex { d: game.scale * x, u: game.offset + slide * y },
        1 | 2 => Apex { u: game.offset + slide * y, ..at },
        3 => Apex { d: game.scale * x.abs(), ..at },
        4 => Apex { d: at.d * (1.0 + 1e-15 * x), u: at.u + 1e-16 * slide * y },
        5 => at,
        6 => Apex { d: 0.0, u: at.u + slide * y * x.signum().max(0.0) },
        7 => Apex { d: knot.0, ..at },
        8 => Apex { d: knot.0, u: knot.1 },
        9 => Apex { d: knot.0, u: at.u + slide * x },
        10 => Apex { d: -game.scale * x.abs(), u: at.u + slide * y },
        11 => Apex { u: at.u + 1e3 * x, ..at },
        12 => {
            let rise = game.scale * x.abs();
            Apex { d: at.d + rise, u: at.u + y * game.law.stick_slope() * rise }
        }
        _ => Apex { d: at.d * 0.5, u: at.u + 1e-3 * slide * y },
    }
}

/// Scales of the rounding errors of a history.
struct Scale {
    /// Rounding of the largest displacement, m.
    place: f64,
    /// Largest μF_N, N.
    force: f64,
    /// Largest G\*κ²N, J.
    energy: f64,
    /// Largest G\*m, N/m.
    stiffness: f64,
}

impl Scale {
    fn see(&mut self, law: &Interface, at: Apex) {
        let d = at.d.max(0.0);
        self.place = self.place.max(EPS * (at.u.abs() + law.stick_slope() * at.d.abs()));
        self.force = self.force.max(law.friction() * law.normal_force(d));
        self.stiffness = self.stiffness.max(law.stick_stiffness(d));
        self.energy = self
            .energy
            .max(law.tangential_modulus() * law.stick_slope().powi(2) * law.profile().reduced_energy(d));
    }
}

fn check(law: &Interface, curve: &Curve, scale: &Scale, capacity: usize) -> Result<(), TestCaseError> {
    let (at, slope) = (curve.apex(), law.stick_slope());
    let limit = law.friction() * law.normal_force(at.d);
    let (force, elastic) = (curve.force(law), curve.elastic(law));
    let tiny = 8.0 * EPS * scale.force;
    prop_assert!(force.abs() <= limit * (1.0 + 1e-12) + tiny, "force {force:e} of {limit:e}, {at:?}");
    prop_assert!(elastic >= -64.0 * EPS * scale.energy, "elastic {elastic:e} of {:e}", scale.energy);
    prop_assert!(curve.knot_count() <= capacity, "{} knots", curve.knot_count());
    let knots: Vec<(f64, f64)> = curve.knots().collect();
    prop_assert_eq!(knots.is_empty(), at.d <= 0.0);
    prop_assert!(knots.first().is_none_or(|k| k.0 == 0.0) && knots.last().is_none_or(|k| *k == (at.d, at.u)));
    let slack = 8.0 * scale.place;
    for pair in knots.windows(2) {
        let (rise, step) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        prop_assert!(rise > 0.0, "heights {pair:?}");
        prop_assert!(step.abs() <= slope * rise + slack, "steep {pair:?}, κ {slope}");
        prop_assert!((at.u - pair[0].1).abs() <= slope * (at.d - pair[0].0) + slack, "wedge {pair:?} {at:?}");
    }
    for h in [0.0, 0.3 * at.d, at.d, 2.0 * at.d.abs()] {
        let open = curve.spring_state(h) == SpringState::Open;
        prop_assert!(open == (at.d <= 0.0 || h >= at.d) && curve.stretch(h).is_finite());
    }
    let radius = curve.stick_radius(law);
    prop_assert!((0.0..=law.profile().radius(at.d)).contains(&radius));
    Ok(())
}

/// Checks that values that are not finite are rejected and leave the curve unchanged.
fn refused(law: &Interface, curve: &mut Curve) -> Result<(), TestCaseError> {
    let before = curve.clone();
    let at = curve.apex();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for end in [Apex { d: bad, ..at }, Apex { u: bad, ..at }, Apex { d: bad, u: bad }] {
            for segment in [
                Segment::Straight(end),
                Segment::Jump(end),
                Segment::Grown { to: end, force: 0.0, energy: 0.0, joins: false },
            ] {
                let answer = curve.commit(law, segment);
                prop_assert!(
                    matches!(answer, Err(ContactError::NotFinite { .. })),
                    "{segment:?}: {answer:?}"
                );
                prop_assert!(*curve == before, "{segment:?} left a trace");
            }
            curve.trial(law, Move::Chord(end));
            curve.preview(law, end);
        }
    }
    Ok(())
}

fn play(game: &Game, capacity: usize) -> Result<(), TestCaseError> {
    let law = &game.law;
    let start = Apex { d: 0.5 * game.scale, u: game.offset };
    let mut curve = Curve::with_capacity(law, start, capacity);
    let mut scale = Scale { place: 0.0, force: 0.0, energy: 0.0, stiffness: 0.0 };
    scale.see(law, start);
    for &throw in &game.throws {
        let (from, goal) = (curve.apex(), target(game, &curve, throw));
        scale.see(law, goal);
        let (trial, seen) = (curve.trial(law, Move::Chord(goal)), curve.preview(law, goal));
        let merged = curve.merged();
        let segment = if throw.kind % 2 == 0 { Segment::Straight(goal) } else { Segment::Jump(goal) };
        let work = curve.commit(law, segment).unwrap();
        check(law, &curve, &scale, capacity)?;

        // Rounding of the work: the last place of u or κd, shifted under the full limit force.
        let path = scale.place / EPS + (goal.u - from.u).abs();
        prop_assert!(work >= -64.0 * EPS * scale.force * path, "friction {work:e}, {from:?} to {goal:?}");
        if curve.merged() == merged {
            prop_assert_eq!(seen.friction, work);
        }

        let booked = curve.merged().force - merged.force;
        // Pieces count as collinear within two units in the last place of their rest positions.
        let slack = 1e-13 * scale.force + 2.0 * scale.stiffness * scale.place + booked;
        prop_assert!(
            (trial.force - curve.force(law)).abs() <= slack,
            "trial {trial:?} {:e}",
            curve.force(law)
        );
        prop_assert!((seen.force - trial.force).abs() <= 1e-13 * scale.force);
        prop_assert!(trial.stiffness >= 0.0 && trial.stiffness.is_finite() && trial.coupling.is_finite());
        for sense in [1.0, -1.0] {
            let branch = curve.branch(law, sense, 0.0);
            prop_assert!(branch.margin(goal.d, goal.u) >= 0.0, "margin {branch:?}");
        }
    }
    refused(law, &mut curve)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_histories_keep_the_invariants(game in games()) {
        play(&game, Curve::DEFAULT_CAPACITY)?;
    }

    #[test]
    fn random_histories_keep_the_invariants_in_a_full_stack(game in games()) {
        play(&game, 8)?;
    }
}

#[test]
fn a_grown_segment_without_a_finite_force_or_energy_is_refused() {
    let law = paraboloid();
    let mut curve = Curve::new(&law, Apex { d: 1e-7, u: 0.0 });
    let before = curve.clone();
    let end = Apex { d: 2e-7, u: 1e-9 };
    for (force, energy) in [(f64::NAN, 0.0), (0.0, f64::NAN), (f64::INFINITY, 0.0), (0.0, f64::INFINITY)] {
        assert!(
            curve.commit(&law, Segment::Grown { to: end, force, energy, joins: false }).is_err(),
            "{force} {energy}"
        );
        assert_eq!(curve, before);
    }
}

/// After growth along the limit line the last piece is slightly less steep. The limit line must cross only that piece, or the force
/// would not be finite.
#[test]
fn the_edge_crosses_no_path_that_runs_along_it() {
    let law = paraboloid();
    let slope = law.stick_slope();
    let mut curve = Curve::new(&law, Apex::default());
    let mut grow = |d: f64, u: f64, joins: bool| {
        curve.commit(&law, Segment::Grown { to: Apex { d, u }, force: 1.0, energy: 1e-9, joins }).unwrap();
    };
    grow(1e-7, slope * 1e-7, false);
    grow(1.5e-7, slope * (1e-7 + (1.0 - 1e-6) * 0.5e-7), true);
    let apex = curve.apex();
    let branch = curve.branch(&law, 1.0, 0.0);
    for ahead in [0.0, 1e-15, 5e-15] {
        let u = apex.u + ahead;
        let force = branch.force(&law, apex.d, u, law.reduced_force(apex.d));
        let asked = curve.dragged(&law, 1.0, Apex { d: apex.d, u }).force;
        assert!((force - asked).abs() < 1e-9 * asked.abs(), "{ahead:e}: {force:e} {asked:e}");
    }
}

// ---- Stacks that overflow

/// Reversals of a decay whose amplitude decreases by a fraction 1/`length` of the first or of the previous amplitude.
fn decays(length: i32) -> [Vec<f64>; 2] {
    let sign = |k: i32| if k % 2 == 0 { 0.9 } else { -0.9 };
    let even = (0..length).map(|k| sign(k) * (1.0 - f64::from(k) / f64::from(length))).collect();
    let geometric = (0..length).map(|k| sign(k) * (-5.0 * f64::from(k) / f64::from(length)).exp()).collect();
    [even, geometric]
}

#[test]
fn a_long_decay_in_a_small_stack_books_its_error() {
    let (law, d) = (paraboloid(), 1.8e-7);
    let (u_c, limit) = (law.gross_slip_displacement(d), law.friction() * law.normal_force(d));
    for turns in decays(100_000) {
        let start = Apex { d, u: 0.0 };
        let mut small = Curve::with_capacity(&law, start, 64);
        let mut large = Curve::with_capacity(&law, start, 200_000);
        let mut worst = 0.0_f64;
        for (k, turn) in turns.iter().enumerate() {
            for curve in [&mut small, &mut large] {
                curve.commit(&law, to(d, turn * u_c)).unwrap();
            }
            let booked = small.merged();
            // Later moves never enlarge a difference of rest positions. The recorded error of the force is therefore a bound for all
            // later times.
            let error = (small.force(&law) - large.force(&law)).abs();
            assert!(error <= booked.force + 1e-13 * limit, "turn {k}: {error:e} {booked:?}");
            let error = (small.elastic(&law) - large.elastic(&law)).abs();
            assert!(error <= booked.force * u_c + 1e-13 * limit * u_c, "turn {k}: {error:e} {booked:?}");
            worst = worst.max(error / (limit * u_c));
            assert!(small.knot_count() <= 64);
        }
        assert_eq!(large.merged().knots, 0);
        assert!(large.knot_count() > 99_000 && small.merged().knots > 99_000);
        // Large amplitudes close the loops in which the small stack has lost reversals, so the errors are largest here.
        for k in 0..200 {
            let part = 0.9 * f64::from(k) / 199.0;
            let probe = |curve: &Curve| curve.trial(&law, Move::Chord(Apex { d, u: part * u_c })).force;
            let error = (probe(&small) - probe(&large)).abs();
            assert!(error <= small.merged().force + 1e-12 * limit, "{part}: {error:e} {:?}", small.merged());
        }
        assert!(small.merged().force < limit, "booked more than all: {:?}", small.merged());
    }
}

// ---- Growth in tiny steps

#[test]
fn collinear_growth_in_tiny_steps_stays_one_piece() {
    // F_x = βG*M(d) = (βG*/E*)F_N, u = βd, from first touch and after an old history.
    for (law, offset) in
        [(paraboloid(), 0.0), (paraboloid(), 1e-6), (law(Profile::sphere(1e-3).unwrap(), 0.3), -3e-7)]
    {
        for ratio in [0.1, -0.5, 0.77, 0.999] {
            let beta = ratio * law.stick_slope();
            let mut curve = Curve::new(&law, Apex { d: 0.0, u: offset });
            let steps = 100_000;
            let mut deepest = 0;
            let mut lost = 0.0;
            for k in 1..=steps {
                let d = 1e-6 * f64::from(k) / f64::from(steps);
                lost += curve.commit(&law, to(d, offset + beta * d)).unwrap();
                deepest = deepest.max(curve.knot_count());
            }
            let (normal, limit) = (law.normal_force(1e-6), law.friction() * law.normal_force(1e-6));
            let force = curve.force(&law);
            assert!((force - beta * G / E * normal).abs() <= 1e-11 * limit, "{ratio}: {force:e}");
            assert!(deepest <= 4, "{ratio}, {offset}: {deepest} knots");
            assert_eq!(lost, 0.0);
        }
    }
}

#[test]
fn slightly_curved_growth_is_not_straightened() {
    // u = β[d + εd²/d₁] on a paraboloid: F_x = G*∫u'm dh = 2G*√R β[(2/3)d^{3/2} + (4/5)εd^{5/2}/d₁]. The chords are a quadrature
    // G*Σ(Δu/Δd)ΔM with the error Σu''ΔmΔ²/12 = ε(β/κ)μF_N/(4N²).
    let law = paraboloid();
    let (d1, beta, steps) = (1e-6, 0.4 * law.stick_slope(), 100_000);
    let limit = law.friction() * law.normal_force(d1);
    for bend in [1e-13, 1e-12, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 0.3] {
        for bend in [bend, -bend] {
            let path = |d: f64| beta * (d + bend * d * d / d1);
            // Contribution G*ΔM Δu/Δd of a chord, without cancellation in ΔM.
            let chord = |k: i32| {
                let edge = |k: i32| d1 * f64::from(k) / f64::from(steps);
                let (low, high) = (edge(k), edge(k + 1));
                let area = |d: f64| 4.0 / 3.0 * (1e-3 * d).sqrt() * d;
                let growth = if k > 0 {
                    (1.5 * ((high - low) / low).ln_1p()).exp_m1() * area(low)
                } else {
                    area(high)
                };
                G * beta * (1.0 + bend * (low + high) / d1) * growth
            };
            for (capacity, name) in [(200_000, "large"), (4096, "small")] {
                let mut curve = Curve::with_capacity(&law, Apex::default(), capacity);
                for k in 1..=steps {
                    let d = d1 * f64::from(k) / f64::from(steps);
                    curve.commit(&law, to(d, path(d))).unwrap();
                }
                let exact =
                    |d: f64| 2.0 * G * beta * (1e-3 * d).sqrt() * (2.0 / 3.0 * d + 0.8 * bend * d * d / d1);
                let booked = curve.merged().force;
                let missed = bend.abs() * 0.4 / (4.0 * f64::from(steps).powi(2)) * limit;
                let error = (curve.force(&law) - exact(d1)).abs();
                let allowed = 1e-13 * limit + 1.001 * missed + booked;
                assert!(error <= allowed, "{name}, {bend:e}: {:e} {:e}", error / limit, allowed / limit);
                // Result of the quadrature.
                let dense: f64 = (0..steps).map(chord).sum();
                let error = (curve.force(&law) - dense).abs();
                assert!(error <= 1e-13 * limit + booked, "{name}, {bend:e}: {:e} {booked:e}", error / limit);
                // The inner knots are tested by unloading to half the indentation along the same path.
                let half = curve.trial(&law, Move::Chord(Apex { d: 0.5 * d1, u: path(0.5 * d1) })).force;
                let error = (half - exact(0.5 * d1)).abs();
                assert!(error <= allowed, "{name}, {bend:e}: half {:e}", error / limit);
                assert!(
                    curve.knot_count() <= capacity && booked <= 1e-6 * limit,
                    "{name}, {bend:e}: {booked:e}"
                );
            }
        }
    }
}
