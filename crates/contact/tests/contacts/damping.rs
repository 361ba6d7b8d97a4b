//! Tests of damped contacts: every spring carries G\*(s + βu̇), limited to its friction limit.

use crate::lottery::Lottery;
use approx::assert_relative_eq;
use std::sync::Arc;
use stickslip_contact::{
    Apex, Course, Engine, Guard, Interface, Law, Load, Material, Memory, Motion, Pair, Profile, Scale,
    Segment, Since, Site, Springs,
};

const RADIUS: f64 = 1e-3;
const MU: f64 = 0.2;
const BETA: f64 = 1e-6;
const DEPTH: f64 = 1e-6;

fn law(beta: f64) -> Interface {
    law_of(Profile::paraboloid(RADIUS).unwrap(), beta)
}

fn law_of(profile: Profile, beta: f64) -> Interface {
    let steel = Material::new(210e9, 0.3).unwrap();
    Interface::new(Pair::new(steel, steel), profile, MU).unwrap().with_damping(beta)
}

fn engines(law: &Interface, count: usize) -> [Memory; 2] {
    let at = Apex { d: DEPTH, u: 0.0 };
    let springs = Springs::new(law.profile(), count, 2.0 * law.profile().radius(2.0 * DEPTH)).unwrap();
    [Engine::Curve, Engine::Row(Arc::new(springs))].map(|engine| engine.memory(law, at))
}

/// Force of a damped contact after a straight path.
fn damped(law: &Interface, memory: &Memory, at: &Motion) -> f64 {
    let elastic = memory.force(law, at.apex());
    memory.damped(law, Since::Chord, at, (elastic, true))[0]
}

/// At constant load F is the first loading (4.30) at the displacement u + βu̇: F = μF_N(1 - (1 - (u + βu̇)/u_c)^{3/2}).
#[test]
fn a_first_loading_is_ahead_by_the_damping_time() {
    let law = law(BETA);
    let (limit, u_c) = (MU * law.normal_force(DEPTH), law.gross_slip_displacement(DEPTH));
    for (memory, allowed) in engines(&law, 8192).into_iter().zip([1e-12, 1e-3]) {
        for (share, ahead) in [(0.3, 1e-3), (0.3, 0.1), (0.8, 0.1), (0.2, 0.7), (0.2, 2.0), (1.5, 0.1)] {
            let at = Motion { d: DEPTH, u: share * u_c, dd: 0.0, du: ahead * u_c / BETA };
            let exact = limit * (1.0 - f64::max(0.0, 1.0 - share - ahead).powf(1.5));
            assert_relative_eq!(damped(&law, &memory, &at), exact, max_relative = allowed);
        }
    }
}

/// Without damping or at rest there is no damping force, also before the contact touches.
#[test]
fn nothing_that_rests_is_damped() {
    let rest = Motion { d: DEPTH, u: 20e-9, dd: 0.0, du: 0.0 };
    let moving = Motion { du: 1e-3, ..rest };
    for memory in engines(&law(BETA), 64) {
        assert_eq!(memory.damped(&law(BETA), Since::Chord, &rest, (0.0, true))[1], 0.0);
        assert_eq!(memory.damped(&law(0.0), Since::Chord, &moving, (0.0, true))[1], 0.0);
        let open = Motion { d: -1e-9, ..moving };
        assert_eq!(memory.damped(&law(BETA), Since::Chord, &open, (0.0, true))[1], 0.0);
    }
}

/// Along 40 random paths with lift-off the curve agrees with the row, whose springs are clipped one by one. The force is within the
/// friction limit, and the damping force opposes the motion.
#[test]
fn random_paths_agree_with_springs_clipped_one_by_one() {
    let law = law(BETA);
    let mut clipped = 0;
    for seed in 0..40 {
        let mut lottery = Lottery(seed);
        let [mut curve, mut row] = engines(&law, 4000);
        for _ in 0..60 {
            let from = curve.apex();
            let to = Apex {
                d: DEPTH * (2.1 * lottery.draw() - 0.2),
                u: from.u + 3.0 * (lottery.draw() - 0.5) * law.gross_slip_displacement(DEPTH),
            };
            let duration = BETA * (4.0 * (lottery.draw() - 0.3)).exp();
            let at =
                Motion { d: to.d, u: to.u, dd: (to.d - from.d) / duration, du: (to.u - from.u) / duration };
            let limit = MU * law.normal_force(to.d);
            let forces = [&curve, &row].map(|memory| damped(&law, memory, &at));
            assert_relative_eq!(forces[0], forces[1], epsilon = 2e-4 * MU * law.normal_force(2.0 * DEPTH));
            assert!(forces[0].abs() <= limit * (1.0 + 1e-12), "seed {seed}: {} {limit}", forces[0]);
            let elastic = curve.force(&law, to);
            assert!((forces[0] - elastic) * at.du >= -1e-12 * limit * at.du.abs());
            clipped += usize::from(forces[0].abs() > 0.999_999 * limit && elastic.abs() < 0.9 * limit);
            curve.commit(&law, Segment::Straight(to)).unwrap();
            row.commit(&law, Segment::Straight(to)).unwrap();
        }
    }
    assert!(clipped > 100, "{clipped}");
}

