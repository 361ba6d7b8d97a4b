//! Errors follow the tolerance, for models that are difficult in this respect.
//!
//! * `set_down_on_a_cone`: a body that is pressed into its contact in full stick.
//! * `faint_friction`: a body on two lists of heights, one with a friction coefficient of 1e-6.
//! * `row_under_a_load`: a slider on 256 springs under a constant load.
//! * `law_damped`, `tip_pressed`: the stiffness has a kink where a damped contact slips or is pressed in deeper.

use serde_json::Value;
use std::path::Path;
use stickslip_drive::scene::Axis;
use stickslip_run::{Job, Outcome, Summary};

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

/// Returns the final position of a body along x, relative to u_c of a contact.
fn place((job, outcome): &(Job, Outcome), body: &str, contact: usize) -> f64 {
    let unit = job.model.contact_natural(contact).unwrap().displacement;
    let body = job.scenario.scene.bodies.iter().position(|named| named.name == body).unwrap();
    outcome.state.coordinate(&job.model, body, Axis::X).unwrap().0 / unit
}

/// Returns the Richardson extrapolation of velocity Verlet at two time steps, and the difference of the two results.
fn by_verlet(name: &str, body: &str, contact: usize, step: f64) -> (f64, f64) {
    let [coarse, fine] = [step, 0.5 * step]
        .map(|step| place(&run(name, &format!(r#"{{"verlet": {{"step": {step:e}}}}}"#)), body, contact));
    (fine + (fine - coarse) / 3.0, (fine - coarse).abs())
}

/// Returns the relative energy error in the summary, and whether there is a warning about it.
fn books((job, outcome): &(Job, Outcome)) -> (f64, bool) {
    let summary: Value = serde_json::from_str(&Summary::new(job, outcome).line().unwrap()).unwrap();
    let warnings = summary["warnings"].as_array().cloned().unwrap_or_default();
    let warned = warnings.iter().any(|warning| warning["kind"] == "energy_balance");
    (summary["energy"]["largest_error_relative"].as_f64().unwrap(), warned)
}

/// The energy error of this body comes only from the growth paths of its contact: there is one bounce and no damping.
#[test]
fn books_of_growth_follow_the_tolerance() {
    let (reference, own) = by_verlet("set_down_on_a_cone", "ball", 0, 2e-5);
    for (tolerance, most) in [(1e-10, 50.0), (1e-11, 60.0), (1e-12, 150.0), (1e-13, 3000.0)] {
        // Rounding causes a large scatter, so the median of five runs is used.
        let stepper = format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#);
        let mut all = (0..5)
            .map(|k| {
                let mass = format!("{:?}", 1.0 + 2.3e-15 * f64::from(k));
                with("set_down_on_a_cone", &[("run.stepper", &stepper), ("bodies.ball.mass", &mass)])
            })
            .collect::<Vec<_>>();
        all.sort_by(|a, b| books(a).0.total_cmp(&books(b).0));
        let ran = &all[2];
        let ((missed, warned), off) = (books(ran), (place(ran, "ball", 0) - reference).abs());
        println!("{tolerance:e}: books miss {missed:.1e}, {off:.1e} u_c from verlet's, {own:.1e}");
        // Errors above 100 tolerances are reported, too.
        let told = warned == (missed > 100.0 * tolerance);
        assert!(missed < most * tolerance && told, "{tolerance:e}: {missed:e}, warned: {warned}");
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

/// The springs slip one by one, and no time step ends where they do.
#[test]
fn rows_under_a_load_are_as_exact_as_they_are_asked_to_be() {
    let (reference, moved) = by_verlet("row_under_a_load", "s0", 0, 1e-5);
    for (tolerance, most) in [(1e-8, 5.0), (1e-9, 2.0)] {
        let ran = at("row_under_a_load", tolerance);
        let (counts, off) = (ran.1.state.counts(), (place(&ran, "s0", 0) - reference).abs());
        println!("{tolerance:e}: {off:.1e} u_c from verlet's, {moved:.1e}, {counts:?}");
        assert!(off < most * tolerance, "{tolerance:e}: {off:e}");
    }
}

/// A row that rings for a long time, because its drive jumps in every period.
#[test]
fn rows_that_ring_are_nearly_so() {
    let jumps = r#"{"trapezoid": {"stroke": 1.204e-6, "rise": 0.1697, "hold": 0.08486, "fall": 0, "period": 0.8486}}"#;
    let at = |tolerance: f64| {
        let stepper = format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#);
        let ran = with("row_under_a_load", &[("run.stepper", &stepper), ("waveforms.drive", jumps)]);
        place(&ran, "s0", 0)
    };
    let finest = at(1e-13);
    for (tolerance, most) in [(1e-8, 300.0), (1e-9, 50.0), (1e-10, 50.0)] {
        let off = (at(tolerance) - finest).abs();
        println!("{tolerance:e}: {off:.1e} u_c from 1e-13");
        assert!(off < most * tolerance, "{tolerance:e}: {off:e}");
    }
}

/// A slider on a damped normal law with seven points, and one on a paraboloid with a conical tip under a sinusoidal force.
#[test]
#[ignore = "takes long: .ci/full"]
fn bends_of_the_stiffness_cost_no_digits() {
    for name in ["law_damped", "tip_pressed"] {
        let place = |tolerance: f64| place(&at(name, tolerance), "slider", 0);
        let (finest, verlet) = (place(1e-13), by_verlet(name, "slider", 0, 2e-7));
        println!("{name}: {:.1e} u_c from verlet's, {:.1e}", (finest - verlet.0).abs(), verlet.1);
        // Reversals are between the time steps, so the error decreases slightly slower than quadratically.
        assert!((finest - verlet.0).abs() < 4.0 * verlet.1, "{name}");
        for tolerance in [1e-6, 1e-8, 1e-9] {
            let off = (place(tolerance) - finest).abs();
            println!("{name}, {tolerance:e}: {off:.1e} u_c from 1e-13");
            assert!(off < 15.0 * tolerance, "{name}, {tolerance:e}: {off:e}");
        }
    }
}
