//! Models whose events accumulate in time. They must run to their end and agree with fixed time steps.
//!
//! * `ball_at_rest`: a ball placed on the ground with its weight only. At a reversal its contact neither slips nor sticks.
//! * `lift_off_and_touch`: a flat foot that opens and closes within the last bit of time.
//! * `flat_damped`: a damped contact moved back under a decreasing load, at the boundary between stick and slip.
//! * `back_and_forth`: a shrinking contact whose state crosses its old memory curve twice within a hundredth of a period.
//! * `hang`: a touch at t = 1e-20 s.
//! * `behind_a_driver`, `rests_behind_a_driver`: similar models with a driver on the stack.
//! * `walk_damped_heights`: prescribed motion of damped springs with a flyback of a nanosecond.
//! * `walk_overloaded`: a load that exceeds the friction limit, at a tolerance near rounding.

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

/// Returns the final positions of all bodies along x and z, relative to the natural displacement of the first contact.
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

/// Compares with the classical Runge–Kutta method at two time steps, whose difference estimates its error.
///
/// The deviation must be below `within` tolerances.
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
    // It bounces to an indentation of 30 nm, four times its u_c.
    against_fixed_steps("ball_at_rest", ["40 ns", "20 ns"], &[1e-4, 1e-6, 1e-8, 1e-10, 1e-12], 1e3);
}

#[test]
fn a_foot_that_opens_in_the_last_bit_of_time_is_open() {
    against_fixed_steps("lift_off_and_touch", ["40 ns", "20 ns"], &[1e-4, 1e-6, 1e-8, 1e-10, 1e-12], 1e3);
}

/// Stick and slip alternate at the boundary. The detour steps use the average motion.
#[test]
fn a_damped_contact_slides_along_the_line_between_stick_and_slip() {
    against_fixed_steps("flat_damped", ["20 ns", "10 ns"], &[1e-3, 1e-4, 1e-6, 1e-8, 1e-10], 100.0);
}

/// Both edges of the stick area are at rest where the ball reverses. This is one event, not two alternating ones.
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

/// At 1e-6 the old memory curve is too coarse to be crossed twice, because it consists of straight segments.
#[test]
fn an_apex_that_crosses_its_old_curve_back_and_forth_is_seen() {
    against_fixed_steps("back_and_forth", ["200 ns", "100 ns"], &[1e-7, 1e-8, 1e-10, 1e-12], 100.0);
}

/// A driver must not cause many detours at these tolerances. Without one, five of six masses that differ by 2e-15 need one detour at
/// 1e-5 or 1e-6.
#[test]
fn a_scene_with_a_driver_needs_few_detours() {
    let places_at = |tolerance: f64| {
        let (job, outcome) = event("behind_a_driver", tolerance);
        (places(&job, &outcome.state), outcome.state.counts().detours)
    };
    // Classical Runge-Kutta at 5 us is 1.5e-5 off it, at 10 us 5e-4.
    let (finest, _) = places_at(1e-9);
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6] {
        let (now, detours) = places_at(tolerance);
        let off = off(&now, &finest);
        println!("behind_a_driver at {tolerance:e}: {off:.2e} u_c off, {detours} detours");
        assert!(detours <= 3 && off < 10.0 * tolerance, "{tolerance:e}: {off:e}, {detours} detours");
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