/// During growth on a curved path the force is that of the same path in many straight pieces.
#[test]
fn a_curved_growth_is_followed() {
    let law = law(BETA);
    let kappa = law.stick_slope();
    // u' = κ(0.2 + 0.6 x) over d from 1 to 1.3 depths, x from 0 to 1: u = κΔ(0.2x + 0.3x²).
    let rise = 0.3 * DEPTH;
    let path = |x: f64| Apex { d: DEPTH + rise * x, u: kappa * rise * (0.2 * x + 0.3 * x * x) };
    let [start, _] = engines(&law, 64);
    let (mut fine, mut force, mut energy) = (start.clone(), 0.0, 0.0);
    for k in 1..=2000 {
        let to = path(f64::from(k) / 2000.0);
        let before = fine.force(&law, fine.apex());
        energy += 0.5 * (before + fine.force(&law, to)) * (to.u - fine.apex().u);
        fine.commit(&law, Segment::Straight(to)).unwrap();
        force = fine.force(&law, to);
    }
    assert!(energy > 0.0);
    for lead in [-2.0, -0.5, -0.1, 0.05, 0.1, 0.5, 2.0] {
        let (dd, end) = (1.0, path(1.0));
        let lead = lead * kappa * rise;
        // The rates give the slope of the path at its end; the lead follows from a damping time of its own.
        let du = kappa * 0.8 * dd;
        let own = self::law(lead.abs() / du);
        let at = Motion { d: end.d, u: end.u, dd: dd * lead.signum(), du: du * lead.signum() };
        // A growing contact whose u̇ has just changed sides has the slope of its path, not of its rates.
        let at = if lead < 0.0 { Motion { dd: 0.0, ..at } } else { at };
        let exact = fine.force(&own, Apex { d: end.d, u: end.u + lead });
        let elastic = force;
        let found = start.damped(&own, Since::Growth(force), &at, (elastic, true))[0];
        let allowed = if lead < 0.0 { 2e-2 } else { 1e-6 };
        assert_relative_eq!(found, exact, epsilon = allowed * MU * law.normal_force(DEPTH));
    }
}

/// Contact pressed by bodies.
struct Pressed(Interface);

impl Site for Pressed {
    fn interface(&self) -> &Interface {
        &self.0
    }
    fn load(&self) -> Load {
        Load::Coupled
    }
    fn is_inert(&self) -> bool {
        false
    }
    fn is_unguarded(&self) -> bool {
        false
    }
    fn has_lulls(&self) -> bool {
        false
    }
    fn scale(&self) -> Scale {
        let displacement = self.0.gross_slip_displacement(2.0 * DEPTH);
        Scale { depth: 2.0 * DEPTH, displacement, frequency: BETA.recip() }
    }
}

/// After random paths the law of a slipping contact, on one branch until an event function of its lead crosses zero, has the force of
/// springs clipped one by one, for leads with and against the slip. Beyond the zero crossing the law is aimed again.
#[test]
fn a_lead_on_one_branch_agrees_with_springs_clipped_one_by_one() {
    let list = [0.1, 0.3, 0.4, 0.6, 0.9, 1.2, 1.5].map(|share| share * DEPTH);
    let list = Profile::foundation(&list, &[RADIUS / 100.0; 7]).unwrap();
    let sites = [Profile::paraboloid(RADIUS).unwrap(), list].map(|profile| Pressed(law_of(profile, BETA)));
    let (mut with, mut against, mut crossed) = (0, 0, 0);
    for seed in 0..100 {
        let mut lottery = Lottery(seed);
        let site = &sites[usize::from(seed >= 60)];
        let law = &site.0;
        let [mut curve, mut row] = engines(law, 4000);
        for _ in 0..40 {
            let from = curve.apex();
            let to = Apex {
                d: DEPTH * (1.9 * lottery.draw() + 0.05),
                u: from.u + 2.0 * (lottery.draw() - 0.5) * law.gross_slip_displacement(DEPTH),
            };
            for memory in [&mut curve, &mut row] {
                memory.commit(law, Segment::Straight(to)).unwrap();
            }
            let mut speed = || (lottery.draw() - 0.5) * law.gross_slip_displacement(to.d) / BETA;
            let at = Motion { d: to.d, u: to.u, dd: speed() / law.stick_slope(), du: speed() };
            let course = curve.course(law, at.d, at.dd, at.du);
            if !matches!(course, Course::Forward | Course::Backward) {
                continue;
            }
            let (mut force, elastic) =
                (Law::of(site, &curve, (course, &at), 0.0, 1e-9), curve.force(law, to));
            let sense = force.sense();
            let check = |force: &Law, at: &Motion| {
                let [exact, found] = [damped(law, &row, at), force.damped((site, &curve), at, elastic)[0]];
                assert_relative_eq!(found, exact, epsilon = 3e-4 * MU * law.normal_force(2.0 * DEPTH));
            };
            check(&force, &at);
            // It begins behind its present place.
            assert!(
                Guard::Behind.value(site, (&curve, &force), &at) > 1e-9 * law.gross_slip_displacement(DEPTH)
            );
            let count = if sense * at.du < 0.0 { &mut against } else { &mut with };
            *count += 1;
            let other = Motion { du: 3.0 * at.du, ..at };
            if sense * at.du > 0.0 && Guard::Ahead.value(site, (&curve, &force), &other) < 0.0 {
                force.aim_lead(site, &curve, (&other, Some((Guard::Ahead, 0.0))), 1e-9);
                check(&force, &other);
                assert!(Guard::Behind.value(site, (&curve, &force), &at) < 0.0);
                force.aim_lead(site, &curve, (&at, Some((Guard::Behind, 0.0))), 1e-9);
                check(&force, &at);
                crossed += 1;
            }
        }
    }
    assert!(with > 200 && against > 200 && crossed > 100, "{with} {against} {crossed}");
}
