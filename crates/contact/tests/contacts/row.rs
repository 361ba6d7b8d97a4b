//! Tests of the row of springs against closed forms and independent reference histories.

use serde_json::Value;
use std::sync::Arc;
use stickslip_contact::{
    Apex, Change, ContactError, ContactState, Interface, Motion, Move, Pair, Profile, Row, Segment, Slack,
    SpringState, Springs, SpringsError,
};

fn to(d: f64, u: f64) -> Segment {
    Segment::Straight(Apex { d, u })
}

fn chord(d: f64, u: f64) -> Move {
    Move::Chord(Apex { d, u })
}

/// Interface with E* = 1, G* = 0.8 and μ = 0.3, so κ = 0.375.
fn law(profile: Profile) -> Interface {
    Interface::new(Pair::from_moduli(1.0, 0.8).unwrap(), profile, 0.3).unwrap()
}

/// Pseudo-random number in [0, 1), the same on every machine (Marsaglia's xorshift).
fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1u64 << 53) as f64
}

/// Order of convergence: minus the slope of log error over log N, by least squares.
fn order(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(n, e)| (n.ln(), e.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) = logs.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
    let top: f64 = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let bottom: f64 = logs.iter().map(|p| (p.0 - x).powi(2)).sum();
    -top / bottom
}

fn powers() -> [(f64, Profile); 3] {
    [1.0, 2.0, 4.0].map(|n| (n, Profile::foundation_power(1.0, n).unwrap()))
}

/// Row over 1.37 times the contact width at d = 1, so that the contact edge lies anywhere in a cell.
fn row(profile: &Profile, count: usize) -> (Springs, Row) {
    let springs = Springs::new(profile, count, 1.37 * 2.0 * profile.radius(1.0)).unwrap();
    let row = Row::new(&springs);
    (springs, row)
}

const COUNTS: [usize; 8] = [100, 200, 400, 800, 1600, 3200, 6400, 12800];

/// Largest error over several numbers of springs near a count, because the position of the contact edge in its cell makes single
/// errors erratic.
fn convergence(error: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
    let worst = |count: usize| (0..8).map(|k| error(count + 2 * k)).fold(0.0, f64::max);
    COUNTS.iter().map(|&count| (count as f64, worst(count))).collect()
}

#[test]
fn loading_follows_the_closed_form_at_second_order() {
    // F_x = μF_N[1-(1-u/u_c)^p], p = (n+1)/n.
    for (n, profile) in powers() {
        let law = law(profile);
        let (limit, u) = (law.friction() * law.normal_force(1.0), 0.6 * law.gross_slip_displacement(1.0));
        let exact = limit * (1.0 - 0.4_f64.powf((n + 1.0) / n));
        let errors = convergence(|count| {
            let (springs, mut row) = row(law.profile(), count);
            row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
            (row.force(&springs, &law, Apex { d: 1.0, u }) - exact).abs() / limit
        });
        assert!((order(&errors) - 2.0).abs() < 0.1, "n = {n}: order {} from {errors:?}", order(&errors));
        assert!(errors[7].1 < 1e-7, "n = {n}: {errors:?}");
    }
}

#[test]
fn unloading_and_the_loop_follow_the_closed_forms() {
    // Unloading F₁ - 2μF_N[1-(1-(u₁-u)/2u_c)^p]; loop energy 4 × first-loading work.
    for (n, profile) in powers() {
        let law = law(profile);
        let p = (n + 1.0) / n;
        let (limit, u_c) = (law.friction() * law.normal_force(1.0), law.gross_slip_displacement(1.0));
        let amplitude = 0.7_f64;
        let q = 1.0 - amplitude;
        let quarter = amplitude + amplitude * q.powf(p) - 2.0 / (p + 1.0) * (1.0 - q.powf(p + 1.0));
        let (springs, mut row) = row(law.profile(), 20_000);
        let mut go = |u: f64| row.commit(&springs, &law, to(1.0, u * u_c)).unwrap();
        go(0.0);
        let first = go(amplitude);
        assert!((first / (limit * u_c) - quarter).abs() < 1e-7, "n = {n}: {first}");
        // The works of unequal parts of a path add up.
        let cycle: f64 = [0.3, 0.1, -amplitude, -0.69, 0.2, amplitude].map(&mut go).iter().sum();
        assert!((cycle / (4.0 * limit * u_c) - quarter).abs() < 1e-7, "n = {n}: {cycle}");
        let u = 0.1;
        let exact = (1.0 - q.powf(p)) - 2.0 * (1.0 - (1.0 - (amplitude - u) / 2.0).powf(p));
        let force = row.force(&springs, &law, Apex { d: 1.0, u: u * u_c });
        assert!((force / limit - exact).abs() < 1e-7, "n = {n}: {force}");
    }
}

