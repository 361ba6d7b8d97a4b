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
    assert!(stdout(&output).ends_with("plots: 5 pictures of 2 scenarios, index.md\n"), "{}", stdout(&output));
    assert_eq!(
        listing(&out),
        ["index.md", "oblique_loading", "oblique_loading.md", "quickstart", "quickstart.md"]
    );
    // Small ones as SVG, too.
    let names =
        ["loop-dark.png", "loop.png", "loop.svg", "trajectory-dark.png", "trajectory.png", "trajectory.svg"];
    assert_eq!(listing(&out.join("quickstart")), names);
    let ran = run_example("quickstart", root.path(), &["run.duration=20 ms"]);
    for name in ["loop.png", "trajectory.png"] {
        let [drawn, shown] = [&ran, &out.join("quickstart")].map(|f| std::fs::read(f.join(name)).unwrap());
        assert!(drawn == shown, "{name}");
    }
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let (index, page) = (read("index.md"), read("oblique_loading.md"));
    assert!(
        index.contains(
            "[`oblique_loading`](oblique_loading.md): Oblique &#42;loading&#42; &lt;b&gt;, then normal"
        ),
        "{index}"
    );
    for text in [
        "# Oblique &#42;loading&#42; &lt;b&gt;, then normal",
        "\nstickslip run \"",
        "\n## State\n\nStick and slip of each spring of a contact over time. `stickslip plot results/oblique_loading --plots state`",
        "srcset=\"oblique_loading/state-dark.png\"><img src=\"oblique_loading/state.png\"",
        "([SVG](oblique_loading/loop.svg))",
        "{{#include ../my scenarios/oblique_loading.json}}",
    ] {
        assert!(page.contains(text), "{text} in {page}");
    }
    // The same once more.
    let before = std::fs::read(out.join("oblique_loading/state-dark.png")).unwrap();
    assert_eq!(code(&gallery(&scenarios, &out)), 0);
    assert!(before == std::fs::read(out.join("oblique_loading/state-dark.png")).unwrap());
    assert_eq!((index, page), (read("index.md"), read("oblique_loading.md")));
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
        assert!(!out.join("index.md").exists());
    };
    refused(2, "scenarios: contains no scenario files NAME.json");
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
    let gallery = scenarios.join("../docs/examples");
    let index = std::fs::read_to_string(gallery.join("index.md")).unwrap();
    let mut kinds = std::collections::BTreeSet::new();
    for file in listing(scenarios).iter().filter(|file| file.ends_with(".json")) {
        let name = file.strip_suffix(".json").unwrap();
        assert!(index.contains(&format!("[`{name}`]({name}.md)")), "run stickslip-lab gallery: no {name}");
        let page = std::fs::read_to_string(gallery.join(format!("{name}.md"))).unwrap();
        let text = std::fs::read_to_string(scenarios.join(file)).unwrap();
        let scenario: serde_json::Value = serde_json::from_str(&text).unwrap();
        for plot in scenario["plots"].as_array().unwrap() {
            let plot = plot.as_str().unwrap_or("xy").to_owned();
            assert!(
                page.contains(&format!("`stickslip plot results/{name} --plots {plot}`")),
                "run stickslip-lab gallery"
            );
            kinds.insert(plot);
        }
        for link in
            page.split(['"', '(', ')']).filter(|link| link.ends_with(".png") || link.ends_with(".svg"))
        {
            assert!(gallery.join(link).is_file(), "run stickslip-lab gallery: no {link}");
        }
    }
    let all = ["drive", "energy", "events", "layout", "loop", "memory", "phase", "state", "trajectory", "xy"];
    assert!(kinds.iter().eq(all.iter()), "{kinds:?}");
}

#[test]
fn a_folder_without_scenarios_is_bad_input_and_nothing_is_written() {
    let root = tempdir().unwrap();
    let (none, empty) = (root.path().join("none"), root.path().join("empty"));
    std::fs::create_dir(&empty).unwrap();
    for (folder, message) in [
        (&none, "none: expected a folder of scenarios: No such file or directory\n   help: "),
        (&empty, "empty: contains no scenario files NAME.json\n   help: "),
    ] {
        let output = gallery(folder, &root.path().join("out"));
        assert!(code(&output) == 2 && stderr(&output).contains(message), "{}", stderr(&output));
    }
    assert!(!root.path().join("out").exists());
}
