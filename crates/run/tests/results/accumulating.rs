//! Scenes whose events accumulate: they used to stop or to hang, and fixed steps run them through.
//!
//! * `ball_at_rest`: a ball set down without anything but its weight. Where it turns, its contact neither slides nor sticks: the
//!   same reversal fired for ever at one moment.
//! * `lift_off_and_touch`: a flat foot that opens and closes in the last bit of time.
//! * `flat_damped`: a damped contact dragged back under a falling load, along the line on which stick and slip take turns.
//! * `back_and_forth`: the apex of a shrinking contact goes across its old curve and back twice within a hundredth of a period. The
//!   second time was not seen in every other period, 3e-4 u_c at any tolerance.
//! * `hang`: a touch at t = 1e-20 s, after which steps of 1e-28 s followed one another.
//! * `behind_a_driver`, `rests_behind_a_driver`: the same as elsewhere, but with a driver on the stack: no detour was tried then.
//! * `walk_damped_heights`: nothing is free, and a flyback of a nanosecond; steps fell to last places of t where damped springs slip.
//! * `walk_overloaded`: a load that outgrows friction, at a tolerance near rounding: a step too small was told.

use std::path::Path;
use stickslip_drive::{RunError, State};
use stickslip_run::{Job, Outcome};

fn job(name: &str, stepper: &str) -> Job {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name).with_extension("json");
    let changes = [("run.stepper", stepper), ("run.limits", "{}")];
    let changes = changes.map(|(key, value)| (key.to_owned(), value.to_owned()));
    Job::prepare(&file, &changes, Path::new("")).unwrap()
}

