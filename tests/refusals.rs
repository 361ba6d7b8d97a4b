//! Bad input: exit code 2, a message with its place, nothing written.

use crate::program::{code, listing, run, scenario, stderr, stdout, stickslip};
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

/// Runs the first example with one text replaced, as "mine.json"; the place of the replacement is where the message
/// must point: line and column of `marked` in the new text.
fn refused(from: &str, to: &str, marked: &str, message: &str) {
    let folder = tempdir().unwrap();
    let text = std::fs::read_to_string(scenario("quickstart")).unwrap();
    assert_eq!(text.matches(from).count(), 1, "{from}");
    let start = text.find(from).unwrap();
    let text = text.replace(from, to);
    let file = folder.path().join("mine.json");
    std::fs::write(&file, &text).unwrap();
    let output = run(&file, &folder.path().join("out"), &[]);
    let offset = start + to.find(marked).unwrap();
    let line = text[..offset].matches('\n').count() + 1;
    let column = text[..offset].chars().rev().take_while(|c| *c != '\n').count() + 1;
    let place = format!("{}:{line}:{column}  ", file.display());
    check(&output, &[&place, message]);
    assert_eq!(listing(folder.path()), ["mine.json"], "{to}");
}

fn check(output: &Output, words: &[&str]) {
    let said = stderr(output);
    assert_eq!((code(output), stdout(output)), (2, String::new()), "{said}");
    for word in words {
        assert!(said.contains(word), "expected {word:?} in:\n{said}");
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    refused("\"10 g\"", "\"-10 g\"", "\"-10 g\"", "bodies.slider.mass: expected");
    refused("\"0.5 mm\"", "\"-0.5 mm\"", "\"-0.5 mm\"", "contacts.ball.profile.paraboloid.radius: expected");
    refused(
        "\"210 GPa\"",
        "\"-210 GPa\"",
        "\"-210 GPa\"",
        "materials.hardened steel.youngs_modulus: expected",
    );
    refused("0.27", "0.51", "0.51", "materials.ruby.poisson_ratio: expected");
    refused(
        "0.2,",
        "-0.2,",
        "-0.2",
        "contacts.ball.friction: expected a number between 0 and 1000, got -0.2",
    );
    refused("\"100 ms\"", "0", "0", "run.duration: expected");
    refused("1e-8", "0.5", "0.5", "run.stepper.event.tolerance: expected");
}

#[test]
fn what_is_no_number_is_refused() {
    refused("0.2,", "NaN,", "NaN", "not JSON");
    refused("0.2,", "1e999,", "1e999", "beyond the largest");
    refused("\"10 g\"", "\"10 m\"", "\"10 m\"", "bodies.slider.mass");
    refused("\"every\": \"10 us\"", "\"every\": \"10 ly\"", "\"10 ly\"", "output.every");
}

#[test]
fn names_that_nothing_has_are_refused() {
    refused(
        "\"ruby\", \"hardened steel\"",
        "\"ruby\", \"hardend steel\"",
        "\"hardend steel\"",
        "did you mean \"hardened steel\"?",
    );
    refused("[\"foot\", \"slider\"]", "[\"foot\", \"slyder\"]", "\"slyder\"", "did you mean \"slider\"?");
    refused(
        "{ \"follows\": \"drive\" }",
        "{ \"follows\": \"drove\" }",
        "\"drove\"",
        "did you mean \"drive\"?",
    );
    refused("\"friction\":", "\"fricton\":", "\"fricton\"", "did you mean \"friction\"?");
    refused("\"trajectory\"", "\"trajektory\"", "\"trajektory\"", "did you mean \"trajectory\"?");
}

#[test]
fn channels_that_nothing_has_are_refused() {
    let channels = |names: &str| format!("\"10 us\", \"channels\": {names} }}");
    let (from, wrong) = ("\"10 us\" },\n  \"plots\"", "\"slider.y_m\"");
    let to = channels("[\"time_s\", \"slider.y_m\"]") + ",\n  \"plots\"";
    refused(from, &to, wrong, "output.channels[1]: there is no channel \"slider.y_m\"\n");
    refused(from, &to, wrong, "help: did you mean \"slider.x_m\"?");
    let to = channels("[\"ball.u_m\", \"slider.x_m\",\"ball.u_m\"]") + ",\n  \"plots\"";
    let folder = tempdir().unwrap();
    let file = folder.path().join("mine.json");
    let text = std::fs::read_to_string(scenario("quickstart")).unwrap().replace(from, &to);
    std::fs::write(&file, text).unwrap();
    check(&run(&file, folder.path(), &[]), &["output.channels[2]: this channel is already in the list"]);
}

#[test]
fn what_contradicts_itself_is_refused() {
    refused(
        "\"slider\": { \"mass\": \"10 g\", ",
        "\"slider\": { ",
        "\"slider\"",
        "bodies.slider: missing key \"mass\"",
    );
}

#[test]
fn falling_times_and_files_outside_are_refused() {
    let sawtooth =
        "{ \"sawtooth\": { \"stroke\": \"200 nm\", \"period\": \"10 ms\", \"flyback\": \"10 us\" } }";
    let falling = "{ \"table\": { \"points\": [[0, 0], [2, \"1 um\"], [1, 0]] } }";
    refused(sawtooth, falling, "1, 0", "waveforms.drive.table.points[2][0]");
    let outside = "{ \"table\": { \"file\": \"../../etc/passwd\", \"time\": \"t\", \"value\": \"x\" } }";
    refused(sawtooth, outside, "\"../../etc", "waveforms.drive.table.file");
    let absolute = "{ \"table\": { \"file\": \"/etc/passwd\", \"time\": \"t\", \"value\": \"x\" } }";
    refused(sawtooth, absolute, "\"/etc", "waveforms.drive.table.file");
}

#[test]
fn what_only_the_model_can_tell_points_into_the_file_too() {
    let run = "\" } ],\n  \"run\":    { \"duration\": \"100 ms\",";
    let from = format!("-0.02 N{run}");
    let to = format!("-0.2 N{run} \"start\": \"equilibrium\",");
    refused(&from, &to, "\"equilibrium\"", "run.start: `slider` has no static equilibrium along x");
}

/// A stiff spring bears a body one of whose feet touches as long as it does not pitch. Where it may it tips off that foot, hangs level, and slides
/// by m g sin α: that is told, and not the pitch, of which 0 N m stay unbalanced.
#[test]
fn what_tips_off_its_foot_is_said_to_slide() {
    let foot = |x: f64, gap: &str| {
        format!(
            r#"{{ "between": ["ground", "block"], "materials": ["steel", "steel"], "profile": {{ "flat": {{ "radius": 1e-5 }} }},
                "friction": 0.27, "normal": "coupled", "at": {{ "block": {{ "x": {x}, "z": -5.8e-3 }} }}{gap} }}"#
        )
    };
    let text = format!(
        r#"{{ "stickslip": 1, "materials": {{ "steel": {{ "youngs_modulus": 210e9, "poisson_ratio": 0.3 }} }},
            "bodies": {{ "block": {{ "mass": 1.7e-4, "x": "free", "z": "free", "pitch": "free", "inertia": 1.7e-8 }} }},
            "contacts": {{ "front": {}, "rear": {} }},
            "springs": {{ "leaf": {{ "between": ["ground", "block"], "direction": "z", "stiffness": 3.565e7, "preload": -8.7e-3 }} }},
            "loads": [ {{ "on": "block", "z": -0.13 }} ],
            "gravity": {{ "acceleration": 9.81, "incline": 0.0654 }},
            "run": {{ "duration": 1e-3, "start": "equilibrium" }} }}"#,
        foot(7.3e-3, ""),
        foot(-10.2e-3, r#", "gap": 9.4e-7"#)
    );
    let folder = tempdir().unwrap();
    let file = folder.path().join("block.json");
    std::fs::write(&file, text).unwrap();
    let pull = 1.7e-4 * 9.81 * 0.0654_f64.sin();
    let message = format!("`block` has no static equilibrium along x: -{pull:.3e} N remain unbalanced");
    check(&run(&file, &folder.path().join("out"), &[]), &[&message]);
}

