//! Effects that must not change a run (output, repetition, interruption), and orderly errors.

use crate::lottery::deal;
use crate::parts::{
    FOOT_SLIDER, Looker, contact, damper, event, foot_and_slider, named, of_profile, p1, piezo, plan, push,
    sine, try_end, wave,
};
use proptest::{prelude::*, test_runner::RngSeed};
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Axis, Body, Contact, ContactStart, Coordinate, Direction, EngineChoice, Load, Normal, Point, Scene, Side,
    Spring, Varying,
};
use stickslip_drive::{
    Entry, Field, Limits, Model, Moments, Part, Plan, Record, RunError, SceneError, SceneFault, Shape, State,
    Stepper, Timing, Trace, Waveform, run,
};

const PERIOD: f64 = 1e-3;

fn steppers() -> [Stepper; 4] {
    [
        Stepper::Event { tolerance: 1e-8 },
        Stepper::Verlet { step: 1e-6 },
        Stepper::Rk4 { step: 3e-6 },
        Stepper::Dopri5 { tolerance: 1e-6 },
    ]
}

/// P1 and random models with the period of their drive, s.
fn scenes() -> Vec<(Scene, f64)> {
    let drawn = [0, 1, 2, 3, 11, 17].map(deal);
    drawn.into_iter().map(|d| (d.scene, d.period)).chain([(p1(), PERIOD)]).collect()
}

fn final_state(scene: &Scene, plan: &Plan, record: impl Fn(&Model) -> Box<dyn Record>) -> State {
    let model = Model::new(scene).unwrap();
    let mut state = model.start(plan).unwrap();
    run(&model, plan, &mut state, &mut *record(&model)).unwrap();
    state
}

/// Compares everything but counts, which may depend on output.
fn same(a: &State, b: &State, scene: &Scene) {
    let model = Model::new(scene).unwrap();
    let bits = |s: &State| -> Vec<u64> {
        let bodies = (0..scene.bodies.len()).filter_map(|i| s.body(&model, i));
        bodies.flat_map(|(x, v)| [x.to_bits(), v.to_bits()]).collect()
    };
    assert_eq!(bits(a), bits(b));
    assert_eq!(a.time().to_bits(), b.time().to_bits());
    assert_eq!(a.memories(), b.memories());
}

#[test]
fn output_never_changes_the_trajectory() {
    for (scene, period) in scenes() {
        for stepper in steppers() {
            let plan = plan(stepper, 2.3 * period);
            let silent = final_state(&scene, &plan, |_| Box::new(()));
            for parts in [7.0, 100.0, 200.0] {
                let plan = Plan { every: Some(period / parts), ..plan };
                let written = final_state(&scene, &plan, |model| Box::new(Trace::new(model)));
                same(&silent, &written, &scene);
                let quiet = final_state(&scene, &plan, |_| Box::new(()));
                same(&silent, &quiet, &scene);
            }
        }
    }
}

#[test]
fn output_leaves_no_trace_in_the_state() {
    for (scene, period) in scenes() {
        for stepper in steppers() {
            let plan = plan(stepper, 2.3 * period);
            let silent = final_state(&scene, &plan, |_| Box::new(()));
            let plan = Plan { every: Some(0.01 * period), ..plan };
            let written = final_state(&scene, &plan, |model| Box::new(Trace::new(model)));
            assert!(silent == written, "{stepper:?}: {:?} {:?}", silent.counts(), written.counts());
            let moments = || Moments::Every(0.013 * period);
            let seen = final_state(&scene, &plan, |_| Box::new(Looker::new(moments(), &plan)));
            assert!(silent == seen, "{stepper:?}: {:?} {:?}", silent.counts(), seen.counts());
        }
    }
}

#[test]
fn two_runs_give_the_same_bits() {
    for (scene, period) in scenes() {
        for stepper in steppers() {
            let plan = Plan { every: Some(0.01 * period), ..plan(stepper, 2.3 * period) };
            let runs = [(); 2].map(|()| {
                let model = Model::new(&scene).unwrap();
                let (mut state, mut trace) = (model.start(&plan).unwrap(), Trace::new(&model));
                run(&model, &plan, &mut state, &mut trace).unwrap();
                (state, trace)
            });
            assert!(runs[0] == runs[1], "{stepper:?}");
        }
    }
}

