//! Runs repeated from the pictures they left.

use crate::program::{code, listing, run, run_example, scenario, stderr, stdout, stickslip};
use sha2::Digest;
use std::path::{Path, PathBuf};
use std::process::Output;
use stickslip_plot::{Figure, Label, Panel, draw_png, read_text};
use tempfile::tempdir;

/// `stickslip repro` of a picture.
fn repro(picture: &Path, options: &[&str]) -> Output {
    stickslip().arg("repro").arg(picture).args(options).output().unwrap()
}

/// What a picture carries.
struct Carried(Vec<(String, String)>);

impl Carried {
    fn by(picture: &Path) -> Self {
        Self(read_text(&std::fs::read(picture).unwrap()).unwrap())
    }

    fn get(&self, key: &str) -> &str {
        self.0.iter().find(|(found, _)| found == key).map(|(_, text)| text.as_str()).unwrap()
    }

    /// The same with another text.
    fn with(&self, key: &str, text: &str) -> Self {
        let other = self.0.iter().filter(|(found, _)| found != key).cloned();
        Self(other.chain([(key.to_owned(), text.to_owned())]).collect())
    }

    /// The same with another scenario, whose hash is right.
    fn with_scenario(&self, from: &str, to: &str) -> Self {
        let scenario = self.get("Scenario");
        assert!(scenario.contains(from), "{from} in {scenario}");
        let scenario = scenario.replacen(from, to, 1);
        let hash = sha2::Sha256::digest(scenario.as_bytes());
        let hash: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
        self.with("Scenario", &scenario).with("Scenario SHA-256", &hash)
    }

    /// A picture that carries this; the folder goes with its guard.
    fn picture(self) -> (tempfile::TempDir, PathBuf) {
        let folder = tempdir().unwrap();
        let path = folder.path().join("picture.png");
        let title = Label::plain(self.get("Title"));
        let figure =
            Figure { title, panels: vec![Panel::default()], provenance: self.0, ..Figure::default() };
        std::fs::write(&path, draw_png(&figure).unwrap()).unwrap();
        (folder, path)
    }

    /// What `repro` says about such a picture.
    fn repeated(self) -> (i32, String, String) {
        let (_folder, path) = self.picture();
        let output = repro(&path, &[]);
        let bare = |text: String| text.replace(path.to_str().unwrap(), "PICTURE");
        (code(&output), bare(stdout(&output)), bare(stderr(&output)))
    }
}

const SHORT: &str = "run.duration=30 ms";

#[test]
fn a_picture_of_a_run_is_reproduced() {
    let out = tempdir().unwrap();
    let cases: [(&str, &[&str]); 6] = [
        ("quickstart", &[SHORT]),
        (
            "quickstart",
            &[SHORT, "run.stepper={\"verlet\":{\"step\":\"1 us\"}}", "title=", "run.limits.wall=60 s"],
        ),
        ("quickstart", &[SHORT, "output={\"channels\": [\"ball.state\", \"slider.x_m\"]}"]),
        ("p1", &["waveforms.drive.sawtooth.flyback=0", "run.limits.steps=1000"]),
        ("p1", &["run.until_steady=1e-4"]),
        ("oblique_loading", &[]),
    ];
    for (name, set) in cases {
        let plots = r#"plots=["loop", "state"]"#;
        let ran = run(&scenario(name), out.path(), &[set, &[plots, "output.springs.count=40"]].concat());
        assert!([0, 3].contains(&code(&ran)), "{name}: {}", stderr(&ran));
        let folder = out.path().join(name);
        let drawn =
            stickslip().arg("plot").arg(&folder).args(["--plots", "trajectory", "--format", "svg"]).output();
        let pictures: &[&str] = if code(&drawn.unwrap()) == 0 {
            &["loop.png", "trajectory.svg"]
        } else {
            &["loop.png", "state.png"]
        };
        for picture in pictures {
            let output = repro(&folder.join(picture), &[]);
            assert_eq!(
                (code(&output), stderr(&output)),
                (0, String::new()),
                "{name} {set:?}: {}",
                stdout(&output)
            );
            assert!(stdout(&output).contains(&format!("{picture}: identical: ")), "{}", stdout(&output));
            let is_short = code(&ran) == 3 || set.iter().any(|set| set.contains("until_steady"));
            assert_eq!(stdout(&output).contains(" events until t = "), is_short);
        }
    }
}

