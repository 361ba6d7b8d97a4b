//! What a tolerance asks for is what comes: scenes whose errors or books did not follow it, or that stopped.
//!
//! * `set_down_on_a_cone`: a body grows into its contact in full stick. Its motion was right to a tolerance, and its books missed
//!   360 tolerances of 1e-12 and 4 600 of 1e-13, of which a user was warned.
//! * `faint_friction`: a body on two lists of heights, one with a friction of 1e-6. No tolerance below 1e-6 came to its end.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and shows what it measured"
)]

use serde_json::Value;
use std::path::Path;
use stickslip_drive::scene::Axis;
use stickslip_results::{Job, Outcome, Summary};

fn with(name: &str, sets: &[(&str, &str)]) -> (Job, Outcome) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name).with_extension("json");
    let sets: Vec<_> = sets.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    let job = Job::prepare(&file, &sets, Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{name}, {sets:?}: {:?}", outcome.error);
    (job, outcome)
}

fn run(name: &str, stepper: &str) -> (Job, Outcome) {
    with(name, &[("run.stepper", stepper)])
}

fn at(name: &str, tolerance: f64) -> (Job, Outcome) {
    run(name, &format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#))
}

/// Place of a body along x at the end, in u_c of a contact.
fn place((job, outcome): &(Job, Outcome), body: &str, contact: usize) -> f64 {
    let unit = job.model.contact_natural(contact).unwrap().displacement;
    let body = job.scenario.scene.bodies.iter().position(|named| named.name == body).unwrap();
    outcome.state.coordinate(&job.model, body, Axis::X).unwrap().0 / unit
}

/// Velocity Verlet on the same scene, which knows no event and no tolerance, at a step and half of it: Richardson's value, and
/// by how much it moved.
fn by_verlet(name: &str, body: &str, contact: usize, step: f64) -> (f64, f64) {
    let [coarse, fine] = [step, 0.5 * step]
        .map(|step| place(&run(name, &format!(r#"{{"verlet": {{"step": {step:e}}}}}"#)), body, contact));
    (fine + (fine - coarse) / 3.0, (fine - coarse).abs())
}

/// What a run's summary says of its energies, and whether it warns of them.
fn books((job, outcome): &(Job, Outcome)) -> (f64, bool) {
    let summary: Value = serde_json::from_str(&Summary::new(job, outcome).line().unwrap()).unwrap();
    let warnings = summary["warnings"].as_array().cloned().unwrap_or_default();
    let warned = warnings.iter().any(|warning| warning["kind"] == "energy_books");
    (summary["energy"]["largest_error_relative"].as_f64().unwrap(), warned)
}

/// Nothing but what the paths of growth leave out keeps the books of this body from closing: no damping, one bounce.
#[test]
fn books_of_growth_follow_the_tolerance() {
    let (reference, own) = by_verlet("set_down_on_a_cone", "ball", 0, 2e-5);
    for (tolerance, most) in [(1e-10, 50.0), (1e-11, 60.0), (1e-12, 150.0), (1e-13, 3000.0)] {
        let ran = at("set_down_on_a_cone", tolerance);
        let ((missed, warned), off) = (books(&ran), (place(&ran, "ball", 0) - reference).abs());
        println!("{tolerance:e}: books miss {missed:.1e}, {off:.1e} u_c from verlet's, {own:.1e}");
        assert!(missed < most * tolerance && !warned, "{tolerance:e}: {missed:e}, warned: {warned}");
        assert!(off < own.max(1e-9), "{tolerance:e}: {off:e}");
    }
}

#[test]
fn a_contact_without_friction_to_speak_of_does_not_stop_its_body() {
    let (reference, own) = by_verlet("faint_friction", "ball", 1, 1e-8);
    assert!(own < 1e-9, "{own:e}");
    for tolerance in [1e-3, 1e-6, 1e-8, 1e-10, 1e-12] {
        let ran = at("faint_friction", tolerance);
        let (counts, off) = (ran.1.state.counts(), (place(&ran, "ball", 1) - reference).abs());
        println!("{tolerance:e}: {off:.1e} u_c from verlet's, {own:.1e}, {counts:?}");
        assert!(off < f64::max(tolerance, 1e-9), "{tolerance:e}: {off:e}");
        assert!(counts.steps < 10_000 && counts.detours == 0, "{tolerance:e}: {counts:?}");
    }
}
