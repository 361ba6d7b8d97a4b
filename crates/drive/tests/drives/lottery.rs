//! Random models by seed. The seed determines which parts occur, so that twenty seeds contain all; values are random.

use crate::parts::{contact, damper, follower, free, named, piezo, push};
use std::f64::consts::TAU;
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Actuator, Contact, ContactStart, Gravity, Load, Named, Normal, Scene, Side, Spring, Varying,
};
use stickslip_drive::{Harmonic, Shape, Timing, Waveform};

/// `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014).
pub(crate) struct Draw(u64);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform distribution between two numbers.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Logarithmic distribution between two numbers.
    pub(crate) fn spread(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }
}

/// Random model with data for its run and evaluation.
pub(crate) struct Drawn {
    pub(crate) scene: Scene,
    /// Period of the drive, s; all corners are at multiples of a hundredth of it.
    pub(crate) period: f64,
    /// Peak-to-peak stroke of the drive, m.
    pub(crate) stroke: f64,
    pub(crate) title: String,
}

/// Shape with corners at multiples of a hundredth of the period; the second value says whether there are any.
fn shape(draw: &mut Draw, kind: u64, stroke: f64, period: f64) -> (Shape, bool) {
    let flyback = (draw.between(4.0, 30.0)).round() / 100.0 * period;
    match kind {
        0 => (Shape::Sawtooth { stroke, flyback }, true),
        1 => {
            let (phase, offset) = (draw.between(0.0, TAU), draw.between(-stroke, stroke));
            (Shape::Sine { amplitude: 0.5 * stroke, phase, offset }, false)
        }
        2 => {
            let term = |draw: &mut Draw, order: f64| Harmonic {
                amplitude: draw.between(0.2, 0.5) * stroke / order,
                order,
                phase: draw.between(0.0, TAU),
            };
            (Shape::Harmonics { terms: [1.0, 2.0, 3.0].map(|order| term(draw, order)).to_vec() }, false)
        }
        3 => (Shape::Triangle { stroke }, true),
        4 => (Shape::Cycloid { stroke, flyback }, false),
        _ => {
            let points = (0..=16).map(|i| {
                (0.25 * f64::from(i) * period, if i == 0 { 0.0 } else { draw.between(-0.5, 0.5) * stroke })
            });
            (Shape::Table { points: points.collect() }, true)
        }
    }
}

fn profile(draw: &mut Draw, kind: u64) -> (Profile, &'static str) {
    let (profile, name) = match kind {
        0 => (Profile::paraboloid(draw.spread(2e-4, 5e-3)), "paraboloid"),
        1 => (Profile::cone(draw.spread(0.003, 0.03)), "cone"),
        2 => (Profile::sphere(draw.spread(2e-4, 5e-3)), "sphere"),
        3 => (Profile::power(draw.spread(1e9, 1e11), 4.0), "power 4"),
        4 => (Profile::flat(draw.spread(1e-5, 1e-4)), "flat"),
        _ => {
            let heights: Vec<f64> = (0..200).map(|_| draw.between(0.0, 6e-7)).collect();
            (Profile::foundation(&heights, &vec![3e-7; 200]), "list")
        }
    };
    (profile.unwrap(), name)
}

/// u_c (m) and G\*m(d) (N/m) of one contact at its mean load.
fn scales(contact: &Contact, force: f64) -> (f64, f64) {
    let law = &contact.interface;
    let d = law.indentation(force);
    (law.gross_slip_displacement(d), law.stick_stiffness(d))
}

/// Model of a seed.
///
/// A slider is on one to three contacts of a foot. The foot follows a waveform or is on a piezo stack. Further parts depend on
/// the seed: a second contact between slider and ground, spring and damper to ground, load, gravity on an incline, a varying
/// normal force. No damper follows a waveform with corners, where its force would jump.
pub(crate) fn deal(seed: u64) -> Drawn {
    let mut draw = Draw::new(seed);
    let (between, force) = ([Side::Body(0), Side::Body(1)], draw.spread(0.2, 3.0));
    let (profile, profile_name) = profile(&mut draw, (seed + seed / 6) % 6);
    let mut ball = contact(between, profile, draw.between(0.1, 0.4), force);
    ball.count = 1 + (draw.bits() % 3) as u32;
    let (u_c, stiffness) = scales(&ball, force);
    let stuck = stiffness * f64::from(ball.count);
    let frequency = draw.spread(1e3, 1e4);
    let mass = stuck / (TAU * frequency).powi(2);
    let period = (draw.between(5.0, 12.0) / frequency * 1e6).round() * 1e-6;
    let stroke = draw.between(1.5, 6.0) * u_c;
    let hold = ball.interface.friction() * force * f64::from(ball.count);
    let (shape, corners) = shape(&mut draw, seed % 6, stroke, period);
    let mut title = format!("seed {seed}: {} on {profile_name}", name(&shape));
    let mut scene = Scene {
        waveforms: vec![named("drive", Waveform::new(shape, Timing::every(period)).unwrap())],
        bodies: vec![named("foot", follower(0)), named("slider", free(mass))],
        ..Scene::default()
    };
    if seed % 5 == 4 {
        ball.start = ContactStart::Displacement(draw.between(-0.8, 0.8) * u_c);
        scene.bodies[1].part.x.velocity = draw.between(-0.5, 0.5) * u_c * TAU * frequency;
    }
    if seed % 6 == 5 {
        let shape = Shape::Sine {
            amplitude: draw.between(0.1, 0.5) * force,
            phase: draw.between(0.0, TAU),
            offset: force,
        };
        let pressing = Waveform::new(shape, Timing::every(period * draw.between(0.3, 2.0))).unwrap();
        scene.waveforms.push(named("pressing", pressing));
        ball.normal = Normal::Force(Varying::Follows(1));
        title += ", varying force";
    }
    scene.contacts.push(named("ball", ball));
    add_parts(&mut draw, seed, &mut scene, &Scales { mass, stuck, hold, corners }, &mut title);
    Drawn { scene, period, stroke, title }
}

