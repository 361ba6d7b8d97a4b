//! Bodies in the plane by two independent methods: the memory curve with event location, and rows of springs with velocity Verlet.

use crate::lottery::on_rows;
use crate::parts::{
    FOOT_SLIDER, channel, contact, damper, event, fitted_order, follower, free, named, of_pair, piezo, plan,
    sine, trace, wave,
};
use stickslip_contact::{Material, Pair, Profile};
use stickslip_drive::scene::{
    Actuator, Body, Contact, Coordinate, Direction, Freedom, Gravity, Load, Normal, Point, Scene, Side,
    Spring, Start, Varying,
};
use stickslip_drive::{Plan, Shape, Stepper};

fn pair(youngs_modulus: f64, poisson_ratio: f64) -> Pair {
    let steel = Material::new(210e9, 0.30).unwrap();
    Pair::new(Material::new(youngs_modulus, poisson_ratio).unwrap(), steel)
}

/// Ball below the second body, pressed by the motion.
fn ball(between: [Side; 2], pair: Pair, (radius, friction): (f64, f64), at: (f64, f64)) -> Contact {
    Contact {
        at: [Point::default(), Point { x: at.0, z: at.1 }],
        normal: Normal::Coupled,
        ..of_pair(pair, &contact(between, Profile::paraboloid(radius).unwrap(), friction, 0.0))
    }
}

fn planar(mass: f64, inertia: f64) -> Body {
    let free = Coordinate::FREE;
    Body { mass: Some(mass), inertia: Some(inertia), x: free, z: free, pitch: free }
}

fn down(on: usize, force: f64, x: f64) -> Load {
    Load { on, at: Point { x, z: 0.0 }, z: Varying::Constant(-force), ..Load::default() }
}

fn clamp(stiffness: f64, damping: f64, preload: f64, on: usize) -> Spring {
    let between = [Side::Ground, Side::Body(on)];
    Spring { direction: Direction::Z, stiffness, preload, ..damper(between, damping) }
}

/// Stage on three ruby balls with an eccentric load, on a foot with a sawtooth. Stroke and period are those of the drive in every case.
fn three_ball_stage() -> Case {
    let between = [Side::Body(0), Side::Body(1)];
    let ball = |x| ball(between, pair(400e9, 0.27), (0.5e-3, 0.2), (x, -6e-3));
    let rear = Contact { count: 2, ..ball(-12e-3) };
    let (stroke, period) = (300e-9, 2e-3);
    let scene = Scene {
        waveforms: vec![wave("drive", Shape::Sawtooth { stroke, flyback: 20e-6 }, period)],
        bodies: vec![named("foot", follower(0)), named("stage", planar(0.05, 1.04e-5))],
        contacts: vec![named("front", ball(12e-3)), named("rear", rear)],
        loads: vec![down(1, 0.6, 0.0), down(1, 0.3, 8e-3)],
        gravity: Gravity { acceleration: 9.81, incline: 0.0 },
        start: Start::Equilibrium,
        ..Scene::default()
    };
    Case { scene, stroke, period }
}

/// Slider on a vertical wall, pressed by a spring along the normal.
fn climber() -> Case {
    let between = [Side::Body(0), Side::Body(1)];
    let ball = |x| ball(between, pair(400e9, 0.27), (1e-3, 0.2), (x, -4e-3));
    let (stroke, period) = (400e-9, 2e-3);
    let scene = Scene {
        waveforms: vec![wave("drive", Shape::Sawtooth { stroke, flyback: 20e-6 }, period)],
        bodies: vec![named("wall", follower(0)), named("climber", planar(8e-3, 6e-7))],
        contacts: vec![named("upper", ball(8e-3)), named("lower", ball(-8e-3))],
        springs: vec![named("clamp", clamp(2e3, 0.0, -1.5, 1))],
        gravity: Gravity { acceleration: 9.81, incline: std::f64::consts::FRAC_PI_2 },
        start: Start::Equilibrium,
        ..Scene::default()
    };
    Case { scene, stroke, period }
}

/// Slider that a force above its feet rocks. Its stroke is the rocking amplitude.
fn rocking_slider() -> Case {
    let between = [Side::Ground, Side::Body(0)];
    let ball = |x| ball(between, pair(210e9, 0.30), (1e-3, 0.3), (x, -10e-3));
    let period = 1.0 / 400.0;
    let force = Varying::Follows(0);
    let scene = Scene {
        waveforms: vec![wave("shaker", sine(60e-3), period)],
        bodies: vec![named("slider", planar(0.03, 4e-6))],
        contacts: vec![named("left", ball(-5e-3)), named("right", ball(5e-3))],
        loads: vec![Load { on: 0, at: Point { x: 0.0, z: 12e-3 }, x: force, ..Load::default() }],
        gravity: Gravity { acceleration: 9.81, incline: 0.0 },
        start: Start::Equilibrium,
        ..Scene::default()
    };
    Case { scene, stroke: 0.0, period }
}

