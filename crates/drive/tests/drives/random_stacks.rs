//! Random stacks of one to three bodies on random contacts: forces are balanced in an equilibrium, and statics confirms each
//! missing equilibrium.

use crate::lottery::Draw;
use crate::parts::{named, piezo};
use crate::stages::{PowerLaw, Rest, coupled, force_at, moment, planar, rest, upright};
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Contact, Coordinate, Direction, Freedom, Gravity, Load, Named, Point, SMALL_ANGLE, Scene, Side, Spring,
    Start, Varying,
};
use stickslip_drive::{SceneError, SceneFault};

const SEEDS: u64 = 600;

fn profile(draw: &mut Draw) -> (PowerLaw, Profile) {
    match draw.bits() % 4 {
        0 => PowerLaw::flat(draw.spread(1e-5, 3e-4)),
        1 => PowerLaw::cone(draw.spread(3e-3, 0.1)),
        2 => PowerLaw::paraboloid(draw.spread(1e-4, 2e-2)),
        _ => PowerLaw::cubic(draw.spread(1e5, 1e8)),
    }
}

/// Stack of bodies, each on the previous one or the ground.
struct Stack {
    scene: Scene,
    laws: Vec<PowerLaw>,
    /// Friction coefficient below each body, and height of its centre above its contacts.
    levels: Vec<(f64, f64)>,
    /// Whether springs hold every body.
    tied: bool,
}

fn stack(seed: u64) -> Stack {
    let mut draw = Draw::new(seed);
    let tied = seed.is_multiple_of(3);
    let mut scene = Scene { start: Start::Equilibrium, ..Scene::default() };
    let (mut laws, mut levels) = (Vec::new(), Vec::new());
    let mut below = (Side::Ground, 0.0);
    let bodies = 1 + (draw.bits() % 3) as usize;
    for body in 0..bodies {
        let (mass, height) = (draw.spread(1e-3, 1.0), draw.between(1e-3, 10e-3));
        let mut part = planar(mass, mass * draw.spread(1e-6, 1e-4));
        if bodies == 1 && draw.bits().is_multiple_of(3) {
            // Guide in pitch, or in pitch and along x.
            let fixed = Coordinate::default();
            (part.x, part.pitch) = [(part.x, fixed), (fixed, fixed)][(draw.bits() % 2) as usize];
        }
        part.z.position = 1e-6 * (draw.bits() % 2) as f64;
        scene.bodies.push(named(&format!("body{body}"), part));
        let friction = [0.0, 0.1, 0.3, 0.9, 50.0][(draw.bits() % 5) as usize];
        levels.push((friction, height));
        for place in 0..1 + draw.bits() % 4 {
            let x = draw.between(-15e-3, 15e-3);
            let (law, profile) = profile(&mut draw);
            let at = [Point { x, z: below.1 }, Point { x, z: -height }];
            let contact = coupled([below.0, Side::Body(body)], at[1], profile, friction);
            let gap = [0.0, 0.0, 0.5e-6, -0.5e-6, 100e-6, 1e-3][(draw.bits() % 6) as usize];
            let count = 1 + (draw.bits() % 3) as u32;
            laws.push(law);
            scene.contacts.push(named(&format!("ball{body}{place}"), Contact { at, gap, count, ..contact }));
        }
        load(&mut draw, &mut scene, body);
        if tied {
            tie(&mut draw, &mut scene, body);
        }
        below = (Side::Body(body), height);
    }
    let incline = if draw.bits().is_multiple_of(2) { 0.0 } else { draw.between(-0.6, 0.6) };
    scene.gravity = Gravity { acceleration: 9.81, incline };
    Stack { scene, laws, levels, tied }
}

fn load(draw: &mut Draw, scene: &mut Scene, body: usize) {
    let size = 9.81 * scene.bodies[body].part.mass.unwrap();
    let at = (draw.between(-8e-3, 8e-3), draw.between(-5e-3, 5e-3));
    match draw.bits() % 4 {
        0 => {}
        1 => {
            let force = (draw.between(-0.3, 0.3) * size, draw.between(-5.0, 2.0) * size);
            scene.loads.push(force_at(body, at, force));
        }
        2 => scene.loads.push(moment(body, draw.between(-4e-3, 4e-3) * size)),
        _ => {
            let preload = -draw.between(0.5, 5.0) * size;
            let at = Point { x: at.0, z: at.1 };
            scene.springs.push(named(&format!("press{body}"), upright(body, at, 0.0, preload)));
        }
    }
}

