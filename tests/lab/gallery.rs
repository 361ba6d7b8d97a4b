//! The gallery and its page.

use crate::program::{code, lab, listing, run_example, scenario, stderr, stdout};
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

/// `stickslip-lab gallery` of a folder's scenarios.
fn gallery(folder: &Path, out: &Path) -> Output {
    lab().arg("gallery").arg("--scenarios").arg(folder).arg("--out").arg(out).output().unwrap()
}

/// Puts an example, changed, into a folder.
fn put(folder: &Path, name: &str, changes: &[(&str, &str)]) {
    let mut text = std::fs::read_to_string(scenario(name)).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{from} in {name}");
        text = text.replacen(from, to, 1);
    }
    std::fs::write(folder.join(format!("{name}.json")), text).unwrap();
}

#[test]
fn the_gallery_has_the_pictures_of_run_and_a_page_that_names_their_commands() {
    let root = tempdir().unwrap();
    let (scenarios, out) = (root.path().join("my scenarios"), root.path().join("plots"));
    std::fs::create_dir(&scenarios).unwrap();
    put(&scenarios, "oblique_loading", &[("Oblique loading", "Oblique *loading* <b>")]);
    put(&scenarios, "quickstart", &[("100 ms", "20 ms")]);
    std::fs::create_dir_all(out.join("quickstart")).unwrap();
    std::fs::write(out.join("quickstart/phase-dark.png"), "of an earlier scenario").unwrap();
    let output = gallery(&scenarios, &out);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert!(
        stdout(&output).ends_with("plots: 5 pictures of 2 scenarios, README.md\n"),
        "{}",
        stdout(&output)
    );
    assert_eq!(listing(&out), ["README.md", "oblique_loading", "quickstart"]);
    // Small ones as SVG, too.
    let names =
        ["loop-dark.png", "loop.png", "loop.svg", "trajectory-dark.png", "trajectory.png", "trajectory.svg"];
    assert_eq!(listing(&out.join("quickstart")), names);
    let ran = run_example("quickstart", root.path(), &["run.duration=20 ms"]);
    for name in ["loop.png", "trajectory.png"] {
        let [drawn, shown] = [&ran, &out.join("quickstart")].map(|f| std::fs::read(f.join(name)).unwrap());
        assert!(drawn == shown, "{name}");
    }
    let page = std::fs::read_to_string(out.join("README.md")).unwrap();
    for text in [
        "\n## Oblique &#42;loading&#42; &lt;b&gt;, then normal",
        "\n[`quickstart`](../my%20scenarios/quickstart.json): `stickslip run \"",
        "**state** – what every spring under a contact does over time: `stickslip plot results/oblique_loading --plots state`",
        "<source media=\"(prefers-color-scheme: dark)\" srcset=\"quickstart/loop-dark.png\">\n  <img src=\"quickstart/loop.png\"",
        "([dark](oblique_loading/loop-dark.png), [SVG](oblique_loading/loop.svg))",
    ] {
        assert!(page.contains(text), "{text} in {page}");
    }
    // The same once more.
    let before = std::fs::read(out.join("oblique_loading/state-dark.png")).unwrap();
    assert_eq!(code(&gallery(&scenarios, &out)), 0);
    assert!(before == std::fs::read(out.join("oblique_loading/state-dark.png")).unwrap());
    assert_eq!(page, std::fs::read_to_string(out.join("README.md")).unwrap());
}

#[test]
fn a_gallery_that_is_not_complete_has_no_page() {
    let root = tempdir().unwrap();
    let (scenarios, out) = (root.path().join("scenarios"), root.path().join("plots"));
    std::fs::create_dir(&scenarios).unwrap();
    let refused = |want: i32, message: &str| {
        let output = gallery(&scenarios, &out);
        assert_eq!((code(&output), stdout(&output)), (want, String::new()));
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
        assert!(!out.join("README.md").exists());
    };
    refused(2, "scenarios: has no scenarios, files NAME.json");
    put(&scenarios, "quickstart", &[("\"friction\": 0.2", "\"friction\": -0.2")]);
    put(&scenarios, "oblique_loading", &[]);
    refused(2, "contacts.ball.friction");
    assert!(!out.exists());
    put(
        &scenarios,
        "quickstart",
        &[("\"duration\": \"100 ms\"", "\"duration\": \"100 ms\", \"limits\": { \"steps\": 50 }")],
    );
    refused(3, "quickstart: the limit of 50 steps was reached at t = ");
}

#[test]
fn the_gallery_of_the_project_is_whole() {
    let scenarios = scenario("p1");
    let scenarios = scenarios.parent().unwrap();
    let plots = scenarios.join("../plots");
    let page = std::fs::read_to_string(plots.join("README.md")).unwrap();
    let (mut kinds, mut pictures) = (Vec::new(), 0);
    for file in listing(scenarios).iter().filter(|file| file.ends_with(".json")) {
        let name = file.strip_suffix(".json").unwrap();
        assert!(
            page.contains(&format!("[`{name}`](../scenarios/{file})")),
            "run stickslip-lab gallery: no {name}"
        );
        let text = std::fs::read_to_string(scenarios.join(file)).unwrap();
        let scenario: serde_json::Value = serde_json::from_str(&text).unwrap();
        for plot in scenario["plots"].as_array().unwrap() {
            let plot = plot.as_str().unwrap().to_owned();
            assert!(
                page.contains(&format!("`stickslip plot results/{name} --plots {plot}`")),
                "run stickslip-lab gallery"
            );
            pictures += 1;
            kinds.push(plot);
        }
    }
    kinds.sort();
    kinds.dedup();
    assert_eq!(
        kinds,
        ["drive", "energy", "events", "layout", "loop", "memory", "phase", "state", "trajectory"]
    );
    assert!(pictures >= 10);
    for link in page.split(['"', '(', ')']).filter(|link| link.ends_with(".png") || link.ends_with(".svg")) {
        assert!(plots.join(link).is_file(), "run stickslip-lab gallery: no {link}");
    }
}

#[test]
fn a_folder_without_scenarios_is_bad_input_and_nothing_is_written() {
    let root = tempdir().unwrap();
    let (none, empty) = (root.path().join("none"), root.path().join("empty"));
    std::fs::create_dir(&empty).unwrap();
    for (folder, message) in [
        (&none, "none: expected a folder of scenarios: No such file or directory\n   help: "),
        (&empty, "empty: has no scenarios, files NAME.json\n   help: "),
    ] {
        let output = gallery(folder, &root.path().join("out"));
        assert!(code(&output) == 2 && stderr(&output).contains(message), "{}", stderr(&output));
    }
    assert!(!root.path().join("out").exists());
}