/// A run interrupted at a corner, where a step ends, and continued from a copy of its state.
#[test]
fn a_run_in_two_halves_is_one_run() {
    let scene = p1();
    let model = Model::new(&scene).unwrap();
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let (whole, half) = (event(tolerance, 10.0 * PERIOD), event(tolerance, 5.0 * PERIOD));
        let mut once = model.start(&whole).unwrap();
        run(&model, &whole, &mut once, &mut ()).unwrap();
        let mut first = model.start(&half).unwrap();
        run(&model, &half, &mut first, &mut ()).unwrap();
        let mut second = first.clone();
        run(&model, &whole, &mut second, &mut ()).unwrap();
        same(&once, &second, &scene);
        assert_ne!(first, second);
    }
}

/// After fixed steps a run with event location chooses laws anew and finds as many events. The slider on a sine is in its
/// periodic motion by then.
#[test]
fn after_fixed_steps_events_are_located_again() {
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let model = Model::new(&foot_and_slider(wave("drive", sine(0.5e-6), PERIOD), 0.02, ball)).unwrap();
    let (exact, step) = (Stepper::Event { tolerance: 1e-8 }, 1e-6);
    // Events up to 3.3, 6.3 and 9.3 periods; the second part uses another stepper.
    let events = |between: Stepper| {
        let mut state = model.start(&plan(exact, PERIOD)).unwrap();
        [(exact, 3.3), (between, 6.3), (exact, 9.3)].map(|(stepper, periods)| {
            let before = state.counts().events;
            run(&model, &plan(stepper, periods * PERIOD), &mut state, &mut ()).unwrap();
            state.counts().events - before
        })
    };
    let known = events(exact);
    for between in [Stepper::Verlet { step }, Stepper::Rk4 { step }, Stepper::Dopri5 { tolerance: 1e-6 }] {
        let found = events(between);
        assert!(found[1] == 0 && found[2].abs_diff(known[2]) <= 1, "{between:?}: {found:?} {known:?}");
    }
}

#[test]
fn a_short_first_part_does_not_slow_down_the_rest() {
    let scene = p1();
    let model = Model::new(&scene).unwrap();
    let (short, long) = (event(1e-8, 1e-7), event(1e-8, 10.0 * PERIOD));
    let mut once = model.start(&long).unwrap();
    run(&model, &long, &mut once, &mut ()).unwrap();
    let mut parts = model.start(&short).unwrap();
    run(&model, &short, &mut parts, &mut ()).unwrap();
    run(&model, &long, &mut parts, &mut ()).unwrap();
    assert!(parts.counts().steps < 2 * once.counts().steps);
}

#[test]
fn limits_stop_a_run_with_a_typed_error_and_keep_what_was_computed() {
    for stepper in steppers() {
        let free_plan = plan(stepper, 20.0 * PERIOD);
        let steps = Plan { limits: Limits { steps: 100, ..Limits::default() }, ..free_plan };
        let model = Model::new(&p1()).unwrap();
        let (mut state, mut trace) = (model.start(&steps).unwrap(), Trace::new(&model));
        let error = run(&model, &steps, &mut state, &mut trace).unwrap_err();
        assert!(
            matches!(error, RunError::TooManySteps { limit: 100, t } if t > 0.0 && t < 20.0 * PERIOD),
            "{error:?}"
        );
        assert!(state.time() > 0.0 && state.counts().steps <= 100);
        // The last row is at the time of the stop.
        assert_eq!(trace.rows().last().unwrap()[0], state.time());
        let Err(error) = try_end(
            &p1(),
            &Plan {
                limits: Limits { wall: Some(0.0), ..Limits::default() },
                duration: 400.0 * PERIOD,
                ..free_plan
            },
        ) else {
            panic!("{stepper:?}: a run of no wall time ended");
        };
        assert!(matches!(error, RunError::OutOfTime { .. }), "{error:?}");
        assert!(!error.to_string().is_empty() && !error.advice().is_empty());
    }
    let events = Limits { events: 10, ..Limits::default() };
    let Err(error) = try_end(&p1(), &Plan { limits: events, ..event(1e-8, 20.0 * PERIOD) }) else {
        panic!("no end")
    };
    assert!(matches!(error, RunError::TooManyEvents { limit: 10, .. }), "{error:?}");
}

