//! Tests of the memory curve against 24 random reference histories of d and u, solved independently.
//!
//! The references are exact to 1e-11 of the largest friction force, and to 1e-6 of the largest friction work.

use crate::lottery::Lottery;
use serde_json::Value;
use stickslip_contact::{
    Apex, Curve, Dragged, Interface, Move, Outcome, Pair, Profile, Row, Segment, Springs,
};

struct History {
    law: Interface,
    /// Rows of d, u, F_N, F_x, tangential elastic energy and friction work.
    rows: Vec<[f64; 6]>,
}

fn histories() -> Vec<History> {
    let file: Value = serde_json::from_str(include_str!("../data/contact_histories.json")).unwrap();
    file["histories"].as_array().unwrap().iter().map(history).collect()
}

fn history(h: &Value) -> History {
    let number = |v: &Value| v.as_f64().unwrap();
    let shape = &h["profile"];
    let profile = match shape["kind"].as_str().unwrap() {
        "paraboloid" => Profile::paraboloid(number(&shape["radius_m"])),
        "cone" => Profile::foundation_power(number(&shape["foundation_slope"]), 1.0),
        "foundation power" => Profile::foundation_power(number(&shape["A_per_m3"]), 4.0),
        "foundation table" => {
            let heights: Vec<f64> = shape["heights_m"].as_array().unwrap().iter().map(number).collect();
            let lengths = vec![number(&shape["length_each_m"]); heights.len()];
            Profile::foundation(&heights, &lengths)
        }
        other => panic!("unknown profile {other}"),
    };
    let pair =
        Pair::from_moduli(number(&h["effective_modulus_Pa"]), number(&h["effective_shear_modulus_Pa"]));
    let law = Interface::new(pair.unwrap(), profile.unwrap(), number(&h["friction"])).unwrap();
    let row = |r: &Value| std::array::from_fn(|i| number(&r[i]));
    History { law, rows: h["rows"].as_array().unwrap().iter().map(row).collect() }
}

fn largest(rows: &[[f64; 6]], column: usize) -> f64 {
    rows.iter().map(|r| r[column].abs()).fold(0.0, f64::max)
}

#[test]
fn curve_meets_the_reference() {
    let all = histories();
    assert_eq!(all.len(), 24);
    for (i, History { law, rows }) in all.iter().enumerate() {
        let mut curve = Curve::new(law, Apex::default());
        let (force, elastic, work) = (largest(rows, 3), largest(rows, 4), largest(rows, 5));
        let mut friction = 0.0;
        for (k, [d, u, normal, fx, energy, booked]) in rows.iter().copied().enumerate() {
            let to = Apex { d, u };
            let seen = curve.preview(law, to);
            friction += curve.commit(law, Segment::Straight(to)).unwrap();
            let place = format!("history {i}, row {k}");
            assert!((law.normal_force(d) - normal).abs() <= 1e-12 * normal, "{place}: F_N");
            assert!((curve.force(law) - fx).abs() <= 1e-10 * force, "{place}: F_x {} {fx}", curve.force(law));
            assert!((curve.elastic(law) - energy).abs() <= 1e-10 * elastic, "{place}: elastic");
            assert!((friction - booked).abs() <= 1e-5 * work, "{place}: friction {friction} {booked}");
            assert!((seen.force - curve.force(law)).abs() <= 1e-13 * force, "{place}: preview");
            assert!((seen.elastic - curve.elastic(law)).abs() <= 1e-13 * elastic, "{place}: preview");
            assert_eq!(seen.stick_radius, curve.stick_radius(law), "{place}: stick radius");
        }
    }
}

