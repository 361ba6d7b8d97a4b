//! `stickslip info` against calculations of its own: every formula is written out here from the handbook (Popov, Heß,
//! Willert, 2019); none of the program's is called.

use crate::program::{
    Table, code, listing, number, run_example, scenario, stderr, stdout, stickslip, summary,
};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::Path;
use tempfile::tempdir;

/// What `check` warns of: `info` says the same, and nothing else beside its answer.
fn odd(file: &Path, arguments: &[&str]) -> String {
    stderr(&stickslip().arg("check").arg(file).args(arguments).output().unwrap())
}

pub(crate) fn info(file: &Path, arguments: &[&str]) -> Value {
    let output = stickslip().arg("info").arg(file).args(arguments).arg("--json").output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, odd(file, arguments)));
    assert_eq!(stdout(&output).lines().count(), 1);
    serde_json::from_str(&stdout(&output)).unwrap()
}

pub(crate) fn tables(file: &Path) -> String {
    let output = stickslip().arg("info").arg(file).output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, odd(file, &[])));
    stdout(&output)
}

fn is(info: &Value, pointer: &str, want: f64, within: f64) {
    let got = number(info, pointer);
    assert!((got - want).abs() <= within * want.abs(), "{pointer}: {got:e}, expected {want:e}");
}

/// 1/E\* = Σ(1-ν²)/E (4.13).
fn normal_modulus(materials: [(f64, f64); 2]) -> f64 {
    1.0 / materials.iter().map(|(e, nu)| (1.0 - nu * nu) / e).sum::<f64>()
}

/// 1/G\* = Σ(2-ν)/(4G), G = E/(2(1+ν)) (4.13).
fn tangential_modulus(materials: [(f64, f64); 2]) -> f64 {
    1.0 / materials.iter().map(|(e, nu)| (2.0 - nu) * 2.0 * (1.0 + nu) / (4.0 * e)).sum::<f64>()
}

const RUBY: (f64, f64) = (400e9, 0.27);
const STEEL: (f64, f64) = (210e9, 0.30);

#[test]
fn the_ruby_drive_has_its_closed_forms() {
    let info = info(&scenario("ruby_drive"), &[]);
    let (normal, tangential) = (normal_modulus([RUBY, STEEL]), tangential_modulus([RUBY, STEEL]));
    let (radius, force, friction, count, mass) = (0.5e-3_f64, 0.3, 0.2, 3.0, 10e-3);
    // F = (4/3)E*√R d^{3/2}; a = √(Rd); p = 3F/(2πa²); u_c = μE*d/G* (4.28).
    let d = (0.75 * force / (normal * radius.sqrt())).powf(2.0 / 3.0);
    let a = (radius * d).sqrt();
    let u_c = friction * normal / tangential * d;
    let shear = |(e, nu): (f64, f64)| e / (2.0 * (1.0 + nu));
    let part = |m: (f64, f64)| (1.0 - 2.0 * m.1) / shear(m);
    let whole = |m: (f64, f64)| 2.0 * (1.0 - m.1) / shear(m);
    let ball = |key: &str| format!("/contacts/ball/{key}");
    for (key, want) in [
        ("normal_modulus_Pa", normal),
        ("tangential_modulus_Pa", tangential),
        ("dundurs_beta", (part(RUBY) - part(STEEL)) / (whole(RUBY) + whole(STEEL))),
        ("stick_slope", friction * normal / tangential),
        ("start/normal_force_N", force),
        ("start/indentation_m", d),
        ("start/contact_radius_m", a),
        ("start/peak_pressure_Pa", 1.5 * force / (PI * a * a)),
        ("start/gross_slip_displacement_m", u_c),
        ("start/zero_step_stroke_m", 2.0 * u_c * (1.0 - 0.5_f64.powf(2.0 / 3.0))),
        ("start/limit_force_N", count * friction * force),
        ("start/tangential_stiffness_N_m", count * 2.0 * tangential * a),
        ("start/normal_stiffness_N_m", count * 2.0 * normal * a),
        ("start/contact_resonance_Hz", (count * 2.0 * tangential * a / mass).sqrt() / TAU),
    ] {
        is(&info, &ball(key), want, 1e-12);
    }
    // The same as published with the set: to the digits given there.
    is(&info, &ball("start/gross_slip_displacement_m"), 39.695e-9, 2e-5);
    is(&info, &ball("start/zero_step_stroke_m"), 29.377e-9, 2e-5);
    is(&info, &ball("start/contact_resonance_Hz"), 4151.0, 2e-4);
    is(&info, &ball("dundurs_beta"), -0.076, 5e-3);
    assert_eq!(info["contacts"]["ball"]["elastically_similar"], false);
    // Mossakovskii's factor of a stuck contact, artanh(β)/β.
    let beta: f64 = (part(RUBY) - part(STEEL)) / (whole(RUBY) + whole(STEEL));
    is(&info, &ball("neglected_stiffness"), beta.atanh() / beta - 1.0, 1e-9);
    let words = info["contacts"]["ball"]["similarity"].as_str().unwrap();
    assert!(words.starts_with("not elastically similar (β = -0.0764): "), "{words}");
    // One mass on one spring: the mode is the contact's resonance; fixed steps end at 2/ω and √8/ω.
    let omega = (count * 2.0 * tangential * a / mass).sqrt();
    is(&info, "/modes/0/frequency_Hz", omega / TAU, 1e-12);
    is(&info, "/stepping/longest_verlet_step_s", 2.0 / omega, 1e-12);
    is(&info, "/stepping/longest_rk4_step_s", 8.0_f64.sqrt() / omega, 1e-12);
    assert!(
        info["contacts"]["ball"].get("smallest").is_none()
            && info["modes"][0].get("frequency_range_Hz").is_none()
    );
    assert_eq!(info["scenario_sha256"].as_str().unwrap().len(), 64);
}

