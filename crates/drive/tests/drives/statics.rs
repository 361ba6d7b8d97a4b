//! Static equilibria, compared with statics by hand.

use crate::parts::{named, of_profile};
use crate::stages::{
    BALL, Foot, MASS, PowerLaw, SIX, THREE, earth, force_at, hertz, hertz_radius, moment, normal_modulus,
    rest, stage, upright,
};
use std::f64::consts::FRAC_PI_2;
use stickslip_drive::scene::{Gravity, Point, Scene, Side};

/// Gaps of the contacts in the reference position, m.
const GAPS: [f64; 5] = [0.0, 0.5e-6, -0.5e-6, 100e-6, 1e-3];
const HEIGHT: f64 = 6e-3;
const PRECISE: f64 = 1e-10;

fn close(got: f64, want: f64, what: &str) {
    assert!((got - want).abs() <= PRECISE * want.abs(), "{what}: {got:e}, expected {want:e}");
}

/// Force along x, force along z and moment about the centre of mass, N and N m.
#[derive(Debug, Clone, Copy)]
struct Wrench {
    x: f64,
    z: f64,
    moment: f64,
}

fn wrench(x: f64, z: f64, moment: f64) -> Wrench {
    Wrench { x, z, moment }
}

impl Wrench {
    /// Moment that the normal forces of contacts `HEIGHT` below carry; friction there holds x.
    fn tilting(&self) -> f64 {
        self.moment - HEIGHT * self.x
    }

    /// Normal forces of one ball at each of two points: ΣN = -F_z, ΣXN = -M.
    fn on_two(&self, feet: [Foot; 2]) -> [f64; 2] {
        let [a, b] = feet;
        let (force, moment) = (-self.z, -self.tilting());
        let first = (moment - b.x * force) / (a.x - b.x);
        [first / f64::from(a.count), (force - first) / f64::from(b.count)]
    }
}

/// Stage on some feet under some loads, with their wrench.
fn loaded(feet: &[Foot]) -> Vec<(&'static str, Scene, Wrench)> {
    let with = |friction: f64, change: &dyn Fn(&mut Scene)| {
        let mut scene = stage(feet, HEIGHT, friction);
        change(&mut scene);
        scene
    };
    let weight = MASS * 9.81;
    let (sin, cos) = 0.2_f64.sin_cos();
    vec![
        ("weight", with(0.2, &|s| s.gravity = earth(0.0)), wrench(0.0, -weight, 0.0)),
        (
            "eccentric force",
            with(0.2, &|s| s.loads.push(force_at(0, (3e-3, 5e-3), (0.0, -2.0)))),
            wrench(0.0, -2.0, -6e-3),
        ),
        (
            "oblique force above",
            with(0.2, &|s| s.loads.push(force_at(0, (3e-3, 5e-3), (0.1, -2.0)))),
            wrench(0.1, -2.0, -6e-3 - 0.5e-3),
        ),
        (
            "weight and moment",
            with(0.2, &|s| (s.gravity, s.loads) = (earth(0.0), vec![moment(0, 2e-3)])),
            wrench(0.0, -weight, 2e-3),
        ),
        ("incline", with(0.5, &|s| s.gravity = earth(0.2)), wrench(-weight * sin, -weight * cos, 0.0)),
        (
            "eccentric mass",
            with(0.5, &|s| (s.gravity, s.loads) = (earth(0.0), vec![force_at(0, (8e-3, 2e-3), (0.0, -1.0))])),
            wrench(0.0, -weight - 1.0, -8e-3),
        ),
    ]
}

#[test]
fn three_balls_carry_what_the_lever_says() {
    for (name, scene, wrench) in loaded(&THREE) {
        for gap in GAPS {
            let mut scene = scene.clone();
            scene.contacts.iter_mut().for_each(|c| c.part.gap = gap);
            let rest = rest(&scene).unwrap_or_else(|e| panic!("{e} {scene:?}"));
            let total: f64 = (0..2).map(|c| f64::from(THREE[c].count) * rest.tangential(c)).sum();
            assert!((total + wrench.x).abs() <= PRECISE * wrench.z.abs(), "{name}, {gap:e}: {total:e}");
            for (c, want) in wrench.on_two(THREE).into_iter().enumerate() {
                close(rest.normal(&scene, c, hertz), want, &format!("{name}, gap {gap:e}, foot {c}"));
            }
        }
    }
}