#[test]
fn split_chords_end_where_whole_chords_end() {
    let mut lottery = Lottery(2024);
    for (i, History { law, rows }) in histories().iter().enumerate() {
        let (force, elastic, work) = (largest(rows, 3), largest(rows, 4), largest(rows, 5));
        let (mut whole, mut split) = (Curve::new(law, Apex::default()), Curve::new(law, Apex::default()));
        let (mut friction, mut parts) = (0.0, 0.0);
        for [d, u, ..] in rows.iter().copied() {
            let from = whole.apex();
            friction += whole.commit(law, Segment::Straight(Apex { d, u })).unwrap();
            let mut share = 0.0;
            while share < 1.0 {
                share = f64::min(1.0, share + 0.3 * lottery.draw());
                let at = |a: f64, b: f64| if share == 1.0 { b } else { a + share * (b - a) };
                let to = Apex { d: at(from.d, d), u: at(from.u, u) };
                parts += split.commit(law, Segment::Straight(to)).unwrap();
            }
            assert!((whole.force(law) - split.force(law)).abs() <= 1e-12 * force, "history {i}: F_x");
            assert!(
                (whole.elastic(law) - split.elastic(law)).abs() <= 1e-12 * elastic,
                "history {i}: elastic"
            );
            assert!((friction - parts).abs() <= 1e-12 * work, "history {i}: friction {friction} {parts}");
        }
        assert!(
            split.knot_count() <= whole.knot_count() + 8,
            "history {i}: {} {}",
            split.knot_count(),
            whole.knot_count()
        );
    }
}

#[test]
fn trials_leave_no_trace() {
    let mut lottery = Lottery(7);
    for History { law, rows } in &histories() {
        let (mut quiet, mut tried) = (Curve::new(law, Apex::default()), Curve::new(law, Apex::default()));
        let (d, u) = (largest(rows, 0), largest(rows, 1));
        let mut sum = Outcome::default().force;
        for row in rows {
            for _ in 0..100 {
                let to = Apex { d: d * (2.0 * lottery.draw() - 1.0), u: u * (2.0 * lottery.draw() - 1.0) };
                sum += tried.trial(law, Move::Chord(to)).force + tried.preview(law, to).friction;
            }
            let to = Segment::Straight(Apex { d: row[0], u: row[1] });
            assert_eq!(quiet.commit(law, to), tried.commit(law, to));
            assert_eq!(quiet, tried);
        }
        assert!(sum.is_finite());
    }
}

#[test]
fn friction_work_closes_the_energy_balance() {
    // ∫F_x du by Gauss quadrature over many short paths, independent of the work integral of the curve.
    let nodes = [0.5 - 15f64.sqrt() / 10.0, 0.5, 0.5 + 15f64.sqrt() / 10.0];
    let weights = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];
    for (i, History { law, rows }) in histories().iter().enumerate() {
        let mut curve = Curve::new(law, Apex::default());
        let (mut input, mut friction) = (0.0, 0.0);
        for [d, u, ..] in rows.iter().copied() {
            let from = curve.apex();
            let at = |s: f64| Apex { d: from.d + s * (d - from.d), u: from.u + s * (u - from.u) };
            let parts = 4000;
            for k in 0..parts {
                for (node, weight) in nodes.iter().zip(weights) {
                    let s = (k as f64 + node) / parts as f64;
                    input +=
                        weight * curve.trial(law, Move::Chord(at(s))).force * (u - from.u) / parts as f64;
                }
            }
            friction += curve.commit(law, Segment::Straight(Apex { d, u })).unwrap();
        }
        let gap = (input - curve.elastic(law) - friction).abs();
        assert!(gap <= 2e-7 * friction, "history {i}: {gap:e} of {friction:e}");
    }
}

/// Number of springs whose state differs between the engines, and number of compared springs.
fn differing_states(history: &History, count: usize) -> (usize, usize) {
    let History { law, rows } = history;
    let span = 2.0 * law.profile().radius(largest(rows, 0));
    let springs = Springs::new(law.profile(), count, span).unwrap();
    let heights: Vec<f64> = springs.heights_by_position().collect();
    let (mut curve, mut row) = (Curve::new(law, Apex::default()), Row::new(&springs));
    let (mut differing, mut compared) = (0, 0);
    for [d, u, ..] in rows.iter().copied() {
        let segment = Segment::Straight(Apex { d, u });
        curve.commit(law, segment).unwrap();
        row.commit(&springs, law, segment).unwrap();
        for (h, state) in heights.iter().zip(row.states(&springs, law)) {
            compared += 1;
            differing += usize::from(curve.spring_state(*h) != state);
        }
    }
    (differing, compared)
}