/// Record that interrupts the run.
struct Enough;

impl Record for Enough {
    fn take(&mut self, _: Entry<'_>) {}

    fn goes_on(&mut self, t: f64) -> bool {
        t < 5.0 * PERIOD
    }
}

#[test]
fn a_record_can_interrupt_a_run() {
    for stepper in steppers() {
        let plan = plan(stepper, 400.0 * PERIOD);
        let model = Model::new(&p1()).unwrap();
        let mut state = model.start(&plan).unwrap();
        let error = run(&model, &plan, &mut state, &mut Enough).unwrap_err();
        assert!(matches!(error, RunError::Interrupted { t } if t >= 5.0 * PERIOD), "{error:?}");
    }
}

/// P1 with one fault.
fn broken(change: impl FnOnce(&mut Scene)) -> Result<Model, SceneError> {
    let mut scene = p1();
    change(&mut scene);
    Model::new(&scene)
}

fn jumping() -> Waveform {
    Waveform::new(Shape::Sawtooth { stroke: 1e-6, flyback: 0.0 }, Timing::every(PERIOD)).unwrap()
}

#[test]
fn errors_of_a_scene_name_the_field_that_is_wrong() {
    type Change = fn(&mut Scene);
    let cases: [((Part, Field), Change); 15] = [
        ((Part::Body(1), Field::Whole), |s| s.bodies[1].part.mass = None),
        ((Part::Body(1), Field::Mass), |s| s.bodies[1].part.mass = Some(0.0)),
        ((Part::Body(1), Field::Mass), |s| s.bodies[1].part.mass = Some(-1.0)),
        ((Part::Body(1), Field::Mass), |s| s.bodies[1].part.mass = Some(f64::NAN)),
        ((Part::Body(1), Field::Mass), |s| s.bodies[1].part.mass = Some(f64::INFINITY)),
        ((Part::Contact(0), Field::Between), |s| s.contacts[0].part.between = [Side::Ground, Side::Ground]),
        ((Part::Contact(0), Field::NormalForce), |s| {
            s.contacts[0].part.normal = Normal::Force(Varying::Constant(-1.0));
        }),
        ((Part::Contact(0), Field::NormalRadius), |s| {
            s.contacts[0].part = of_profile(Profile::flat(1e-4).unwrap(), &s.contacts[0].part);
            s.contacts[0].part.normal = Normal::Radius(Varying::Constant(1e-5));
        }),
        ((Part::Contact(0), Field::NormalForce), |s| {
            s.contacts[0].part = of_profile(Profile::sphere(1e-6).unwrap(), &s.contacts[0].part);
            s.contacts[0].part.normal = Normal::Force(Varying::Constant(100.0));
        }),
        ((Part::Contact(0), Field::SpringCount), |s| {
            s.contacts[0].part.engine = EngineChoice::Springs { count: 0, span: None };
        }),
        ((Part::Contact(0), Field::StartForce), |s| s.contacts[0].part.start = ContactStart::Force(0.2)),
        // P1 has μF_N = 0.15 N and slips at this force.
        ((Part::Contact(0), Field::StartForce), |s| s.contacts[0].part.start = ContactStart::Force(-0.15)),
        ((Part::Actuator(0), Field::Stiffness), |s| {
            s.actuators
                .push(named("stack", piezo([Side::Ground, Side::Body(1)], 0.0, Varying::Constant(1e-6))));
        }),
        ((Part::Spring(0), Field::Between), |s| {
            s.springs.push(named("tie", damper([Side::Body(1), Side::Body(1)], 1.0)));
        }),
        ((Part::Body(0), Field::Mass), |s| s.bodies[0].part.mass = Some(0.0)),
    ];
    for (place, change) in cases {
        let error = broken(change).unwrap_err();
        assert_eq!((error.part, error.field), place, "{error}");
        assert!(!error.fault.to_string().is_empty());
    }
}

#[test]
fn jumps_are_refused_where_nothing_can_follow_them() {
    let mut scene = p1();
    scene.waveforms[0].part = jumping();
    let model = Model::new(&scene).unwrap();
    let error = model.start(&plan(Stepper::Dopri5 { tolerance: 1e-6 }, PERIOD)).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Stepper));
    scene.springs.push(named("drag", damper([Side::Body(0), Side::Body(1)], 1.0)));
    let error = Model::new(&scene).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Spring(0), Field::Damping));
    assert_eq!(error.fault, SceneFault::DampedJump("drive".to_owned()), "{error}");
}

