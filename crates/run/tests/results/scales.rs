//! Independent parts of a model with their own scales, and contacts with very small strokes or friction coefficients.
//!
//! * `hang_unrelated_masses`: a slider at rest with a friction coefficient of 1e-8, and two masses on a spring. Work must have separate
//!   scales.
//! * `frictionless_stage`, `frictionless_chain`: friction coefficients of 1e-12 with forces of newtons.
//! * `fretting_small_stroke`, `driven_233`: a contact with amplitudes below a thousandth of u_c.

use serde_json::Value;
use std::f64::consts::TAU;
use std::path::Path;
use stickslip_drive::scene::Axis;
use stickslip_run::{Job, Outcome, Summary};

/// Runs a model of the test data with overrides, in at most 20 000 time steps.
fn ended(name: &str, set: &[(&str, &str)]) -> (Job, Outcome) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name).with_extension("json");
    let changes = set.iter().chain(&[("run.limits.steps", "20000")]);
    let changes: Vec<_> = changes.map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let job = Job::prepare(&file, &changes, Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{name} {set:?}: {:?}", outcome.error);
    (job, outcome)
}

fn energy((job, outcome): &(Job, Outcome), key: &str) -> f64 {
    let summary: Value = serde_json::from_str(&Summary::new(job, outcome).pretty().unwrap()).unwrap();
    summary["energy"][key].as_f64().unwrap()
}

#[test]
fn tiny_frictions_stall_nothing_beside_them() {
    for name in ["hang_unrelated_masses", "frictionless_stage", "frictionless_chain"] {
        for tolerance in ["1e-4", "1e-6", "1e-8", "1e-10"] {
            let run = ended(name, &[("run.stepper.event.tolerance", tolerance)]);
            let (counts, books) = (run.1.state.counts(), energy(&run, "largest_error_relative"));
            println!("{name} at {tolerance}: {counts:?}, books {books:.1e}");
            assert!(counts.steps < 10_000 && counts.detours == 0, "{name} at {tolerance}: {counts:?}");
            assert!(books < 100.0 * tolerance.parse::<f64>().unwrap(), "{name} at {tolerance}: {books:e}");
        }
    }
}

/// Two masses on a spring, one of them driven by F sin ωt from rest. Their centre moves as t - sin(ωt)/ω, the spring as sin ωt - (ω/Ω) sin
/// Ωt.
#[test]
fn masses_swing_beside_a_contact_of_tiny_friction_as_alone() {
    let [m0, m1, stiffness, force, omega] = [2e-3, 3e-3, 1.4e6, 1.0, TAU / 1.2e-3];
    let own = f64::sqrt(stiffness * (1.0 / m0 + 1.0 / m1));
    let t = 3.6e-3;
    let centre = force / ((m0 + m1) * omega) * (t - (omega * t).sin() / omega);
    let stretch =
        force / m1 / (own * own - omega * omega) * ((omega * t).sin() - omega / own * (own * t).sin());
    let place = centre - m1 / (m0 + m1) * stretch;
    for friction in ["1e-14", "1e-11", "1e-8", "1e-2"] {
        let set = [("contacts.c.friction", friction), ("run.stepper.event.tolerance", "1e-6")];
        let (job, outcome) = ended("hang_unrelated_masses", &set);
        let (x, _) = outcome.state.coordinate(&job.model, 0, Axis::X).unwrap();
        let (still, _) = outcome.state.coordinate(&job.model, 2, Axis::X).unwrap();
        println!("{friction}: {x:e} m, {:.1e} of it off", (x / place - 1.0).abs());
        let rests = still.abs() < 1e-9 * job.model.contact_natural(0).unwrap().displacement;
        assert!((x / place - 1.0).abs() < 1e-5 && rests, "{friction}: {x:e} m, {place:e} m, {still:e} m");
    }
}

/// Returns E_d/(4μF_N u_c) = Ũ + Ũ(1-Ũ)ᵖ - 2/(p+1) (1-(1-Ũ)ᵖ⁺¹) with p = 3/2 for a ball in partial slip (Cattaneo and Mindlin).
///
/// The series has no cancellation: the sum over j ≥ 2 of (-1)ʲ (p over j) (j-1)/(j+1) Ũʲ⁺¹.
fn lost_by_a_loop(part: f64) -> f64 {
    let (mut binomial, mut sum) = (1.0, 0.0);
    for j in 1..400 {
        let order = f64::from(j);
        binomial *= (order - 1.0 - 1.5) / order;
        sum += binomial * (order - 1.0) / (order + 1.0) * part.powi(j + 1);
    }
    sum
}

