//! Random models run to their end at any tolerance.

use crate::lottery::{Draw, deal, on_rows};
use crate::parts::{FOOT_SLIDER, contact, event, foot_and_slider, named, of_pair, steel, wave};
use std::f64::consts::TAU;
use stickslip_contact::{Pair, Profile};
use stickslip_drive::scene::{Coordinate, Direction, Gravity, Normal, Point, Scene, Side, Spring};
use stickslip_drive::{Limits, Model, Plan, RunError, Shape, run};

/// Number of seeds; the variable `STICKSLIP_SEEDS` sets more.
const SEEDS: u64 = 60;

/// Units of mass, length and time.
#[derive(Clone, Copy)]
pub(crate) struct Units {
    pub(crate) mass: f64,
    pub(crate) length: f64,
    pub(crate) time: f64,
}

impl Units {
    const SI: Self = Self { mass: 1.0, length: 1.0, time: 1.0 };

    fn force(self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    pub(crate) fn energy(self) -> f64 {
        self.force() * self.length
    }
}

/// Slider that only its weight or a preloaded spring presses, with a start out of balance: in contact, above or pressed, and a
/// drive with a phase.
pub(crate) fn pressed(seed: u64) -> (Scene, f64) {
    pressed_in(seed, Units::SI)
}

/// The same model in other units.
pub(crate) fn pressed_in(seed: u64, units: Units) -> (Scene, f64) {
    let mut draw = Draw::new(seed);
    let mut of = |count: u64| draw.bits() % count;
    let (kind, start, shape, load, rubs) = (of(5), of(4), of(3), of(3), of(4));
    let (period, mass) = (units.time * draw.spread(1e-4, 1e-2), units.mass * draw.spread(1e-5, 0.1));
    let (amplitude, length) = (units.length * draw.spread(1e-9, 1e-5), units.length);
    let profile = match kind {
        0 => Profile::flat(length * draw.spread(1e-6, 1e-4)),
        1 => Profile::cone(draw.spread(1e-3, 0.1)),
        2 => Profile::sphere(length * draw.spread(1e-4, 1e-2)),
        3 => Profile::power(draw.spread(1e6, 1e9) / (length * length), 3.0),
        _ => Profile::paraboloid(length * draw.spread(1e-4, 1e-2)),
    };
    let friction = [0.0, 0.05, 0.2, 0.8][rubs as usize];
    let pressure = units.force() / (length * length);
    let moduli = [steel().normal_modulus(), steel().tangential_modulus()].map(|modulus| pressure * modulus);
    let mut ball = of_pair(
        Pair::from_moduli(moduli[0], moduli[1]).unwrap(),
        &contact(FOOT_SLIDER, profile.unwrap(), friction, 1.0),
    );
    ball.normal = Normal::Coupled;
    let shape = match shape {
        0 => Shape::Sine { amplitude, phase: draw.between(0.0, TAU), offset: 0.0 },
        1 => Shape::Triangle { stroke: amplitude },
        _ => Shape::Sawtooth { stroke: amplitude, flyback: 0.1 * period },
    };
    let mut scene = foot_and_slider(wave("drive", shape, period), mass, ball);
    let position = length * [0.0, 1e-8, -1e-9, -1e-8][start as usize];
    scene.bodies[1].part.z = Coordinate { position, ..Coordinate::FREE };
    if load < 2 {
        let acceleration = 9.81 * length / (units.time * units.time);
        scene.gravity = Gravity { acceleration, ..Gravity::default() };
    }
    if load > 0 {
        let press = Spring {
            between: [Side::Ground, Side::Body(1)],
            at: [Point::default(); 2],
            direction: Direction::Z,
            stiffness: units.force() / length * draw.spread(10.0, 1e5),
            damping: if draw.bits() & 1 == 0 {
                0.0
            } else {
                units.mass / units.time * draw.spread(0.01, 10.0)
            },
            preload: -units.force() * draw.spread(1e-3, 10.0),
        };
        scene.springs.push(named("press", press));
    }
    (scene, period)
}

/// Fixed steps run all of them; no run stops by itself. Motions beyond the range of the model are refused.
#[test]
fn no_drawn_scene_stops_itself() {
    let seeds = std::env::var("STICKSLIP_SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(SEEDS);
    let (mut runs, mut detours, mut stops) = (0_u32, 0, Vec::new());
    for seed in 0..seeds {
        let drawn = deal(seed);
        let (alone, period) = pressed(seed);
        let rows = on_rows(&drawn.scene, 16);
        let scenes =
            [(rows, drawn.period, "rows"), (drawn.scene, drawn.period, "drawn"), (alone, period, "pressed")];
        for (scene, period, kind) in scenes {
            let Ok(model) = Model::new(&scene) else { continue };
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
                let limits = Limits { wall: Some(20.0), ..Limits::default() };
                let plan = Plan { limits, ..event(tolerance, 3.0 * period) };
                let Ok(mut state) = model.start(&plan) else { continue };
                runs += 1;
                match run(&model, &plan, &mut state, &mut ()) {
                    Ok(()) | Err(RunError::Contact { .. }) => {}
                    Err(error) => stops.push((kind, seed, tolerance, error)),
                }
                if state.counts().detours > 0 {
                    println!("{kind} {seed} at {tolerance:e}: {} detours", state.counts().detours);
                    detours += 1;
                }
            }
        }
    }
    println!("{runs} runs, {detours} of them with detours, {} stops", stops.len());
    assert!(stops.is_empty(), "{stops:#?}");
}