/// z and pitch at which Hertzian balls carry a force and a moment, by Newton's method on (z, θ).
fn newton(feet: &[Foot], force: f64, moment: f64) -> (f64, f64) {
    let (mut z, mut pitch) = (-1e-6_f64, 0.0_f64);
    let balance = |z: f64, pitch: f64| {
        let (mut r, mut k) = ([force, moment], [0.0; 3]);
        for foot in feet {
            let (d, n) = ((-z - foot.x * pitch).max(0.0), f64::from(foot.count));
            let (f, s) = (n * hertz(d), n * 2.0 * normal_modulus() * hertz_radius(d));
            r = [r[0] + f, r[1] + foot.x * f];
            k = [k[0] + s, k[1] + s * foot.x, k[2] + s * foot.x * foot.x];
        }
        (r, k)
    };
    for _ in 0..200 {
        let ([rz, rm], [kzz, kzm, kmm]) = balance(z, pitch);
        let det = kzz * kmm - kzm * kzm;
        z += (kmm * rz - kzm * rm) / det;
        pitch += (kzz * rm - kzm * rz) / det;
    }
    let ([rz, rm], _) = balance(z, pitch);
    assert!(rz.abs() < 1e-13 * force.abs() && rm.abs() < 1e-13 * force.abs() * 0.01, "{rz:e} {rm:e}");
    (z, pitch)
}

#[test]
fn six_balls_share_as_hertz_law_says() {
    for (name, scene, wrench) in loaded(&SIX) {
        let (z, pitch) = newton(&SIX, wrench.z, wrench.tilting());
        for gap in GAPS {
            let mut scene = scene.clone();
            scene.contacts.iter_mut().for_each(|c| c.part.gap = gap);
            let rest = rest(&scene).unwrap_or_else(|e| panic!("{e} {scene:?}"));
            let [_, _, turned] = rest.pose(0);
            assert!(
                (turned - pitch).abs() < 1e-9 * (z / 1e-3).abs(),
                "{name}, {gap:e}: {turned:e} {pitch:e}"
            );
            for (c, foot) in SIX.iter().enumerate() {
                let want = hertz(-z - foot.x * pitch);
                close(rest.normal(&scene, c, hertz), want, &format!("{name}, gap {gap:e}, foot {c}"));
            }
        }
    }
}

#[test]
fn one_end_of_six_balls_may_leave_the_ground() {
    // The load acts beyond the middle of the last gap: the first pair lifts off.
    let mut scene = stage(&SIX, HEIGHT, 0.2);
    scene.loads.push(force_at(0, (10e-3, 0.0), (0.0, -3.0)));
    let rest = rest(&scene).unwrap_or_else(|e| panic!("{e} {scene:?}"));
    assert!(rest.depth(&scene.contacts[0].part) < 0.0);
    let lever = wrench(0.0, -3.0, -30e-3).on_two([SIX[1], SIX[2]]);
    for (c, want) in [1, 2].into_iter().zip(lever) {
        close(rest.normal(&scene, c, hertz), want, "lever");
    }
}

#[test]
fn a_spring_that_presses_is_part_of_the_balance() {
    let at = Point { x: 4e-3, z: 2e-3 };
    for (stiffness, preload, gap) in
        [(0.0, -3.0, 0.0), (2e3, -3.0, 0.0), (5e6, -3.0, 0.2e-6), (2e3, -3.0, 1e-3)]
    {
        let mut scene = stage(&THREE, HEIGHT, 0.6);
        scene.gravity = earth(FRAC_PI_2);
        scene.contacts.iter_mut().for_each(|c| c.part.gap = gap);
        scene.springs.push(named("preload", upright(0, at, stiffness, preload)));
        let rest = rest(&scene).unwrap_or_else(|e| panic!("{e} {scene:?}"));
        let force = preload - stiffness * rest.moved(Side::Body(0), at).1;
        let weight = MASS * 9.81;
        let wrench = wrench(-weight, force, at.x * force);
        for (c, want) in wrench.on_two(THREE).into_iter().enumerate() {
            close(rest.normal(&scene, c, hertz), want, &format!("spring {stiffness:e}, foot {c}"));
        }
        let total: f64 = (0..2).map(|c| f64::from(THREE[c].count) * rest.tangential(c)).sum();
        close(total, weight, "climber");
    }
}