#[test]
fn a_gross_slip_loop_has_its_closed_form() {
    // U > u_c: 4μF_N[U - 2u_c/(p+1)].
    for (n, profile) in powers() {
        let law = law(profile);
        let (limit, u_c) = (law.friction() * law.normal_force(1.0), law.gross_slip_displacement(1.0));
        let (springs, mut row) = row(law.profile(), 20_000);
        let mut go = |u: f64| row.commit(&springs, &law, to(1.0, u * u_c)).unwrap();
        go(0.0);
        go(1.8);
        let cycle = go(-1.8) + go(1.8);
        let exact = 4.0 * limit * u_c * (1.8 - 2.0 / ((n + 1.0) / n + 1.0));
        assert!((cycle / exact - 1.0).abs() < 1e-7, "n = {n}: {cycle} {exact}");
    }
}

#[test]
fn lowering_and_raising_remembers() {
    // g = x², d 1 → .6 → 1 at u = .5u_c: F_x 0.258579 → 0.173254 → 0.173254.
    let law = law(Profile::paraboloid(1.0).unwrap());
    let (springs, mut row) = row(law.profile(), 40_000);
    let u = 0.5 * law.gross_slip_displacement(1.0);
    row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
    let mut forces = Vec::new();
    for d in [1.0, 0.6, 1.0] {
        row.commit(&springs, &law, to(d, u)).unwrap();
        forces.push(row.force(&springs, &law, Apex { d, u }));
    }
    for (force, exact) in forces.iter().zip([0.258579, 0.173254, 0.173254]) {
        assert!((force - exact).abs() < 6e-7, "{forces:?}");
    }
    // After raising and lowering, the old value is restored exactly.
    row.commit(&springs, &law, to(1.2, u)).unwrap();
    row.commit(&springs, &law, to(1.0, u)).unwrap();
    assert_eq!(row.force(&springs, &law, Apex { d: 1.0, u }), forces[2]);
}

#[test]
fn oblique_loading_sticks_or_slips_as_a_whole() {
    // u = βd from first touch: |β| < κ: F_x/F_N = βG*/E*, no friction work; otherwise F_x = ±μF_N.
    let law = law(Profile::paraboloid(1.0).unwrap());
    let kappa = law.stick_slope();
    for (beta, state) in [(0.9, ContactState::Stick), (-0.5, ContactState::Stick), (-1.1, ContactState::Slip)]
    {
        let (springs, mut row) = row(law.profile(), 20_000);
        let end = chord(1.0, beta * kappa);
        let seen = row.preview(&springs, &law, end);
        let ratio = beta.clamp(-1.0, 1.0) * law.friction();
        assert!((seen.force / law.normal_force(1.0) - ratio).abs() < 1e-7 && seen.state == state);
        let work = row.commit(&springs, &law, to(1.0, beta * kappa)).unwrap();
        // The same sum in a different order.
        assert!((work - seen.friction).abs() <= 1e-13 * work.max(1e-4));
        if state == ContactState::Stick {
            assert!(work < 1e-17, "{work}");
        } else {
            // Springs slip at (|β|-κ)/κ of their limit's rate: ∫ μE*(d-h)… = μ(|β|-κ)∫F_N dd.
            let exact = law.friction() * (beta.abs() - 1.0) * kappa * law.normal_energy(1.0);
            assert!((work / exact - 1.0).abs() < 1e-7, "{work} {exact}");
        }
    }
}

