//! `stickslip map`: a result over two parameters. Borders are tested beside the library; here is what is written and said.

use crate::program::{Table, code, listing, scenario, stderr, stdout, stickslip};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::tempdir;

const FORCE: &str = "contacts.ball.normal.force";
const AMPLITUDE: &str = "waveforms.drive.sine.amplitude";

/// The template of a fretting contact.
fn fretting(folder: &Path) -> PathBuf {
    let file = folder.join("fretting.json");
    let made = stickslip()
        .arg("new")
        .arg(file.with_extension(""))
        .args(["--template", "fretting"])
        .output()
        .unwrap();
    assert_eq!(code(&made), 0, "{}", stderr(&made));
    file
}

fn map(file: &Path, out: &Path, [x, y, of]: [&str; 3]) -> Command {
    let mut map = stickslip();
    map.arg("map").arg(file).args(["--x", x, "--y", y, "--of", of]).arg("--out").arg(out);
    map
}

fn output(file: &Path, out: &Path, asked: [&str; 3], more: &[&str]) -> Output {
    map(file, out, asked).args(more).output().unwrap()
}

#[test]
fn a_border_is_written_drawn_and_told() {
    let root = tempdir().unwrap();
    let (file, out) = (fretting(root.path()), root.path().join("out"));
    let table = root.path().join("measured.csv");
    fs::write(&table, "x,y,regime\n5,0.3 um,partial\n10 N,1e-6,gross\n").unwrap();
    let asked = [&*format!("{FORCE}=1N..20N"), &*format!("{AMPLITUDE}=50nm..1.5um"), "contacts.ball.regime"];
    let told = output(&file, &out, asked, &["--overlay", table.to_str().unwrap(), "--format", "png,svg"]);
    assert_eq!(code(&told), 0, "{}", stderr(&told));
    for said in
        ["border between partial and gross: ", "computed without runs", "map.csv, map.png, map.svg, map.json"]
    {
        assert!(stdout(&told).contains(said), "{}", stdout(&told));
    }
    assert_eq!(listing(&out), ["map.csv", "map.json", "map.png", "map.svg"]);
    let rows = Table::read(&out.join("map.csv"));
    assert_eq!(rows.head, ["x", "y", "result"]);
    assert!(rows.column("result").len() == 33 * 33 && rows.column("result").contains(&"partial"));
    let found: Value = serde_json::from_slice(&fs::read(out.join("map.json")).unwrap()).unwrap();
    assert_eq!((&found["borders"][0]["between"], &found["runs"]), (&json!(["partial", "gross"]), &json!(0)));
    assert!(found["borders"][0]["points"].as_array().unwrap().len() >= 12);
    let picture = fs::read_to_string(out.join("map.svg")).unwrap();
    for word in ["partial", "gross", "measured: gross", "(N)", "(µm)", FORCE] {
        assert!(picture.contains(word), "{word}");
    }
    // One thread or two, the same bytes; and as a line of JSON.
    let again = root.path().join("again");
    let printed = output(&file, &again, asked, &["--threads", "1", "--json", "--quiet"]);
    assert_eq!(fs::read(again.join("map.csv")).unwrap(), fs::read(out.join("map.csv")).unwrap());
    let printed: Value = serde_json::from_str(&stdout(&printed)).unwrap();
    assert_eq!(printed["borders"], found["borders"]);
}

/// A killed map of runs loses the parts under way and no more.
#[cfg(unix)]
#[test]
fn a_killed_map_continues_to_the_same_bytes() {
    let root = tempdir().unwrap();
    let (whole, out) = (root.path().join("whole"), root.path().join("out"));
    let asked = ["contacts.ball.friction=0.05..0.5", "bodies.slider.mass=5g..50g", "steps.last_m"];
    let more = ["--set", "run.cycles=40", "--quiet", "--threads", "1", "--points", "24"];
    let begun = Instant::now();
    assert_eq!(code(&output(&scenario("p1"), &whole, asked, &more)), 0);
    let mut child = map(&scenario("p1"), &out, asked).args(more).stdout(Stdio::null()).spawn().unwrap();
    std::thread::sleep(Duration::from_secs_f64(0.5 * begun.elapsed().as_secs_f64()));
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(code(&output(&scenario("p1"), &out, asked, &more)), 0);
    assert_eq!(listing(&out), ["map.csv", "map.json", "map.png", "parts"]);
    assert_eq!(listing(&out.join("parts")), listing(&whole.join("parts")));
    for name in ["map.csv", "map.json", "map.png"] {
        assert_eq!(fs::read(out.join(name)).unwrap(), fs::read(whole.join(name)).unwrap(), "{name}");
    }
    // Another map has parts of its own, and those of this one stay. A value of what varies does not count, nor an earlier one of two.
    let set = ["--set", "contacts.ball.friction=0.3", "--set", "run.cycles=4", "--set", "run.cycles=3"];
    let other = ["contacts.ball.friction=0.05..0.4", asked[1], asked[2]];
    let other = output(&scenario("p1"), &out, other, &[&set[..], &["--quiet", "--points", "3"]].concat());
    assert_eq!(code(&other), 0, "{}", stderr(&other));
    let both = listing(&out.join("parts"));
    assert!(
        both.len() == 2 && listing(&whole.join("parts")).iter().all(|one| both.contains(one)),
        "{both:?}"
    );
}

#[test]
fn bad_input_is_refused() {
    let root = tempdir().unwrap();
    let (file, out) = (fretting(root.path()), root.path().join("out"));
    let (x, y, of) = (format!("{FORCE}=1N..20N"), format!("{AMPLITUDE}=50nm..1.5um"), "contacts.ball.regime");
    let table = root.path().join("measured.csv");
    fs::write(&table, "x,y\n5,much\n").unwrap();
    let overlay = ["--overlay", table.to_str().unwrap()];
    let cases: [(i32, &str, [&str; 3], &[&str]); 9] = [
        (2, "did you mean \"force\"?", ["contacts.ball.normal.forse=1..2", &y, of], &[]),
        (2, "--x  expected a range that rises", ["contacts.ball.normal.force=2..1", &y, of], &[]),
        (2, "--x  expected FROM..TO", ["contacts.ball.normal.force=2", &y, of], &[]),
        (2, "another parameter", [&x, &x, of], &[]),
        (2, "did you mean \"ball\"?", [&x, &y, "contacts.bal.regime"], &[]),
        (2, "did you mean \"contacts.ball.peak_fx_N\"?", [&x, &y, "contacts.ball.peak_fx_n"], &[]),
        (2, "line 2, column y: expected a number", [&x, &y, of], &overlay),
        (3, "no point of the map has the result", [&x, "contacts.ball.friction=-2..-1", of], &[]),
        (
            3,
            "no point of the map has the result",
            [&x, &y, "contacts.ball.normal.open_share"],
            &["--points", "2"],
        ),
    ];
    for (wanted, words, asked, more) in cases {
        let said = output(&file, &out, asked, more);
        let text = stderr(&said);
        assert!(code(&said) == wanted && text.contains(words), "{words}: {} {text}", code(&said));
        assert!(!out.join("map.json").exists());
    }
    fs::write(root.path().join("taken"), "").unwrap();
    let said = output(&file, &root.path().join("taken"), [&x, &y, of], &[]);
    assert!(code(&said) == 2 && stderr(&said).contains("--out"), "{}", stderr(&said));
}