/// A block on two feet at ±8 mm, 20 mm below its middle, tips at 0.4 of its weight. With 2e-5 more it was found at rest at -15 835 rad, and
/// the run ended well.
#[test]
fn a_block_that_tips_has_no_equilibrium() {
    let foot = |x: f64| {
        format!(
            r#"{{ "between": ["ground", "b"], "materials": ["steel", "steel"], "profile": {{ "paraboloid": {{ "radius": 0.002 }} }},
                "friction": 2.0, "normal": "coupled", "at": {{ "b": {{ "x": {x}, "z": -0.02 }} }} }}"#
        )
    };
    let text = |beyond: f64| {
        format!(
            r#"{{ "stickslip": 1, "bodies": {{ "b": {{ "mass": 0.05, "inertia": 3e-6, "x": "free", "z": "free", "pitch": "free" }} }},
                "contacts": {{ "front": {}, "rear": {} }}, "gravity": {{}}, "loads": [ {{ "on": "b", "x": {} }} ],
                "run": {{ "duration": 1e-3, "start": "equilibrium" }} }}"#,
            foot(8e-3),
            foot(-8e-3),
            0.05 * 9.80665 * 0.4 * (1.0 + beyond)
        )
    };
    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("block.json"), folder.path().join("out"));
    std::fs::write(&file, text(2e-5)).unwrap();
    check(
        &run(&file, &out, &[]),
        &["run.start: `b` has no static equilibrium in pitch: ", "\n   help: reduce the load"],
    );
    assert_eq!(listing(folder.path()), ["block.json"]);
    std::fs::write(&file, text(-2e-5)).unwrap();
    assert_eq!(code(&run(&file, &out, &[])), 0);
}