#[test]
fn a_spring_that_touches_inside_a_step_starts_where_it_touches() {
    // From d = -1 to 1 with u from 0 to 2v: the same as from d = 0 with u from v to 2v.
    let law = law(Profile::sphere(3.0).unwrap());
    let (springs, start) = row(law.profile(), 1000);
    let v = 0.3 * law.stick_slope();
    let (mut opened, mut touching) = (Row::at(&springs, Apex { d: -1.0, u: 0.0 }), start);
    opened.commit(&springs, &law, to(1.0, 2.0 * v)).unwrap();
    touching.commit(&springs, &law, to(0.0, v)).unwrap();
    touching.commit(&springs, &law, to(1.0, 2.0 * v)).unwrap();
    let force = |row: &Row| row.force(&springs, &law, Apex { d: 1.0, u: 2.0 * v });
    assert!((force(&opened) / force(&touching) - 1.0).abs() < 1e-14);
    assert!((force(&opened) / law.normal_force(1.0) - v * 0.8).abs() < 1e-5);
}

#[test]
fn lifting_off_in_one_step_dissipates_what_was_stored() {
    // Lift-off at constant u: the friction work equals the elastic energy, and the work ∫F_x du is 0, for any number of steps.
    let law = law(Profile::paraboloid(1.0).unwrap());
    let (springs, mut row) = row(law.profile(), 20_001);
    let u = 0.8 * law.gross_slip_displacement(1.0);
    row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
    row.commit(&springs, &law, to(1.0, u)).unwrap();
    let stored = row.elastic(&springs, &law);
    let mut stepwise = row.clone();
    let at_once = row.commit(&springs, &law, to(-0.5, u)).unwrap();
    let in_steps: f64 = [0.9, 0.55, 0.3, 0.299, 0.0, -0.5]
        .map(|d| stepwise.commit(&springs, &law, to(d, u)).unwrap())
        .iter()
        .sum();
    assert!((at_once / stored - 1.0).abs() < 1e-12 && (in_steps / stored - 1.0).abs() < 1e-12);
    assert_eq!(row.elastic(&springs, &law), 0.0);
    assert_eq!(row.preview(&springs, &law, chord(-0.5, u)).state, ContactState::Open);
    assert!(row.states(&springs, &law).all(|state| state == SpringState::Open));
    assert_eq!(row, stepwise);
}

#[test]
fn friction_work_is_the_work_put_in_less_what_is_stored() {
    // ∫F_x du - ΔE along random chords, by Gauss–Legendre quadrature of the force over short pieces.
    let law = law(Profile::sphere(2.0).unwrap());
    let (springs, mut row) = row(law.profile(), 333);
    let (mut seed, mut from) = (7, Apex::default());
    let (mut booked, mut input, mut scale) = (0.0, 0.0, 0.0_f64);
    for _ in 0..60 {
        let end = Apex { d: 1.4 * random(&mut seed) - 0.3, u: 1.2 * (random(&mut seed) - 0.5) };
        let pieces = 4000;
        for k in 0..pieces {
            let at = |part: f64| {
                let part = (f64::from(k) + part) / f64::from(pieces);
                Apex { d: from.d + part * (end.d - from.d), u: from.u + part * (end.u - from.u) }
            };
            let du = (end.u - from.u) / f64::from(pieces);
            input += 0.5
                * du
                * (row.force(&springs, &law, at(0.5 - 0.5 / 3_f64.sqrt()))
                    + row.force(&springs, &law, at(0.5 + 0.5 / 3_f64.sqrt())));
        }
        booked += row.commit(&springs, &law, Segment::Straight(end)).unwrap();
        from = end;
        scale = scale.max(booked).max(row.elastic(&springs, &law));
        let balance = input - booked - row.elastic(&springs, &law);
        assert!(balance.abs() <= 1e-7 * scale, "{balance:e} of {scale:e}");
    }
    assert!(scale > 0.1);
}