#[test]
fn places_that_do_not_exist_are_refused() {
    type Change = fn(&mut Scene);
    let nowhere = Side::Body(7);
    assert!(broken(|s| s.contacts[0].part.between = [nowhere, Side::Ground]).is_err());
    let cases: [Change; 5] = [
        |s| s.bodies[0].part.x = Coordinate::follows(7),
        |s| s.contacts[0].part.normal = Normal::Force(Varying::Follows(7)),
        |s| s.loads.push(push(7, 1.0)),
        |s| s.loads.push(Load { on: 1, x: Varying::Follows(7), ..Load::default() }),
        |s| s.springs.push(named("tie", damper([Side::Ground, Side::Body(7)], 1.0))),
    ];
    for change in cases {
        assert!(broken(change).is_err());
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    type Change = fn(&mut Scene);
    let cases: [((Part, Field), Change); 14] = [
        ((Part::Contact(0), Field::Count), |s| s.contacts[0].part.count = 0),
        ((Part::Contact(0), Field::NormalForce), |s| {
            s.contacts[0].part.normal = Normal::Force(Varying::Constant(f64::NAN));
        }),
        ((Part::Contact(0), Field::NormalForce), |s| {
            s.contacts[0].part.normal = Normal::Force(Varying::Constant(f64::INFINITY));
        }),
        ((Part::Contact(0), Field::NormalIndentation), |s| {
            s.contacts[0].part.normal = Normal::Indentation(Varying::Constant(f64::NAN));
        }),
        ((Part::Contact(0), Field::StartDisplacement), |s| {
            s.contacts[0].part.start = ContactStart::Displacement(f64::NAN);
        }),
        ((Part::Body(1), Field::Position(Axis::X)), |s| s.bodies[1].part.x.position = f64::NAN),
        ((Part::Body(1), Field::Velocity(Axis::X)), |s| s.bodies[1].part.x.velocity = f64::INFINITY),
        ((Part::Load(0), Field::Component(Axis::X)), |s| s.loads.push(push(1, f64::NAN))),
        ((Part::Gravity, Field::Acceleration), |s| s.gravity.acceleration = f64::NAN),
        ((Part::Spring(0), Field::Damping), |s| {
            s.springs.push(named("tie", damper([Side::Ground, Side::Body(1)], f64::NAN)));
        }),
        ((Part::Spring(0), Field::Damping), |s| {
            s.springs.push(named("tie", damper([Side::Ground, Side::Body(1)], -1.0)));
        }),
        ((Part::Spring(0), Field::Stiffness), |s| {
            s.springs
                .push(named("tie", Spring { stiffness: -1.0, ..damper([Side::Ground, Side::Body(1)], 0.0) }));
        }),
        ((Part::Spring(0), Field::Preload), |s| {
            s.springs.push(named(
                "tie",
                Spring { preload: f64::NAN, ..damper([Side::Ground, Side::Body(1)], 0.0) },
            ));
        }),
        ((Part::Gravity, Field::Incline), |s| s.gravity.incline = f64::INFINITY),
    ];
    for (place, change) in cases {
        match broken(change) {
            Ok(_) => panic!("{place:?}: taken"),
            Err(error) => assert_eq!((error.part, error.field), place, "{error}"),
        }
    }
}

#[test]
fn plans_out_of_range_are_refused() {
    let good = event(1e-6, PERIOD);
    let model = Model::new(&p1()).unwrap();
    for bad in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        let plans = [
            ((Part::Run, Field::Duration), Plan { duration: bad, ..good }),
            ((Part::Run, Field::Interval), Plan { every: Some(bad), ..good }),
            ((Part::Run, Field::Tolerance), event(bad, PERIOD)),
            ((Part::Run, Field::Step), plan(Stepper::Verlet { step: bad }, PERIOD)),
            ((Part::Run, Field::Step), plan(Stepper::Rk4 { step: bad }, PERIOD)),
            ((Part::Run, Field::Tolerance), plan(Stepper::Dopri5 { tolerance: bad }, PERIOD)),
        ];
        for (place, plan) in plans {
            match model.start(&plan) {
                Ok(_) => panic!("{place:?} = {bad}: taken"),
                Err(error) => assert_eq!((error.part, error.field), place, "{error}"),
            }
        }
    }
}

