//! Tests of static and kinetic friction: closed forms at constant load, an independent sum over springs, energy balance.

use crate::lottery::Lottery;
use approx::assert_relative_eq;
use std::sync::Arc;
use stickslip_contact::{
    Apex, Engine, FrictionError, Interface, Material, Memory, Move, Pair, Profile, Segment, Springs,
};

const STATIC: f64 = 0.3;
const KINETIC: f64 = 0.2;
const DEPTH: f64 = 1e-6;
const RADIUS: f64 = 1e-3;

fn law() -> Interface {
    let steel = Material::new(210e9, 0.3).unwrap();
    let pair = Pair::new(steel, steel);
    Interface::new(pair, Profile::paraboloid(RADIUS).unwrap(), STATIC)
        .unwrap()
        .with_kinetic_friction(KINETIC)
        .unwrap()
}

fn springs(law: &Interface, count: usize) -> Arc<Springs> {
    Arc::new(Springs::new(law.profile(), count, 2.0 * law.profile().radius(1.6 * DEPTH)).unwrap())
}

#[test]
fn a_kinetic_coefficient_above_the_static_one_is_refused() {
    let refused = law().with_kinetic_friction(0.31).unwrap_err();
    assert_eq!(refused, FrictionError::Kinetic { kinetic: 0.31, most: 0.3 });
    assert!(law().with_kinetic_friction(-0.1).is_err() && law().with_kinetic_friction(f64::NAN).is_err());
    // Equal coefficients are one coefficient.
    assert_eq!(law().with_kinetic_friction(STATIC).unwrap().kinetic(), None);
}

/// At constant load: F = μ_s F_N [1 - (1 - u/u_c)^{3/2}] up to u_c, then μ_k F_N. The released energy is
/// G\*(κ_s² - κ_k²) N(d), with N(d) = (8/15) √R d^{5/2} for a paraboloid.
#[test]
fn a_pulled_contact_breaks_loose_and_sticks_again() {
    let law = law();
    let (normal, u_c) = (law.normal_force(DEPTH), law.gross_slip_displacement(DEPTH));
    let springs = springs(&law, 20_000);
    for (engine, allowed) in [(Engine::Curve, 1e-12), (Engine::Row(springs), 2e-4)] {
        let mut memory = engine.memory(&law, Apex { d: DEPTH, u: 0.0 });
        let at = |share: f64| Apex { d: DEPTH, u: share * u_c };
        let before = STATIC * normal * (1.0 - (1.0_f64 - 0.9).powf(1.5));
        assert_relative_eq!(memory.force(&law, at(0.9)), before, max_relative = allowed);
        assert_relative_eq!(memory.force(&law, at(1.1)), KINETIC * normal, max_relative = allowed);
        assert_relative_eq!(
            memory.trial(&law, Move::Chord(at(1.1))).force,
            KINETIC * normal,
            max_relative = allowed
        );
        memory.commit(&law, Segment::Straight(at(0.999_999))).unwrap();
        assert_eq!(memory.slides(), 0.0);
        let elastic = memory.preview(&law, memory.apex()).elastic;
        let friction = memory.commit(&law, Segment::Straight(at(1.000_001))).unwrap();
        assert_eq!(memory.slides(), 1.0);
        let released = law.tangential_modulus()
            * (law.stick_slope().powi(2) - law.kinetic().unwrap().stick_slope().powi(2))
            * (8.0 / 15.0)
            * RADIUS.sqrt()
            * DEPTH.powf(2.5);
        assert_relative_eq!(friction, released, max_relative = 1e-5 + 3.0 * allowed);
        let after = memory.preview(&law, memory.apex()).elastic;
        assert_relative_eq!(elastic - after, released, max_relative = 1e-5 + 3.0 * allowed);
        // It slides on at μ_k; after a small return it needs μ_s again.
        memory.commit(&law, Segment::Straight(at(2.0))).unwrap();
        memory.commit(&law, Segment::Straight(at(1.9999))).unwrap();
        assert_eq!(memory.slides(), 0.0);
        let share = KINETIC / STATIC;
        memory.commit(&law, Segment::Straight(at(2.0 + 0.999 * (1.0 - share)))).unwrap();
        assert_eq!(memory.slides(), 0.0);
        memory.commit(&law, Segment::Straight(at(2.0 + 1.001 * (1.0 - share)))).unwrap();
        assert_eq!(memory.slides(), 1.0);
    }
}

/// The law spring by spring, in steps so small that the order of events within a step does not matter.
struct Plain {
    heights: Vec<f64>,
    length: f64,
    stretches: Vec<f64>,
    at: Apex,
    slides: f64,
    friction: f64,
    breaks: usize,
}

