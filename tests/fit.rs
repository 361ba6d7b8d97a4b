//! Numbers of scenarios that fit what was measured.

use crate::program::{code, run, stderr, stdout, stickslip};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

const FREE: &str = "contacts.ball.friction,contacts.ball.profile.paraboloid.radius";
const BALL: &str = r#"{"stickslip": 1, "bodies": {"rig": {"x": {"follows": {"sine": {"amplitude": "200 nm", "period": "1 s"}}}}},
    "contacts": {"ball": {"between": ["rig", "ground"], "materials": ["hardened steel", "hardened steel"],
        "profile": {"paraboloid": {"radius": "4 mm"}}, "friction": 0.5, "normal": {"force": "10 N"}}},
    "run": {"cycles": 2}}"#;
/// Of the drawn loops: μ, F_N (N), R (m).
const TRUTH: [f64; 3] = [0.6, 10.0, 5e-3];

/// Random numbers of deviation 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        let mut uniform = || {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
        };
        let radius = (-2.0 * uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * uniform()).cos()
    }
}

/// A closed loop of so many u_c (Cattaneo 1938, Mindlin 1949: power 3/2; a cone: 2), 200 points even in u, noise of 1 % of μF_N on the force.
fn table(share: f64, power: f64, seed: u64) -> String {
    let [friction, load, radius] = TRUTH;
    let (young, poisson) = (210e9, 0.3);
    let plane = young / (2.0 * (1.0 - poisson * poisson));
    let shear = young / (1.0 + poisson) / (2.0 - poisson);
    let indentation = (0.75 * load / plane / radius.sqrt()).powf(2.0 / 3.0);
    let gross = friction * plane / shear * indentation;
    let virgin = |u: f64| friction * load * (1.0 - (1.0 - (u / gross).min(1.0)).powf(power));
    let (amplitude, mut random) = (share * gross, Random(seed.wrapping_mul(7919) + 1));
    let mut text = "disp (um),force (N)\n".to_owned();
    for row in 0..200 {
        let way = 2.0 * amplitude * f64::from(row % 100) / 100.0;
        let sign = if row < 100 { 1.0 } else { -1.0 };
        let force = sign * (virgin(amplitude) - 2.0 * virgin(0.5 * way));
        let noisy = force + 0.01 * friction * load * random.next();
        writeln!(text, "{},{noisy}", 1e6 * sign * (amplitude - way)).unwrap();
    }
    text
}

fn fit(folder: &Path, table: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("ball.json"), BALL).unwrap();
    fs::write(folder.join("rig.csv"), table).unwrap();
    let command = ["fit", "ball.json", "--data", "rig.csv", "--out", "out"];
    stickslip().args(command).args(arguments).current_dir(folder).output().unwrap()
}

