//! Tests of damped sticking springs: the force decreases with the duration of a move.

use approx::assert_relative_eq;
use std::sync::Arc;
use stickslip_contact::{
    Apex, Engine, Interface, Material, Memory, Move, Pair, Profile, Segment, Springs, Timed,
};

const RADIUS: f64 = 1e-3;
const MU: f64 = 0.2;
const BETA: f64 = 1e-6;
const DEPTH: f64 = 1e-6;

fn law(beta: f64) -> Interface {
    let steel = Material::new(210e9, 0.3).unwrap();
    Interface::new(Pair::new(steel, steel), Profile::paraboloid(RADIUS).unwrap(), MU)
        .unwrap()
        .with_damping(beta)
}

fn engines(law: &Interface) -> [Memory; 2] {
    let at = Apex { d: DEPTH, u: 0.0 };
    let springs = Springs::new(law.profile(), 4096, 2.0 * law.profile().radius(DEPTH)).unwrap();
    [Engine::Curve, Engine::Row(Arc::new(springs))].map(|engine| engine.memory(law, at))
}

/// F = μF_N(1 - (1 - u/u_c)^{3/2}) + βG\*2c u̇, c = a(1 - u/u_c)^{1/2} (4.30 and the stick radius of a paraboloid).
#[test]
fn a_move_in_a_time_adds_what_the_stuck_springs_oppose() {
    let law = law(BETA);
    let (limit, u_c) = (MU * law.normal_force(DEPTH), law.gross_slip_displacement(DEPTH));
    let (radius, modulus) = ((RADIUS * DEPTH).sqrt(), law.tangential_modulus());
    for (memory, allowed) in engines(&law).into_iter().zip([1e-12, 1e-3]) {
        for (share, duration) in [(0.3, 1e-5), (0.3, 1e-3), (0.8, 1e-4)] {
            let to = Apex { d: DEPTH, u: share * u_c };
            let exact = limit * (1.0 - (1.0 - share).powf(1.5))
                + BETA * modulus * 2.0 * radius * (1.0 - share).sqrt() * to.u / duration;
            let response = memory.trial(&law, Timed { path: Move::Chord(to), duration });
            assert_relative_eq!(response.force, exact, max_relative = allowed);
        }
        // In gross slip nothing sticks.
        let gross = Apex { d: DEPTH, u: 2.0 * u_c };
        let response = memory.trial(&law, Timed { path: Move::Chord(gross), duration: 1e-6 });
        assert_relative_eq!(response.force, limit, max_relative = 1e-6);
    }
}

/// Without damping, or with a duration of 0, the duration has no influence. The memory never depends on it.
#[test]
fn nothing_else_asks_how_long_it_takes() {
    let to = Apex { d: DEPTH, u: 20e-9 };
    let undamped = law(0.0);
    for mut memory in engines(&undamped) {
        let quick = memory.trial(&undamped, Timed { path: Move::Chord(to), duration: 1e-9 });
        assert_eq!(quick, memory.trial(&undamped, Move::Chord(to)));
        let mut other = memory.clone();
        let work = memory.commit(&undamped, Timed { path: Segment::Straight(to), duration: 1e-9 }).unwrap();
        assert_eq!(work, other.commit(&law(BETA), Segment::Straight(to)).unwrap());
        assert_eq!(memory, other);
    }
}
