//! Small oscillations of stages, compared with normal modes of explicit matrices.
//!
//! The modes are valid for small amplitudes A: stiffness varies with depth, which shifts a frequency by (A/d)², and edges slip,
//! which shifts it by A/u_c. The amplitude is a few 1e-4 of d; the friction coefficient is so high that it is below 1e-6 of u_c.

use crate::parts::{column, event, fitted_order, of_profile, plan, trace};
use crate::stages::{
    BALL, Foot, INERTIA, MASS, PowerLaw, SIX, THREE, earth, force_at, hertz_radius, normal_modulus, rest,
    stage, tangential_modulus,
};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use std::f64::consts::TAU;
use stickslip_drive::scene::{Scene, Start};
use stickslip_drive::{Field, Model, Part, Plan, SceneFault, Stepper};

const HEIGHT: f64 = 6e-3;
const STICKY: f64 = 1000.0;

/// Stage that starts in equilibrium, and the matrices of its small motions.
struct Stage {
    scene: Scene,
    mass: Vector3<f64>,
    stiffness: Matrix3<f64>,
    /// Smallest indentation, m.
    depth: f64,
}

/// K = Σ n (k_t uuᵀ + k_n ddᵀ) over the feet, with u = -(x + Hθ), d = -(z + Xθ), k_t = 2G*a and k_n = 2E*a.
fn stage_on(feet: &[Foot], friction: f64) -> Stage {
    let mut scene = stage(feet, HEIGHT, friction);
    scene.gravity = earth(0.0);
    scene.loads.push(force_at(0, (4e-3, 0.0), (0.0, -1.0)));
    let start = rest(&scene).unwrap();
    let depths: Vec<f64> = scene.contacts.iter().map(|c| start.depth(&c.part)).collect();
    let mut stiffness = Matrix3::zeros();
    for (foot, d) in feet.iter().zip(&depths) {
        let (u, normal) = (Vector3::new(1.0, 0.0, HEIGHT), Vector3::new(0.0, 1.0, foot.x));
        let width = 2.0 * f64::from(foot.count) * hertz_radius(*d);
        stiffness += width * tangential_modulus() * u * u.transpose();
        stiffness += width * normal_modulus() * normal * normal.transpose();
    }
    let pose = start.pose(0);
    let body = &mut scene.bodies[0].part;
    for (coordinate, place) in [&mut body.x, &mut body.z, &mut body.pitch].into_iter().zip(pose) {
        coordinate.position = place;
    }
    scene.start = Start::Given;
    let depth = depths.iter().copied().fold(f64::INFINITY, f64::min);
    Stage { scene, mass: Vector3::new(MASS, MASS, INERTIA), stiffness, depth }
}

/// Angular frequencies in increasing order, and shapes q with qᵀMq = 1.
fn modes(stage: &Stage) -> Vec<(f64, Vector3<f64>)> {
    let root = stage.mass.map(f64::sqrt);
    let scaled = Matrix3::from_fn(|i, j| stage.stiffness[(i, j)] / (root[i] * root[j]));
    let eigen = SymmetricEigen::new(scaled);
    let shape = |k: usize| eigen.eigenvectors.column(k).component_div(&root);
    let mut modes: Vec<_> = (0..3).map(|k| (eigen.eigenvalues[k].sqrt(), shape(k))).collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    modes
}

impl Stage {
    /// Model with an initial velocity along a mode; the largest amplitude at a foot is `share` of the smallest indentation.
    fn pushed(&self, (frequency, shape): &(f64, Vector3<f64>), share: f64) -> Scene {
        let largest = (shape[0].abs() + HEIGHT * shape[2].abs()).max(shape[1].abs() + 14e-3 * shape[2].abs());
        let speed = shape * (share * self.depth * frequency / largest);
        let mut scene = self.scene.clone();
        let body = &mut scene.bodies[0].part;
        (body.x.velocity, body.z.velocity, body.pitch.velocity) = (speed[0], speed[1], speed[2]);
        scene
    }

