//! Rows of springs between events, against steps that know of none.

use std::path::Path;
use stickslip_run::Job;

/// x of the slider at the end, m.
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

/// Where a spring touches, a row that a force presses sinks slower from there on, and what had stuck may slip at once. That was decided by
/// how fast it had sunk before: below 1e-9 the slip began with the next guard, above it never did, and the slider ended 8e-13 m off.
/// The reference takes steps of 2 ns over all springs; it is within 4e-14 m.
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

/// Steps that ask the whole law which springs stick ask a little ahead, and what has begun to slip until there is taken off again: with
/// damping of 5 µs they were 9.4e-16 m off, however short. The reference is the event stepper's closed law of the branch.
#[test]
fn damping_by_the_whole_law_is_that_of_the_moment() {
    let located = x_at_the_end("damped_sine.json", r#"{"event": {"tolerance": 1e-12}}"#);
    let stepped = x_at_the_end("damped_sine.json", r#"{"rk4": {"step": "10 ns"}}"#);
    assert!((stepped - located).abs() < 2e-18, "{stepped:e} instead of {located:e}");
}
