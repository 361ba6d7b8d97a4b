//! Runs that end when the steps of their drive are constant.

use crate::lottery::deal;
use crate::parts::{
    FOOT_SLIDER, channel, contact, event, foot_and_slider, named, p1, plan, push, sine, wave,
};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Load, Scene, Varying};
use stickslip_drive::{Model, Plan, Shape, State, Stepper, Timing, Trace, UntilSteady, Waveform, run};

const PERIOD: f64 = 1e-3;

fn until_steady(plan: Plan, change: f64) -> Plan {
    Plan { until_steady: Some(UntilSteady { waveform: 0, body: 1, change }), ..plan }
}

fn recorded(scene: &Scene, plan: &Plan) -> (Model, State, Trace) {
    let model = Model::new(scene).unwrap();
    let (mut state, mut trace) = (model.start(plan).unwrap(), Trace::new(&model));
    run(&model, plan, &mut state, &mut trace).unwrap();
    (model, state, trace)
}

/// Whether two runs have equal results and counts, except for their knowledge of steps.
fn came_to_the_same((model, one): (&Model, &State), other: &State) -> bool {
    (one.time(), one.body(model, 1), one.counts()) == (other.time(), other.body(model, 1), other.counts())
        && (one.tally(), one.memories()) == (other.tally(), other.memories())
}

/// Step lengths of the slider, from rows at the ends of periods.
fn steps(model: &Model, trace: &Trace) -> Vec<f64> {
    let x = channel(model, "slider.x_m");
    let places: Vec<f64> = trace.column(x).collect();
    places.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Sine that moves a slider under a load: its periods do not end with corners.
fn shaken() -> Scene {
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let scene = foot_and_slider(wave("drive", sine(1e-6), PERIOD), 0.02, ball);
    Scene { loads: vec![push(1, -0.05)], ..scene }
}

#[test]
fn p1_ends_with_the_period_that_its_reference_steps_say() {
    let data: serde_json::Value = serde_json::from_str(include_str!("../data/drive_p1.json")).unwrap();
    let known = data["steps_nm_first_eight"].as_array().unwrap();
    let known: Vec<f64> = known.iter().map(|step| 1e-9 * step.as_f64().unwrap()).collect();
    for change in [1e-2, 1e-4, 1e-6, 1e-7] {
        let agrees = |k: usize| (known[k] - known[k - 1]).abs() <= change * known[k];
        // Periods are counted from 1: period k + 1 ends with known[k].
        let last = (3..known.len()).find(|&k| (k - 2..=k).all(agrees)).unwrap() + 1;
        let asked = Plan { every: Some(PERIOD), ..until_steady(event(1e-10, 1000.0 * PERIOD), change) };
        let (model, state, trace) = recorded(&p1(), &asked);
        assert_eq!(state.time(), last as f64 * PERIOD, "{change:e}");
        let found = steps(&model, &trace);
        assert_eq!(found.len(), last);
        for (step, known) in found.iter().zip(&known) {
            assert!((step - known).abs() < 1e-9 * known, "{change:e}: {step:e}");
        }
        println!("P1 with changes of {change:e}: ends after {last} periods");
    }
}

/// At a corner a step ends anyway: an early end equals a shorter run, including counts.
#[test]
fn an_early_end_at_a_corner_is_a_shorter_run() {
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let (model, early, _) = recorded(&p1(), &until_steady(event(tolerance, 1000.0 * PERIOD), 1e-6));
        let (_, short, _) = recorded(&p1(), &event(tolerance, early.time()));
        assert!(came_to_the_same((&model, &early), &short), "{tolerance:e}");
        let from = early.clone();
        let (mut on, mut once) = (from, model.start(&event(tolerance, 20.0 * PERIOD)).unwrap());
        for state in [&mut on, &mut once] {
            run(&model, &event(tolerance, 20.0 * PERIOD), state, &mut ()).unwrap();
        }
        assert_eq!(on.body(&model, 1), once.body(&model, 1), "{tolerance:e}");
    }
}

#[test]
fn until_its_end_the_run_is_the_longer_one_to_the_last_bit() {
    let drawn = [0, 1, 2, 3, 11, 17].map(|seed| (deal(seed).scene, deal(seed).period));
    let steppers = [
        Stepper::Event { tolerance: 1e-8 },
        Stepper::Verlet { step: 0.7e-6 },
        Stepper::Rk4 { step: 3e-6 },
        Stepper::Dopri5 { tolerance: 1e-6 },
    ];
    let mut early = [0; 4];
    for (scene, period) in drawn.into_iter().chain([(p1(), PERIOD), (shaken(), PERIOD)]) {
        for (stepper, early) in steppers.into_iter().zip(&mut early) {
            // Interval that sometimes meets the ends of periods.
            let long = Plan { every: Some(0.15 * period), ..plan(stepper, 24.3 * period) };
            let (_, _, whole) = recorded(&scene, &long);
            let (_, state, part) = recorded(&scene, &until_steady(long, 1e-2));
            let count = part.rows().len();
            let is_early = state.time() < long.duration;
            *early += u32::from(is_early);
            for (k, (a, b)) in part.rows().zip(whole.rows()).enumerate().take(count - usize::from(is_early)) {
                assert!(
                    a.iter().map(|a| a.to_bits()).eq(b.iter().map(|b| b.to_bits())),
                    "{stepper:?}: row {k}"
                );
            }
            let before = |trace: &Trace| -> Vec<_> {
                let kept = trace.events().filter(|(event, _)| event.t < state.time());
                kept.map(|(event, row)| (*event, row.to_vec())).collect()
            };
            assert!(before(&part) == before(&whole), "{stepper:?}");
            assert!(part.events().all(|(event, _)| event.t <= state.time()));
            let times: Vec<f64> = part.column(0).collect();
            assert_eq!(times.last(), Some(&state.time()));
            assert!(times.windows(2).all(|pair| pair[1] - pair[0] > 1e-9 * period), "{stepper:?}");
        }
    }
    assert!(early.iter().all(|early| *early >= 2), "{early:?}");
}