impl Plain {
    fn step(&mut self, law: &Interface, to: Apex) {
        let (du, dd) = (to.u - self.at.u, to.d - self.at.d);
        let [fast, slow] = [law.stick_slope(), law.kinetic().unwrap().stick_slope()];
        if self.slides * du <= slow * dd {
            self.slides = 0.0;
        }
        let modulus = law.tangential_modulus();
        let slope = if self.slides == 0.0 { fast } else { slow };
        let (mut all, mut any, mut sum) = (true, false, 0.0);
        for (h, s) in self.heights.iter().zip(&mut self.stretches) {
            let limit = slope * (to.d - h);
            if limit <= 0.0 {
                *s = 0.0;
                continue;
            }
            any = true;
            let tried = *s + if self.at.d > *h { du } else { du * (to.d - h) / dd };
            *s = tried.clamp(-limit, limit);
            self.friction += modulus * self.length * s.abs() * (tried - *s).abs();
            all &= s.abs() >= limit;
            sum += *s;
        }
        if any && all && self.slides == 0.0 {
            self.slides = sum.signum();
            self.breaks += 1;
            for (h, s) in self.heights.iter().zip(&mut self.stretches) {
                let limit = self.slides * slow * (to.d - h).max(0.0);
                self.friction += 0.5 * modulus * self.length * (s.powi(2) - limit.powi(2)).max(0.0);
                *s = limit;
            }
        }
        if !any {
            self.slides = 0.0;
        }
        self.at = to;
    }

    fn force(&self, law: &Interface) -> f64 {
        law.tangential_modulus() * self.length * self.stretches.iter().sum::<f64>()
    }
}

/// Both engines against the plain law along 30 random paths with varying load and lift-off; friction against the balance of energy.
#[test]
fn random_paths_agree_with_a_plain_sum_over_springs() {
    let law = law();
    let (count, width) = (800, 2.0 * law.profile().radius(1.6 * DEPTH));
    let springs = springs(&law, count);
    let force = KINETIC * law.normal_force(DEPTH);
    let (mut broke, mut released) = (0, 0);
    for seed in 0..30 {
        let mut lottery = Lottery(seed);
        let start = Apex { d: 0.5 * DEPTH, u: 0.0 };
        let length = width / count as f64;
        let heights: Vec<f64> = (0..count)
            .map(|i| law.profile().depth(((i as f64 + 0.5) * length - 0.5 * width).abs()))
            .collect();
        let stretches = vec![0.0; count];
        let mut plain =
            Plain { heights, length, stretches, at: start, slides: 0.0, friction: 0.0, breaks: 0 };
        let mut both: Vec<Memory> = [Engine::Curve, Engine::Row(Arc::clone(&springs))]
            .map(|engine| engine.memory(&law, start))
            .into();
        let mut friction = [0.0; 2];
        for _ in 0..40 {
            let to = Apex {
                d: DEPTH * (1.7 * lottery.draw() - 0.2),
                u: plain.at.u + 4.0 * (lottery.draw() - 0.5) * law.gross_slip_displacement(DEPTH),
            };
            let (from, steps) = (plain.at, 4000);
            for k in 1..=steps {
                let share = f64::from(k) / f64::from(steps);
                let at = Apex { d: from.d + share * (to.d - from.d), u: from.u + share * (to.u - from.u) };
                plain.step(&law, if k == steps { to } else { at });
            }
            for (memory, friction) in both.iter_mut().zip(&mut friction) {
                let tried = memory.force(&law, to);
                let before = memory.slides();
                let work = memory.commit(&law, Segment::Straight(to)).unwrap();
                assert!(work >= 0.0);
                released += usize::from(memory.slides() != before);
                *friction += work;
                assert_relative_eq!(
                    tried,
                    memory.force(&law, to),
                    epsilon = 1e-9 * force,
                    max_relative = 1e-9
                );
                assert_relative_eq!(tried, plain.force(&law), epsilon = 6e-3 * force);
                assert_eq!(memory.slides(), plain.slides, "seed {seed}");
            }
        }
        for friction in friction {
            assert_relative_eq!(friction, plain.friction, max_relative = 6e-3);
        }
        broke += plain.breaks;
    }
    assert!(broke > 300 && released > 100, "{broke} {released}");
}

/// Paths that end at the static limit, or beyond it by rounding, go on sliding: a contact that has broken loose on a path that is steeper
/// than the kinetic limit does not stick again on the same path.
#[test]
fn rounding_at_the_limit_does_not_make_a_contact_stick_again() {
    let law = law();
    let (rows, slope) = (springs(&law, 400), law.stick_slope());
    for (k, engine) in
        (0..400).map(|k| (k, if k % 2 == 0 { Engine::Curve } else { Engine::Row(Arc::clone(&rows)) }))
    {
        let depth = 0.1 * DEPTH * (1.0 + 0.013 * f64::from(k));
        let lowest = if k % 2 == 0 { 0.0 } else { rows.height_of_reduced_force(0.0) };
        let start = Apex { d: depth, u: 3e-7 * f64::from(k) };
        // All springs slip where u - u₀ = κ_s (d - h) for the lowest spring.
        let steep = slope * (1.2 + 0.01 * f64::from(k % 50));
        let way = slope * (depth - lowest) / (steep - slope);
        for places in -12..=12 {
            let way = way * (1.0 + f64::from(places) * f64::EPSILON);
            let to = Apex { d: start.d + way, u: start.u + steep * way };
            if to.d > 1.5 * DEPTH {
                continue;
            }
            let mut memory = engine.memory(&law, start);
            let trial = memory.trial(&law, Move::Chord(to)).force;
            memory.commit(&law, Segment::Straight(to)).unwrap();
            let force = memory.force(&law, to) / law.normal_force(to.d);
            let wanted = if memory.slides() == 0.0 { STATIC } else { KINETIC };
            assert!((force / wanted - 1.0).abs() < 0.01, "{k} {places}: {force}, {}", memory.slides());
            assert!((trial / law.normal_force(to.d) / wanted - 1.0).abs() < 0.01, "{k} {places}: {trial}");
        }
    }
}