    /// Angular frequency of a mode in a run, from its first and last upward zero crossing over a number of periods.
    fn measured(&self, scene: &Scene, shape: &Vector3<f64>, plan: &Plan, every: f64) -> f64 {
        let (model, _, rows) = trace(scene, plan, every);
        let body = &scene.bodies[0].part;
        let along = |names: [&str; 3], origin: [f64; 3]| {
            let mut sum = Vec::new();
            for i in 0..3 {
                let values = column(&model, &rows, &format!("stage.{}", names[i]));
                sum.resize(values.len(), 0.0);
                let weight = shape[i] * self.mass[i];
                sum.iter_mut().zip(values).for_each(|(s, v)| *s += weight * (v - origin[i]));
            }
            sum
        };
        let start = [body.x.position, body.z.position, body.pitch.position];
        let q = along(["x_m", "z_m", "pitch_rad"], start);
        let v = along(["vx_m_s", "vz_m_s", "vpitch_rad_s"], [0.0; 3]);
        let up: Vec<usize> = (1..q.len() - 1).filter(|k| q[*k] < 0.0 && q[*k + 1] >= 0.0).collect();
        let zero =
            |k: usize| every * (k as f64 + crossing((q[k], v[k] * every), (q[k + 1], v[k + 1] * every)));
        let (first, last) = (up[0], up[up.len() - 1]);
        TAU * (up.len() - 1) as f64 / (zero(last) - zero(first))
    }
}

