//! Spring rows with the event-driven integrator under varying normal loads.
//!
//! * `row_coupled`: a slider on a foot that moves along x and z.
//! * `row_force`: two rows under a sinusoidal force.
//! * `row_at_rest`: a slider at rest under a load while the indentation decreases and unloaded springs open.
//!
//! The reference is velocity Verlet without events on the same row, with Richardson extrapolation of two time steps.

use serde_json::Value;
use std::path::Path;
use stickslip_drive::State;
use stickslip_drive::scene::Axis;
use stickslip_run::{Job, Outcome, Summary};

fn run(name: &str, sets: &[(&str, String)]) -> (Job, Outcome) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name).with_extension("json");
    let sets: Vec<_> = sets.iter().map(|(path, value)| ((*path).to_owned(), value.clone())).collect();
    let job = Job::prepare(&file, &sets, Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{name}, {sets:?}: {:?}", outcome.error);
    (job, outcome)
}

/// Returns the final position of the slider along x, relative to the natural displacement of the first contact.
fn place(job: &Job, state: &State) -> f64 {
    let unit = job.model.contact_natural(0).unwrap().displacement;
    state.coordinate(&job.model, 1, Axis::X).unwrap().0 / unit
}

/// Compares every tolerance with fixed time steps: within ten tolerances, or within the error of the fixed steps.
fn against_verlet(name: &str, contacts: &[&str], count: usize, step: f64) {
    let springs: Vec<_> =
        contacts.iter().map(|c| (format!("contacts.{c}.engine.springs.count"), count.to_string())).collect();
    let of = |stepper: String| {
        let mut sets: Vec<_> = springs.iter().map(|(path, count)| (path.as_str(), count.clone())).collect();
        sets.push(("run.stepper", stepper));
        run(name, &sets)
    };
    let [coarse, fine] = [step, 0.5 * step].map(|step| {
        let (job, outcome) = of(format!(r#"{{"verlet": {{"step": {step:e}}}}}"#));
        place(&job, &outcome.state)
    });
    let (reference, own) = (fine + (fine - coarse) / 3.0, (fine - coarse).abs() / 3.0);
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let (job, outcome) = of(format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#));
        let off = (place(&job, &outcome.state) - reference).abs();
        let counts = outcome.state.counts();
        println!("{name}, {count} springs, {tolerance:e}: {off:.1e} u_c off, verlet {own:.1e}, {counts:?}");
        assert!(off <= f64::max(10.0 * tolerance, own), "{name}, {count} springs, {tolerance:e}: {off:e}");
    }
}

#[test]
fn rows_under_a_coupled_normal_are_those_of_fixed_steps() {
    for count in [16, 64, 255] {
        against_verlet("row_coupled", &["c"], count, 20e-9);
    }
}

#[test]
#[ignore = "takes long: .ci/full"]
fn rows_under_a_following_force_are_those_of_fixed_steps() {
    for count in [16, 64] {
        against_verlet("row_force", &["c0", "c1"], count, 0.4e-6);
    }
}

#[test]
fn a_slider_at_rest_on_a_row_is_not_moved_by_springs_that_part() {
    against_verlet("row_at_rest", &["c"], 64, 40e-6);
}

/// The friction work is that of the path, not of one chord per time step. The energy error follows the tolerance.
#[test]
fn books_of_rows_under_a_coupled_normal_close() {
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let stepper = format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#);
        let (job, outcome) = run("row_coupled", &[("run.stepper", stepper)]);
        let summary: Value = serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
        let books = summary["energy"]["largest_error_relative"].as_f64().unwrap();
        println!("books at {tolerance:e}: {books:.1e}");
        assert!(books < 10.0 * tolerance, "{tolerance:e}: {books:e}");
    }
}
