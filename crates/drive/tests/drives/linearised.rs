//! Small motions compared with closed forms, and stability limits compared with the steppers.

use crate::parts::{contact, damper, event, foot_and_slider, free, named, p1, plan, sine, wave};
use nalgebra::{DMatrix, DVector};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Body, Coordinate, Normal, Scene, Side, Spring, Varying};
use stickslip_drive::{Field, Indentations, Linearised, Model, Part, Shape, State, Stepper};
use stickslip_stepper::{Rk4, Stepping, System, Verlet};

const FOOT: Side = Side::Body(0);
const SLIDER: Side = Side::Body(1);

/// Effective shear modulus of steel on steel by 1/G\* = 2(2-ν)/(4G), G = E/(2(1+ν)), and E\* by 1/E\* = 2(1-ν²)/E.
fn moduli() -> (f64, f64) {
    let (e, nu) = (210e9, 0.3);
    let g = e / (2.0 * (1.0 + nu));
    (e / (2.0 * (1.0 - nu * nu)), 4.0 * g / (2.0 * (2.0 - nu)))
}

/// Stuck stiffness 2G\*a of a paraboloid of radius R under a force F, a³ = 3FR/(4E\*).
fn stuck(radius: f64, force: f64) -> f64 {
    let (normal, tangential) = moduli();
    2.0 * tangential * (0.75 * force * radius / normal).cbrt()
}

/// Ground –k₁, c– 5 g –contact– 20 g.
fn chain(stiffness: f64, damping: f64) -> Scene {
    let between = [Side::Ground, FOOT];
    Scene {
        bodies: vec![named("foot", free(5e-3)), named("slider", free(20e-3))],
        contacts: vec![named("ball", contact([FOOT, SLIDER], Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0))],
        springs: vec![named("stack", Spring { stiffness, ..damper(between, damping) })],
        ..Scene::default()
    }
}

/// A model's state at t = 0.
fn still(model: &Model) -> State {
    model.start(&event(1e-8, 1.0)).unwrap()
}

fn about_rest(scene: &Scene) -> Linearised {
    let model = Model::new(scene).unwrap();
    model.linearised(&still(&model), |d| d.start)
}

fn close(got: f64, want: f64, within: f64) {
    assert!((got - want).abs() <= within * want.abs(), "{got:e}, expected {want:e}");
}

#[test]
fn a_chain_of_two_masses_has_its_closed_modes() {
    let (k1, k2, m1, m2) = (20e6, stuck(1e-3, 1.0), 5e-3, 20e-3);
    let model = Model::new(&chain(k1, 7.0)).unwrap();
    let linearised = model.linearised(&still(&model), |d| d.start);
    assert_eq!(linearised.coordinates(), ["foot.x", "slider.x"]);
    assert_eq!(linearised.mass(), &DVector::from_vec(vec![m1, m2]));
    assert_eq!(linearised.damping(), &DMatrix::from_row_slice(2, 2, &[7.0, 0.0, 0.0, 0.0]));
    close(linearised.stiffness()[(0, 0)], k1 + k2, 1e-12);
    close(linearised.stiffness()[(0, 1)], -k2, 1e-12);
    // m₁m₂ω⁴ - [m₂(k₁+k₂) + m₁k₂]ω² + k₁k₂ = 0; x₁/x₂ = 1 - m₂ω²/k₂.
    let (sum, product) = ((k1 + k2) / m1 + k2 / m2, k1 * k2 / (m1 * m2));
    let root = (0.25 * sum * sum - product).sqrt();
    let modes = linearised.modes();
    for (mode, square) in modes.iter().zip([product / (0.5 * sum + root), 0.5 * sum + root]) {
        close(mode.frequency, square.sqrt(), 1e-12);
        let ratio = 1.0 - m2 * square / k2;
        close(mode.shape[0] / mode.shape[1], ratio, 1e-10);
        close(mode.contacts[0], mode.shape[0] - mode.shape[1], 1e-12);
        // φᵀCφ/(2ω φᵀMφ).
        let damping = 7.0 * ratio * ratio / (2.0 * square.sqrt() * (m1 * ratio * ratio + m2));
        close(mode.damping_ratio, damping, 1e-10);
    }
    assert_eq!(
        modes.iter().map(|m| m.shape.iter().copied().fold(0.0, f64::max)).collect::<Vec<_>>(),
        [1.0, 1.0]
    );
}

