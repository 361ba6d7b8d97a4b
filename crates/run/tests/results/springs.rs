//! Spring rows between events, compared with time steps without events.

use std::path::Path;
use stickslip_run::Job;

/// Returns the final x of the slider, m.
fn ends_at(stepper: &str) -> f64 {
    x_at_the_end("springs_under_force.json", stepper)
}

fn x_at_the_end(name: &str, stepper: &str) -> f64 {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    let set = [("run.stepper".to_owned(), stepper.to_owned())];
    let job = Job::prepare(&file, &set, Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    outcome.state.body(&job.model, 1).unwrap().0
}

/// When a spring touches, a row under a force sinks more slowly, and sticking springs may slip at once.
///
/// The reference uses time steps of 2 ns over all springs and is accurate to 4e-14 m.
#[test]
fn springs_slip_by_how_a_row_sinks_after_a_spring_has_touched() {
    let stepped = ends_at(r#"{"rk4": {"step": "2 ns"}}"#);
    let located = |tolerance: &str| ends_at(&format!(r#"{{"event": {{"tolerance": {tolerance}}}}}"#));
    let finest = located("1e-12");
    assert!((finest - stepped).abs() < 1e-13, "{finest:e} instead of {stepped:e}");
    for tolerance in ["1e-6", "1e-7", "1e-8", "1e-9", "1e-10"] {
        let found = located(tolerance);
        assert!((found - finest).abs() < 1e-15, "{tolerance}: {found:e} instead of {finest:e}");
    }
}

/// The full force law of a damped contact uses the slip states at the time of evaluation.
///
/// The reference is the closed form of the branch in the event-driven integrator.
#[test]
fn damping_by_the_whole_law_is_that_of_the_moment() {
    let located = x_at_the_end("damped_sine.json", r#"{"event": {"tolerance": 1e-12}}"#);
    let stepped = x_at_the_end("damped_sine.json", r#"{"rk4": {"step": "10 ns"}}"#);
    assert!((stepped - located).abs() < 2e-18, "{stepped:e} instead of {located:e}");
}
