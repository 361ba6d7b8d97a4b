//! A run that a caller advances allocates no memory, per time step or per frame, for all integrators, also after a restart from bytes.
//!
//! Exception, described in [`Run`]: a slip memory that becomes deeper than before allocates memory. It starts with a capacity of 256 knots.
//! Of these drives only the stage needs more.

use crate::shared::{Stage, frames, rk4, verlet};
use stickslip_contact::Memory;
use stickslip_drive::{Entry, Plan, Record, Run, State, Stepper, UntilSteady};

/// Drives with the periods of their waveforms, s.
const DRIVES: [(&str, f64); 4] = [
    ("p1.json", 1e-3),
    ("piezo_stack.json", 1e-3),
    ("three_ball_stage.json", 2e-3),
    ("walking_drive.json", 2e-3),
];
/// Frame lengths, s; the last one is several periods.
const FRAMES: [f64; 4] = [20e-6, 3.7e-6, 91.3e-6, 5e-3];
/// Numbers of periods before and during the counting.
const WARM: f64 = 3.0;
const COUNTED: f64 = 3.0;
/// Initial capacity of a slip memory, in knots.
const ROOM: usize = 256;
/// Size of a knot, in bytes.
const KNOT: usize = 72;
/// Maximum number of doublings of the capacity, whose maximum is 16 384 knots.
const DOUBLINGS: u64 = 6;

fn steppers(stage: &Stage) -> Vec<Stepper> {
    let fixed = [verlet, rk4].map(|make| stage.step(0.5, make).unwrap());
    let located = [1e-4, 1e-9].map(|tolerance| Stepper::Event { tolerance });
    located.into_iter().chain(fixed).chain([frames(20e-6)]).collect()
}

/// Returns the largest number of knots of a slip memory.
fn depth(state: &State) -> usize {
    let knots = |memory: &Memory| match memory {
        Memory::Curve(curve) => curve.knot_count(),
        _ => 0,
    };
    state.memories().iter().map(knots).max().unwrap_or(0)
}

/// A record that counts rows and events.
#[derive(Default)]
struct Written {
    rows: u64,
    events: u64,
}

impl Record for Written {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(_) => self.rows += 1,
            Entry::Event(..) => self.events += 1,
            _ => {}
        }
    }
}

/// Allocations after a warm-up.
#[derive(Debug, Default)]
struct Allocated {
    /// Not by slip memories.
    plain: u64,
    /// By slip memories that became deeper than before.
    deeper: u64,
    /// Largest number of knots at the end of a frame.
    deepest: usize,
}

/// Returns the allocations of frames after a warm-up.
fn counted(run: &mut Run<'_>, period: f64, row: &mut Vec<f64>) -> Allocated {
    let (mut allocated, mut written) = (Allocated::default(), Written::default());
    let mut advance = |run: &mut Run<'_>, until: f64, counts: bool| {
        let info = allocation_counter::measure(|| {
            run.advance(until, &mut written).unwrap();
            run.row(row);
        });
        if counts && info.count_total > 0 {
            // A temporary growth within the frame is recognised by the size of the allocation: at least twice the capacity.
            let is_deeper = info.bytes_total >= info.count_total * (2 * ROOM * KNOT) as u64;
            let book = if is_deeper { &mut allocated.deeper } else { &mut allocated.plain };
            *book += info.count_total;
        }
        allocated.deepest = allocated.deepest.max(depth(run.state()));
    };
    let start = run.state().time();
    let warm = (WARM * period / FRAMES[0]) as u32;
    (1..=warm).for_each(|k| advance(run, start + f64::from(k) * FRAMES[0], false));
    for frame in FRAMES {
        let (from, frames) = (run.state().time(), (COUNTED * period / frame).ceil() as u32);
        (1..=frames).for_each(|k| advance(run, from + f64::from(k) * frame, true));
    }
    assert!(written.rows > 1000, "{} rows", written.rows);
    allocated
}

#[test]
fn frames_and_steps_allocate_nothing() {
    for (name, period) in DRIVES {
        let stage = Stage::example(name);
        let model = &stage.job.model;
        for stepper in steppers(&stage) {
            let plan = Plan { every: Some(7e-6), ..stage.plan(stepper, 1.0) };
            let mut row = Vec::new();
            let mut run = Run::new(model, &plan, stage.start(&plan).unwrap()).unwrap();
            let fresh = counted(&mut run, period, &mut row);
            let counts = run.state().counts();
            let state =
                State::from_bytes(model, &stage.key, &run.state().to_bytes(model, &stage.key)).unwrap();
            let mut run = Run::resume(model, &plan, state).unwrap();
            let restored = counted(&mut run, period, &mut row);
            println!("{name} {stepper:?}: {fresh:?}; restored {restored:?}; {counts:?}");
            let contacts = model.contacts().count() as u64;
            for allocated in [fresh, restored] {
                assert_eq!(allocated.plain, 0, "{name} {stepper:?}");
                assert!(allocated.deeper <= contacts * DOUBLINGS, "{name} {stepper:?}: {allocated:?}");
            }
        }
    }
}

/// Checking for constant steps at each period end allocates no memory.
#[test]
fn looking_for_constant_steps_allocates_nothing() {
    let (stage, period) = (Stage::example("p1.json"), 1e-3);
    // The limit is never reached, so every period end is checked.
    let until_steady = Some(UntilSteady { waveform: 0, body: 1, change: 1e-300 });
    for stepper in steppers(&stage) {
        let plan = Plan { every: Some(7e-6), until_steady, ..stage.plan(stepper, 1.0) };
        let mut run = Run::new(&stage.job.model, &plan, stage.start(&plan).unwrap()).unwrap();
        let allocated = counted(&mut run, period, &mut Vec::new());
        println!("{stepper:?}: {allocated:?}");
        assert_eq!((allocated.plain, allocated.deeper), (0, 0), "{stepper:?}");
    }
}