#[test]
fn what_nothing_holds_has_no_frequency_and_what_is_never_pressed_no_stiffness() {
    let mut scene = chain(0.0, 0.0);
    scene.contacts[0].part.normal = Normal::Indentation(Varying::Constant(-1e-6));
    let linearised = about_rest(&scene);
    assert_eq!(linearised.stiffness(), &DMatrix::zeros(2, 2));
    assert!(linearised.modes().iter().all(|mode| mode.frequency == 0.0));
    // One mode is free, the other one has the reduced mass.
    let modes = about_rest(&chain(0.0, 0.0)).modes();
    assert_eq!(modes[0].frequency, 0.0);
    close(modes[1].frequency, (stuck(1e-3, 1.0) / 4e-3).sqrt(), 1e-12);
    close(modes[0].shape[0], modes[0].shape[1], 1e-8);
    let nothing = Model::new(&Scene::default()).unwrap();
    assert!(nothing.linearised(&still(&nothing), |d| d.start).modes().is_empty());
    assert_eq!(nothing.longest_step(Stepper::Verlet { step: 1.0 }), Some(f64::INFINITY));
}

#[test]
fn a_contact_resounds_with_the_masses_that_are_free_along_it() {
    let model = Model::new(&p1()).unwrap();
    let d = model.indentations(&still(&model), 0).unwrap();
    close(model.contact_resonance(0, d.start).unwrap(), (stuck(1e-3, 1.0) / 20e-3).sqrt(), 1e-12);
    let model = Model::new(&chain(20e6, 0.0)).unwrap();
    // 1/m = 1/5 g + 1/20 g = 1/4 g.
    close(model.contact_resonance(0, d.start).unwrap(), (stuck(1e-3, 1.0) / 4e-3).sqrt(), 1e-12);
}

#[test]
fn a_load_that_varies_gives_the_range_of_indentations() {
    let mut scene = foot_and_slider(
        wave("drive", sine(1e-6), 1e-3),
        0.02,
        contact([FOOT, SLIDER], Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0),
    );
    scene.waveforms.push(wave("load", Shape::Sine { amplitude: 0.5, phase: 0.0, offset: 1.5 }, 1e-3));
    scene.contacts[0].part.normal = Normal::Force(Varying::Follows(1));
    let model = Model::new(&scene).unwrap();
    // F = (4/3)E*√R d^{3/2}.
    let depth = |force: f64| (0.75 * force / (moduli().0 * 1e-3_f64.sqrt())).powf(2.0 / 3.0);
    let Indentations { least, start, most } = model.indentations(&still(&model), 0).unwrap();
    for (got, force) in [(least, 1.0), (start, 1.5), (most, 2.0)] {
        close(got, depth(force), 1e-12);
    }
    let limit = model.longest_step(Stepper::Verlet { step: 1e-6 }).unwrap();
    close(limit, 2.0 / (stuck(1e-3, 2.0) / 0.02).sqrt(), 1e-12);
    assert!(model.indentations(&still(&model), 1).is_none());
}

/// M ẍ + C ẋ + K x = 0.
struct Linear {
    mass: DVector<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
}

impl System for Linear {
    fn dimension(&self) -> usize {
        2 * self.mass.len()
    }
    fn positions(&self) -> usize {
        self.mass.len()
    }
    fn total(&self) -> usize {
        2 * self.mass.len()
    }
    fn slopes(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        let (x, v) = y.split_at(self.mass.len());
        let force =
            -(&self.stiffness * DVector::from_row_slice(x)) - &self.damping * DVector::from_row_slice(v);
        dy[..v.len()].copy_from_slice(v);
        dy[v.len()..].copy_from_slice(force.component_div(&self.mass).as_slice());
    }
}

/// Largest displacement late in a long run with fixed steps from a displacement of 1; infinite after overflow.
fn late(system: &Linear, verlet: bool, h: f64) -> f64 {
    let n = system.mass.len();
    let mut y = vec![1.0; n];
    y.resize(2 * n, 0.0);
    let (mut verlets, mut rk4) = (Verlet::new(n, 2 * n, 2 * n), Rk4::new(2 * n, 2 * n));
    let mut largest = 0.0_f64;
    for k in 0..40_000 {
        if verlet {
            verlets.step(system, 0.0, &mut y, h);
        } else {
            rk4.step(system, 0.0, &mut y, h);
        }
        if k > 39_000 {
            let size = y[..n].iter().map(|x| x.abs()).sum::<f64>();
            largest = if size.is_finite() { largest.max(size) } else { f64::INFINITY };
        }
    }
    largest
}