/// Between the ends of two periods the loop is closed, so the energy input equals the loss. 3 nm are 0.4 % of u_c.
#[test]
fn work_put_into_small_strokes_follows_the_tolerance() {
    for (amplitude, metres) in [("500 nm", 5e-7), ("100 nm", 1e-7), ("10 nm", 1e-8), ("3 nm", 3e-9)] {
        for tolerance in ["1e-4", "1e-6", "1e-8", "1e-10"] {
            let run = |duration| {
                let stepper = ("run.stepper.event.tolerance", tolerance);
                let set = [("waveforms.s.sine.amplitude", amplitude), ("run.duration", duration), stepper];
                ended("fretting_small_stroke", &set)
            };
            let (one, two) = (run("1 s"), run("2 s"));
            let natural = one.0.model.contact_natural(0).unwrap();
            let lost =
                4.0 * natural.force * natural.displacement * lost_by_a_loop(metres / natural.displacement);
            let off = |key| ((energy(&two, key) - energy(&one, key)) / lost - 1.0).abs();
            let (input, friction, books) =
                (off("input_J"), off("friction_J"), energy(&two, "largest_error_relative"));
            println!(
                "{amplitude} at {tolerance}: input {input:.1e}, friction {friction:.1e} off, books {books:.1e}"
            );
            let tolerance: f64 = tolerance.parse().unwrap();
            assert!(
                input < 100.0 * tolerance + 1e-9 && friction < 1e-9,
                "{amplitude} at {tolerance:e}: {input:e}, {friction:e}"
            );
            assert!(books < 100.0 * tolerance, "{amplitude} at {tolerance:e}: {books:e}");
        }
    }
}

#[test]
fn books_of_a_small_stroke_close_at_the_tolerance() {
    for tolerance in ["1e-6", "1e-8", "1e-10"] {
        let set = [("run.stepper", &*format!(r#"{{"event": {{"tolerance": {tolerance}}}}}"#))];
        let books = energy(&ended("driven_233", &set), "largest_error_relative");
        assert!(books < 100.0 * tolerance.parse::<f64>().unwrap(), "{tolerance}: {books:e}");
    }
    // The same with a compliant rig: massless positions are solved with a tolerance of 1e-10.
    let rig = [
        ("bodies.end", r#"{"x": "balanced"}"#),
        ("contacts.c.between", r#"["end", "ground"]"#),
        ("springs", r#"{"k": {"between": ["rig", "end"], "stiffness": "5 N/um"}}"#),
    ];
    for amplitude in ["100 nm", "3 nm", "0.3 nm"] {
        let set: Vec<_> = rig.into_iter().chain([("waveforms.s.sine.amplitude", amplitude)]).collect();
        let books = energy(&ended("fretting_small_stroke", &set), "largest_error_relative");
        println!("{amplitude} on a rig: books {books:.1e}");
        assert!(books < 1e-8, "{amplitude}: {books:e}");
    }
}

/// With 10 N and a friction of 3e-14 N, a mass of 1 kg moves as without the contact: F/(mω²)(ωt - sin ωt).
#[test]
fn friction_below_the_rounding_of_forces_is_none() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/odd/friction_of_rounding.json");
    let run = |friction: &str| {
        let set = [("contacts.ball.friction".to_owned(), friction.to_owned())];
        let job = Job::prepare(&file, &set, Path::new("")).unwrap();
        let outcome = job.run(&());
        assert!(outcome.error.is_none(), "{friction}: {:?}", outcome.error);
        let said = job.warnings().iter().any(|odd| odd.kind == "friction");
        ((job, outcome), said)
    };
    let (none, said) = run("1e-14");
    let (x, _) = none.1.state.coordinate(&none.0.model, 0, Axis::X).unwrap();
    let turn = TAU * 3.0;
    let place = 10.0 / (TAU / 1e-3_f64).powi(2) * (turn - turn.sin());
    assert!(said && energy(&none, "friction_J") == 0.0 && (x / place - 1.0).abs() < 1e-9, "{x:e} {place:e}");
    let (some, said) = run("1e-10");
    assert!(!said && energy(&some, "friction_J") > 0.0);
}