/// Random models with varying normal force, selected from thousands.
#[test]
fn shrinking_contacts_do_not_chatter() {
    for seed in [1_447_917_947, 2_067_624_281, 2_770_423_175, 2_168_180_231] {
        let drawn = deal(seed);
        let outcome = try_end(&drawn.scene, &event(1e-8, drawn.period));
        assert!(outcome.is_ok(), "{}: {:?}", drawn.title, outcome.err());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn drawn_scenes_end_or_stop_in_an_orderly_way(seed in any::<u32>(), which in 0_usize..4) {
        let drawn = deal(u64::from(seed));
        let limits = Limits { steps: 3_000, events: 3_000, wall: Some(60.0) };
        let plan = Plan { limits, every: Some(0.1 * drawn.period), ..plan(steppers()[which], drawn.period) };
        let model = Model::new(&drawn.scene).unwrap();
        let (mut state, mut trace) = (model.start(&plan).unwrap(), Trace::new(&model));
        match run(&model, &plan, &mut state, &mut trace) {
            Ok(()) => prop_assert_eq!(state.time(), plan.duration),
            Err(RunError::TooManySteps { .. }) => prop_assert!(state.time() < plan.duration),
            Err(error) => prop_assert!(false, "{error}"),
        }
        prop_assert!(trace.rows().flatten().all(|x| x.is_finite()));
    }
}

/// Parts without effect do not change any bit or count: a contact that never closes, a spring and a stack between bodies at rest,
/// an unused waveform.
#[test]
fn what_cannot_act_changes_nothing() {
    let plain = p1();
    let mut scene = p1();
    let triangle = Waveform::new(Shape::Triangle { stroke: 2e-6 }, Timing::every(1.0)).unwrap();
    // It has no corner within the run.
    scene.waveforms.push(named("lift", triangle.clone()));
    scene.waveforms.push(named("nobody's", triangle));
    scene.bodies.push(named("lid", Body { z: Coordinate::follows(1), ..Body::default() }));
    scene.bodies.push(named("rail", Body::default()));
    let apart = Contact {
        between: [Side::Body(2), Side::Body(1)],
        normal: Normal::Coupled,
        gap: 2.1e-6,
        ..scene.contacts[0].part.clone()
    };
    scene.contacts.push(named("far", apart));
    let still = [Side::Ground, Side::Body(3)];
    let direction = Direction::X;
    let at = [Point::default(); 2];
    let spring = Spring { between: still, at, direction, stiffness: 1e6, damping: 1.0, preload: 2.0 };
    scene.springs.push(named("idle", spring));
    scene.actuators.push(named("stack", piezo(still, 1e6, Varying::Constant(1e-6))));
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let plan = event(tolerance, 10.0 * PERIOD);
        let [alone, among] = [&plain, &scene].map(|scene| {
            let model = Model::new(scene).unwrap();
            let mut state = model.start(&plan).unwrap();
            run(&model, &plan, &mut state, &mut ()).unwrap();
            (state.body(&model, 1), state.counts(), state.memories()[0].clone())
        });
        assert_eq!(alone, among, "{tolerance:e}");
    }
}