#[test]
fn every_profile_carries_what_the_lever_says() {
    let cases = [
        ("flat", PowerLaw::flat(0.1e-3)),
        ("cone", PowerLaw::cone(0.02)),
        ("paraboloid", PowerLaw::paraboloid(BALL)),
        ("cubic", PowerLaw::cubic(2e6)),
        ("quartic", PowerLaw::quartic(1e10)),
    ];
    for (name, (law, profile)) in cases {
        for (what, mut scene, wrench) in loaded(&THREE) {
            for gap in GAPS {
                for contact in &mut scene.contacts {
                    contact.part = of_profile(profile.clone(), &contact.part);
                    contact.part.gap = gap;
                }
                let rest = rest(&scene).unwrap_or_else(|e| panic!("{e} {scene:?}"));
                for (c, want) in wrench.on_two(THREE).into_iter().enumerate() {
                    close(
                        rest.normal(&scene, c, |d| law.force(d)),
                        want,
                        &format!("{name}, {what}, gap {gap:e}, foot {c}"),
                    );
                }
            }
        }
    }
}

/// Under proportional loading all forces of Hertzian contacts grow alike; d and u are proportional to the power 2/3 of the load.
/// Each contact has a share of the load in proportion to its radius in full stick, at most μF_N in gross slip.
fn shares(feet: &[Foot], normal: &[f64], friction: f64, load: f64) -> Vec<f64> {
    let radius = |n: f64| (0.75 * n * BALL / normal_modulus()).cbrt();
    let mut slips = vec![false; feet.len()];
    loop {
        let count = |c: usize| f64::from(feet[c].count);
        let (mut left, mut sum) = (load, 0.0);
        for c in 0..feet.len() {
            if slips[c] {
                left -= count(c) * friction * normal[c];
            } else {
                sum += count(c) * radius(normal[c]);
            }
        }
        let share = |c: usize| if slips[c] { friction * normal[c] } else { left * radius(normal[c]) / sum };
        match (0..feet.len()).find(|c| !slips[*c] && share(*c) > friction * normal[*c]) {
            Some(c) => slips[c] = true,
            None => return (0..feet.len()).map(share).collect(),
        }
    }
}

#[test]
fn gravity_on_quarters_of_a_turn_is_all_along_or_all_across() {
    let pull = |degrees: f64| Gravity { acceleration: 9.81, incline: degrees.to_radians() }.components();
    for (degrees, along, across) in
        [(0.0, 0.0, 1.0), (90.0, 1.0, 0.0), (180.0, 0.0, -1.0), (270.0, -1.0, 0.0)]
    {
        for turns in [-2.0, -1.0, 0.0, 1.0, 3.0] {
            assert_eq!(
                pull(degrees + 360.0 * turns),
                (9.81 * along, 9.81 * across),
                "{degrees} and {turns} turns"
            );
        }
    }
    // A thousandth of a degree is a slope, not rounding.
    let slope = 1e-3_f64.to_radians();
    close(pull(1e-3).0, 9.81 * slope.sin(), "nearly level");
    close(pull(90.0 + 1e-3).1, -9.81 * slope.sin(), "nearly upright");
}

#[test]
fn contacts_on_an_incline_share_the_load_by_their_stiffness() {
    let mut slipped = 0;
    for feet in [&THREE[..], &SIX] {
        for (incline, friction) in [(0.02_f64, 0.5), (0.2, 0.2), (0.2, 0.15), (0.2, 0.13)] {
            for gap in [0.0, 0.5e-6, 100e-6, 1e-3] {
                let mut scene = stage(feet, HEIGHT, friction);
                scene.gravity = earth(incline);
                scene.loads.push(force_at(0, (7e-3, 0.0), (0.0, -0.3)));
                scene.contacts.iter_mut().for_each(|c| c.part.gap = gap);
                let rest = rest(&scene).unwrap_or_else(|e| panic!("{e} {scene:?}"));
                let normal: Vec<f64> = (0..feet.len()).map(|c| rest.normal(&scene, c, hertz)).collect();
                let load = MASS * 9.81 * incline.sin();
                for (c, want) in shares(feet, &normal, friction, load).into_iter().enumerate() {
                    let got = rest.tangential(c);
                    slipped += usize::from(want >= friction * normal[c]);
                    // Moment balance: friction acts at the height of the contacts.
                    assert!(
                        (got - want).abs() <= 1e-6 * load,
                        "{incline} {friction} {gap:e}: {got:e} {want:e}"
                    );
                }
                let total: f64 = (0..feet.len()).map(|c| f64::from(feet[c].count) * rest.tangential(c)).sum();
                close(total, load, "sum");
            }
        }
    }
    assert!(slipped > 4, "{slipped}");
}
