//! `stickslip export fmu`: what is in the file, and what is refused. `.ci/capi` runs the FMUs in hosts.

use crate::program::{code, scenario, stderr, stdout, stickslip};
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

fn export(folder: &Path, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("library.so"), b"a library").unwrap();
    let library = ["--library", "library.so"];
    stickslip().args(["export", "fmu"]).args(arguments).args(library).current_dir(folder).output().unwrap()
}

#[test]
fn an_fmu_has_the_same_bytes_each_time() {
    let folder = tempdir().unwrap();
    let file = scenario("commanded");
    let file = file.to_str().unwrap();
    for (version, words) in [("2", "FMI 2.0, 4 inputs"), ("3", "FMI 3.0, 4 inputs")] {
        for out in ["a.fmu", "b.fmu"] {
            let output = export(folder.path(), &[file, "--fmi", version, "--out", out]);
            assert_eq!((code(&output), stderr(&output)), (0, String::new()));
            assert!(stdout(&output).starts_with(&format!("{out}: {words}")), "{}", stdout(&output));
        }
        let [a, b] = ["a.fmu", "b.fmu"].map(|out| std::fs::read(folder.path().join(out)).unwrap());
        assert!(a == b && a.starts_with(b"PK"));
    }
}

#[test]
fn what_no_host_could_use_is_refused() {
    let folder = tempdir().unwrap();
    let drive = scenario("quickstart");
    let drive = drive.to_str().unwrap();
    let refused = |arguments: &[&str], wanted: &str| {
        let mut all = vec![drive];
        all.extend(arguments);
        let output = export(folder.path(), &all);
        assert!(code(&output) == 2 && stderr(&output).contains(wanted), "{}", stderr(&output));
        assert!(!folder.path().join("quickstart.fmu").exists());
    };
    refused(&["--parameter", "contacts.bal.friction"], "did you mean \"ball\"?");
    refused(&["--parameter", "contacts.ball.count"], "this is a count");
    refused(&["--parameter", "contacts.ball.damping"], "the scenario gives no value");
    refused(&["--set", r#"interface.outputs=["slider.x"]"#], "there is no channel \"slider.x\"");
    refused(&["--set", r#"interface.inputs=["drive"]"#], "neither of kind `input` nor `generator`");
    refused(&["--set", r#"interface.inputs=["dive"]"#], "did you mean \"drive\"?");
    refused(&["--set", "run.stepper=dopri5"], "dopri5");
    let output = stickslip()
        .args(["export", "fmu", drive, "--library", "nowhere.so"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(code(&output) == 2 && stderr(&output).contains("cargo build"), "{}", stderr(&output));
}

#[test]
fn the_interface_chooses() {
    let folder = tempdir().unwrap();
    let file = scenario("quickstart");
    let set = r#"interface={"outputs":["slider.x_m","ball.state"],"parameters":["bodies.slider.mass"]}"#;
    let arguments = [file.to_str().unwrap(), "--set", set, "--parameter", "contacts.ball.friction"];
    let output = export(folder.path(), &arguments);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert!(stdout(&output).contains("0 inputs, 2 outputs, 2 parameters"), "{}", stdout(&output));
}
