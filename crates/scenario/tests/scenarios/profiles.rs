//! Profiles in scenarios and in files: they must equal those of the contact crate for the same numbers.

use std::fs;
use std::path::Path;
use stickslip_contact::{Profile, SelfAffine};
use stickslip_scenario::Scenario;

/// Loads a scenario with one contact of a profile, in a folder.
fn load(profile: &str, folder: &Path) -> Scenario {
    let text = format!(
        r#"{{ "stickslip": 1, "materials": {{ "m": {{ "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 }} }},
            "waveforms": {{ "w": {{ "sine": {{ "amplitude": "10 nm", "period": 1 }} }} }},
            "bodies": {{ "rig": {{ "x": {{ "follows": "w" }} }} }},
            "contacts": {{ "c": {{ "between": ["rig", "ground"], "materials": ["m", "m"], "friction": 0.3,
                "profile": {profile}, "normal": {{ "indentation": "5 nm" }} }} }},
            "run": {{ "duration": 1 }} }}"#
    );
    Scenario::from_str(&text, "s.json", folder).unwrap_or_else(|error| panic!("{error}"))
}

fn profile(scenario: &Scenario) -> &Profile {
    scenario.scene.contacts[0].part.interface.profile()
}

/// Checks that a scenario has this profile, also after it is resolved and read again.
#[track_caller]
fn is(text: &str, folder: &Path, want: &Profile, word: &str) {
    let scenario = load(text, folder);
    assert_eq!(profile(&scenario), want);
    assert_eq!(scenario.profile_of(0), Some(word));
    let again = Scenario::from_str(&scenario.resolved(), "resolved.json", "").unwrap();
    assert_eq!(profile(&again), want);
    assert_eq!(again.resolved(), scenario.resolved());
}

#[test]
fn closed_forms_are_those_of_the_numbers_given() {
    let here = Path::new("");
    is(
        r#"{ "truncated_cone": { "flat": "20 um", "slope": 0.01 } }"#,
        here,
        &Profile::truncated_cone(20e-6, 0.01).unwrap(),
        "truncated_cone",
    );
    is(
        r#"{ "truncated_paraboloid": { "flat": "20 um", "radius": "5 mm" } }"#,
        here,
        &Profile::truncated_paraboloid(20e-6, 5e-3).unwrap(),
        "truncated_paraboloid",
    );
    is(
        r#"{ "rounded_flat": { "flat": "20 um", "radius": "5 mm" } }"#,
        here,
        &Profile::rounded_flat(20e-6, 5e-3).unwrap(),
        "rounded_flat",
    );
    is(
        r#"{ "tipped_paraboloid": { "radius": "5 mm", "tip": "2 um" } }"#,
        here,
        &Profile::tipped_paraboloid(5e-3, 2e-6).unwrap(),
        "tipped_paraboloid",
    );
    is(
        r#"{ "powers": { "terms": [{ "coefficient": 100, "exponent": 2 }, { "coefficient": 3, "exponent": 1.37 }] } }"#,
        here,
        &Profile::powers(&[(100.0, 2.0), (3.0, 1.37)]).unwrap(),
        "powers",
    );
}