#[test]
fn both_engines_see_the_same_springs_stick_and_slip() {
    for (i, history) in histories().iter().enumerate() {
        let (differing, compared) = differing_states(history, 512);
        assert!(compared > 2000, "history {i}");
        assert_eq!(differing, 0, "history {i}: {differing} of {compared} springs");
    }
}

/// A shrinking contact may cross the old curve before the stepper detects it. Beyond the curve the force must continue with the slope
/// G\*m(d).
#[test]
fn the_law_of_an_edge_goes_on_smoothly_beside_the_curve() {
    let pair = Pair::from_moduli(1.15e11, 0.95e11).unwrap();
    let law = Interface::new(pair, Profile::paraboloid(1e-3).unwrap(), 0.2).unwrap();
    // A growth path in three pieces of increasing slope: a branch that starts on it is found on the curve itself.
    let mut curve = Curve::new(&law, Apex::default());
    let (mut force, mut energy, mut at) = (0.0, 0.0, Apex::default());
    for (d, slope) in [(1e-7, 0.02), (2e-7, 0.05), (3e-7, 0.1)] {
        let end = Apex { d, u: at.u + slope * (d - at.d) };
        let more = law.tangential_modulus()
            * slope
            * (law.profile().reduced_force(d) - law.profile().reduced_force(at.d));
        // ½∫F du over the piece, with F linear in M; accurate enough because energies do not affect forces.
        energy += (force + 0.5 * more) * (end.u - at.u);
        force += more;
        curve.commit(&law, Segment::Grown { to: end, force, energy, joins: at.d > 0.0 }).unwrap();
        at = end;
    }
    let (d, u) = (2.5e-7, 2.0e-9 + 0.05 * 1e-7 + 0.1 * 0.5e-7);
    let stiffness = law.stick_stiffness(d);
    for sense in [1.0, -1.0] {
        let at = |beside: f64| curve.dragged(&law, sense, Apex { d, u: u + beside });
        let Dragged { force: here, front } = at(0.0);
        assert!((front / d - 1.0).abs() < 1e-9);
        for beside in [1e-12, -1e-12] {
            let slope = (at(beside).force - here) / beside;
            assert!((slope / stiffness - 1.0).abs() < 1e-3, "{sense} {beside:e}: {}", slope / stiffness);
        }
        // Second-order expansion of the law: F + G\*m δ - σ G\*m'δ²/2(κ-σk).
        let bend = law.tangential_modulus() * law.profile().reduced_stiffness(d)
            / (2.0 * d)
            / (law.stick_slope() - sense * 0.1);
        let beside = -sense * 1e-9;
        let known = here + stiffness * beside - 0.5 * sense * bend * beside * beside;
        assert!(((at(beside).force - known) / (known - here - stiffness * beside)).abs() < 0.02);
    }
}

/// Pieces made by slip lie on the limit line to rounding. The slip front must not depend on this rounding, because the friction power
/// depends on the front.
#[test]
fn an_edge_at_rest_begins_where_its_last_move_left_it() {
    let pair = Pair::from_moduli(1.15e11, 0.95e11).unwrap();
    let law = Interface::new(pair, Profile::paraboloid(1e-3).unwrap(), 0.2).unwrap();
    let mut lottery = Lottery(7);
    for _ in 0..50 {
        let (d, u) = (3e-7 * (1.0 + lottery.draw()), 1e-6 * lottery.draw());
        let mut curve = Curve::new(&law, Apex { d, u });
        let mut at = curve.apex();
        for _ in 0..40 {
            let (rise, drag) = (2e-9 * (lottery.draw() - 0.5), 1e-9 * lottery.draw());
            at = Apex { d: at.d + rise, u: at.u + law.stick_slope() * rise.abs() + drag };
            curve.commit(&law, Segment::Straight(at)).unwrap();
            let Dragged { force, front } = curve.dragged(&law, 1.0, at);
            let known = law.profile().depth(curve.stick_radius(&law));
            assert!((front - known).abs() < 1e-9 * at.d, "{front:e} {known:e}");
            assert!((force / curve.force(&law) - 1.0).abs() < 1e-9);
        }
    }
}