#[test]
fn a_load_on_the_slider_raises_the_zero_step_stroke() {
    // λ = 20 mN/(3 · 0.2 · 0.3 N); S₀ = 2u_c[1 - ((1-λ)/2)^{2/3}].
    let found = info(&scenario("quickstart"), &[]);
    let share: f64 = 0.02 / 0.18;
    let u_c = number(&found, "/contacts/ball/start/gross_slip_displacement_m");
    is(&found, "/contacts/ball/start/loaded/share", share, 1e-12);
    let want = 2.0 * u_c * (1.0 - (0.5 * (1.0 - share)).powf(2.0 / 3.0));
    is(&found, "/contacts/ball/start/loaded/zero_step_stroke_m", want, 1e-12);
    // Gravity on an incline pulls too: 10 g · 9.81 m/s² · sin 30°.
    let set = ["--set", "gravity={\"acceleration\": 9.81, \"incline\": \"30 deg\"}"];
    is(&info(&scenario("quickstart"), &set), "/contacts/ball/start/loaded/force_N", -0.02 - 0.04905, 1e-12);
    // More than friction holds.
    let found = info(&scenario("quickstart"), &["--set", "loads[0].x=-0.19"]);
    assert!(found.pointer("/contacts/ball/start/loaded/zero_step_stroke_m").is_none());
}

#[test]
fn a_stack_and_its_slider_have_the_modes_of_a_chain_of_two_masses() {
    let info = info(&scenario("piezo_stack"), &[]);
    let (normal, tangential) = (normal_modulus([STEEL; 2]), tangential_modulus([STEEL; 2]));
    let (k1, k2) = (20e6, 2.0 * tangential * (0.75 * 1e-3 / normal).cbrt());
    let (m1, m2, c): (f64, f64, f64) = (5e-3, 20e-3, 20.0);
    // m₁m₂ω⁴ - [m₂(k₁+k₂) + m₁k₂]ω² + k₁k₂ = 0; x₁/x₂ = 1 - m₂ω²/k₂; ζ = c x₁²/(2ω(m₁x₁² + m₂x₂²)).
    let (half, product) = (0.5 * ((k1 + k2) / m1 + k2 / m2), k1 * k2 / (m1 * m2));
    let root = (half * half - product).sqrt();
    for (mode, square) in [product / (half + root), half + root].into_iter().enumerate() {
        let ratio = 1.0 - m2 * square / k2;
        let mode = format!("/modes/{mode}");
        is(&info, &format!("{mode}/frequency_Hz"), square.sqrt() / TAU, 1e-12);
        let shape = ["foot.x", "slider.x"].map(|name| number(&info, &format!("{mode}/shape/{name}")));
        assert!((shape[0] / shape[1] / ratio - 1.0).abs() < 1e-10, "{shape:?}, {ratio}");
        let damping = c * ratio * ratio / (2.0 * square.sqrt() * (m1 * ratio * ratio + m2));
        is(&info, &format!("{mode}/damping_ratio"), damping, 1e-10);
    }
    // The contact alone swings with the reduced mass of 4 g.
    is(&info, "/contacts/ball/start/contact_resonance_Hz", (k2 / 4e-3).sqrt() / TAU, 1e-12);
}

