//! `stickslip view`: what is in the page, and what is refused. `.ci/page` opens pages in a browser.

use crate::program::{code, scenario, stderr, stdout, stickslip};
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

const PAGE: &str = "<p>before</p><script id=\"scenes\" type=\"application/json\">[]</script><script id=\"engine\">x</script>";

fn view(folder: &Path, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("page.html"), PAGE).unwrap();
    let page = ["--page", "page.html"];
    stickslip().arg("view").args(arguments).args(page).current_dir(folder).output().unwrap()
}

/// The page contains the resolved scenarios, whatever their texts contain, and nothing else has changed.
#[test]
fn a_page_contains_the_resolved_scenarios() {
    let folder = tempdir().unwrap();
    let title = r#"title="</script><!-- <b>""#;
    let (drive, impact) = (scenario("quickstart"), scenario("measured_impact"));
    let files = [drive.to_str().unwrap(), impact.to_str().unwrap()];
    let output = view(folder.path(), &[files[0], files[1], "--set", title, "--out", "talk.html"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert_eq!(stdout(&output), "talk.html: 2 scenarios, 0.00 MB\n");
    let page = std::fs::read_to_string(folder.path().join("talk.html")).unwrap();
    let [open, close] = PAGE.split("[]").collect::<Vec<_>>()[..] else { panic!("one list") };
    let list = page.strip_prefix(open).and_then(|rest| rest.strip_suffix(close)).unwrap();
    assert!(!list.contains("</") && !list.contains("<!--"), "{list}");
    let list: serde_json::Value = serde_json::from_str(list).unwrap();
    let names: Vec<_> = list.as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["quickstart", "measured_impact"]);
    let text: serde_json::Value = serde_json::from_str(list[0]["text"].as_str().unwrap()).unwrap();
    assert_eq!(text["title"], "</script><!-- <b>");
    assert_eq!(text["contacts"]["ball"]["normal"]["force"], 0.3);
    // The table of a file is part of the page.
    assert!(!list[1]["text"].as_str().unwrap().contains("\"file\""));
}

#[test]
fn without_page_or_scenario_nothing_is_written() {
    let folder = tempdir().unwrap();
    let drive = scenario("quickstart");
    let drive = drive.to_str().unwrap();
    let refused = |output: &Output, wanted: &str| {
        assert!(code(output) == 2 && stderr(output).contains(wanted), "{}", stderr(output));
        assert!(!folder.path().join("quickstart.html").exists());
    };
    refused(&view(folder.path(), &[drive, "--set", "contacts.ball.friction=-1"]), "contacts.ball.friction");
    refused(&view(folder.path(), &["none.json"]), "none.json");
    let other = |page: &str| {
        std::fs::write(folder.path().join("other.html"), "<p>no page of ours</p>").unwrap();
        stickslip().args(["view", drive, "--page", page]).current_dir(folder.path()).output().unwrap()
    };
    refused(&other("missing.html"), "`.ci/page` makes it");
    refused(&other("other.html"), "is not the page of stickslip");
}