#[test]
fn tangents_are_the_slopes_of_the_force() {
    let law = law(Profile::paraboloid(1.0).unwrap());
    let (springs, mut row) = row(law.profile(), 501);
    row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
    row.commit(&springs, &law, to(1.0, 0.2)).unwrap();
    let mut seed = 3;
    for _ in 0..40 {
        // d decreases and no spring is new, so the derivatives are those at the end of the path.
        let end = Apex { d: 1.0 - 0.5 * random(&mut seed), u: 0.2 - 0.5 * random(&mut seed) };
        let response = row.trial(&springs, &law, Move::Chord(end));
        assert!((response.force - row.force(&springs, &law, end)).abs() < 1e-15);
        let step = 1e-9;
        let force = |d: f64, u: f64| row.force(&springs, &law, Apex { d: end.d + d, u: end.u + u });
        let stiffness = (force(0.0, step) - force(0.0, -step)) / (2.0 * step);
        let coupling = (force(step, 0.0) - force(-step, 0.0)) / (2.0 * step);
        assert!((response.stiffness - stiffness).abs() < 1e-5, "{response:?} {stiffness}");
        assert!((response.coupling - coupling).abs() < 1e-5, "{response:?} {coupling}");
    }
}

#[test]
fn states_show_stick_inside_and_slip_outside() {
    // c/a = (1-u/u_c)^{1/n} at first loading; after a reversal the edge slips in the opposite direction.
    let law = law(Profile::paraboloid(1.0).unwrap());
    let springs = Springs::new(law.profile(), 1001, 3.0).unwrap();
    let u_c = law.gross_slip_displacement(1.0);
    let mut row = Row::new(&springs);
    row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
    assert!(row.states(&springs, &law).all(|s| s == SpringState::Stick || s == SpringState::Open));
    row.commit(&springs, &law, to(1.0, 0.75 * u_c)).unwrap();
    let state = |x: f64| match x.abs() {
        x if x > 1.0 => SpringState::Open,
        x if x > 0.5 => SpringState::SlipForward,
        _ => SpringState::Stick,
    };
    assert_eq!(springs.count(), 1001);
    for (&x, seen) in springs.positions().iter().zip(row.states(&springs, &law)) {
        assert_eq!(seen, state(x), "{x}");
    }
    let seen = row.preview(&springs, &law, chord(1.0, 0.75 * u_c));
    assert!((seen.stick_radius - 0.5).abs() < 3e-3 && seen.state == ContactState::Partial);
    // Repeating the move changes nothing: the springs remain at their limit.
    row.commit(&springs, &law, to(1.0, 0.75 * u_c)).unwrap();
    assert!(row.states(&springs, &law).any(|s| s == SpringState::SlipForward));
    row.commit(&springs, &law, to(1.0, 0.75 * u_c * (1.0 - 1e-9))).unwrap();
    assert!(row.states(&springs, &law).all(|s| s != SpringState::SlipForward));
    row.commit(&springs, &law, to(1.0, 0.25 * u_c)).unwrap();
    // 0.5u_c back: slip backward outside (1-0.25)^(1/2).
    for ((&x, seen), s) in
        springs.positions().iter().zip(row.states(&springs, &law)).zip(row.stretches(&springs, &law))
    {
        let limit = (law.stick_slope() * (1.0 - x * x)).max(0.0);
        assert_eq!(seen == SpringState::SlipBackward, x.abs() > 0.75_f64.sqrt() && x.abs() < 1.0, "{x}");
        assert!(s.abs() <= limit * (1.0 + 1e-12));
    }
}

