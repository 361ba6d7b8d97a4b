//! Rows of springs between events, against steps that know of none.

use std::path::Path;
use stickslip_results::Job;

/// x of the slider at the end, m.
fn ends_at(stepper: &str) -> f64 {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/springs_under_force.json");
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
