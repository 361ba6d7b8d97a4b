//! `stickslip new`: what it writes runs at once.

use crate::program::{Table, code, listing, number, run, stderr, stdout, stickslip, summary};
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

fn new(folder: &Path, arguments: &[&str]) -> Output {
    stickslip().arg("new").args(arguments).current_dir(folder).output().unwrap()
}

const NAMES: [&str; 15] = [
    "drive",
    "datasheet",
    "piezo",
    "fretting",
    "oblique",
    "vibration",
    "linear",
    "six_balls",
    "smooth_impact",
    "walking",
    "vertical",
    "assisted",
    "rotary",
    "hobby",
    "oscillator",
];

#[test]
fn every_template_runs_at_once_and_satisfies_the_schema_it_names() {
    let folder = tempdir().unwrap();
    let listed = stdout(&new(folder.path(), &["--list"]));
    assert!(listing(folder.path()).is_empty());
    let names: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(names, NAMES);
    for name in names {
        let output = new(folder.path(), &[name, "--template", name]);
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        assert!(stdout(&output).contains(&format!("stickslip run {name}.json")), "{}", stdout(&output));
        let file = folder.path().join(format!("{name}.json"));
        let scenario: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
        assert!(listed.contains(scenario["title"].as_str().unwrap()));
        // As an editor does: the address is relative to the file.
        let schema = folder.path().join(scenario["$schema"].as_str().unwrap());
        let schema: Value = serde_json::from_slice(&std::fs::read(schema).unwrap()).unwrap();
        assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&scenario), "{name}");
        let output = run(&file, &folder.path().join("results"), &[]);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
    }
}

/// What a drive's description says of it.
struct Preset {
    name: &'static str,
    /// Peak to peak of the foot, or of a foot's way along the slide, m.
    stroke: f64,
    /// Share of the stroke that a mean step is at least and at most, its sign the direction.
    step: [f64; 2],
}

/// The rigid slider of a stick-slip drive steps by the stroke; what the springs of its contacts take back and what the load takes
/// is at most twice their u_c, 30 to 60 nm here.
const PRESETS: [Preset; 8] = [
    Preset { name: "linear", stroke: 300e-9, step: [0.6, 1.0] },
    Preset { name: "six_balls", stroke: 300e-9, step: [0.7, 1.0] },
    // One that always slips goes at 2bAω at most: 2πbA in a period, A a 2.2nd of the stroke.
    Preset { name: "smooth_impact", stroke: 440e-9, step: [0.35, 0.72] },
    // Two pairs carry it, each at most by its stroke.
    Preset { name: "walking", stroke: 480e-9, step: [1.2, 2.0] },
    Preset { name: "vertical", stroke: 400e-9, step: [0.6, 1.0] },
    // It goes as fast as its load lets it, below the rail's own speed.
    Preset { name: "assisted", stroke: 800e-9, step: [0.1, 3.0] },
    Preset { name: "rotary", stroke: 400e-9, step: [0.7, 1.0] },
    Preset { name: "hobby", stroke: 4.6e-6 * 20.0 / 120.0, step: [0.9, 1.0] },
];

/// Drives move the way that their page says, in steps below the stroke and by nearly all of it, in the range of published
/// stages; nothing is to be said against them.
#[test]
fn drives_of_the_templates_move_as_their_page_says() {
    let folder = tempdir().unwrap();
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../templates/README.md")).unwrap();
    for Preset { name, stroke, step } in PRESETS {
        assert_eq!(code(&new(folder.path(), &[name, "--template", name])), 0);
        let file = folder.path().join(format!("{name}.json"));
        let checked = stickslip().arg("check").arg(&file).output().unwrap();
        assert_eq!((code(&checked), stderr(&checked)), (0, String::new()), "{}", stdout(&checked));
        assert!(!stdout(&checked).contains("warning"), "{}", stdout(&checked));
        let out = folder.path().join("results");
        assert_eq!(code(&run(&file, &out, &[])), 0);
        let told = summary(&out.join(name));
        let speed = number(&told, "/steps/mean_speed_m_s");
        let mean = number(&told, "/steps/net_travel_m") / number(&told, "/steps/periods");
        let share = mean / stroke;
        assert!(share >= step[0] && share <= step[1], "{name}: {share}");
        assert!((10e-9..=1e-6).contains(&mean), "{name}: {mean:e}");
        assert!((1e-5..=2e-2).contains(&speed), "{name}: {speed:e}");
        let row = page.lines().find(|line| line.starts_with(&format!("| `{name}`"))).unwrap_or_default();
        let said = format!("{:.0} nm", mean * 1e9);
        assert!(row.contains(&said), "{name}: {said} is not in {row}");
    }
}

/// A data sheet is filled in by `--set`; nothing is warned of, and there is a picture of the drive's electronics.
#[test]
fn a_data_sheet_makes_a_drive() {
    let folder = tempdir().unwrap();
    assert_eq!(code(&new(folder.path(), &["motor", "--template", "datasheet"])), 0);
    let file = folder.path().join("motor.json");
    let checked = stickslip().arg("check").arg(&file).output().unwrap();
    assert_eq!((code(&checked), stdout(&checked).contains("warning")), (0, false), "{}", stderr(&checked));
    let stack = "actuators.stack";
    let numbers =
        [("stroke", "9 um"), ("voltage", "100 V"), ("capacitance", "3 uF"), ("stiffness", "50 N/um")];
    let sheet = numbers.map(|(key, value)| format!("{stack}.data_sheet.{key}={value}"));
    let others = [
        format!("{stack}.driver.current=5 A"),
        "bodies.stage.mass=50 g".to_owned(),
        "run.cycles=2".to_owned(),
    ];
    let set: Vec<&str> = sheet.iter().chain(&others).map(String::as_str).collect();
    let out = folder.path().join("results");
    let output = run(&file, &out, &set);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let pictures = listing(&out.join("motor")).into_iter().filter(|name| name.ends_with(".png")).count();
    assert!(pictures >= 2);
    let told = summary(&out.join("motor"));
    // 9 um at 100 V make 9 um of the sawtooth of 100 V; the stage follows by less.
    let step = number(&told, "/steps/last_m");
    assert!(step > 5e-6 && step < 9e-6, "{step:e}");
}