#[test]
fn a_run_with_more_rows_than_fit_is_refused() {
    refused(
        "\"10 us\" },\n  \"plots\"",
        "\"1 ns\" },\n  \"plots\"",
        "\"1 ns\"",
        "output.every: the run would have 1.000e8 rows",
    );
}

#[test]
fn a_run_with_more_looks_than_fit_is_refused() {
    let from = "\"10 us\" },\n  \"plots\"";
    let with = |output: &str| format!("\"10 us\", {output} }},\n  \"plots\"");
    let springs = "{ \"every\": \"100 ns\" }";
    let message = "output.springs: 101 springs at 1.000e6 times give 1.010e8 lines, expected at most 2.778e7";
    refused(from, &with(&format!("\"springs\": {springs}")), springs, message);
    let memory = "{ \"every\": \"1 us\" }";
    let message = "output.memory: 1.000e5 curves of up to 16384 corners may give 1.638e9 lines, expected at most 4.167e7";
    refused(from, &with(&format!("\"memory\": {memory}")), memory, message);
    // Asked for by a picture, with rows that are fine enough.
    let to = "\"100 ns\" },\n  \"plots\":  [ \"state\", \"loop\", \"trajectory\" ]";
    refused(
        "\"10 us\" },\n  \"plots\":  [ \"loop\", \"trajectory\" ]",
        to,
        "\"state\"",
        "plots[0]: 101 springs at ",
    );
}

#[test]
fn overrides_are_checked_like_the_file() {
    let out = tempdir().unwrap();
    let results = out.path().join("results");
    for (set, message) in [
        ("contacts.ball.friction=-1", "--set contacts.ball.friction=-1  contacts.ball.friction: expected"),
        ("contacts.bell.friction=1", "did you mean \"ball\"?"),
        ("output.channels=[\"ball.x_m\"]", "output.channels[0]: there is no channel \"ball.x_m\""),
        (
            "plots=[\"loop\", {\"x\": \"ball.u_m\", \"y\": [\"ball.fn_N\", \"ball.fx_M\"]}]",
            "plots[1].y[1]: there is no channel \"ball.fx_M\" with numbers",
        ),
        (
            "plots=[{\"x\": \"time_s\", \"y\": \"ball.state\"}]",
            "plots[0].y: there is no channel \"ball.state\" with numbers",
        ),
    ] {
        check(&run(&scenario("quickstart"), &results, &[set]), &[message]);
        assert!(!results.exists(), "{set}");
    }
}

#[test]
fn usage_is_explained() {
    let call = |arguments: &[&str]| stickslip().args(arguments).output().unwrap();
    for arguments in
        [&[][..], &["run"], &["run", "a.json", "--set", "no"], &["run", "a.json", "--threads", "0"]]
    {
        check(&call(arguments), &["Usage"].map(|word| if arguments.len() > 2 { "error" } else { word }));
    }
    check(&call(&["run", "nowhere/a.json"]), &["nowhere/a.json: there is no such file"]);
}

#[test]
fn a_bad_file_does_not_keep_the_others_from_running() {
    let out = tempdir().unwrap();
    let bad = out.path().join("bad.json");
    std::fs::write(&bad, "{").unwrap();
    let mut command = stickslip();
    command.arg("run").arg(&bad).arg(scenario("oblique_loading")).arg("--out").arg(out.path());
    let output = command.output().unwrap();
    assert_eq!(code(&output), 2);
    assert!(stdout(&output).starts_with("oblique_loading: "));
    assert_eq!(listing(out.path()), ["bad.json", "oblique_loading"]);
}

#[test]
fn files_of_one_name_do_not_overwrite_each_other() {
    let out = tempdir().unwrap();
    let copy = out.path().join("oblique_loading.json");
    std::fs::copy(scenario("oblique_loading"), &copy).unwrap();
    let mut command = stickslip();
    command
        .arg("run")
        .arg(scenario("oblique_loading"))
        .arg(&copy)
        .arg("--out")
        .arg(out.path().join("results"));
    let output = command.output().unwrap();
    assert_eq!(code(&output), 2);
    let place = format!("{}: its results folder ", copy.display());
    assert!(stderr(&output).starts_with(&place), "{}", stderr(&output));
}

#[test]
fn a_folder_that_cannot_be_made_is_bad_input() {
    let out = tempdir().unwrap();
    let taken: &Path = &out.path().join("taken");
    std::fs::write(taken, "a file").unwrap();
    check(&run(&scenario("oblique_loading"), taken, &[]), &["cannot be created", "--out"]);
}
