//! Stages: rigid sliders on balls, and independent formulas of their statics.

use crate::parts::{contact, named};
use std::f64::consts::{FRAC_PI_2, PI};
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Axis, Body, Contact, Coordinate, Direction, Gravity, Load, Normal, Point, Scene, Side, Spring, Start,
    Varying,
};
use stickslip_drive::{Model, SceneError, State, Stepper};

pub(crate) const GROUND_STAGE: [Side; 2] = [Side::Ground, Side::Body(0)];
/// Mass and moment of inertia of a stage, kg and kg m².
pub(crate) const MASS: f64 = 0.05;
pub(crate) const INERTIA: f64 = 8e-6;
/// Radius of a ball, m.
pub(crate) const BALL: f64 = 1e-3;

/// Point at which a stage stands on balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Foot {
    pub(crate) x: f64,
    pub(crate) count: u32,
}

/// Three balls: two at one end, one at the other.
pub(crate) const THREE: [Foot; 2] = [Foot { x: -9e-3, count: 2 }, Foot { x: 14e-3, count: 1 }];
/// Six balls, two at each of three points.
pub(crate) const SIX: [Foot; 3] =
    [Foot { x: -11e-3, count: 2 }, Foot { x: 2e-3, count: 2 }, Foot { x: 12e-3, count: 2 }];

/// A body that is free in the plane.
pub(crate) fn planar(mass: f64, inertia: f64) -> Body {
    let free = Coordinate::FREE;
    Body { mass: Some(mass), inertia: Some(inertia), x: free, z: free, pitch: free }
}

/// Steel contact at a point of the second body and the point below it of the first, pressed by the bodies.
pub(crate) fn coupled(between: [Side; 2], at: Point, profile: Profile, friction: f64) -> Contact {
    let below = Point { x: at.x, z: 0.0 };
    Contact { at: [below, at], normal: Normal::Coupled, ..contact(between, profile, friction, 0.0) }
}

/// Stage in static equilibrium: body 0 on the ground, on balls `height` below its centre of mass.
pub(crate) fn stage(feet: &[Foot], height: f64, friction: f64) -> Scene {
    let ball = |foot: &Foot| Contact {
        count: foot.count,
        ..coupled(GROUND_STAGE, Point { x: foot.x, z: -height }, Profile::paraboloid(BALL).unwrap(), friction)
    };
    Scene {
        bodies: vec![named("stage", planar(MASS, INERTIA))],
        contacts: feet.iter().enumerate().map(|(i, foot)| named(&format!("foot{i}"), ball(foot))).collect(),
        start: Start::Equilibrium,
        ..Scene::default()
    }
}

/// A force (N) at a point.
pub(crate) fn force_at(on: usize, (x, z): (f64, f64), force: (f64, f64)) -> Load {
    let at = Point { x, z };
    Load {
        on,
        at,
        x: Varying::Constant(force.0),
        z: Varying::Constant(force.1),
        pitch: Varying::Constant(0.0),
    }
}

/// A moment, N m.
pub(crate) fn moment(on: usize, moment: f64) -> Load {
    Load { on, pitch: Varying::Constant(moment), ..Load::default() }
}

pub(crate) fn earth(incline: f64) -> Gravity {
    Gravity { acceleration: 9.81, incline }
}

/// A spring along z from the ground to a point of a body.
pub(crate) fn upright(body: usize, at: Point, stiffness: f64, preload: f64) -> Spring {
    let between = [Side::Ground, Side::Body(body)];
    Spring { between, at: [Point::default(), at], direction: Direction::Z, stiffness, damping: 0.0, preload }
}

/// Model with its static equilibrium.
#[derive(Debug)]
pub(crate) struct Rest {
    pub(crate) model: Model,
    pub(crate) state: State,
}

/// Returns the static equilibrium of a model, or the error.
pub(crate) fn rest(scene: &Scene) -> Result<Rest, SceneError> {
    let model = Model::new(scene)?;
    let state = model.start(&crate::parts::plan(Stepper::Event { tolerance: 1e-8 }, 1.0))?;
    Ok(Rest { model, state })
}

impl Rest {
    /// x, z and pitch of a body.
    pub(crate) fn pose(&self, body: usize) -> [f64; 3] {
        [Axis::X, Axis::Z, Axis::Pitch].map(|axis| self.state.coordinate(&self.model, body, axis).unwrap().0)
    }