#[test]
fn a_load_that_varies_has_its_ranges() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("mine.json");
    let text = std::fs::read_to_string(scenario("p1")).unwrap();
    let load = "{ \"follows\": { \"sine\": { \"amplitude\": \"0.4 N\", \"offset\": \"1 N\", \"period\": \"1 ms\" } } }";
    let text = text.replace("\"force\": \"1 N\"", &format!("\"force\": {load}"));
    let text = text.replace("\"cycles\": 20", "\"duration\": \"2 ms\"");
    std::fs::write(&file, text.replace("\"output\"", "\"figures\": { \"waveform\": \"drive\" }, \"output\""))
        .unwrap();
    let info = info(&file, &[]);
    let (normal, tangential) = (normal_modulus([STEEL; 2]), tangential_modulus([STEEL; 2]));
    for (state, force) in [("smallest", 0.6), ("start", 1.0), ("largest", 1.4)] {
        let a = (0.75 * force * 1e-3 / normal).cbrt();
        let at = |key: &str| format!("/contacts/ball/{state}/{key}");
        is(&info, &at("normal_force_N"), force, 1e-12);
        is(&info, &at("contact_radius_m"), a, 1e-12);
        is(&info, &at("indentation_m"), a * a / 1e-3, 1e-12);
        is(&info, &at("peak_pressure_Pa"), 1.5 * force / (PI * a * a), 1e-12);
        is(&info, &at("contact_resonance_Hz"), (2.0 * tangential * a / 0.02).sqrt() / TAU, 1e-12);
    }
    for (end, state) in ["smallest", "largest"].into_iter().enumerate() {
        let want = number(&info, &format!("/contacts/ball/{state}/contact_resonance_Hz"));
        is(&info, &format!("/modes/0/frequency_range_Hz/{end}"), want, 1e-12);
    }
    // The stiffest state sets the longest step.
    let omega = TAU * number(&info, "/contacts/ball/largest/contact_resonance_Hz");
    is(&info, "/stepping/longest_verlet_step_s", 2.0 / omega, 1e-12);
    assert!(tables(&file).contains("F_N, normal force per contact        1.000 N (600.0 mN … 1.400 N)"));
}

#[test]
fn what_is_expected_is_what_runs_bring() {
    let out = tempdir().unwrap();
    let names = listing(scenario("p1").parent().unwrap());
    for name in names.iter().filter_map(|name| name.strip_suffix(".json")) {
        let info = info(&scenario(name), &[]);
        let folder = run_example(name, out.path(), &[]);
        let counts = summary(&folder);
        let trace = Table::read(&folder.join("trace.csv"));
        assert_eq!(number(&info, "/expected/rows"), number(&counts, "/counts/rows"), "{name}");
        assert_eq!(number(&info, "/expected/columns"), trace.head.len() as f64, "{name}");
        assert_eq!(info["scenario_sha256"], counts["scenario_sha256"]);
        let events = Table::read(&folder.join("events.csv"));
        let corners = events.column("kind").iter().filter(|kind| **kind == "corner").count() as f64;
        let expected =
            ["corners", "contacts_estimate"].map(|key| number(&info, &format!("/expected/events/{key}")));
        // A corner at the very end of the run starts nothing and may be missing.
        assert!((corners..=corners + 2.0).contains(&expected[0]), "{name}: {expected:?}, {corners}");
        let ratio = (expected[0] + expected[1]) / events.rows.len() as f64;
        // Ringing each time that a contact sticks again, and bounces that fade, are known only after the run.
        let least = if ["belt", "oscillator", "bounce"].contains(&name) { 0.1 } else { 0.5 };
        assert!((least..=2.0).contains(&ratio), "{name}: {ratio} of {} events", events.rows.len());
        let size = std::fs::metadata(folder.join("trace.csv")).unwrap().len() as f64;
        let ratio = number(&info, "/expected/trace_B") / size;
        assert!((0.7..=1.4).contains(&ratio), "{name}: {ratio} of {size} B");
    }
}

/// What a run says of a pair is what `info` says of it.
#[test]
fn a_summary_tells_how_far_the_theory_holds() {
    let out = tempdir().unwrap();
    for (name, contact, similar) in [("quickstart", "ball", false), ("oblique_loading", "ball", true)] {
        let folder = run_example(name, out.path(), &["plots=[]"]);
        let told = summary(&folder)["contacts"][contact]["similarity"].clone();
        let known = &info(&scenario(name), &[])["contacts"][contact];
        assert_eq!(told["text"], known["similarity"], "{name}");
        assert_eq!(told["dundurs_beta"], known["dundurs_beta"], "{name}");
        assert_eq!(told["neglected_stiffness"], known["neglected_stiffness"], "{name}");
        assert_eq!(told["text"] == "elastically similar (β = 0): the theory is exact", similar, "{name}");
    }
}
