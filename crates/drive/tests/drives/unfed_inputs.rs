//! Inputs without a caller: a run uses the initial value, the model checks the range.

use crate::parts::{FOOT_SLIDER, column, damped, damper, free, named, p1, piezo, plan, trace, wave};
use stickslip_contact::FirstLoadingError;
use stickslip_drive::scene::{Normal, Scene, Side, Varying};
use stickslip_drive::{Field, Interpolation, Model, Part, SceneError, SceneFault, Shape, Stepper};

const PERIOD: f64 = 1e-3;

fn input(initial: f64, range: (f64, f64), interpolation: Interpolation) -> Shape {
    Shape::Input { initial, range, interpolation }
}

/// P1 with an input instead of its sawtooth.
fn driven_by(shape: Shape) -> Scene {
    let mut scene = p1();
    scene.waveforms[0] = wave("drive", shape, PERIOD);
    scene
}

/// Mass on a stack with the stroke s from t = 0: x = s (1 - cos ωt), ω² = k/m.
#[test]
fn a_mass_on_a_stack_swings_about_the_initial_stroke() {
    let (mass, stiffness, stroke, duration) = (0.02, 2e4, 3e-7, 10e-3);
    let turn = f64::sqrt(stiffness / mass);
    let steppers = [
        Stepper::Event { tolerance: 1e-9 },
        Stepper::Verlet { step: 1e-6 },
        Stepper::Rk4 { step: 3e-6 },
        Stepper::Dopri5 { tolerance: 1e-9 },
    ];
    for stepper in steppers {
        let mut scene = Scene {
            waveforms: vec![wave("stroke", input(stroke, (-1e-6, 1e-6), Interpolation::Linear), PERIOD)],
            bodies: vec![named("stage", free(mass))],
            ..Scene::default()
        };
        let between = [Side::Ground, Side::Body(0)];
        scene.actuators.push(named("stack", piezo(between, stiffness, Varying::Follows(0))));
        let (model, _, rows) = trace(&scene, &plan(stepper, duration), 1e-4);
        let (times, places) = (column(&model, &rows, "time_s"), column(&model, &rows, "stage.x_m"));
        assert_eq!(times.len(), 101);
        for (t, x) in times.into_iter().zip(places) {
            let expected = stroke * (1.0 - (turn * t).cos());
            assert!((x - expected).abs() < 2e-6 * stroke, "{stepper:?}: {x} at {t}, not {expected}");
        }
    }
}

/// A table with a single value gives the same motion.
#[test]
fn a_foot_on_an_unfed_input_stays_where_a_table_holds_it() {
    let run = |shape: Shape| {
        let mut scene = driven_by(shape);
        scene.bodies[1].part.x.velocity = 1e-4;
        let plan = plan(Stepper::Event { tolerance: 1e-8 }, 3.0 * PERIOD);
        let (model, _, rows) = trace(&scene, &plan, 1e-5);
        assert!(column(&model, &rows, "foot.x_m").iter().all(|x| *x == 2e-7));
        // The slider moves.
        assert!(column(&model, &rows, "slider.x_m").iter().any(|x| *x > 1e-9));
        let channels = 0..model.channels().len();
        channels.map(|place| rows.column(place).map(f64::to_bits).collect()).collect::<Vec<Vec<u64>>>()
    };
    let held = run(Shape::Table { points: vec![(0.0, 2e-7)] });
    for interpolation in [Interpolation::Held, Interpolation::Linear] {
        assert_eq!(run(input(2e-7, (0.0, 5e-7), interpolation)), held);
    }
}

/// The possible values count, not the initial one: dampers refuse held inputs and follow linear ones.
#[test]
fn a_damper_refuses_what_may_jump_and_follows_what_is_straight() {
    let refusal = |shape: Shape, change: fn(&mut Scene)| -> Option<SceneError> {
        let mut scene = driven_by(shape);
        change(&mut scene);
        Model::new(&scene).err()
    };
    let spring: fn(&mut Scene) = |s| s.springs.push(named("drag", damper(FOOT_SLIDER, 1.0)));
    let contact: fn(&mut Scene) = |s| s.contacts[0].part = damped(&s.contacts[0].part, 1e-6);
    for (change, part) in [(spring, Part::Spring(0)), (contact, Part::Contact(0))] {
        let error = refusal(input(0.0, (0.0, 1e-9), Interpolation::Held), change).unwrap();
        assert_eq!((error.part, error.field), (part, Field::Damping));
        assert_eq!(error.fault, SceneFault::DampedJump("drive".to_owned()));
        assert_eq!(refusal(input(0.0, (0.0, 1e-9), Interpolation::Linear), change), None);
        // A range of one value allows no jump.
        assert_eq!(refusal(input(1e-9, (1e-9, 1e-9), Interpolation::Held), change), None);
    }
}

#[test]
fn the_reference_takes_an_input_that_is_straight_and_none_that_jumps() {
    let start = |interpolation, stepper| {
        let model = Model::new(&driven_by(input(0.0, (0.0, 1e-7), interpolation))).unwrap();
        model.start(&plan(stepper, PERIOD)).map(|_| ())
    };
    let [dopri5, rk4] = [Stepper::Dopri5 { tolerance: 1e-6 }, Stepper::Rk4 { step: 3e-6 }];
    assert_eq!(start(Interpolation::Held, dopri5).unwrap_err().fault, SceneFault::UnlocatedJump);
    assert_eq!(start(Interpolation::Linear, dopri5), Ok(()));
    assert_eq!(start(Interpolation::Held, rk4), Ok(()));
}

/// The range is checked before a run, even if the initial value is valid.
#[test]
fn a_contact_refuses_an_input_that_may_pull_it() {
    let refusal = |low: f64| {
        let mut scene = p1();
        scene.waveforms.push(wave("press", input(1.0, (low, 2.0), Interpolation::Linear), PERIOD));
        scene.contacts[0].part.normal = Normal::Force(Varying::Follows(1));
        Model::new(&scene).err()
    };
    let error = refusal(-0.25).unwrap();
    assert_eq!(error.part, Part::Contact(0));
    assert_eq!(error.fault, SceneFault::Loading(FirstLoadingError::NormalForce(-0.25)));
    assert_eq!(refusal(0.0), None);
}