/// Coulomb friction takes 2μF_N/k of the amplitude in every half period, and the block stops where the spring is weaker than friction.
#[test]
fn the_oscillator_loses_the_same_amplitude_every_half_period() {
    let folder = tempdir().unwrap();
    assert_eq!(code(&new(folder.path(), &["block", "--template", "oscillator"])), 0);
    let out = folder.path().join("results");
    assert_eq!(code(&run(&folder.path().join("block.json"), &out, &["output.every=10 us"])), 0);
    let table = Table::read(&out.join("block").join("trace.csv"));
    let x: Vec<f64> = table.column("block.x_m").iter().map(|word| word.parse().unwrap()).collect();
    let turns: Vec<f64> = x
        .windows(3)
        .filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0 && w[1].abs() > 1e-4)
        .map(|w| w[1])
        .collect();
    // μF_N/k = 0.1 · 10 N / 10 kN/m, about which each half period swings; partial slip moves it by less than u_c = 1 µm.
    let expected = [-0.8e-3, 0.6e-3, -0.4e-3, 0.2e-3];
    assert_eq!(turns.len(), expected.len(), "{turns:?}");
    for (turn, expected) in turns.iter().zip(expected) {
        assert!((turn - expected).abs() < 2e-6, "{turns:?}");
    }
}

#[test]
fn the_name_is_drive_unless_another_is_given_and_may_have_a_folder_and_an_ending() {
    let folder = tempdir().unwrap();
    assert_eq!(code(&new(folder.path(), &[])), 0);
    assert_eq!(listing(folder.path()), ["drive.json", "schema"]);
    assert_eq!(listing(&folder.path().join("schema")), ["scenario-1.json"]);
    assert_eq!(code(&new(folder.path(), &["rig/v1.2"])), 0);
    assert_eq!(code(&new(folder.path(), &["rig/motor.json"])), 0);
    assert_eq!(listing(&folder.path().join("rig")), ["motor.json", "schema", "v1.2.json"]);
}

/// What comes next can be typed as it stands.
#[test]
fn a_name_of_several_words_is_quoted() {
    let folder = tempdir().unwrap();
    for (name, word) in [("one", "one.json"), ("two words", "\"two words.json\""), ("it's", "\"it's.json\"")]
    {
        let said = String::from_utf8(new(folder.path(), &[name]).stdout).unwrap();
        assert!(said.ends_with(&format!("next: stickslip run {word}\n")), "{said}");
    }
}

#[test]
fn a_scenario_is_never_overwritten() {
    let folder = tempdir().unwrap();
    std::fs::write(folder.path().join("drive.json"), "mine").unwrap();
    let output = new(folder.path(), &[]);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()));
    assert!(stderr(&output).starts_with("drive.json: is there already\n"), "{}", stderr(&output));
    assert_eq!(listing(folder.path()), ["drive.json"]);
    assert_eq!(std::fs::read_to_string(folder.path().join("drive.json")).unwrap(), "mine");
}

#[test]
fn an_older_schema_is_renewed_and_a_stranger_is_left_alone() {
    let folder = tempdir().unwrap();
    let schema = folder.path().join("schema/scenario-1.json");
    assert_eq!(code(&new(folder.path(), &["a"])), 0);
    let now = std::fs::read_to_string(&schema).unwrap();
    std::fs::write(&schema, now.replacen("Materials by name", "Stuff", 1)).unwrap();
    assert_eq!(code(&new(folder.path(), &["b"])), 0);
    assert_eq!(std::fs::read_to_string(&schema).unwrap(), now);
    std::fs::write(&schema, "{}").unwrap();
    let output = new(folder.path(), &["c"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("scenario-1.json: is there already and is no schema of stickslip"));
    assert_eq!(std::fs::read_to_string(&schema).unwrap(), "{}");
    assert_eq!(listing(folder.path()), ["a.json", "b.json", "schema"]);
}

#[test]
fn the_schema_may_lie_elsewhere() {
    let folder = tempdir().unwrap();
    assert_eq!(code(&new(folder.path(), &["--schema", "https://example.org/a \"b\".json"])), 0);
    assert_eq!(listing(folder.path()), ["drive.json"]);
    let text = std::fs::read_to_string(folder.path().join("drive.json")).unwrap();
    let scenario: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(scenario["$schema"], "https://example.org/a \"b\".json");
}

#[test]
fn a_file_without_a_name_is_not_made() {
    let folder = tempdir().unwrap();
    for name in ["motors/", ".json", "motors/.json", "."] {
        let output = new(folder.path(), &[name]);
        assert_eq!(code(&output), 2, "{name}");
        assert_eq!(
            stderr(&output),
            format!("{name}: expected the name of a file, such as motor or drives/motor\n")
        );
    }
    assert!(listing(folder.path()).is_empty());
}

#[test]
fn a_template_that_is_not_there_is_refused_with_those_that_are() {
    let folder = tempdir().unwrap();
    let output = new(folder.path(), &["--template", "peizo"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("piezo"), "{}", stderr(&output));
    assert!(listing(folder.path()).is_empty());
}