#[test]
fn a_sliding_spring_stays_at_its_limit_wherever_rounding_takes_it() {
    // Far from the origin u - (u - κd) rounds to either side of κd.
    let law = law(Profile::paraboloid(1.0).unwrap());
    let (springs, mut row) = row(law.profile(), 64);
    row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
    let mut seed = 11;
    for k in 0..2000 {
        let u = row.apex().u + (0.4 + random(&mut seed)) * if k % 2 == 0 { 1.0 } else { 1.0 / 3.0 };
        row.commit(&springs, &law, to(1.0, u)).unwrap();
        let slips = |s: SpringState| s == SpringState::SlipForward || s == SpringState::Open;
        assert!(row.states(&springs, &law).all(slips), "at step {k}");
        let here = row.trial(&springs, &law, chord(1.0, u));
        assert_eq!(
            (here.stiffness, here.force),
            (0.0, row.force(&springs, &law, Apex { d: 1.0, u: u + 1.0 }))
        );
    }
}

#[test]
fn trials_leave_no_trace_and_refusals_neither() {
    let law = law(Profile::paraboloid(1.0).unwrap());
    let (springs, mut row) = row(law.profile(), 64);
    row.commit(&springs, &law, to(0.8, 0.1)).unwrap();
    let before = row.clone();
    row.trial(&springs, &law, chord(0.2, -0.4));
    row.preview(&springs, &law, chord(1.0, 0.4));
    let outgrown = row.commit(&springs, &law, to(2.0, 0.1));
    assert!(matches!(outgrown, Err(ContactError::Outgrown { d: 2.0, .. })));
    assert!(matches!(row.commit(&springs, &law, to(f64::NAN, 0.1)), Err(ContactError::NotFinite { .. })));
    assert!(row.commit(&springs, &law, to(0.5, f64::INFINITY)).is_err());
    assert_eq!(row, before);
    assert!((springs.reach() - 1.37 * 1.37).abs() < 1e-14);
}

#[test]
fn other_segments_are_chords_to_their_ends() {
    let law = law(Profile::paraboloid(1.0).unwrap());
    let (springs, row) = row(law.profile(), 64);
    let end = Apex { d: 0.9, u: 0.2 };
    let ends = [
        Segment::Straight(end),
        Segment::Jump(end),
        Segment::Grown { to: end, force: 1.0, energy: 1.0, joins: false },
    ];
    let rows = ends.map(|segment| {
        let mut row = row.clone();
        row.commit(&springs, &law, segment).unwrap();
        row
    });
    assert!(rows[0] == rows[1] && rows[0] == rows[2]);
    let grown = row.trial(&springs, &law, Move::Grown { to: end, force: 9.0 });
    assert_eq!(grown, row.trial(&springs, &law, Move::Chord(end)));
}

#[test]
fn without_friction_everything_slips_and_nothing_is_lost() {
    let profile = Profile::paraboloid(1.0).unwrap();
    let law = Interface::new(Pair::from_moduli(1.0, 0.8).unwrap(), profile, 0.0).unwrap();
    let (springs, mut row) = row(law.profile(), 64);
    row.commit(&springs, &law, to(1.0, 0.0)).unwrap();
    assert_eq!(row.commit(&springs, &law, to(1.0, -1.0)), Ok(0.0));
    assert_eq!(row.force(&springs, &law, Apex { d: 1.0, u: 3.0 }), 0.0);
    assert!(row.states(&springs, &law).all(|s| s == SpringState::SlipBackward || s == SpringState::Open));
}

#[test]
fn a_flat_punch_slips_all_at_once() {
    let law = law(Profile::flat(1.0).unwrap());
    let springs = Springs::new(law.profile(), 7, 2.0).unwrap();
    let mut row = Row::new(&springs);
    row.commit(&springs, &law, to(0.5, 0.0)).unwrap();
    let u_c = law.gross_slip_displacement(0.5);
    assert!(
        (row.force(&springs, &law, Apex { d: 0.5, u: 0.9 * u_c }) / (1.6 * 0.9 * u_c) - 1.0).abs() < 1e-14
    );
    let limit = law.friction() * law.normal_force(0.5);
    assert!((row.force(&springs, &law, Apex { d: 0.5, u: 5.0 * u_c }) / limit - 1.0).abs() < 1e-14);
    assert_eq!(springs.reach(), f64::INFINITY);
}