/// Springs that hold all three coordinates of a body.
fn tie(draw: &mut Draw, scene: &mut Scene, body: usize) {
    for x in [-6e-3, 7e-3] {
        let at = Point { x, z: draw.between(-3e-3, 3e-3) };
        let stiffness = draw.spread(1e2, 1e7);
        scene
            .springs
            .push(named(&format!("leg{body}{x}"), upright(body, at, stiffness, draw.between(-1.0, 1.0))));
    }
    let between = [Side::Ground, Side::Body(body)];
    let at = [Point::default(), Point { x: 0.0, z: draw.between(-3e-3, 3e-3) }];
    let actuator = piezo(between, draw.spread(1e2, 1e7), Varying::Constant(draw.between(-1e-6, 1e-6)));
    scene.actuators.push(named(&format!("stack{body}"), stickslip_drive::scene::Actuator { at, ..actuator }));
}

/// Sums of forces on the bodies, and of their magnitudes, along x, along z and in pitch.
struct Forces(Vec<[(f64, f64); 3]>);

impl Forces {
    fn add(&mut self, side: Side, at: Point, (x, z): (f64, f64)) {
        if let Side::Body(body) = side {
            let moment = [at.x * z, -at.z * x];
            self.put(body, [x, z, 0.0]);
            moment.iter().for_each(|m| self.put(body, [0.0, 0.0, *m]));
        }
    }

    fn put(&mut self, body: usize, parts: [f64; 3]) {
        for ((sum, size), part) in self.0[body].iter_mut().zip(parts) {
            (*sum, *size) = (*sum + part, *size + part.abs());
        }
    }

    /// A force on the second of two ends, and its opposite on the first.
    fn pair(&mut self, between: [Side; 2], at: [Point; 2], force: (f64, f64)) {
        self.add(between[1], at[1], force);
        self.add(between[0], at[0], (-force.0, -force.1));
    }
}

fn constant(value: Varying) -> f64 {
    let Varying::Constant(value) = value else { panic!("all is constant here") };
    value
}

/// Weight, loads, springs and actuators for displacements by `moved`.
fn applied(scene: &Scene, moved: impl Fn(Side, Point) -> (f64, f64)) -> Forces {
    let mut forces = Forces(vec![[(0.0, 0.0); 3]; scene.bodies.len()]);
    let (sin, cos) = scene.gravity.incline.sin_cos();
    for (i, body) in scene.bodies.iter().enumerate() {
        let weight = scene.gravity.acceleration * body.part.mass.unwrap();
        forces.add(Side::Body(i), Point::default(), (-weight * sin, -weight * cos));
    }
    for Load { on, at, x, z, pitch } in &scene.loads {
        forces.add(Side::Body(*on), *at, (constant(*x), constant(*z)));
        forces.put(*on, [0.0, 0.0, constant(*pitch)]);
    }
    for Named { part: Spring { between, at, direction, stiffness, preload, .. }, .. } in &scene.springs {
        let ends = [0, 1].map(|i| moved(between[i], at[i]));
        assert_eq!(*direction, Direction::Z);
        forces.pair(*between, *at, (0.0, preload - stiffness * (ends[1].1 - ends[0].1)));
    }
    for Named { part, .. } in &scene.actuators {
        let ends = [0, 1].map(|i| moved(part.between[i], part.at[i]));
        let force = part.stiffness * (constant(part.stroke) - (ends[1].0 - ends[0].0));
        forces.pair(part.between, part.at, (force, 0.0));
    }
    forces
}

/// Largest imbalance of a free coordinate relative to the acting forces, with friction at its limit. Rounding of coordinates is
/// not an imbalance.
fn imbalance(stack: &Stack, rest: &Rest) -> f64 {
    let scene = &stack.scene;
    let mut forces = applied(scene, |side, at| rest.moved(side, at));
    let nothing = || Forces(vec![[(0.0, 0.0); 3]; scene.bodies.len()]);
    let (mut friction, mut rounding) = (nothing(), nothing());
    let far = |[x, z, pitch]: [f64; 3]| x.abs() + z.abs() + 0.02 * pitch.abs();
    let ulp = 4.0 * f64::EPSILON * (0..scene.bodies.len()).map(|b| far(rest.pose(b))).fold(1e-6, f64::max);
    for (c, (Named { part, .. }, law)) in scene.contacts.iter().zip(&stack.laws).enumerate() {
        let (count, depth, along) = (f64::from(part.count), rest.depth(part), rest.tangential(c));
        let (normal, noise) = (law.force(depth), law.stiffness(depth) * ulp);
        let coefficient = part.interface.friction();
        assert!(along.abs() <= coefficient * (normal * (1.0 + 1e-12) + noise), "{along:e} of {normal:e}");
        forces.pair(part.between, part.at, (count * along, count * normal));
        friction.pair(part.between, part.at, (count * coefficient.min(1.0) * normal, 0.0));
        rounding.pair(part.between, part.at, (count * noise, count * noise));
    }
    for Named { part, .. } in &scene.springs {
        rounding.pair(part.between, part.at, (0.0, part.stiffness * ulp));
    }
    for Named { part, .. } in &scene.actuators {
        rounding.pair(part.between, part.at, (part.stiffness * ulp, 0.0));
    }
    let mut worst = 0.0_f64;
    for (b, body) in scene.bodies.iter().enumerate() {
        for (axis, (_, coordinate)) in body.part.coordinates().into_iter().enumerate() {
            let (left, size) = (forces.0[b][axis].0.abs(), forces.0[b][axis].1 + friction.0[b][axis].1);
            if coordinate.freedom == Freedom::Free && left > rounding.0[b][axis].1 {
                worst = worst.max(left / size);
            }
        }
    }
    worst
}