struct Scales {
    mass: f64,
    stuck: f64,
    hold: f64,
    corners: bool,
}

fn add_parts(draw: &mut Draw, seed: u64, scene: &mut Scene, scales: &Scales, title: &mut String) {
    let &Scales { mass, stuck, hold, corners } = scales;
    let ground = [Side::Ground, Side::Body(1)];
    if seed.is_multiple_of(3) {
        let (profile, profile_name) = profile(draw, (seed / 3) % 6);
        let (friction, force) = (draw.between(0.1, 0.3), draw.between(0.1, 0.4));
        scene.contacts.push(named("guide", contact(ground, profile, friction, hold * force / friction)));
        *title += &format!(", second contact ({profile_name})");
    }
    if seed % 4 == 1 {
        let foot = mass * draw.between(0.5, 2.0);
        let stiffness = stuck * draw.between(3.0, 20.0);
        let damping = 2.0 * draw.between(0.02, 0.1) * (stiffness * foot).sqrt();
        let (inner, outer) = if corners { (0.0, damping) } else { (damping, 0.0) };
        let between = [Side::Ground, Side::Body(0)];
        scene.bodies[0].part = free(foot);
        scene.actuators.push(named(
            "stack",
            Actuator { damping: inner, ..piezo(between, stiffness, Varying::Follows(0)) },
        ));
        scene.springs.push(named("guide of the foot", damper(between, outer)));
        *title += ", stack";
    }
    if seed % 4 == 2 {
        let (stiffness, ratio) = (stuck * draw.between(0.02, 0.2), draw.between(0.02, 0.5));
        let damping = 2.0 * ratio * (stuck * mass).sqrt();
        scene
            .springs
            .push(named("tie", Spring { stiffness, preload: 0.1 * hold, ..damper(ground, damping) }));
        *title += ", tie";
    }
    if seed % 3 == 1 {
        scene.loads.push(push(1, draw.between(0.05, 0.4) * hold * draw.sign()));
        *title += ", load";
    }
    if seed % 7 == 3 {
        let sine = Shape::Sine { amplitude: 0.2 * hold, phase: draw.between(0.0, TAU), offset: 0.0 };
        let timing = Timing::every(scene.waveforms[0].part.period().unwrap_or(1e-3) * draw.between(0.4, 3.0));
        scene.waveforms.push(named("wind", Waveform::new(sine, timing).unwrap()));
        scene.loads.push(Load { on: 1, x: Varying::Follows(scene.waveforms.len() - 1), ..Load::default() });
        *title += ", varying load";
    }
    if seed % 5 == 3 {
        let most = (0.4 * hold / (mass * 9.81)).min(1.0);
        scene.gravity = Gravity { acceleration: 9.81, incline: (most * draw.between(0.1, 1.0)).asin() };
        *title += ", gravity";
    }
}

fn name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Sawtooth { .. } => "sawtooth",
        Shape::Triangle { .. } => "triangle",
        Shape::Sine { .. } => "sine",
        Shape::Harmonics { .. } => "harmonics",
        Shape::Cycloid { .. } => "cycloid",
        Shape::Table { .. } => "table",
        Shape::Input { .. } => "input",
        Shape::Generator(_) => "generator",
        // Not random: these shapes are tested in shapes.rs.
        _ => "other",
    }
}

/// Replaces all contacts of a model by rows of springs.
pub(crate) fn on_rows(scene: &Scene, count: usize) -> Scene {
    let mut scene = scene.clone();
    for Named { part, .. } in &mut scene.contacts {
        part.engine = stickslip_drive::scene::EngineChoice::Springs { count, span: None };
    }
    scene
}
