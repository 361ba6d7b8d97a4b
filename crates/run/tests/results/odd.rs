//! Implausible scenarios: `tests/odd/NAME.json` runs and gives the warnings in `tests/odd/NAME.txt`.
//!
//! For a new case, write the JSON, run `STICKSLIP_WRITE=1 cargo test -p stickslip-run --test results odd`, and check the written file.

use std::fs;
use std::path::{Path, PathBuf};
use stickslip_run::Job;

const STIFFNESS: &str = "actuators.stack.data_sheet.stiffness";
const CAPACITANCE: &str = "actuators.stack.data_sheet.capacitance";
const PRESS: &str = "contacts.ball.normal.force";

fn example(name: &str) -> PathBuf {
    Path::new("../../scenarios").join(name).with_extension("json")
}

fn files(folder: &str) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    files
}

fn job(path: &Path) -> Job {
    Job::prepare(path, &[], Path::new("")).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn odd_scenes_are_warned_of_word_for_word() {
    let (mut wrong, mut kinds) = (Vec::new(), Vec::new());
    let files = files("tests/odd");
    assert!(files.len() >= 20, "only {} scenes", files.len());
    for path in files {
        let warnings = job(&path).warnings();
        kinds.extend(warnings.iter().map(|warning| warning.kind));
        let told: Vec<String> = warnings.iter().map(|odd| format!("{}: {odd}", odd.kind)).collect();
        let told = told.join("\n");
        let beside = path.with_extension("txt");
        if std::env::var_os("STICKSLIP_WRITE").is_some() {
            fs::write(&beside, format!("{told}\n")).unwrap();
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if expected.trim_end() != told || warnings.len() != 1 {
            wrong.push(format!("{}\nexpected\n{expected}\ngot\n{told}\n", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    kinds.sort_unstable();
    kinds.dedup();
    let all = [
        "damping",
        "driver_chatters",
        "endless",
        "frames_under_damping",
        "frames_under_impacts",
        "frames_under_limits",
        "friction",
        "geometry",
        "load",
        "mass",
        "modulus",
        "pressure",
        "resonance",
        "step",
        "stiff_driver",
        "stroke",
        "tolerance",
    ];
    assert_eq!(kinds, all);
}

const NONE: (&str, &str) = ("run.duration", "20 ms");
const STEEL: (&str, &str) = ("contacts.ball.materials", r#"["ruby", "steel"]"#);
const FLYBACK: &str = "waveforms.drive.sawtooth.flyback";

/// An example, a key, a value outside the bounds and one inside, another override, and the kind and words of the warning.
type Slip = (&'static str, &'static str, [&'static str; 2], (&'static str, &'static str), [&'static str; 2]);

const SLIPS: [Slip; 9] = [
    ("driven_stage", "bodies.stage.mass", ["100 kg", "25 kg"], NONE, ["mass", "a mass of 100.0 kg exceeds"]),
    (
        "driven_stage",
        STIFFNESS,
        ["0.1 N/m", "0.2 N/um"],
        NONE,
        ["stiffness", "a stiffness of 100.0 mN/m is outside"],
    ),
    (
        "driven_stage",
        STIFFNESS,
        ["100 N/mm", "1 N/um"],
        NONE,
        ["stiffness", "a stiffness of 100.0 kN/m is outside"],
    ),
    (
        "driven_stage",
        STIFFNESS,
        ["11000 N/um", "10000 N/um"],
        NONE,
        ["stiffness", "200.0 kN/m to 10.00 GN/m"],
    ),
    (
        "driven_stage",
        CAPACITANCE,
        ["7.2 mF", "1 mF"],
        NONE,
        ["capacitance", "a capacitance of 7.200 mF is outside"],
    ),
    (
        "quickstart",
        "contacts.ball.damping",
        ["1.6 us", "1.4 us"],
        NONE,
        ["damping_time", "a damping time of 1.600 µs is 0.16 of the shortest flank"],
    ),
    // 2a = 18.16 µm divided by √(G/ρ) = 3.208 km/s in steel: 5.661 ns per passage.
    (
        "quickstart",
        FLYBACK,
        ["56 ns", "57 ns"],
        NONE,
        ["flank", "a flank of 56.00 ns is shorter than 56.61 ns"],
    ),
    // For the voltage of a stack, 2a = 58.4 µm: ten passages take 91 ns.
    ("driven_stage", FLYBACK, ["10 ns", "1 us"], NONE, ["flank", "a flank of 10.00 ns is shorter than"]),
    // 1.07 of 355 MPa: 1.159 GPa under 300 mN, and pressures go with the third root of the force.
    (
        "quickstart",
        PRESS,
        ["10.6 mN", "10.5 mN"],
        STEEL,
        ["pressure", "structural steel, with a yield stress of up to 355.0 MPa"],
    ),
];

/// A wrong unit prefix gives a warning with the number and the bound. Values within the bounds give none.
#[test]
fn slips_of_a_prefix_are_warned_of_and_what_lies_inside_the_bounds_is_not() {
    for (name, path, [outside, inside], beside, [kind, words]) in SLIPS {
        let kinds = |value: &str| {
            let set = [beside, (path, value)].map(|(path, value)| (path.to_owned(), value.to_owned()));
            let job =
                Job::prepare(&example(name), &set, Path::new("")).unwrap_or_else(|error| panic!("{error}"));
            job.warnings().into_iter().filter(|warning| warning.kind == kind).collect::<Vec<_>>()
        };
        let (odd, plausible) = (kinds(outside), kinds(inside));
        assert!(odd.len() == 1 && odd[0].message.contains(words), "{path} {outside}: {odd:?}");
        assert_eq!(plausible, [], "{path} {inside}");
    }
}

/// All examples are free of warnings.
#[test]
fn the_examples_are_plausible() {
    let folders = ["../../scenarios", "../../templates", "../../docs/piezo", "../../docs/realtime"];
    for path in folders.into_iter().flat_map(files) {
        let job = job(&path);
        assert_eq!(job.warnings(), [], "{}", path.display());
        assert_eq!(stickslip_run::warning::of_scenario(&job), []);
    }
}

/// A scenario with thousands of implausible values reports the first ones in a short time.
#[test]
fn many_oddities_are_told_of_the_first() {
    let mut text = String::from(
        r#"{ "stickslip": 1, "run": { "duration": 1 }, "materials": { "brass": { "youngs_modulus": "100 GPa", "poisson_ratio": 0.3 } },
            "waveforms": { "w": { "triangle": { "stroke": "1 um", "period": 1 } } },
            "bodies": { "foot": { "x": { "follows": "w" } } }, "contacts": {"#,
    );
    for c in 0..5_000 {
        let comma = if c == 0 { "" } else { "," };
        text += &format!(
            r#"{comma} "c{c}": {{ "between": ["ground", "foot"], "materials": ["brass", "brass"], "friction": 0.2,
                "profile": {{ "paraboloid": {{ "radius": "1 mm" }} }}, "normal": {{ "force": "100 N" }} }}"#
        );
    }
    text += "} }";
    let scenario = stickslip_scenario::Scenario::from_str(&text, "odd.json", "").unwrap();
    let warnings = Job::new(scenario, "odd".to_owned(), "".into()).unwrap().warnings();
    assert_eq!(warnings.len(), 20);
    assert!(warnings[19].help.as_ref().unwrap().ends_with("; 4980 more warnings are not shown"));
}