#[test]
fn points_and_lines_are_read_from_files_in_their_units() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("worn.csv", "f (nm),note,r_um\n0,a,0\n0,b,10\n12.5,c,15\n30,d,20\n");
    let points = [(0.0, 0.0), (10e-6, 0.0), (15e-6, 12.5e-9), (20e-6, 30e-9)];
    let want = Profile::table(&points, &[10e-6]).unwrap();
    let file = r#"{ "table": { "file": "worn.csv", "radius": "r", "gap": "f", "kinks": ["10 um"] } }"#;
    is(file, folder.path(), &want, "table");
    let here = r#"{ "table": { "points": [[0, 0], ["10 um", 0], ["15 um", "12.5 nm"], ["20 um", "30 nm"]], "kinks": [1e-5] } }"#;
    is(here, Path::new(""), &want, "table");
    write("line.csv", "z [nm]\n-3\n0\n12\n7\n");
    let want = Profile::rough(&[-3e-9, 0.0, 12e-9, 7e-9], 1e-6).unwrap();
    let file = r#"{ "rough": { "file": "line.csv", "height": "z", "spacing": "1 um" } }"#;
    is(file, folder.path(), &want, "rough");
    let here = r#"{ "rough": { "heights": ["-3 nm", 0, "12 nm", "7 nm"], "spacing": "1 um" } }"#;
    is(here, Path::new(""), &want, "rough");
    write("law.csv", "d (nm),F (mN)\n0,0\n5,1\n10,3\n");
    let file = r#"{ "normal_law": { "file": "law.csv", "indentation": "d", "force": "F" } }"#;
    let scenario = load(file, folder.path());
    // The points are forces, independent of E*.
    let law = &scenario.scene.contacts[0].part.interface;
    for (d, force) in [(5e-9, 1e-3), (10e-9, 3e-3)] {
        assert!((law.normal_force(d) / force - 1.0).abs() < 1e-13);
        assert!((law.indentation(force) / d - 1.0).abs() < 1e-13);
    }
    assert_eq!(scenario.profile_of(0), Some("normal_law"));
}

#[test]
fn a_line_made_by_numbers_keeps_its_recipe() {
    let line = SelfAffine {
        rms: 20e-9,
        hurst: 0.8,
        longest: 20e-6,
        shortest: 1e-6,
        length: 100e-6,
        points: 256,
        seed: 7,
    };
    let want = Profile::rough(&line.heights().unwrap(), 100e-6 / 256.0).unwrap();
    let text = r#"{ "rough": { "self_affine": { "rms": "20 nm", "hurst": 0.8, "longest": "20 um", "shortest": "1 um", "length": "100 um", "points": 256, "seed": 7 } } }"#;
    is(text, Path::new(""), &want, "rough");
    assert!(load(text, Path::new("")).resolved().contains("self_affine"));
}

/// Line of a profilometer with a preamble, tabs, decimal commas and a tilt of 1 %. The positions give the spacing, `level` removes the
/// tilt, and `within` crops it.
#[test]
fn lines_of_instruments_are_read_and_levelled() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |k: i32| 20.0 * (0.5 * f64::from(k)).sin();
    let mut text = "Scan 7\n\nLateral\tHeight\num\tnm\n".to_owned();
    for k in 0..100 {
        let place = 0.2 * f64::from(k);
        text += &format!("{place:.1}\t{:.6}\n", 5.0 + 10.0 * place + wave(k)).replace('.', ",");
    }
    fs::write(folder.path().join("line.txt"), text).unwrap();
    let heights = |more: &str| -> (f64, Vec<f64>) {
        let scenario =
            load(&format!(r#"{{ "rough": {{ "file": "line.txt", "recipe": {{}}{more} }} }}"#), folder.path());
        let resolved: serde_json::Value = serde_json::from_str(&scenario.resolved()).unwrap();
        let rough = &resolved["contacts"]["c"]["profile"]["rough"];
        let all = rough["heights"].as_array().unwrap().iter().map(|height| height.as_f64().unwrap());
        (rough["spacing"].as_f64().unwrap(), all.collect())
    };
    let (spacing, plain) = heights("");
    assert!((spacing - 0.2e-6).abs() < 1e-15 && (plain[3] - 1e-9 * (11.0 + wave(3))).abs() < 1e-14);
    let (_, level) = heights(r#", "level": "line""#);
    // A least-squares fit leaves neither a mean nor a first moment.
    let moment: f64 = level.iter().enumerate().map(|(k, height)| k as f64 * height).sum();
    assert!(level.iter().sum::<f64>().abs() < 1e-20 && moment.abs() < 1e-18);
    assert!((level[40] - level[37] - 1e-9 * (wave(40) - wave(37))).abs() < 0.3e-9);
    let (_, part) = heights(r#", "within": ["2 um", "4 um"]"#);
    assert_eq!(part, plain[10..=20]);
}