#[test]
fn periods_without_a_corner_end_on_the_dense_output() {
    // Without the reference method, whose interpolation between long steps has errors of 1 %.
    for (stepper, within) in [
        (Stepper::Event { tolerance: 1e-10 }, 1e-9),
        (Stepper::Verlet { step: 0.3e-6 }, 1e-5),
        (Stepper::Rk4 { step: 0.3e-6 }, 1e-5),
    ] {
        let long = plan(stepper, 200.0 * PERIOD);
        let (model, early, trace) = recorded(&shaken(), &until_steady(long, 1e-5));
        let periods = early.time() / PERIOD;
        assert!((4.0..100.0).contains(&periods) && (periods - periods.round()).abs() < 1e-12, "{periods}");
        // Another run with rows at the ends of periods.
        let asked = Plan { every: Some(PERIOD), ..plan(Stepper::Event { tolerance: 1e-12 }, early.time()) };
        let (_, other, rows) = recorded(&shaken(), &asked);
        let (x, exact) = (early.body(&model, 1).unwrap().0, other.body(&model, 1).unwrap().0);
        println!("{stepper:?}: {periods} periods, {:e} off", x / exact - 1.0);
        assert!((x / exact - 1.0).abs() < within, "{stepper:?}: {x:e} {exact:e}");
        let last = &steps(&model, &rows)[periods.round() as usize - 4..];
        assert!(last.windows(2).all(|pair| (pair[1] / pair[0] - 1.0).abs() < 2e-5), "{stepper:?}: {last:?}");
        // The energies are those of a run that ends there.
        let books = trace.rows().last().unwrap();
        let (input, error) =
            (books[channel(&model, "energy.input_J")], books[channel(&model, "energy.error_J")]);
        assert!(error.abs() < 1e-3 * input.abs(), "{stepper:?}: {error:e} of {input:e}");
    }
}

/// A load of another period makes every step different.
#[test]
fn a_drive_that_never_settles_runs_to_its_end() {
    let mut scene = p1();
    scene.waveforms.push(wave("wind", sine(0.05), 1.37 * PERIOD));
    scene.loads.push(Load { on: 1, x: Varying::Follows(1), ..Load::default() });
    let long = event(1e-8, 40.0 * PERIOD);
    let (model, state, _) = recorded(&scene, &until_steady(long, 1e-3));
    assert!(came_to_the_same((&model, &state), &recorded(&scene, &long).1));
}

/// A drive below its zero-step stroke comes to rest: steps of zero length are constant, too.
#[test]
fn steps_of_nothing_are_as_long_as_each_other() {
    let mut scene = p1();
    let shape = Shape::Sawtooth { stroke: 1e-8, flyback: 0.1e-3 };
    let spring = crate::parts::damper(
        [stickslip_drive::scene::Side::Ground, stickslip_drive::scene::Side::Body(1)],
        40.0,
    );
    scene.springs.push(named("oil", spring));
    scene.waveforms[0] = wave("drive", shape, PERIOD);
    let (_, state, _) = recorded(&scene, &until_steady(event(1e-8, 1000.0 * PERIOD), 1e-6));
    println!("at rest after {} periods", state.time() / PERIOD);
    assert!(state.time() < 100.0 * PERIOD);
}

/// Steps count from the waveform's delay to its last cycle.
#[test]
fn delay_and_cycles_bound_the_steps() {
    let saw = |timing| Waveform::new(Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 }, timing).unwrap();
    let mut scene = p1();
    let delayed = Timing { delay: 2.5 * PERIOD, ..Timing::every(PERIOD) };
    scene.waveforms[0].part = saw(delayed);
    let (_, state, _) = recorded(&scene, &until_steady(event(1e-8, 1000.0 * PERIOD), 1e-6));
    assert!((state.time() - 9.5 * PERIOD).abs() < 1e-12 * PERIOD, "{:e}", state.time());
    scene.waveforms[0].part = saw(Timing { cycles: Some(6.0), ..delayed });
    let (_, state, _) = recorded(&scene, &until_steady(event(1e-8, 30.0 * PERIOD), 1e-6));
    assert_eq!(state.time(), 30.0 * PERIOD);
}

#[test]
fn what_makes_no_steps_never_ends_early() {
    let long = event(1e-8, 20.0 * PERIOD);
    for asked in [(7, 1), (0, 0), (0, 7)] {
        let until_steady = Some(UntilSteady { waveform: asked.0, body: asked.1, change: 0.1 });
        let (_, state, _) = recorded(&p1(), &Plan { until_steady, ..long });
        assert_eq!(state.time(), long.duration, "{asked:?}");
    }
}