/// A picture may come from anybody, and what it carries may take for ever.
#[test]
fn a_picture_whose_run_takes_too_long_is_not_waited_for() {
    let out = tempdir().unwrap();
    let set =
        ["run.stepper={\"verlet\":{\"step\":\"1 us\"}}", SHORT, "plots=[\"loop\"]", "run.limits.wall=60 s"];
    assert_eq!(code(&run(&scenario("quickstart"), out.path(), &set)), 0);
    let picture = out.path().join("quickstart/loop.png");
    let output = repro(&picture, &["--wall", "1 ns"]);
    assert_eq!((code(&output), stdout(&output)), (3, String::new()));
    let said = stderr(&output);
    assert!(said.contains("loop.png: the limit of 0.000000001 s of wall time was reached at t = "), "{said}");
    assert!(said.contains("nothing compared\n   help: allow more time with --wall"), "{said}");
    let output = repro(&picture, &["--wall", "10 min"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[cfg(unix)]
#[test]
fn a_picture_of_an_interrupted_run_is_reproduced_to_the_same_step() {
    let out = tempdir().unwrap();
    let mut command = stickslip();
    command.arg("run").arg(scenario("quickstart")).arg("--out").arg(out.path());
    // Some minutes; looks up at every 1024th step.
    command.args(["--set", "run.stepper={\"verlet\":{\"step\":\"1 ns\"}}", "--set", SHORT]);
    let child = command.stdout(std::process::Stdio::null()).spawn().unwrap();
    let folder = out.path().join("quickstart");
    while !(folder.exists() && listing(&folder).len() >= 2) {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    std::thread::sleep(std::time::Duration::from_millis(200));
    std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(code(&child.wait_with_output().unwrap()), 130);
    let output = repro(&folder.join("loop.png"), &["--out", out.path().join("again").to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let [first, second] =
        [&folder, &out.path().join("again")].map(|f| std::fs::read(f.join("trace.csv")).unwrap());
    assert!(first == second && stdout(&output).contains(" until t = "));
}

#[test]
fn the_results_of_the_repeated_run_are_left_where_asked() {
    let out = tempdir().unwrap();
    let folder = run_example("quickstart", out.path(), &[SHORT]);
    let again = out.path().join("again");
    let output = repro(&folder.join("trajectory.png"), &["--out", again.to_str().unwrap(), "-q"]);
    assert_eq!((code(&output), stdout(&output)), (0, String::new()));
    assert_eq!(listing(&folder), listing(&again));
    for name in listing(&folder).iter().filter(|name| *name != "summary.json") {
        assert!(
            std::fs::read(folder.join(name)).unwrap() == std::fs::read(again.join(name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn a_run_that_departs_is_told_from_when() {
    // The load on the slider is the same until 10.2 ms, where its table has a corner in any case.
    let out = tempdir().unwrap();
    let table = r#"loads=[{"on":"slider","x":{"follows":{"table":{"points":[[0,-0.02],[0.0102,-0.02],[1,-0.02]]}}}}]"#;
    let folder = run_example("quickstart", out.path(), &[SHORT, table]);
    let carried = Carried::by(&folder.join("loop.png")).with_scenario("[1.0,-0.02]", "[1.0,-2.02]");
    let (code, said, _) = carried.repeated();
    assert_eq!(code, 1, "{said}");
    // Blocks of 64 rows, 10 µs apart: the 16th begins at 10.24 ms, the 15th at 9.6 ms.
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        lines[0].starts_with("PICTURE: differs: channel ")
            && lines[0].ends_with(" from t = 0.009600000000000001 s, within 64 rows")
    );
    assert!(
        said.contains("differs: channel slider.x_m from t = 0.0096") && said.contains("more columns of rows")
    );
    assert!(said.contains("differs: events' slider.x_m from t = 0.01"), "{said}");
}

#[test]
fn one_changed_digest_names_its_channel_and_time() {
    let out = tempdir().unwrap();
    let folder = run_example("quickstart", out.path(), &[SHORT]);
    let carried = Carried::by(&folder.join("loop.png"));
    let mut print: serde_json::Value = serde_json::from_str(carried.get("Fingerprint")).unwrap();
    let column = &mut print["trace"]["columns"][3];
    assert_eq!(column["name"], "slider.x_m");
    let mut digests = column["digests"].as_str().unwrap().to_owned();
    // The sixth block of 64 rows begins with row 320.
    digests.replace_range(80..81, if &digests[80..81] == "0" { "1" } else { "0" });
    column["digests"] = digests.into();
    let (code, said, _) = carried.with("Fingerprint", &print.to_string()).repeated();
    assert_eq!(
        (code, said.as_str()),
        (1, "PICTURE: differs: channel slider.x_m from t = 0.0032 s, within 64 rows\n")
    );
}

#[test]
fn another_version_is_told_and_compared_all_the_same() {
    let out = tempdir().unwrap();
    let folder = run_example("oblique_loading", out.path(), &[]);
    let carried = Carried::by(&folder.join("loop.png")).with("Software", "stickslip 0.0.9");
    let (code, said, noted) = carried.repeated();
    assert_eq!(code, 0);
    assert!(said.starts_with("PICTURE: identical: 701 rows of 18 channels, "), "{said}");
    assert_eq!(noted, "PICTURE: note: computed by stickslip 0.0.9, this is stickslip 0.1.0\n");
}

#[test]
fn pictures_of_something_else_are_refused() {
    let out = tempdir().unwrap();
    let said = |name: &str, bytes: &[u8]| {
        std::fs::write(out.path().join(name), bytes).unwrap();
        let output = repro(&out.path().join(name), &[]);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()));
        stderr(&output).replace(&format!("{}/", out.path().display()), "")
    };
    let plain = draw_png(&Figure { panels: vec![Panel::default()], ..Figure::default() }).unwrap();
    let help = "\n   help: plots of `stickslip run` and `plot` contain their scenario, unless another program has written the file again\n";
    let none = "plain.png: contains no scenario: the text \"Software\" is missing";
    assert_eq!(said("plain.png", &plain), format!("{none}{help}"));
    assert_eq!(
        said("text.png", b"no picture"),
        "text.png: is not a readable PNG or SVG file: neither PNG nor SVG\n"
    );
    assert!(said("empty.png", b"").contains("neither PNG nor SVG"));
    assert!(said("page.svg", b"<html></html>").contains("neither PNG nor SVG"));
    assert!(said("cut.svg", b"<svg><metadata>").contains("is not a readable PNG or SVG file: SVG: "));
    let folder = run_example("oblique_loading", out.path(), &[]);
    let mut picture = std::fs::read(folder.join("loop.png")).unwrap();
    let place = picture.windows(9).position(|w| w == b"Scenario\0").unwrap();
    picture[place + 40] ^= 1;
    assert_eq!(said("broken.png", &picture), "broken.png: is not a readable PNG or SVG file: PNG: damaged\n");
    assert!(
        said("short.png", &picture[..place])
            .starts_with("short.png: is not a readable PNG or SVG file: PNG: ")
    );
    let huge = std::fs::File::create(out.path().join("huge.png")).unwrap();
    huge.set_len(65 << 20).unwrap();
    let output = repro(&out.path().join("huge.png"), &[]);
    assert!(stderr(&output).ends_with("huge.png: is larger than 67108864 bytes\n"), "{}", stderr(&output));
    let missing = repro(&out.path().join("none.png"), &[]);
    assert_eq!(code(&missing), 2);
    assert!(stderr(&missing).ends_with("none.png: cannot be read: No such file or directory\n"));
    let folder = repro(out.path(), &[]);
    assert!(code(&folder) == 2 && stderr(&folder).ends_with(": cannot be read: not a file\n"));
}

#[test]
fn what_a_stranger_wrote_into_a_picture_passes_all_checks_or_is_refused() {
    let out = tempdir().unwrap();
    let folder = run_example("oblique_loading", out.path(), &[]);
    let carried = Carried::by(&folder.join("loop.png"));
    let refused = |carried: Carried| {
        let (code, said, why) = carried.repeated();
        assert_eq!((code, said.as_str()), (2, ""), "{why}");
        why
    };
    let why = refused(carried.with_scenario("\"friction\": 0.3", "\"friction\": -0.3"));
    assert!(
        why.starts_with("PICTURE (its scenario):") && why.contains("contacts.ball.friction: expected"),
        "{why}"
    );
    // A resolved scenario has its tables in it; no file is opened.
    std::fs::write(out.path().join("points.csv"), "t,x\n0,0\n1,1\n").unwrap();
    let points = carried.get("Scenario").split_once("\"slide\"").unwrap().1;
    let (_, points) = points.split_once("\"points\": ").unwrap();
    let points = &points[..=points.find("]]").unwrap() + 1];
    for file in ["points.csv", "/etc/passwd"] {
        let table = format!("\"file\": \"{file}\", \"time\": \"t\", \"value\": \"x\"");
        let why = refused(carried.with_scenario(&format!("\"points\": {points}"), &table));
        assert!(
            why.contains("waveforms.slide.table.file: this scenario has no folder, so it cannot name files"),
            "{why}"
        );
    }
    let why = refused(carried.with("Scenario", &carried.get("Scenario").replace("0.3", "0.31")));
    assert_eq!(
        why,
        "PICTURE: its \"Scenario\" is damaged: it does not match the \"Scenario SHA-256\" in the file\n"
    );
    let why = refused(carried.with("Fingerprint", "{}"));
    assert!(why.starts_with("PICTURE: its \"Fingerprint\" is damaged: missing field"), "{why}");
    let why = refused(carried.with("Simulated/s", "later"));
    assert_eq!(why, "PICTURE: its \"Simulated/s\" is damaged: expected a number, got \"later\"\n");
    // 65 megabytes in as many kilobytes.
    let why = refused(carried.with("Scenario", &" ".repeat(65 << 20)));
    assert!(why.starts_with("PICTURE: is not a readable PNG or SVG file: PNG: "), "{why}");
}