#[test]
fn what_is_out_of_range_is_refused() {
    let profile = Profile::paraboloid(1.0).unwrap();
    assert_eq!(Springs::new(&profile, 0, 1.0), Err(SpringsError::Count(0)));
    assert_eq!(Springs::new(&profile, usize::MAX, 1.0), Err(SpringsError::Count(usize::MAX)));
    assert_eq!(Springs::new(&profile, 4, 0.0), Err(SpringsError::Span(0.0)));
    assert!(Springs::new(&profile, 4, f64::NAN).is_err());
    let narrow = Springs::new(&Profile::flat(1.0).unwrap(), 4, 1.0);
    assert_eq!(narrow, Err(SpringsError::Narrow { span: 1.0, width: 2.0 }));
}

/// Reference history: profile, interface and rows (d, u, `F_N`, `F_x`, elastic energy, friction work).
struct History {
    law: Interface,
    smooth: bool,
    rows: Vec<Vec<f64>>,
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn history(value: &Value) -> History {
    let profile = &value["profile"];
    let list = |name: &str| profile[name].as_array().unwrap().iter().map(number).collect::<Vec<f64>>();
    let (profile, smooth) = match profile["kind"].as_str().unwrap() {
        "paraboloid" => (Profile::paraboloid(number(&profile["radius_m"])), true),
        "cone" => (Profile::foundation_power(number(&profile["foundation_slope"]), 1.0), true),
        "foundation power" => (Profile::foundation_power(number(&profile["A_per_m3"]), 4.0), true),
        "foundation table" => {
            let heights = list("heights_m");
            let lengths = vec![number(&profile["length_each_m"]); heights.len()];
            (Profile::foundation(&heights, &lengths), false)
        }
        other => panic!("unknown profile {other}"),
    };
    let pair = Pair::from_moduli(
        number(&value["effective_modulus_Pa"]),
        number(&value["effective_shear_modulus_Pa"]),
    );
    let law = Interface::new(pair.unwrap(), profile.unwrap(), number(&value["friction"])).unwrap();
    let rows = value["rows"].as_array().unwrap();
    History {
        law,
        smooth,
        rows: rows.iter().map(|row| row.as_array().unwrap().iter().map(number).collect()).collect(),
    }
}

/// Largest errors of `F_N`, `F_x` (relative to the largest `F_N` or `μF_N`), elastic energy and friction work (relative to their
/// largest value).
fn errors(history: &History, count: usize) -> [f64; 4] {
    let History { law, rows, .. } = history;
    let largest = |column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, f64::max);
    let scales = [largest(2), law.friction() * largest(2), largest(4), largest(5)];
    let springs = Springs::new(law.profile(), count, 2.0 * law.profile().radius(largest(0))).unwrap();
    let (mut row, mut work, mut worst) = (Row::new(&springs), 0.0, [0.0_f64; 4]);
    for reference in rows {
        let end = Apex { d: reference[0], u: reference[1] };
        let seen = row.preview(&springs, law, Move::Chord(end));
        let trial = row.trial(&springs, law, Move::Chord(end));
        let booked = row.commit(&springs, law, Segment::Straight(end)).unwrap();
        work += booked;
        assert!((seen.friction - booked).abs() <= 1e-12 * scales[3]);
        let own = [law.normal_force(end.d), row.force(&springs, law, end), row.elastic(&springs, law), work];
        for other in [seen.force, trial.force] {
            assert!((other - own[1]).abs() <= 1e-13 * scales[1]);
        }
        assert!((seen.elastic - own[2]).abs() <= 1e-13 * scales[2]);
        for k in 0..4 {
            worst[k] = worst[k].max((own[k] - reference[2 + k]).abs() / scales[k]);
        }
    }
    worst
}

fn histories() -> Vec<History> {
    let text = include_str!("../data/contact_histories.json");
    let file: Value = serde_json::from_str(text).unwrap();
    file["histories"].as_array().unwrap().iter().map(history).collect()
}

