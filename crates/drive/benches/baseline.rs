//! The loop a researcher writes, tuned, against the event stepper, on the benchmark drive P1.
//!
//! Velocity Verlet at 0.2 µs over a row of 1024 springs: the symmetric half of the row, eight lanes, two comparisons
//! per clamp, nothing else in the loop. Its code shares nothing with the library. Both are run in turn within one
//! process; times are the shortest of all turns, errors those of x(20 ms) against `tests/data/drive_p1.json`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use std::hint::black_box;
use std::time::Instant;
use stickslip_contact::{Material, Pair, Profile};
use stickslip_drive::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, Point, Scene, Side, Varying,
};
use stickslip_drive::{Event, Limits, Model, Plan, Record, Shape, Stepper, Timing, Waveform, run};

const YOUNG: f64 = 210e9;
const POISSON: f64 = 0.3;
const RADIUS: f64 = 1e-3;
const FRICTION: f64 = 0.15;
const FORCE: f64 = 1.0;
const MASS: f64 = 0.02;
const STROKE: f64 = 0.5e-6;

/// Springs in the row; half of them are stored.
const SPRINGS: usize = 1024;
const LANES: usize = 8;
const BLOCKS: usize = SPRINGS / 2 / LANES;
/// Steps of 0.2 µs: per period, in its rise, in 20 ms.
const PERIOD: u32 = 5000;
const RISE: u32 = 4500;
const STEPS: u32 = 100_000;
const STEP: f64 = 0.2e-6;

/// Half a row: stretches and their limits, m.
struct Row {
    stretch: [[f64; LANES]; BLOCKS],
    limit: [[f64; LANES]; BLOCKS],
    /// Stiffness of a spring and its mirror image, N/m.
    stiffness: f64,
}

impl Row {
    fn new() -> Self {
        let normal = YOUNG / (1.0 - POISSON * POISSON) / 2.0;
        let tangential = YOUNG / (1.0 + POISSON) / (2.0 - POISSON);
        let d = (0.75 * FORCE / (normal * RADIUS.sqrt())).powf(2.0 / 3.0);
        let width = (RADIUS * d).sqrt() / (SPRINGS / 2) as f64;
        let slope = FRICTION * normal / tangential;
        let limit = |i: usize| slope * (d - ((i as f64 + 0.5) * width).powi(2) / RADIUS);
        Self {
            stretch: [[0.0; LANES]; BLOCKS],
            limit: std::array::from_fn(|block| std::array::from_fn(|lane| limit(block * LANES + lane))),
            stiffness: 2.0 * tangential * width,
        }
    }

    /// Moves all springs by `du` and returns their force, N.
    #[inline]
    fn slide(&mut self, du: f64) -> f64 {
        let mut sums = [0.0; LANES];
        for (stretch, limit) in self.stretch.iter_mut().zip(&self.limit) {
            for lane in 0..LANES {
                let mut s = stretch[lane] + du;
                if s > limit[lane] {
                    s = limit[lane];
                }
                if s < -limit[lane] {
                    s = -limit[lane];
                }
                stretch[lane] = s;
                sums[lane] += s;
            }
        }
        self.stiffness * sums.iter().sum::<f64>()
    }
}

/// Place of the foot after `n` steps, m.
fn foot(n: u32) -> f64 {
    let n = n % PERIOD;
    if n <= RISE {
        STROKE * f64::from(n) / f64::from(RISE)
    } else {
        STROKE * f64::from(PERIOD - n) / f64::from(PERIOD - RISE)
    }
}

/// x(20 ms) of the slider, m.
fn baseline() -> f64 {
    let mut row = Row::new();
    let (mut x, mut v, mut a, mut at) = (0.0, 0.0, 0.0, 0.0);
    for n in 1..=STEPS {
        let dx = STEP * (v + 0.5 * STEP * a);
        let next = foot(n);
        let force = row.slide(next - at - dx);
        at = next;
        x += dx;
        v += 0.5 * STEP * (a + force / MASS);
        a = force / MASS;
    }
    x
}

fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

fn p1() -> Scene {
    let steel = Material::new(YOUNG, POISSON).unwrap();
    let shape = Shape::Sawtooth { stroke: STROKE, flyback: 0.1e-3 };
    let body = |mass, x| Body { mass, x, ..Body::default() };
    let contact = Contact {
        between: [Side::Body(0), Side::Body(1)],
        at: [Point::default(); 2],
        pair: Pair::new(steel, steel),
        profile: Profile::paraboloid(RADIUS).unwrap(),
        friction: FRICTION,
        normal: Normal::Force(Varying::Constant(FORCE)),
        gap: 0.0,
        damping: 0.0,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    Scene {
        waveforms: vec![named("drive", Waveform::new(shape, Timing::every(1e-3)).unwrap())],
        bodies: vec![
            named("foot", body(None, Coordinate::follows(0))),
            named("slider", body(Some(MASS), Coordinate::FREE)),
        ],
        contacts: vec![named("ball", contact)],
        ..Scene::default()
    }
}

struct Nothing;

impl Record for Nothing {
    fn row(&mut self, _: &[f64]) {}
    fn event(&mut self, _: &Event, _: &[f64]) {}
    fn wants_events(&self) -> bool {
        false
    }
}

fn by_events(model: &Model) -> f64 {
    let stepper = Stepper::Event { tolerance: 1e-6 };
    let plan = Plan { duration: 20e-3, stepper, limits: Limits::default(), every: None };
    let mut state = model.start(&plan).unwrap();
    run(model, &plan, &mut state, &mut Nothing).unwrap();
    state.body(model, 1).unwrap().0
}

/// Result of `work` and the time of one of `times` calls, s.
fn timed(times: u32, mut work: impl FnMut() -> f64) -> (f64, f64) {
    let begun = Instant::now();
    let mut result = 0.0;
    for _ in 0..times {
        result = black_box(work());
    }
    (result, begun.elapsed().as_secs_f64() / f64::from(times))
}

fn main() {
    let data: serde_json::Value = serde_json::from_str(include_str!("../tests/data/drive_p1.json")).unwrap();
    let reference = data["slider_x_m_at_20_ms"].as_f64().unwrap();
    let model = Model::new(&p1()).unwrap();
    let (mut plain, mut events) = ((0.0, f64::INFINITY), (0.0, f64::INFINITY));
    for _ in 0..15 {
        let turn = timed(2, baseline);
        plain = (turn.0, plain.1.min(turn.1));
        let turn = timed(100, || by_events(black_box(&model)));
        events = (turn.0, events.1.min(turn.1));
    }
    let error = |x: f64| (x - reference).abs() / STROKE;
    let stored = plain.1 / f64::from(STEPS) / (SPRINGS / 2) as f64 * 1e9;
    println!("P1, per simulated second; error of x(20 ms) in strokes");
    println!(
        "  velocity Verlet 0.2 us, {SPRINGS} springs: {:.1} ms, error {:.1e} ({stored:.3} ns per stored spring, {:.3} per spring)",
        plain.1 * 50e3,
        error(plain.0),
        0.5 * stored,
    );
    println!("  event stepper, tolerance 1e-6: {:.3} ms, error {:.1e}", events.1 * 50e3, error(events.0));
    println!("  ratio {:.0}", plain.1 / events.1);
}