fn told(output: &Output) -> Value {
    assert_eq!(code(output), 0, "{}", stderr(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Standard deviations against the bounds of Cramér and Rao of an independent computation, in %: of μ, and of k = 2G*a, in which the radius is by its cube root.
#[test]
fn errors_are_those_of_cramer_and_rao() {
    let folder = tempdir().unwrap();
    for (share, friction, stiffness) in [(0.4, 2.0, 0.36), (0.7, 0.41, 0.19), (0.95, 0.16, 0.13)] {
        let (mut told_of, mut inside, count) = ([0.0; 2], 0, 12);
        for seed in 0..count {
            let told = told(&fit(folder.path(), &table(share, 1.5, seed), &["--free", FREE, "--json"]));
            for (k, (path, exact)) in FREE.split(',').zip([TRUTH[0], TRUTH[2]]).enumerate() {
                let number = |key: &str| told["parameters"][path][key].as_f64().unwrap();
                told_of[k] += 100.0 * number("sd") / number("value") / count as f64;
                inside += i32::from(number("low") <= exact && exact <= number("high"));
            }
            assert!(told["runs"].as_u64().unwrap() <= 100, "{told}");
            assert_eq!(told["model_fits"], true, "{told}");
        }
        assert!((told_of[0] / friction - 1.0).abs() < 0.15, "{share}: {told_of:?}");
        assert!((told_of[1] / 3.0 / stiffness - 1.0).abs() < 0.15, "{share}: {told_of:?}");
        // 24 intervals of 95 %: fewer than 20 inside once in 200 times.
        assert!(inside >= 20, "{share}: {inside}");
    }
}

#[test]
fn what_the_data_cannot_tell_is_refused_by_name() {
    let folder = tempdir().unwrap();
    let ball = table(0.7, 1.5, 1);
    let with = |more: &str| format!("contacts.ball.friction,{more}");
    for (free, said) in [
        (
            with("contacts.ball.normal.force"),
            "cannot distinguish contacts.ball.friction and contacts.ball.normal.force",
        ),
        (
            "contacts.ball.profile.paraboloid.radius,contacts.ball.materials[0].young".to_owned(),
            "the scenario has no value at this path",
        ),
        (with("contacts.ball.profile.paraboloid.radiuss"), "did you mean \"radius\"?"),
        (with("run.cycles"), "this key sets execution or output of the run"),
    ] {
        let output = fit(folder.path(), &ball, &["--free", &free]);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{free}");
        assert!(stderr(&output).contains(said), "{free}: {}", stderr(&output));
        assert!(!folder.path().join("out").exists());
    }
    for (text, said) in [
        ("u (um),F (N)\n0,1\n1,1\n2,1\n1,1\n0,1\n1,1\n2,1\n1,1\n0,1\n", "its forces are constant"),
        ("u (um),F (N)\n0,0\n1,1\n", "no cycle closes"),
    ] {
        let output = fit(folder.path(), text, &["--free", FREE]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
    for (channel, said) in
        [("disp=rag.x", "there is no channel rag.x"), ("way=rig.x", "there is no column \"way\"")]
    {
        let output = fit(folder.path(), &ball, &["--free", FREE, "--displacement", channel]);
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
}

/// The loop of a cone for that of a ball: what is left is no noise. Drawn data sets give the same errors as the theory.
#[test]
fn the_wrong_profile_is_flagged_and_drawn_data_agree() {
    let folder = tempdir().unwrap();
    let arguments = ["--free", FREE, "--json"];
    for share in [0.7, 0.95] {
        let told = told(&fit(folder.path(), &table(share, 2.0, 5), &arguments));
        assert_eq!(told["model_fits"], false, "{told}");
    }
    let [linear, drawn] = [&[][..], &["--bootstrap", "200"]]
        .map(|more| told(&fit(folder.path(), &table(0.7, 1.5, 3), &[&arguments, more].concat())));
    for path in FREE.split(',') {
        let [linear, drawn] = [&linear, &drawn].map(|told| told["parameters"][path]["sd"].as_f64().unwrap());
        assert!((drawn / linear - 1.0).abs() < 0.2, "{path}: {drawn:e}, not {linear:e}");
    }
}

/// A rig led along what was measured, with its spring between it and the contact: rows of a run of the true numbers give them back; so do rows of a
/// trajectory of a block that slides on a spring.
#[test]
fn rigs_and_trajectories_give_their_numbers_back() {
    let folder = tempdir().unwrap();
    let rig = r#"{"stickslip": 1, "bodies": {"rig": {"x": {"follows": {"sine": {"amplitude": "1.2 um", "period": "1 s"}}}}, "holder": {"x": "balanced"}},
        "springs": {"arm": {"between": ["rig", "holder"], "direction": "x", "stiffness": "20 N/um"}},
        "contacts": {"ball": {"between": ["holder", "ground"], "materials": ["hardened steel", "hardened steel"],
            "profile": {"sphere": {"radius": "5 mm"}}, "friction": 0.6, "normal": {"force": "10 N"}}},
        "run": {"cycles": 3}, "output": {"every": "5 ms"}}"#;
    let block = r#"{"stickslip": 1, "bodies": {"block": {"mass": "1 kg", "x": "free"}},
        "loads": [{"on": "block", "x": {"follows": {"sine": {"amplitude": "3 N", "period": "0.15 s"}}}}],
        "springs": {"arm": {"between": ["block", "ground"], "direction": "x", "stiffness": "1 N/mm"}},
        "contacts": {"ball": {"between": ["block", "ground"], "materials": ["hardened steel", "hardened steel"],
            "profile": {"paraboloid": {"radius": "5 mm"}}, "friction": 0.05, "normal": {"force": "5 N"}}},
        "run": {"duration": "0.4 s"}, "output": {"every": "2 ms"}}"#;
    for (name, text, channel, start, truth, within) in [
        ("rig", rig, "rig.x", "22 N/um", [0.6, 20e6], 2e-3),
        ("block", block, "block.x", "1.1 N/mm", [0.05, 1e3], 1e-4),
    ] {
        fs::write(folder.path().join(format!("{name}.json")), text).unwrap();
        assert_eq!(code(&run(&folder.path().join(format!("{name}.json")), folder.path(), &[])), 0);
        let output = stickslip()
            .args([
                "fit",
                &format!("{name}.json"),
                "--data",
                &format!("{name}/trace.csv"),
                "--time",
                "time_s",
                "--json",
            ])
            .args(["--free", "contacts.ball.friction,springs.arm.stiffness", "--out", "fitted"])
            .args(["--displacement", &format!("{channel}_m={channel}"), "--force", "ball.fx_N=ball.fx"])
            .args(["--set", &format!("springs.arm.stiffness=\"{start}\"")])
            .current_dir(folder.path())
            .output()
            .unwrap();
        let told = told(&output);
        for (path, exact) in ["contacts.ball.friction", "springs.arm.stiffness"].iter().zip(truth) {
            let value = told["parameters"][*path]["value"].as_f64().unwrap();
            assert!((value / exact - 1.0).abs() < within, "{path}: {value:e}");
        }
        assert_eq!(told["model_fits"], true, "{told}");
    }
}