    /// Displacement along x and z of a point of a side.
    pub(crate) fn moved(&self, side: Side, at: Point) -> (f64, f64) {
        match side {
            Side::Ground => (0.0, 0.0),
            Side::Body(body) => {
                let [x, z, pitch] = self.pose(body);
                (x - at.z * pitch, z + at.x * pitch)
            }
        }
    }

    /// Indentation of a coupled contact.
    pub(crate) fn depth(&self, contact: &Contact) -> f64 {
        let [first, second] = [0, 1].map(|i| self.moved(contact.between[i], contact.at[i]).1);
        first - second - contact.gap
    }

    /// Normal force of one contact `c`, N: its depth in the test's own law.
    pub(crate) fn normal(&self, scene: &Scene, c: usize, law: impl Fn(f64) -> f64) -> f64 {
        law(self.depth(&scene.contacts[c].part).max(0.0))
    }

    /// F_x of one contact, N.
    pub(crate) fn tangential(&self, c: usize) -> f64 {
        self.state.tangential_force(&self.model, c).unwrap()
    }
}

/// E\* of steel on steel, E = 210 GPa, ν = 0.3: 1/E\* = 2(1-ν²)/E.
pub(crate) fn normal_modulus() -> f64 {
    210e9 / (2.0 * (1.0 - 0.3 * 0.3))
}

/// G\* of steel on steel: 1/G\* = 2(2-ν)/(4G), G = E/(2(1+ν)).
pub(crate) fn tangential_modulus() -> f64 {
    4.0 * 210e9 / (2.0 * 1.3) / (2.0 * 1.7)
}

/// Profile with the test's own formulas: B and n of g = B xⁿ; a flat punch has its radius and no n.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PowerLaw {
    foundation: f64,
    exponent: Option<f64>,
}

impl PowerLaw {
    pub(crate) fn flat(radius: f64) -> (Self, Profile) {
        (Self { foundation: radius, exponent: None }, Profile::flat(radius).unwrap())
    }

    pub(crate) fn cone(slope: f64) -> (Self, Profile) {
        (Self { foundation: FRAC_PI_2 * slope, exponent: Some(1.0) }, Profile::cone(slope).unwrap())
    }

    pub(crate) fn paraboloid(radius: f64) -> (Self, Profile) {
        (Self { foundation: 1.0 / radius, exponent: Some(2.0) }, Profile::paraboloid(radius).unwrap())
    }

    /// f = A r³ with κ₃ = 3π/4.
    pub(crate) fn cubic(coefficient: f64) -> (Self, Profile) {
        let foundation = 0.75 * PI * coefficient;
        (Self { foundation, exponent: Some(3.0) }, Profile::power(coefficient, 3.0).unwrap())
    }

    /// f = A r⁴ with κ₄ = 8/3.
    pub(crate) fn quartic(coefficient: f64) -> (Self, Profile) {
        let foundation = 8.0 / 3.0 * coefficient;
        (Self { foundation, exponent: Some(4.0) }, Profile::power(coefficient, 4.0).unwrap())
    }

    /// Contact radius: B aⁿ = d.
    fn radius(self, d: f64) -> f64 {
        self.exponent.map_or(self.foundation, |n| (d.max(0.0) / self.foundation).powf(1.0 / n))
    }

    /// F_N = E\* 2a d n/(n+1), N.
    pub(crate) fn force(self, d: f64) -> f64 {
        let share = self.exponent.map_or(1.0, |n| n / (n + 1.0));
        if d > 0.0 { normal_modulus() * 2.0 * self.radius(d) * d * share } else { 0.0 }
    }

    /// E\* 2a, N/m.
    pub(crate) fn stiffness(self, d: f64) -> f64 {
        if d > 0.0 { normal_modulus() * 2.0 * self.radius(d) } else { 0.0 }
    }
}

/// Hertz: F_N = (4/3)E\*√R d^{3/2}.
pub(crate) fn hertz(d: f64) -> f64 {
    4.0 / 3.0 * normal_modulus() * BALL.sqrt() * d * d.sqrt()
}

/// Hertz: contact radius a = √(Rd).
pub(crate) fn hertz_radius(d: f64) -> f64 {
    (BALL * d).sqrt()
}