#[test]
fn it_follows_the_reference_histories() {
    let histories = histories();
    assert_eq!(histories.len(), 24);
    for (place, history) in histories.iter().enumerate() {
        let seen = errors(history, 4096);
        // The references are exact to 1e-11 in forces and elastic energy and to 1e-6 in friction work.
        let bounds = if history.smooth { [1e-12, 1e-6, 1e-6, 1e-5] } else { [1e-12, 1e-12, 1e-12, 1e-5] };
        assert!(seen.iter().zip(bounds).all(|(seen, bound)| *seen <= bound), "history {place}: {seen:?}");
    }
}

#[test]
fn it_converges_on_the_reference_histories_at_second_order() {
    for (place, history) in histories().iter().enumerate().filter(|(_, history)| history.smooth) {
        let points: Vec<(f64, f64)> = [32, 64, 128, 256, 512, 1024, 2048]
            .map(|count| (f64::from(count), errors(history, count as usize)[1]))
            .to_vec();
        assert!((order(&points) - 2.0).abs() < 0.3, "history {place}: {} {points:?}", order(&points));
    }
}

#[test]
fn equal_rows_give_equal_bits() {
    let history = &histories()[1];
    let run = || {
        let springs =
            Springs::new(history.law.profile(), 777, 2.0 * history.law.profile().radius(3e-7)).unwrap();
        let mut row = Row::new(&springs);
        for reference in &history.rows {
            row.commit(&springs, &history.law, to(reference[0], reference[1])).unwrap();
        }
        let at = row.apex();
        (row.force(&springs, &history.law, at).to_bits(), row)
    };
    assert_eq!(run(), run());
}

/// F_N of a row is the sum over its own springs, computed here from the midpoints of the cells.
#[test]
fn the_normal_force_of_a_row_is_the_sum_over_its_springs() {
    let profile = Profile::paraboloid(1.0).unwrap();
    let span = 2.2;
    for count in [1, 2, 16, 17, 1000] {
        let springs = Arc::new(Springs::new(&profile, count, span).unwrap());
        let law = law(profile.clone()).on_springs(springs);
        let cell = span / f64::from(count as u32);
        let sum = |power: i32, d: f64| -> f64 {
            let x = |i: usize| -0.5 * span + (i as f64 + 0.5) * cell;
            (0..count).map(|i| cell * (d - x(i).powi(2)).max(0.0).powi(power)).sum()
        };
        for d in [-0.1, 0.0, 1e-4, 0.03, 0.4, 0.9, 1.2] {
            let (force, energy) = (sum(1, d), 0.5 * sum(2, d));
            assert!((law.normal_force(d) - force).abs() <= 1e-14, "{count} springs, F_N({d})");
            assert!((law.normal_energy(d) - energy).abs() <= 1e-14, "{count} springs, energy at {d}");
            // E* = 1: the inverse is exact between two heights.
            if force > 0.0 {
                assert!((law.indentation(force) - d).abs() <= 1e-14, "{count} springs, d of {force}");
                let stiffness = law.normal_stiffness(d);
                let slope = (sum(1, d + 1e-9) - sum(1, d - 1e-9)) / 2e-9;
                assert!((stiffness - slope).abs() < 1e-5, "{count} springs, {stiffness} and {slope}");
            }
        }
    }
}

