//! Inputs that a caller supplies during a run.

use crate::held::finished;
use crate::lottery::on_rows;
use crate::parts::{FOOT_SLIDER, contact, event, foot_and_slider, named, sine, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Normal, Scene, Varying};
use stickslip_drive::{
    EventKind, InputError, Interpolation, Model, Plan, Run, RunError, Shape, Stepper, Timing, Trace, Waveform,
};

const PERIOD: f64 = 1e-3;

/// P1 with its sawtooth, or a supplied one.
fn dragged(shape: Shape) -> Scene {
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let mut drive = wave("drive", shape.clone(), PERIOD);
    if matches!(shape, Shape::Input { .. }) {
        drive.part = Waveform::new(shape, Timing::every(1.0)).unwrap();
    }
    foot_and_slider(drive, 0.02, ball)
}

fn input(interpolation: Interpolation) -> Shape {
    Shape::Input { initial: 0.0, range: (-1e-6, 1e-6), interpolation }
}

/// An input that is supplied piece by piece gives the rows and corners of the waveform, with identical bits.
#[test]
fn a_sawtooth_fed_as_an_input_is_the_sawtooth() {
    let (stroke, flyback) = (1e-6, 20e-6);
    let plan = Plan { every: Some(7e-6), ..event(1e-8, 4.0 * PERIOD) };
    let known = Model::new(&dragged(Shape::Sawtooth { stroke, flyback })).unwrap();
    let (_, rows) = finished(&known, &plan, known.start(&plan).unwrap(), false).unwrap();
    let model = Model::new(&dragged(input(Interpolation::Linear))).unwrap();
    let mut fed = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    let mut trace = Trace::new(&model);
    for k in 0..4 {
        let start = f64::from(k) * PERIOD;
        for (until, value) in [(start + (PERIOD - flyback), stroke), (start + PERIOD, 0.0)] {
            fed.lead(0, until, value).unwrap();
            fed.advance(until, &mut trace).unwrap();
        }
    }
    // The corner at the end requires the next piece.
    fed.lead(0, 5.0 * PERIOD, stroke).unwrap();
    fed.advance(4.0 * PERIOD + 1e-9, &mut trace).unwrap();
    assert_eq!(trace.rows().len(), rows.rows().len() - 1);
    assert!(trace.rows().zip(rows.rows()).all(|(a, b)| a == b));
    let corners =
        |trace: &Trace| -> Vec<_> { trace.events().map(|(event, after)| (*event, after.to_vec())).collect() };
    let (fed, known) = (corners(&trace), corners(&rows));
    assert_eq!(fed.len(), known.len());
    // The last corner differs: the waveform rises again.
    let last = 4.0 * PERIOD - 1e-9;
    assert!(fed.iter().zip(&known).filter(|(a, _)| a.0.t < last).all(|(a, b)| a == b));
    assert!(known.iter().any(|(event, _)| event.kind == EventKind::Corner));
}

/// A held input jumps in zero time and the energy balance closes. Holding the present value changes nothing.
#[test]
fn a_held_input_jumps_and_its_work_is_booked() {
    let model = Model::new(&dragged(input(Interpolation::Held))).unwrap();
    let plan = event(1e-9, PERIOD);
    let mut run = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    let mut trace = Trace::new(&model);
    for (k, value) in [0.0, 3e-8, 3e-8, -8e-8, 0.0].into_iter().enumerate() {
        run.hold(0, value).unwrap();
        run.advance((k + 1) as f64 * 5e-5, &mut trace).unwrap();
    }
    let jumps: Vec<f64> =
        trace.events().filter(|(e, _)| e.kind == EventKind::Jump).map(|(e, _)| e.t).collect();
    assert_eq!(jumps, [5e-5, 3.0 * 5e-5, 4.0 * 5e-5]);
    let mut row = Vec::new();
    run.row(&mut row);
    let of = |name: &str| row[model.channels().iter().position(|c| c.name == name).unwrap()];
    assert!(of("energy.friction_J") > 0.0 && of("energy.input_J") > 0.0);
    assert!(of("energy.error_J").abs() < 1e-8 * of("energy.input_J"), "{:e}", of("energy.error_J"));
}

