//! Cost of an evaluation versus the size of the model: one to eight contacts, one to three free coordinates.
//!
//! A slider stands on balls on a foot with a sawtooth motion; its weight is proportional to their number. With x alone the normal
//! forces are constant; with z and pitch the motion determines them, and with pitch two springs along z hold the slider upright.
//! The time per evaluation is that of whole runs with the event stepper at 1e-6. Each time is the shortest of several runs. It
//! must not grow faster than contacts × coordinates.
//!
//! `size CONTACTS COORDINATES PERIODS` runs one model once and prints its counts, to count instructions. The difference between
//! two numbers of periods excludes construction and start.
//!
//! `size start` measures the equilibrium before a run with 100 to 10 000 contacts: it must grow in proportion to their number.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use std::hint::black_box;
use std::time::Instant;
use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_drive::scene::{
    Body, Contact, ContactStart, Coordinate, Direction, EngineChoice, Gravity, Named, Normal, NormalDamping,
    Point, Scene, Side, Spring, Start, Varying,
};
use stickslip_drive::{Counts, Limits, Model, Plan, Shape, Stepper, Timing, Waveform, run};

const PERIOD: f64 = 1e-3;
const PERIODS: u32 = 20;
const TURNS: u32 = 25;
/// Force on each ball, N.
const FORCE: f64 = 0.3;
const GRAVITY: f64 = 9.81;
/// Largest distance of balls and springs from the middle along x, m.
const REACH: f64 = 12e-3;
/// Height of the centre of mass, m.
const HEIGHT: f64 = 4e-3;

fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

fn ball(place: f64, coordinates: usize) -> Contact {
    let steel = Material::new(210e9, 0.3).unwrap();
    let constant = Normal::Force(Varying::Constant(FORCE));
    Contact {
        between: [Side::Body(0), Side::Body(1)],
        at: [Point { x: place, z: 0.0 }, Point { x: place, z: -HEIGHT }],
        interface: Interface::new(Pair::new(steel, steel), Profile::paraboloid(1e-3).unwrap(), 0.2).unwrap(),
        normal: if coordinates == 1 { constant } else { Normal::Coupled },
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    }
}

fn scene(contacts: usize, coordinates: usize) -> Scene {
    let mass = FORCE * contacts as f64 / GRAVITY;
    let free = |i: usize| if i < coordinates { Coordinate::FREE } else { Coordinate::default() };
    let slider = Body {
        mass: Some(mass),
        inertia: Some(mass * REACH * REACH / 3.0),
        x: free(0),
        z: free(1),
        pitch: free(2),
    };
    let foot = Body { x: Coordinate::follows(0), ..Body::default() };
    // Evenly distributed; a single one is in the middle.
    let place = |i: usize| REACH * ((2 * i + 1) as f64 / contacts as f64 - 1.0);
    let balls = (0..contacts).map(|i| named(&format!("ball{i}"), ball(place(i), coordinates)));
    let upright = |x: f64| Spring {
        between: [Side::Ground, Side::Body(1)],
        at: [Point::default(), Point { x, z: 0.0 }],
        direction: Direction::Z,
        stiffness: 1e4,
        damping: 0.0,
        preload: 0.0,
    };
    let springs = [("left", -REACH), ("right", REACH)].map(|(name, x)| named(name, upright(x)));
    let sawtooth = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.05e-3 };
    Scene {
        waveforms: vec![named("drive", Waveform::new(sawtooth, Timing::every(PERIOD)).unwrap())],
        bodies: vec![named("foot", foot), named("slider", slider)],
        contacts: balls.collect(),
        springs: if coordinates < 3 { Vec::new() } else { springs.to_vec() },
        gravity: Gravity { acceleration: GRAVITY, incline: 0.0 },
        start: Start::Equilibrium,
        ..Scene::default()
    }
}

/// Returns the counts of a run and its time without the initial equilibrium, s.
fn timed(model: &Model, periods: u32) -> (Counts, f64) {
    let stepper = Stepper::Event { tolerance: 1e-6 };
    let duration = PERIOD * f64::from(periods);
    let plan = Plan { duration, stepper, limits: Limits::default(), every: None, until_steady: None };
    let mut state = model.start(&plan).unwrap();
    let begun = Instant::now();
    run(black_box(model), &plan, &mut state, &mut ()).unwrap();
    (state.counts(), begun.elapsed().as_secs_f64())
}

/// Size of a model, counts of its runs, and the shortest time of one, s.
struct Cell {
    contacts: usize,
    coordinates: usize,
    model: Model,
    counts: Counts,
    time: f64,
}

impl Cell {
    fn new(contacts: usize, coordinates: usize) -> Self {
        let model = Model::new(&scene(contacts, coordinates)).unwrap();
        Self { contacts, coordinates, model, counts: Counts::default(), time: f64::INFINITY }
    }

    fn turn(&mut self) {
        let (counts, time) = timed(&self.model, PERIODS);
        (self.counts, self.time) = (counts, self.time.min(time));
    }

    /// Returns the time per evaluation, s.
    fn evaluation(&self) -> f64 {
        self.time / self.counts.evaluations as f64
    }
}

/// Prints the times of construction and equilibrium per contact.
fn starts() {
    println!("contacts × coordinates   µs/contact to build   and to settle");
    for (contacts, coordinates) in [1, 2, 3].into_iter().flat_map(|n| [100, 1000, 10_000].map(|c| (c, n))) {
        let scene = scene(contacts, coordinates);
        let begun = Instant::now();
        let model = Model::new(&scene).unwrap();
        let built = begun.elapsed();
        let stepper = Stepper::Event { tolerance: 1e-6 };
        let plan =
            Plan { duration: PERIOD, stepper, limits: Limits::default(), every: None, until_steady: None };
        black_box(model.start(&plan).unwrap());
        let settled = begun.elapsed() - built;
        let each = [built, settled].map(|time| time.as_secs_f64() * 1e6 / contacts as f64);
        println!("{contacts:8} × {coordinates:<11} {:20.2} {:15.2}", each[0], each[1]);
    }
}

fn main() {
    if std::env::args().any(|argument| argument == "start") {
        return starts();
    }
    let numbers: Vec<u32> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    if let [contacts, coordinates, periods] = numbers[..] {
        let model = Model::new(&scene(contacts as usize, coordinates as usize)).unwrap();
        println!("{:?}", timed(&model, periods).0);
        return;
    }
    let sizes = [1, 2, 3].into_iter().flat_map(|n| [1, 2, 4, 8].map(|c| (c, n)));
    let mut cells: Vec<Cell> = sizes.map(|(c, n)| Cell::new(c, n)).collect();
    for _ in 0..TURNS {
        cells.iter_mut().for_each(Cell::turn);
    }
    let unit = cells[0].evaluation();
    println!("contacts × coordinates   ns/evaluation   against 1 × 1   evaluations/period   events/period");
    for cell in &cells {
        let per_period = |count: u64| count as f64 / f64::from(PERIODS);
        let ratio = cell.evaluation() / unit;
        println!(
            "{:8} × {:<11} {:15.1} {:15.2} {:20.1} {:15.1}",
            cell.contacts,
            cell.coordinates,
            cell.evaluation() * 1e9,
            ratio,
            per_period(cell.counts.evaluations),
            per_period(cell.counts.events),
        );
    }
}