/// Until a spring changes, the force of the row equals the linear law of its interval for any motion.
#[test]
fn a_lull_is_the_row_until_its_end() {
    let profile = Profile::paraboloid(1.0).unwrap();
    let (springs, mut row) = row(&profile, 101);
    let springs = Arc::new(springs);
    let law = law(profile).on_springs(Arc::clone(&springs));
    let slack = Slack { d: 1e-14, u: 1e-14 };
    let (mut seed, mut looked) = (7, 0);
    for _ in 0..2000 {
        let mut next = || 2.0 * random(&mut seed) - 1.0;
        let (dd, du) = (next(), next());
        let from = row.apex();
        let at = Motion { d: from.d, u: from.u, dd, du };
        let lull = row.lull(&springs, &law, (&at, Change::Any), slack, None);
        // Positions on a straight path before its first change.
        let inside = |t: f64| {
            let to = Apex { d: from.d + t * dd, u: from.u + t * du };
            let sticks = lull.left(1.0, to).min(lull.left(-1.0, to)) > 0.0;
            (sticks && to.d < lull.next() && to.d > lull.top()).then_some(to)
        };
        let mut t = 0.1;
        while inside(t).is_none() && t > 1e-9 {
            t *= 0.5;
        }
        if let Some(to) = inside(t) {
            let (one, all) = (lull.force(&law, to), row.force(&springs, &law, to));
            assert!((one - all).abs() < 1e-14, "{one} and {all} at {to:?}, {lull:?}");
            assert!((lull.reduced_force(to.d) - springs.reduced_force(to.d)).abs() < 1e-14);
            looked += 1;
        }
        let (d, u) = (0.6 + 0.35 * next(), from.u + 0.2 * next());
        row.commit(&springs, &law, Segment::Straight(Apex { d, u })).unwrap();
    }
    assert!(looked > 1500, "{looked}");
}

/// A spring that touched while the contact was at rest has no stretch. When the indentation decreases it reaches both limits and
/// lifts off at the same time. The order in which these events are found must not change the forces of the springs below.
#[test]
fn a_spring_that_parts_unstretched_moves_no_other() {
    let profile = Profile::paraboloid(1.0).unwrap();
    let (springs, _) = row(&profile, 101);
    let springs = Arc::new(springs);
    let law = law(profile).on_springs(Arc::clone(&springs));
    let slack = Slack { d: 1e-9, u: 1e-9 };
    let mut looked = 0;
    for height in springs.heights_by_position().filter(|height| (0.1..0.9).contains(height)) {
        // All springs in contact below 0.1 are stretched, and none above.
        let mut row = Row::at(&springs, Apex { d: 0.1, u: 0.0 });
        for to in [Apex { d: 0.1, u: 0.01 }, Apex { d: 0.95, u: 0.01 }, Apex { d: height + 1e-10, u: 0.01 }] {
            row.commit(&springs, &law, Segment::Straight(to)).unwrap();
        }
        let from = row.apex();
        let at = Motion { d: from.d, u: from.u, dd: -1.0, du: 0.0 };
        for change in [Change::Parts, Change::Slips(1.0), Change::Slips(-1.0), Change::Any] {
            let lull = row.lull(&springs, &law, (&at, change), slack, None);
            let to = Apex { d: height - 1e-4, u: from.u };
            for to in [from, to] {
                let (one, all) = (lull.force(&law, to), row.force(&springs, &law, to));
                assert!((one - all).abs() < 1e-9, "{one} and {all} at {to:?} after {change:?}");
            }
            looked += 1;
        }
    }
    assert!(looked > 100, "{looked}");
}

/// On random paths a row is in gross slip exactly when its lowest spring slips.
#[test]
fn the_lowest_spring_is_the_last_to_slip() {
    let mut seed = 0x1d0_5eed;
    for (_, profile) in powers() {
        let law = law(profile);
        let (springs, mut row) = row(law.profile(), 41);
        let (mut slips, mut sticks) = (0, 0);
        for _ in 0..3000 {
            let (d, u) = (0.2 + 0.8 * random(&mut seed), 1.5 * (random(&mut seed) - 0.5));
            row.commit(&springs, &law, to(d, u)).unwrap();
            let whole = row.preview(&springs, &law, chord(d, u)).state == ContactState::Slip;
            let lowest = row.lowest(&springs, &law);
            assert_eq!(
                matches!(lowest, SpringState::SlipForward | SpringState::SlipBackward),
                whole,
                "{d} {u}"
            );
            if whole { slips += 1 } else { sticks += 1 }
        }
        assert!(slips > 200 && sticks > 200, "{slips} {sticks}");
    }
}