/// Margins of each body to its limits along x, along z and in pitch by statics, relative to the acting forces; negative beyond
/// the limit. A failure below affects all bodies above.
fn margins(stack: &Stack) -> Vec<[f64; 3]> {
    let scene = &stack.scene;
    let forces = applied(scene, |_, _| (0.0, 0.0)).0;
    let (mut x, mut z, mut about) = (0.0, 0.0, 0.0);
    let mut margins = Vec::new();
    for (body, [fx, fz, m]) in forces.iter().enumerate().rev() {
        let (friction, height) = stack.levels[body];
        let free = scene.bodies[body].part.coordinates().map(|(_, c)| c.freedom == Freedom::Free);
        // Forces from above act at the top of this body, `height` above its centre.
        let above = about - height * x;
        (x, z) = (x + fx.0, z + fz.0);
        about = above + m.0 - height * x;
        let places = scene.contacts.iter().filter(|c| c.part.between[1] == Side::Body(body));
        let places: Vec<f64> = places.map(|c| c.part.at[1].x).collect();
        let first = places.iter().copied().fold(f64::INFINITY, f64::min);
        let last = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let centre = about / z;
        let inside = (centre - first).min(last - centre) / 15e-3;
        let along =
            if friction * -z > 0.0 || x != 0.0 { (friction * -z - x.abs()) / x.abs().max(-z) } else { 1.0 };
        margins.push([if free[0] { along } else { 1.0 }, -z / fz.1, if free[2] { inside } else { 1.0 }]);
    }
    margins.reverse();
    margins
}

/// Whether statics confirms that a coordinate has no equilibrium: this body, or one above, is beyond its limit.
fn is_lost(stack: &Stack, body: usize, axis: usize) -> bool {
    let margins = margins(stack);
    let places = (0..margins.len()).flat_map(|body| (0..3).map(move |axis| (body, axis)));
    let lost: Vec<(usize, usize)> = places.filter(|&(body, axis)| margins[body][axis] < 0.0).collect();
    match lost[..] {
        [(lowest, way)] if axis != 2 => body >= lowest && axis == way,
        _ => lost.iter().any(|(_, way)| *way == axis),
    }
}

#[test]
fn stacks_come_to_rest_in_balance_or_say_what_nothing_holds() {
    let (mut rests, mut turned, mut refused) = (0, 0, [0; 3]);
    for seed in 0..SEEDS {
        let stack = stack(seed);
        match rest(&stack.scene) {
            Ok(rest) => {
                let imbalance = imbalance(&stack, &rest);
                assert!(imbalance < 1e-9, "seed {seed}: {imbalance:e}");
                rests += 1;
            }
            // Soft springs and wide gaps allow large angles, and a tilted body may have a balance anywhere.
            Err(SceneError { fault: SceneFault::Turned { body, angle }, .. }) => {
                let body = body.trim_start_matches("body").parse().unwrap();
                let is_loose = stack.tied || stack.scene.contacts.iter().any(|c| c.part.gap > 50e-6);
                assert!(angle.abs() > SMALL_ANGLE, "seed {seed}: {angle}");
                assert!(
                    is_loose || is_lost(&stack, body, 2),
                    "seed {seed}: {angle}, {:.2?}",
                    margins(&stack)
                );
                turned += 1;
            }
            Err(error) => {
                let SceneFault::NoEquilibrium { body, axis, .. } = &error.fault else { panic!("{error}") };
                let axis = *axis as usize;
                let body = body.trim_start_matches("body").parse().unwrap();
                assert!(!stack.tied, "seed {seed}: springs hold all, but {error}");
                assert!(is_lost(&stack, body, axis), "seed {seed}: {error}, {:.2?}", margins(&stack));
                refused[axis] += 1;
            }
        }
    }
    println!("{rests} rest, {turned} would turn far, refused {refused:?}");
    assert!(rests > 0 && refused.iter().all(|n| *n > 10), "{rests} {refused:?}");
}