/// Rod on two pairs of feet that move on ellipses with a phase difference of half a period.
fn walking_drive() -> Case {
    let (amplitude, period) = (300e-9, 2e-3);
    let turn = |amplitude, degrees: f64| Shape::Sine { amplitude, phase: degrees.to_radians(), offset: 0.0 };
    let foot = |w| Body { z: Coordinate::follows(w + 1), ..follower(w) };
    let free = Coordinate::FREE;
    let feet = |foot| {
        let ball = ball([Side::Body(foot), Side::Body(2)], pair(370e9, 0.22), (2e-3, 0.25), (0.0, 0.0));
        crate::parts::damped(&Contact { count: 2, ..ball }, 2e-6)
    };
    let scene = Scene {
        waveforms: vec![
            wave("stride_a", turn(amplitude, 90.0), period),
            wave("lift_a", turn(120e-9, 180.0), period),
            wave("stride_b", turn(amplitude, 270.0), period),
            wave("lift_b", turn(120e-9, 0.0), period),
        ],
        bodies: vec![
            named("feet_a", foot(0)),
            named("feet_b", foot(2)),
            named("rod", Body { mass: Some(0.02), x: free, z: free, ..Body::default() }),
        ],
        contacts: vec![named("a", feet(0)), named("b", feet(1))],
        springs: vec![named("clamp", clamp(1e3, 20.0, -3.0, 2))],
        start: Start::Equilibrium,
        ..Scene::default()
    };
    Case { scene, stroke: 2.0 * amplitude, period }
}

/// A counter-mass on a piezo stack that drags its carrier over the ground.
fn impact_drive() -> Case {
    let between = [Side::Ground, Side::Body(0)];
    let ball = |x| Contact { count: 2, ..ball(between, pair(210e9, 0.30), (2e-3, 0.25), (x, -5e-3)) };
    let (stroke, period) = (2e-6, 4e-3);
    let stack = Actuator { damping: 40.0, ..piezo(FOOT_SLIDER, 8e6, Varying::Follows(0)) };
    let scene = Scene {
        waveforms: vec![wave("drive", Shape::Sawtooth { stroke, flyback: 50e-6 }, period)],
        bodies: vec![named("carrier", planar(0.03, 3e-6)), named("counter", free(0.01))],
        contacts: vec![named("front", ball(15e-3)), named("rear", ball(-15e-3))],
        actuators: vec![named("piezo", stack)],
        gravity: Gravity { acceleration: 9.81, incline: 0.0 },
        start: Start::Equilibrium,
        ..Scene::default()
    };
    Case { scene, stroke, period }
}

/// Ball that bounces and slides until it rolls. Its stroke is the height of fall, its period that of the bounces.
fn bouncing_ball() -> Case {
    let height = 0.5e-6;
    let mut body = planar(4.08e-3, 40.8e-9);
    (body.z.position, body.x.velocity) = (height, 12e-3);
    let between = [Side::Ground, Side::Body(0)];
    let scene = Scene {
        bodies: vec![named("ball", body)],
        contacts: vec![named("foot", ball(between, pair(210e9, 0.30), (5e-3, 0.15), (0.0, -5e-3)))],
        gravity: Gravity { acceleration: 9.81, incline: 0.0 },
        ..Scene::default()
    };
    Case { scene, stroke: height, period: 2.0 * (2.0 * height / 9.81_f64).sqrt() }
}

struct Case {
    scene: Scene,
    stroke: f64,
    period: f64,
}

impl Case {
    /// x of the free body at 32 times.
    fn path(&self, scene: &Scene, plan: &Plan) -> Vec<f64> {
        let (model, _, rows) = trace(scene, plan, plan.duration / 32.0);
        let free = scene.bodies.iter().find(|b| b.part.x.freedom == Freedom::Free).unwrap();
        rows.column(channel(&model, &format!("{}.x_m", free.name))).collect()
    }

    fn curve(&self, periods: f64) -> Vec<f64> {
        self.path(&self.scene, &event(1e-10, periods * self.period))
    }

    fn row(&self, periods: f64, springs: usize, steps: f64) -> Vec<f64> {
        let plan = plan(Stepper::Verlet { step: self.period / steps }, periods * self.period);
        self.path(&on_rows(&self.scene, springs), &plan)
    }

    /// Largest difference in strokes.
    fn off(&self, a: &[f64], b: &[f64]) -> f64 {
        let travel = a.iter().map(|x| (x - a[0]).abs()).fold(0.0, f64::max);
        let scale = if self.stroke > 0.0 { self.stroke } else { travel };
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
    }
}

/// 4096 springs, and steps that end at every corner of the drive.
fn agree(case: &Case) {
    let (periods, steps) = (3.0, 16_000.0);
    let off = case.off(&case.curve(periods), &case.row(periods, 4096, steps));
    println!("curve and row differ by {off:.1e} of the stroke");
    assert!(off < 1e-5, "{off:e}");
}

#[test]
fn stage_on_three_balls() {
    agree(&three_ball_stage());
}

#[test]
fn climber_on_a_wall() {
    agree(&climber());
}

#[test]
fn slider_that_rocks() {
    agree(&rocking_slider());
}

#[test]
fn rod_on_walking_feet() {
    agree(&walking_drive());
}

#[test]
fn carrier_dragged_by_a_counter_mass() {
    agree(&impact_drive());
}

#[test]
fn ball_that_bounces_and_slides() {
    agree(&bouncing_ball());
}

/// Discretisation error of the row, with steps so small that their error is negligible.
#[test]
fn order_of_the_row_in_its_springs() {
    let case = three_ball_stage();
    let exact = case.curve(1.0);
    let errors = [8, 16, 32, 64, 128, 256].map(|count: u32| {
        (1.0 / f64::from(count), case.off(&exact, &case.row(1.0, count as usize, 64_000.0)))
    });
    let order = fitted_order(&errors);
    println!("order {order:.2}, {errors:?}");
    assert!(order > 1.5, "{errors:?}");
}