/// Zero in [0, 1] of the cubic through two values with their slopes.
fn crossing((a, da): (f64, f64), (b, db): (f64, f64)) -> f64 {
    let value = |s: f64| {
        let r = 1.0 - s;
        a * r * r * (1.0 + 2.0 * s) + da * s * r * r + b * s * s * (3.0 - 2.0 * s) - db * s * s * r
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn sliding_rocking_and_bouncing_have_the_frequencies_of_the_linear_modes() {
    for (name, feet) in [("three balls", &THREE[..]), ("six balls", &SIX)] {
        let stage = stage_on(feet, STICKY);
        for mode in modes(&stage) {
            let period = TAU / mode.0;
            let scene = stage.pushed(&mode, 3e-4);
            let frequency = stage.measured(&scene, &mode.1, &event(1e-12, 40.5 * period), period / 40.0);
            let off = frequency / mode.0 - 1.0;
            println!("{name}: {:.1} Hz, off by {off:.1e}, shape {:?}", mode.0 / TAU, mode.1.as_slice());
            assert!(off.abs() < 1e-6, "{name}: {off:e}");
        }
    }
}

#[test]
fn with_ordinary_friction_the_modes_are_met_in_proportion_to_the_amplitude() {
    let stage = stage_on(&THREE, 0.3);
    let mode = &modes(&stage)[0];
    let period = TAU / mode.0;
    let off = |share: f64| {
        let scene = stage.pushed(mode, share);
        1.0 - stage.measured(&scene, &mode.1, &event(1e-12, 20.5 * period), period / 40.0) / mode.0
    };
    let points: Vec<(f64, f64)> = [3e-3, 1e-3, 3e-4, 1e-4].map(|share| (share, off(share))).to_vec();
    let order = fitted_order(&points);
    println!("order {order:.3}: {points:?}");
    assert!((order - 1.0).abs() < 0.02 && points[3].1 > 0.0, "{points:?}");
}

/// Velocity Verlet oscillates too fast: sin(ω'h/2) = ωh/2, ω'/ω = 1 + (ωh)²/24 + …
#[test]
fn verlet_at_small_steps_converges_to_the_modes_at_its_own_order() {
    let stage = stage_on(&THREE, STICKY);
    for mode in modes(&stage) {
        let period = TAU / mode.0;
        let scene = stage.pushed(&mode, 3e-4);
        let off = |parts: f64| {
            let step = period / parts;
            let plan = plan(Stepper::Verlet { step }, 20.5 * period);
            let off = stage.measured(&scene, &mode.1, &plan, step) / mode.0 - 1.0;
            let known = 2.0 * (0.5 * mode.0 * step).asin() / (mode.0 * step) - 1.0;
            assert!((off / known - 1.0).abs() < 0.01, "{parts}: {off:e}, closed form {known:e}");
            (step, off)
        };
        let order = fitted_order(&[40.0, 80.0, 160.0, 320.0].map(off));
        println!("order {order:.3}");
        assert!((order - 2.0).abs() < 0.02);
    }
}

#[test]
fn the_matrices_of_a_model_are_those_written_out_by_hand() {
    for feet in [&THREE[..], &SIX] {
        let stage = stage_on(feet, 0.3);
        let model = Model::new(&stage.scene).unwrap();
        let start = model.start(&event(1e-8, 1.0)).unwrap();
        let linear = model.linearised(&start, |d| d.start);
        assert_eq!(linear.coordinates(), ["stage.x", "stage.z", "stage.pitch"]);
        for i in 0..3 {
            assert_eq!(linear.mass()[i], stage.mass[i]);
            for j in 0..3 {
                let (got, want) = (linear.stiffness()[(i, j)], stage.stiffness[(i, j)]);
                assert!(
                    (got - want).abs() < 1e-12 * (stage.stiffness[(i, i)] * stage.stiffness[(j, j)]).sqrt()
                );
            }
        }
        for (got, (frequency, shape)) in linear.modes().iter().zip(modes(&stage)) {
            assert!((got.frequency / frequency - 1.0).abs() < 1e-12);
            let scale = got.shape[0] / shape[0];
            for (i, got) in got.shape.iter().enumerate() {
                assert!((got - scale * shape[i]).abs() < 1e-9 * (scale * shape[i]).abs().max(1e-3), "{i}");
            }
            for c in 0..feet.len() {
                let u = -got.shape[0] - HEIGHT * got.shape[2];
                assert!((got.contacts[c] - u).abs() < 1e-14);
            }
        }
    }
}

/// The stiffness of flat punches does not depend on depth, so the stability limit is exact.
#[test]
fn verlet_stays_bounded_below_the_longest_step_and_is_refused_beyond_it() {
    let mut scene = stage(&THREE, HEIGHT, 0.5);
    for contact in &mut scene.contacts {
        contact.part = of_profile(PowerLaw::flat(0.05 * BALL).1, &contact.part);
    }
    scene.gravity = earth(0.1);
    let model = Model::new(&scene).unwrap();
    let limit = model.longest_step(Stepper::Verlet { step: 1.0 }).unwrap();
    // The fastest mode with explicit matrices: widths 2b instead of 2a.
    let mut stiffness = Matrix3::zeros();
    for foot in THREE {
        let (u, d) = (Vector3::new(1.0, 0.0, HEIGHT), Vector3::new(0.0, 1.0, foot.x));
        let width = 2.0 * f64::from(foot.count) * 0.05 * BALL;
        stiffness +=
            width * (tangential_modulus() * u * u.transpose() + normal_modulus() * d * d.transpose());
    }
    let by_hand =
        Stage { scene: scene.clone(), mass: Vector3::new(MASS, MASS, INERTIA), stiffness, depth: 0.0 };
    let fastest = modes(&by_hand)[2].0;
    assert!((limit * fastest / 2.0 - 1.0).abs() < 1e-12, "{limit:e}, {fastest:e}");

    let (start, periods) = (rest(&scene).unwrap().pose(0), 500.0);
    let step = 0.98 * limit;
    let plan = plan(Stepper::Verlet { step }, periods * TAU / fastest);
    let (model, state, rows) = trace(&scene, &plan, plan.duration / 50.0);
    assert!(state.counts().steps > 1500);
    let z = column(&model, &rows, "stage.z_m");
    let most = z.iter().map(|z| (z - start[1]).abs()).fold(0.0, f64::max);
    assert!(most < 1e-9 * start[1].abs(), "{most:e}");
    let error =
        Model::new(&scene).unwrap().start(&Plan { stepper: Stepper::Verlet { step: 1.02 * limit }, ..plan });
    let error = error.unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Step));
    assert!(matches!(error.fault, SceneFault::Unstable { .. }), "{error}");
}
