//! Models of the benchmark drive P1 with one size increased.

use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_drive::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, NormalDamping, Point, Side, Varying,
};
use stickslip_drive::{Scene, Shape, Timing, Waveform, WaveformError};

/// Period of the drive, s.
pub(super) const PERIOD: f64 = 1e-3;
/// Relative difference between neighbouring contacts and sliders, so that their events do not coincide.
const SPREAD: f64 = 0.01;
/// Amplitudes of the outer cycles from the first to the last, m; amplitude of the inner cycle, m.
const OUTER: (f64, f64) = (50e-9, 10e-9);
const INNER: f64 = 5e-9;
/// Friction coefficient.
const FRICTION: f64 = 0.15;
/// Mass of a slider that practically does not move, kg.
const HEAVY: f64 = 1e3;

/// Returns P1 with a number of sliders. Each slider has its own contacts, which share a normal force of 1 N, with this engine.
pub(super) fn drive(sliders: u32, contacts: u32, engine: EngineChoice) -> Result<Scene, String> {
    let shape = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1 * PERIOD };
    let mut scene = with_foot(Waveform::new(shape, Timing::every(PERIOD)))?;
    for slider in 0..sliders {
        let mass = 0.02 * (1.0 + SPREAD * f64::from(slider));
        scene.bodies.push(named(format!("slider {slider}"), free(mass)));
        let place = scene.bodies.len() - 1;
        for contact in 0..contacts {
            let radius = 1e-3 * (1.0 + SPREAD * f64::from(contact));
            let part = touching(place, radius, 1.0 / f64::from(contacts), engine)?;
            scene.contacts.push(named(format!("ball {slider}.{contact}"), part));
        }
    }
    Ok(scene)
}

/// Returns a heavy slider on a foot with `swings` decreasing half cycles and then `inner` equal cycles, and the start time of the equal
/// cycles, s.
pub(super) fn remembering(swings: u32, inner: u32) -> Result<(Scene, f64), String> {
    let half = 0.5 * PERIOD;
    let outer = |k: u32| OUTER.0 + (OUTER.1 - OUTER.0) * f64::from(k) / f64::from(swings.max(2) - 1);
    let amplitudes = (0..swings).map(outer).chain((0..2 * inner).map(|_| INNER));
    let signs = [1.0, -1.0].into_iter().cycle();
    let turns = amplitudes.zip(signs).enumerate();
    let turns = turns.map(|(k, (amplitude, sign))| ((k + 1) as f64 * half, sign * amplitude));
    let points = std::iter::once((0.0, 0.0)).chain(turns).collect();
    let mut scene = with_foot(Waveform::new(Shape::Table { points }, Timing::every(PERIOD)))?;
    scene.bodies.push(named("slider".to_owned(), free(HEAVY)));
    scene.contacts.push(named("ball".to_owned(), touching(1, 1e-3, 1.0, EngineChoice::Curve)?));
    Ok((scene, f64::from(swings) * half))
}

fn with_foot(waveform: Result<Waveform, WaveformError>) -> Result<Scene, String> {
    let waveform = waveform.map_err(|error| error.to_string())?;
    Ok(Scene {
        waveforms: vec![named("drive".to_owned(), waveform)],
        bodies: vec![named("foot".to_owned(), Body { x: Coordinate::follows(0), ..Body::default() })],
        ..Scene::default()
    })
}

fn free(mass: f64) -> Body {
    Body { mass: Some(mass), x: Coordinate::FREE, ..Body::default() }
}

/// Returns a contact of a steel ball between the foot and a body.
fn touching(body: usize, radius: f64, force: f64, engine: EngineChoice) -> Result<Contact, String> {
    let steel = Material::new(210e9, 0.3).map_err(|error| error.to_string())?;
    let profile = Profile::paraboloid(radius).map_err(|error| error.to_string())?;
    Ok(Contact {
        between: [Side::Body(0), Side::Body(body)],
        at: [Point::default(); 2],
        interface: Interface::new(Pair::new(steel, steel), profile, FRICTION)
            .map_err(|error| error.to_string())?,
        normal: Normal::Force(Varying::Constant(force)),
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine,
        count: 1,
    })
}

fn named<T>(name: String, part: T) -> Named<T> {
    Named { name, part }
}
