//! Batches: every line is what its scene comes to alone, on any number of cores, without an allocation.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_drive::{Model, Plan, Scene, Variants, run};
use stickslip_scenario::Scenario;
use stickslip_study::{Batch, Figure, FigureError, LineFault};

/// A scenario of the gallery, with keys set.
fn scenario(name: &str, set: &[(&str, &str)]) -> Scenario {
    let file = format!("{}/../../scenarios/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut scenario = Scenario::load_with(file, set).unwrap();
    scenario.plan.every = None;
    scenario
}

fn p1() -> Scenario {
    scenario("p1", &[("run.stepper.event.tolerance", "1e-6")])
}

/// A part between -1 and 1 that belongs to a variant.
fn spread(variant: usize, number: u32) -> f64 {
    2.0 * (variant as f64 * f64::from(number).sqrt()).fract() - 1.0
}

/// A batch of P1 in which mass, friction, load and stroke vary by a tenth.
fn varied(scenario: &Scenario) -> Batch {
    let mut batch = Batch::of(scenario).unwrap();
    batch.vary("bodies.slider.mass").unwrap().vary("contacts.ball.friction").unwrap();
    batch.vary("contacts.ball.normal.force").unwrap().vary("waveforms.drive.sawtooth.stroke").unwrap();
    batch.tell(Figure::End("slider.x_m".to_owned())).unwrap();
    batch.tell(Figure::Step { channel: "slider.x_m".to_owned(), waveform: 0 }).unwrap();
    batch
}

fn draw(base: &[f64], variant: usize, numbers: &mut [f64]) {
    for ((number, base), prime) in numbers.iter_mut().zip(base).zip([2, 3, 5, 7]) {
        *number = base * (1.0 + 0.1 * spread(variant, prime));
    }
}

/// The scene that a line tells of, read from the file with its numbers written into it, run by itself. Independent of how batches set
/// numbers and share rooms.
#[test]
fn a_line_is_what_the_file_with_its_numbers_comes_to() {
    let whole = p1();
    let batch = varied(&whole);
    let base: Vec<f64> = batch.numbers().collect();
    let lines = batch.run(40, |i, numbers| draw(&base, i, numbers), |_| true);
    for (i, line) in lines.iter().enumerate().step_by(13) {
        let mut numbers = base.clone();
        draw(&base, i, &mut numbers);
        let [mass, friction, force, stroke] = [0, 1, 2, 3].map(|k| format!("{:e}", numbers[k]));
        let alone = scenario(
            "p1",
            &[
                ("run.stepper.event.tolerance", "1e-6"),
                ("bodies.slider.mass", &mass),
                ("contacts.ball.friction", &friction),
                ("contacts.ball.normal.force", &force),
                ("waveforms.drive.sawtooth.stroke", &stroke),
            ],
        );
        let place = |duration: f64| {
            let plan = Plan { duration, ..alone.plan };
            let model = Model::new(&alone.scene).unwrap();
            let mut state = model.start(&plan).unwrap();
            run(&model, &plan, &mut state, &mut ()).unwrap();
            (state.body(&model, 1).unwrap().0, state.counts())
        };
        let (end, counts) = place(20e-3);
        assert_eq!(line.figures[0].to_bits(), end.to_bits(), "variant {i}");
        assert_eq!(line.end.as_ref().unwrap().counts.events, counts.events, "variant {i}");
        // The run of 19 periods ends with a cut of its last leap: the place there is that of the tolerance.
        let step = end - place(19e-3).0;
        assert!((line.figures[1] - step).abs() < 1e-6 * 0.5e-6, "variant {i}: {} {step}", line.figures[1]);
    }
}

#[test]
fn any_number_of_cores_tells_the_same() {
    let whole = p1();
    let tell = |cores: usize| {
        let mut batch = varied(&whole);
        let base: Vec<f64> = batch.numbers().collect();
        let lines = batch.on(cores).run(
            300,
            |i, numbers| {
                draw(&base, i, numbers);
                // Some are refused in each of the ways there are, and leave nothing behind for the next.
                match i % 50 {
                    7 => numbers[0] = -1.0,
                    17 => numbers[1] = -0.1,
                    27 => numbers[2] = f64::NAN,
                    37 => numbers[3] = f64::INFINITY,
                    _ => {}
                }
            },
            |_| true,
        );
        (lines.to_string(), lines)
    };
    let [(one, lines), (two, _), (three, _)] = [1, 2, 3].map(tell);
    assert_eq!(one, two);
    assert_eq!(one, three);
    let fault = |i: usize| lines.get(i).unwrap().end.as_ref().unwrap_err();
    assert!(matches!(fault(7), LineFault::Scene(_)), "{}", fault(7));
    assert!(matches!(fault(17), LineFault::Number { place: 1, .. }), "{}", fault(17));
    assert!(matches!(fault(27), LineFault::Scene(_)), "{}", fault(27));
    assert!(matches!(fault(37), LineFault::Waveform { place: 0, .. }), "{}", fault(37));
    assert_eq!(lines.iter().filter(|line| line.end.is_err()).count(), 24);
    assert!(lines.get(7).unwrap().figures.iter().all(|figure| figure.is_nan()));
}

/// Model, start, workspace and run of one variant after another, in a room that others of every kind of method have had before.
#[test]
fn a_room_knows_nothing_of_who_had_it_before() {
    let names = [
        "p1",
        "ruby_drive",
        "sine_drive",
        "oblique_impact",
        "three_ball_stage",
        "impact_drive",
        "bouncing_ball",
    ];
    let mut variants = Variants::new();
    for turn in 0..3 {
        for (k, name) in names.into_iter().enumerate() {
            let mut own = scenario(name, &[("run.stepper.event.tolerance", "1e-5")]);
            own.plan.duration = own.plan.duration.min(10e-3);
            let mass = own.scene.bodies.iter_mut().filter_map(|body| body.part.mass.as_mut());
            mass.for_each(|mass| *mass *= 1.0 + 0.01 * spread(turn + k, 3));
            let model = Model::new(&own.scene).unwrap();
            let mut state = model.start(&own.plan).unwrap();
            let alone = run(&model, &own.plan, &mut state, &mut ());
            let shared = variants.run(&own.scene, &own.plan, &mut ());
            assert_eq!(alone.is_ok(), shared.is_ok(), "{name}");
            assert_eq!(&model, variants.model(), "{name}");
            assert_eq!(&state, variants.state(), "{name}");
        }
    }
}

/// Allocations of so many variants, by masses, loads, friction and places at the start.
fn allocations(scene: &mut Scene, plan: &Plan, variants: &mut Variants, count: usize) -> u64 {
    let mut each = |i: usize| {
        let mass = scene.bodies.iter_mut().filter_map(|body| body.part.mass.as_mut());
        mass.for_each(|mass| *mass *= 1.0 + 1e-3 * spread(i, 2));
        let place = scene.bodies.iter_mut().filter(|body| body.part.is_free());
        place.for_each(|body| body.part.x.position += 1e-9 * spread(i, 3));
        let law = &mut scene.contacts[0].part.interface;
        law.set_friction(law.friction() * (1.0 + 1e-3 * spread(i, 5))).unwrap();
        variants.run(scene, plan, &mut ()).unwrap();
    };
    each(0);
    allocation_counter::measure(|| (1..=count).for_each(&mut each)).count_total
}

#[test]
fn variants_allocate_nothing() {
    for name in ["p1", "ruby_drive", "sine_drive"] {
        let Scenario { mut scene, mut plan, .. } = scenario(name, &[("run.stepper.event.tolerance", "1e-6")]);
        plan.duration = plan.duration.min(20e-3);
        let mut variants = Variants::new();
        assert_eq!(allocations(&mut scene, &plan, &mut variants, 20), 0, "{name}");
    }
}

/// In a batch a waveform that varies takes three allocations to be drawn; whatever else varies takes none.
#[test]
fn lines_allocate_nothing_but_their_waveforms() {
    let whole = p1();
    let count = |count: usize, waveform: bool| {
        let mut batch = varied(&whole);
        let base: Vec<f64> = batch.numbers().collect();
        let number = |i: usize, numbers: &mut [f64]| {
            draw(&base, i, numbers);
            if !waveform {
                numbers[3] = base[3];
            }
        };
        batch.on(1);
        allocation_counter::measure(|| drop(batch.run(count, number, |_| true))).count_total
    };
    assert_eq!(count(10, false), count(110, false));
    assert_eq!(count(110, true) - count(10, true), 300);
}

/// Whoever watches may stop a batch; what was not run says so.
#[test]
fn a_batch_that_is_stopped_keeps_its_lines() {
    let whole = p1();
    let mut batch = varied(&whole);
    let asked = AtomicUsize::new(0);
    let lines = batch.on(1).run(
        200,
        |_, _| {
            asked.fetch_add(1, Ordering::Relaxed);
        },
        |done| done < 64,
    );
    let run = lines.iter().filter(|line| line.end.is_ok()).count();
    assert_eq!((run, asked.into_inner()), (64, 64));
    assert!(lines.iter().skip(64).all(|line| matches!(line.end, Err(LineFault::NotRun))));
}

/// Every number that can vary is the one that the file sets under the same key.
#[test]
fn numbers_are_those_of_the_file() {
    let keys: [(&str, &[&str]); 4] = [
        ("p1", &["bodies.slider.mass", "contacts.ball.friction", "contacts.ball.normal.force"]),
        (
            "p1",
            &["waveforms.drive.sawtooth.stroke", "waveforms.drive.sawtooth.period", "bodies.slider.start.vx"],
        ),
        ("sine_drive", &["waveforms.drive.sine.amplitude", "bodies.slider.start.x"]),
        ("piezo_stack", &["actuators.stack.stiffness", "actuators.stack.damping"]),
    ];
    for (name, paths) in keys {
        for path in paths {
            let own = scenario(name, &[(path, "1.25e-3")]);
            let mut batch = Batch::of(&own).unwrap();
            batch.vary(path).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(batch.numbers().collect::<Vec<_>>(), [1.25e-3], "{name}: {path}");
        }
    }
}

#[test]
fn names_that_mean_nothing_are_refused() {
    let whole = p1();
    let mut batch = Batch::of(&whole).unwrap();
    for path in [
        "",
        "bodies.slyder.mass",
        "bodies.foot.mass",
        "contacts.ball.normal.radius",
        "run.duration",
        "loads[0].x",
    ] {
        assert!(batch.vary(path).is_err(), "{path}");
    }
    let unknown = batch.tell(Figure::End("slyder.x_m".to_owned())).unwrap_err();
    assert!(matches!(unknown, FigureError::Channel(..)));
    let step = Figure::Step { channel: "slider.x_m".to_owned(), waveform: 9 };
    assert_eq!(batch.tell(step).unwrap_err(), FigureError::Waveform(9));
}