#[test]
fn the_longest_steps_are_where_the_steppers_begin_to_blow_up() {
    // Undamped, lightly damped, above critical damping, and limited by damping alone.
    for damping in [0.0, 20.0, 800.0, 20_000.0] {
        let mut scene = chain(20e6, damping);
        scene.springs.push(named("guide", damper([Side::Ground, SLIDER], 0.3 * damping)));
        let model = Model::new(&scene).unwrap();
        let linear = model.linearised(&still(&model), |d| d.most);
        let system = Linear {
            mass: linear.mass().clone(),
            damping: linear.damping().clone(),
            stiffness: linear.stiffness().clone(),
        };
        for (verlet, stepper) in [(true, Stepper::Verlet { step: 1.0 }), (false, Stepper::Rk4 { step: 1.0 })]
        {
            let limit = model.longest_step(stepper).unwrap();
            let (below, above) = (late(&system, verlet, 0.999 * limit), late(&system, verlet, 1.001 * limit));
            assert!(below < 100.0, "{stepper:?}, {damping}: {below:e} below {limit:e}");
            assert!(above > 1e6, "{stepper:?}, {damping}: {above:e} above {limit:e}");
        }
    }
}

#[test]
fn one_damped_mode_has_its_closed_limits() {
    let mut scene = chain(20e6, 30.0);
    scene.bodies[1].part = Body { x: Coordinate::default(), ..free(1.0) };
    let model = Model::new(&scene).unwrap();
    let (k, m, c) = (20e6 + stuck(1e-3, 1.0), 5e-3, 30.0);
    let h = model.longest_step(Stepper::Verlet { step: 1.0 }).unwrap();
    // (hω)² + 8ζhω = 4 with ω² = k/m, 2ζω = c/m.
    close(h * h * k / m + 4.0 * h * c / m, 4.0, 1e-12);
    assert_eq!(model.longest_step(Stepper::Event { tolerance: 1e-8 }), None);
}

#[test]
fn a_step_beyond_the_longest_is_refused_before_the_run() {
    let model = Model::new(&p1()).unwrap();
    let limit = 2.0 / (stuck(1e-3, 1.0) / 0.02).sqrt();
    assert!(model.start(&plan(Stepper::Verlet { step: 0.999 * limit }, 1.0)).is_ok());
    let error = model.start(&plan(Stepper::Verlet { step: 1.001 * limit }, 1.0)).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Step));
    let message = error.fault.to_string();
    assert!(message.starts_with(&format!("expected less than {limit:.3e} s")), "{message}");
    let error = model.start(&plan(Stepper::Rk4 { step: 1.001 * 2.0_f64.sqrt() * limit }, 1.0)).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Step));
    assert!(model.start(&event(1e-8, 1.0)).is_ok());
}

/// Independent copies of a model of [`chain`].
fn copies(scene: &Scene, count: usize) -> Scene {
    let mut all = Scene::default();
    for copy in 0..count {
        let side = |side| match side {
            Side::Body(body) => Side::Body(2 * copy + body),
            Side::Ground => Side::Ground,
        };
        all.bodies.extend(
            scene.bodies.iter().map(|body| named(&format!("{} {copy}", body.name), body.part.clone())),
        );
        for contact in &scene.contacts {
            let mut part = contact.part.clone();
            part.between = part.between.map(side);
            all.contacts.push(named(&format!("{} {copy}", contact.name), part));
        }
        for spring in &scene.springs {
            let part = Spring { between: spring.part.between.map(side), ..spring.part };
            all.springs.push(named(&format!("{} {copy}", spring.name), part));
        }
    }
    all
}

/// Independent subsystems are separated: 6 000 coordinates in one matrix would have 3.6e7 entries.
#[test]
fn scenes_side_by_side_have_the_longest_steps_of_one() {
    for (damping, count) in [(0.0, 3_000), (7.0, 300)] {
        let one = chain(20e6, damping);
        let (one, many) = (Model::new(&one).unwrap(), Model::new(&copies(&one, count)).unwrap());
        for stepper in [Stepper::Verlet { step: 0.0 }, Stepper::Rk4 { step: 0.0 }] {
            let longest = |model: &Model| model.longest_step(stepper).unwrap();
            close(longest(&many), longest(&one), 1e-12);
        }
    }
}