fn event(name: &str, tolerance: f64) -> (Job, Outcome) {
    let job = job(name, &format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#));
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{name} at {tolerance:e}: {:?}", outcome.error);
    (job, outcome)
}

/// Places of all bodies along x and z at the end, in natural displacements of the first contact.
fn places(job: &Job, state: &State) -> Vec<f64> {
    use stickslip_drive::scene::Axis;
    let unit = job.model.contact_natural(0).unwrap().displacement;
    let bodies = 0..job.scenario.scene.bodies.len();
    let axes = |i: usize| [Axis::X, Axis::Z].map(|axis| state.coordinate(&job.model, i, axis));
    bodies.flat_map(axes).flatten().map(|(place, _)| place / unit).collect()
}

fn off(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}

/// Against classical Runge–Kutta at two steps, whose difference is its own error. Nothing in these scenes makes more of a change than it was:
/// where the local errors of all steps and events add up there is a tolerance for each, and never more than so many `within`.
fn against_fixed_steps(name: &str, steps: [&str; 2], tolerances: &[f64], within: f64) {
    let fixed = steps.map(|step| {
        let job = job(name, &format!(r#"{{"rk4": {{"step": "{step}"}}}}"#));
        let outcome = job.run(&());
        assert!(outcome.error.is_none(), "{name}, rk4: {:?}", outcome.error);
        places(&job, &outcome.state)
    });
    let own = off(&fixed[0], &fixed[1]);
    for &tolerance in tolerances {
        let (job, outcome) = event(name, tolerance);
        let off = off(&places(&job, &outcome.state), &fixed[1]);
        let counts = outcome.state.counts();
        println!("{name} at {tolerance:e}: {off:.2e} u_c off, rk4 {own:.2e}, {counts:?}");
        let within = within.min((counts.steps + counts.events) as f64);
        assert!(off <= within * tolerance + 3.0 * own, "{name} at {tolerance:e}: {off:e}, rk4 {own:e}");
    }
}

#[test]
fn a_ball_set_down_under_its_weight_alone_goes_on() {
    // It bounces 30 nm deep, which is four of its u_c.
    against_fixed_steps("ball_at_rest", ["40 ns", "20 ns"], &[1e-4, 1e-6, 1e-8, 1e-10, 1e-12], 1e3);
}

#[test]
fn a_foot_that_opens_in_the_last_bit_of_time_is_open() {
    against_fixed_steps("lift_off_and_touch", ["40 ns", "20 ns"], &[1e-4, 1e-6, 1e-8, 1e-10, 1e-12], 1e3);
}

/// Stick and slip take turns along the line: detours take what they come to on average.
#[test]
fn a_damped_contact_slides_along_the_line_between_stick_and_slip() {
    against_fixed_steps("flat_damped", ["20 ns", "10 ns"], &[1e-3, 1e-4, 1e-6, 1e-8, 1e-10], 100.0);
}

/// Both edges of a contact stand still where its ball turns: one event, and not two that chase each other.
#[test]
fn events_of_one_moment_are_one() {
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        for (name, most) in [("ball_at_rest", 4.0), ("lift_off_and_touch", 8.0), ("hang", 16.0)] {
            let (job, outcome) = event(name, tolerance);
            let counts = outcome.state.counts();
            let natural = job.model.contact_natural(0).unwrap();
            let swing = std::f64::consts::TAU * natural.displacement / natural.velocity;
            let swings = job.scenario.plan.duration / swing;
            println!("{name} at {tolerance:e}: {counts:?} in {swings:.0} swings");
            assert!(
                counts.detours == 0 && (counts.events as f64) < 20.0 + most * swings,
                "{name}: {counts:?}"
            );
        }
    }
}

#[test]
fn a_touch_at_the_very_start_does_not_hang() {
    against_fixed_steps("hang", ["10 ns", "5 ns"], &[1e-6, 1e-8, 1e-10, 1e-12], 100.0);
}

/// At 1e-6 the old curve is too coarse to be crossed twice: it is kept in straight pieces.
#[test]
fn an_apex_that_crosses_its_old_curve_back_and_forth_is_seen() {
    against_fixed_steps("back_and_forth", ["200 ns", "100 ns"], &[1e-7, 1e-8, 1e-10, 1e-12], 100.0);
}

/// Behind a driver whose voltage is off where steps are cut stick and slip push each other back, and took a detour or two at each of these
/// tolerances. Where it belongs five of six masses 2e-15 apart take one at 1e-5 or 1e-6, and none at the others.
#[test]
fn a_scene_with_a_driver_needs_no_detours() {
    let places_at = |tolerance: f64| {
        let (job, outcome) = event("behind_a_driver", tolerance);
        (places(&job, &outcome.state), outcome.state.counts().detours)
    };
    let mut all = 0;
    // Classical Runge-Kutta at 5 us is 1.5e-5 off it, at 10 us 5e-4.
    let (finest, _) = places_at(1e-9);
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6] {
        let (now, detours) = places_at(tolerance);
        let off = off(&now, &finest);
        println!("behind_a_driver at {tolerance:e}: {off:.2e} u_c off, {detours} detours");
        all += detours;
        assert!(all <= 1 && off < tolerance, "{tolerance:e}: {off:e}, {detours} detours");
    }
    against_fixed_steps("rests_behind_a_driver", ["10 us", "5 us"], &[1e-2, 1e-3, 1e-6], 100.0);
}

#[test]
fn a_walk_goes_on_where_damping_is_gone_at_once() {
    let finest = event("walk_damped_heights", 1e-12).1;
    for tolerance in [1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
        let (job, outcome) = event("walk_damped_heights", tolerance);
        assert_eq!(outcome.state.counts().detours, 0, "{tolerance:e}");
        assert!(off(&places(&job, &outcome.state), &places(&job, &finest.state)) < 1e-12);
    }
}

#[test]
fn an_overload_is_told_as_one_at_any_tolerance() {
    for tolerance in [1e-3, 1e-8, 1e-12, 1e-13] {
        let job = job("walk_overloaded", &format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#));
        let Some(RunError::Unbalanced { t, body, .. }) = job.run(&()).error else {
            panic!("{tolerance:e}: no overload is told");
        };
        assert!(body == "rig" && (t - 1.562_640_370_037_2e-6).abs() < 1e-18, "{tolerance:e}: {t:e}");
    }
}