#[test]
fn what_an_input_does_not_take_is_refused() {
    let plan = event(1e-9, PERIOD);
    let of = |interpolation| Model::new(&dragged(input(interpolation))).unwrap();
    let (held, linear) = (of(Interpolation::Held), of(Interpolation::Linear));
    let mut run = Run::new(&held, &plan, held.start(&plan).unwrap()).unwrap();
    assert_eq!(run.hold(1, 0.0), Err(InputError::NoInput(1)));
    assert_eq!(run.lead(0, 1.0, 0.0), Err(InputError::Interpolation { input: 0, is: Interpolation::Held }));
    for value in [f64::NAN, 2e-6, f64::INFINITY] {
        assert!(matches!(run.hold(0, value), Err(InputError::Range { input: 0, .. })));
    }
    run.advance(1e-4, &mut ()).unwrap();
    for until in [0.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(run.advance(until, &mut ()), Err(RunError::Backwards { .. })));
    }
    let mut run = Run::new(&linear, &plan, linear.start(&plan).unwrap()).unwrap();
    assert!(matches!(run.lead(0, 0.0, 0.0), Err(InputError::Time { input: 0, .. })));
    run.lead(0, 1e-4, 1e-7).unwrap();
    assert_eq!(
        run.advance(2e-4, &mut ()),
        Err(RunError::InputMissing { input: 0, known: 1e-4, until: 2e-4 })
    );
    run.lead(0, 2e-4, 0.0).unwrap();
    assert_eq!(run.lead(0, 3e-4, 0.0), Err(InputError::Occupied { input: 0, until: 2e-4 }));
    run.advance(2e-4, &mut ()).unwrap();
    assert!(matches!(run.finish(&mut ()), Err(RunError::InputMissing { .. })));
    let dopri5 = Plan { stepper: Stepper::Dopri5 { tolerance: 1e-6 }, ..plan };
    let held = Run::new(&linear, &dopri5, linear.start(&dopri5).unwrap());
    assert_eq!(held.err(), Some(RunError::NotHeld { stepper: "dopri5" }));
}

/// A row of springs under a supplied load agrees with the same load from a table.
#[test]
fn a_row_under_a_fed_load_is_the_row_under_its_table() {
    let corners: Vec<(f64, f64)> = (0..=40)
        .map(|k| (f64::from(k) * 1e-4, 1.0 + 0.4 * f64::from(k % 3) - 0.3 * f64::from(k % 2)))
        .collect();
    let of = |load: Shape| {
        let mut ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
        ball.normal = Normal::Force(Varying::Follows(1));
        let mut scene = foot_and_slider(wave("drive", sine(0.3e-6), PERIOD), 0.02, ball);
        let load = Waveform::new(load, Timing::every(1.0)).unwrap();
        scene.waveforms.push(named("load", load));
        Model::new(&on_rows(&scene, 64)).unwrap()
    };
    let plan = event(1e-8, 40.0 * 1e-4);
    let table = of(Shape::Table { points: corners.clone() });
    let (known, _) = finished(&table, &plan, table.start(&plan).unwrap(), false).unwrap();
    let model = of(Shape::Input { initial: 1.0, range: (0.5, 2.0), interpolation: Interpolation::Linear });
    let mut fed = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    for (until, load) in &corners[1..] {
        fed.lead(1, *until, *load).unwrap();
        fed.advance(*until, &mut ()).unwrap();
    }
    let [fed_x, known_x] = [(fed.state(), &model), (&known, &table)].map(|(s, m)| s.body(m, 1).unwrap().0);
    let unit = model.contact_natural(0).unwrap().displacement;
    let off = (fed_x - known_x).abs() / unit;
    println!(
        "{off:e} u_c, {} evaluations, table {}",
        fed.state().counts().evaluations,
        known.counts().evaluations
    );
    assert!(off < 1e-3, "{off:e}");
}
