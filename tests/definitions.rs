//! Whatever the program prints has its definition: `info`, `contact`, `check`, `validate` and a run with every output option.

use crate::program::{Table, code, listing, run, scenario, stderr, stdout, stickslip, summary};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;
use stickslip_quantity::Definition;
use tempfile::tempdir;

/// What the page docs/definitions.md says of columns and keys.
pub(crate) fn definitions() -> Vec<Definition> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/definitions.md");
    let page = std::fs::read_to_string(page).unwrap();
    let (mut file, mut all) = ("", Vec::new());
    for line in page.lines() {
        if let Some(name) = line.strip_prefix("## ") {
            file = name;
        } else if let Some((name, text)) = line.strip_prefix("| `").and_then(|rest| rest.split_once("` | ")) {
            let (name, text) = (name.to_owned().into(), text.trim_end_matches(" |").to_owned().into());
            all.push(Definition { file: file.to_owned().leak(), name, text });
        }
    }
    all
}

/// The page is what the program prints, and every number has a text.
#[test]
fn the_page_is_what_explain_prints() {
    let page = stdout(&stickslip().arg("explain").output().unwrap());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/definitions.md");
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        std::fs::write(&path, &page).unwrap();
    }
    assert_eq!(std::fs::read_to_string(path).unwrap(), page);
    let all = definitions();
    assert!(all.len() > 600, "{}", all.len());
    assert!(all.iter().all(|one| one.text.len() > 3), "{:?}", all.iter().find(|one| one.text.len() < 4));
}

fn defined(file: &str, name: &str) -> bool {
    definitions().iter().any(|definition| definition.defines(file, name))
}

/// Keys that hold values, as paths; names of parts stay what they are.
fn keys(value: &Value, here: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(entries) => {
            for (key, inner) in entries {
                // The dot of a file's or a coordinate's name is none of a path.
                let key = key.replace('.', " ");
                keys(inner, &if here.is_empty() { key } else { format!("{here}.{key}") }, found);
            }
        }
        Value::Array(entries) if entries.iter().any(Value::is_object) => {
            entries.iter().for_each(|inner| keys(inner, here, found));
        }
        // A list of nothing may be one of anything.
        Value::Array(entries) if entries.is_empty() => {}
        _ => drop(found.insert(here.to_owned())),
    }
}

/// What the answers of a command have and nobody defines.
fn lacking(file: &str, answers: &[Value]) -> Vec<String> {
    let mut found = BTreeSet::new();
    answers.iter().for_each(|answer| keys(answer, "", &mut found));
    assert!(found.len() > 5, "{found:?}");
    found.into_iter().filter(|name| !defined(file, name)).collect()
}

fn answers(arguments: &[&str]) -> Vec<Value> {
    let output = stickslip().args(arguments).output().unwrap();
    assert!(code(&output) != 3, "{}", stderr(&output));
    stdout(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn examples() -> Vec<String> {
    let folder = scenario("p1").parent().unwrap().to_owned();
    let names = listing(&folder).into_iter().filter(|name| name.ends_with(".json"));
    names.map(|name| folder.join(name).to_str().unwrap().to_owned()).collect()
}

#[test]
fn every_figure_of_info_is_defined() {
    let mut all: Vec<Value> = examples().iter().flat_map(|file| answers(&["info", "--json", file])).collect();
    assert!(all.len() > 15);
    // What the examples do not ask for: other steppers, every output, an early end, something odd.
    let sets: [&[&str]; 4] = [
        &[
            "run.stepper.verlet.step=10 us",
            "bodies.wall={}",
            "output.springs={}",
            "output.memory={}",
            "output.fields={}",
        ],
        &["run.stepper.frames.length=20 us"],
        &["run.until_steady=1e-6"],
        &["waveforms.drive.sawtooth.cycles=3", "gravity={}"],
    ];
    let file = scenario("quickstart");
    for set in sets {
        let set = set.iter().flat_map(|one| ["--set", one]);
        let arguments: Vec<&str> =
            ["info", "--json", file.to_str().unwrap()].into_iter().chain(set).collect();
        all.extend(answers(&arguments));
    }
    assert_eq!(all.len(), examples().len() + sets.len());
    assert_eq!(lacking("info --json", &all), Vec::<String>::new());
}

#[test]
fn every_figure_of_a_contact_by_itself_is_defined() {
    let (file, root) = (scenario("quickstart"), tempdir().unwrap());
    let (file, out) = (file.to_str().unwrap(), root.path().join("out"));
    let mut all = answers(&["contact", "--json", file]);
    all.extend(answers(&["contact", "--json", file, "--force", "1 N", "--tangential", "50 mN"]));
    let history = ["contact", "--json", file, "--history", "20 nm, -20 nm", "--out", out.to_str().unwrap()];
    all.extend(answers(&history));
    all.push(serde_json::from_slice(&std::fs::read(out.join("contact.json")).unwrap()).unwrap());
    assert_eq!(all.len(), 4);
    assert_eq!(lacking("contact.json", &all), Vec::<String>::new());
    let tables: Vec<String> = listing(&out).into_iter().filter(|name| name.ends_with(".csv")).collect();
    assert_eq!(tables.len(), 6);
    for name in tables {
        let head = Table::read(&out.join(&name)).head;
        let lacking: Vec<_> =
            head.iter().filter(|column| !defined(&format!("contact: {name}"), column)).collect();
        assert!(lacking.is_empty(), "{name}: {lacking:?}");
    }
}

#[test]
fn every_figure_of_a_branch_is_defined() {
    let (file, root) = (scenario("p1"), tempdir().unwrap());
    let (file, out) = (file.to_str().unwrap(), root.path().join("out"));
    let range = "waveforms.drive.sawtooth.stroke=30 nm..600 nm";
    let mut all = answers(&["branch", "--json", file, "--vary", range, "--out", out.to_str().unwrap()]);
    all.push(serde_json::from_slice(&std::fs::read(out.join("branch.json")).unwrap()).unwrap());
    assert!(all.len() == 2 && all[0]["special_points"][0]["changes"][0]["event"].is_string());
    assert_eq!(
        (&all[0]["ends"][0]["kind"], &all[0]["ends"][1]["kind"]),
        (&json!("shakedown"), &json!("range"))
    );
    assert_eq!(lacking("branch.json", &all), Vec::<String>::new());
    let head = Table::read(&out.join("branch.csv")).head;
    assert_eq!(head[0], "waveforms.drive.sawtooth.stroke_m");
    let lacking: Vec<_> = head[1..].iter().filter(|column| !defined("branch.csv", column)).collect();
    assert!(lacking.is_empty() && head.len() == 10, "{lacking:?}");
}

#[test]
fn every_figure_of_a_curve_is_defined() {
    let (file, root) = (scenario("ruby_drive"), tempdir().unwrap());
    let (file, out) = (file.to_str().unwrap(), root.path().join("out"));
    let out = out.to_str().unwrap();
    let ask =
        |more: &[&str]| answers(&[&["curve", "--json", file, "--points", "2", "--out", out], more].concat());
    let mut all = ask(&["--vary", "contacts.ball.friction=-0.1..0.2"]);
    all.extend(ask(&["--curve", "force-speed", "--both"]));
    let out = Path::new(out);
    all.push(serde_json::from_slice(&std::fs::read(out.join("curve.json")).unwrap()).unwrap());
    assert!(all.len() == 3 && all[0]["points"][0]["fault"].is_string() && all[2]["files"][0] == "curve.csv");
    assert_eq!(lacking("curve.json", &all), Vec::<String>::new());
    let head = Table::read(&out.join("curve.csv")).head;
    assert_eq!(head[0], "load_N");
    let unknown: Vec<_> = head.iter().filter(|column| !defined("curve.csv", column)).collect();
    assert!(unknown.is_empty() && head.len() == 13, "{unknown:?}");
    let all = ask(&["--curve", "holding-force", "--vary", "contacts.ball.friction=-0.1..0.2"]);
    assert!(all[0]["points"][0]["along_x"]["fault"].is_string() && all[0]["body"] == "slider");
    assert_eq!(lacking("curve.json", &all), Vec::<String>::new());
    let head = Table::read(&out.join("curve.csv")).head;
    // What is varied by its path has the name that it has in the scenario.
    let unknown: Vec<_> = head[1..].iter().filter(|column| !defined("curve.csv", column)).collect();
    assert!(unknown.is_empty() && head.len() == 9, "{unknown:?}");
    for (curve, of) in
        [("step-amplitude", "stroke_m"), ("speed-frequency", "frequency_Hz"), ("preload", "preload_N")]
    {
        ask(&["--curve", curve]);
        let head = Table::read(&out.join("curve.csv")).head;
        assert!(head[0] == of && defined("curve.csv", of), "{curve}: {}", head[0]);
    }
}

#[test]
fn every_figure_of_derivatives_is_defined() {
    let (file, root) = (scenario("driven_stage"), tempdir().unwrap());
    let (file, out) = (file.to_str().unwrap(), root.path().join("out"));
    let asked = ["--of", "steps.last_m", "--to", "waveforms.drive.sawtooth.stroke", "--set", "run.cycles=2"];
    let all = [&["sensitivity", "--json", file, "--out", out.to_str().unwrap()], &asked[..]].concat();
    let mut all = answers(&all);
    all.push(serde_json::from_slice(&std::fs::read(out.join("sensitivity.json")).unwrap()).unwrap());
    let note = &all[0]["figures"][0]["derivatives"][0]["note"];
    assert!(all.len() == 2 && note.is_string() && all[1]["files"][0] == "sensitivity.csv", "{note}");
    assert_eq!(lacking("sensitivity.json", &all), Vec::<String>::new());
    let head = Table::read(&out.join("sensitivity.csv")).head;
    let lacking: Vec<_> = head.iter().filter(|column| !defined("sensitivity.csv", column)).collect();
    assert!(lacking.is_empty() && head.len() == 13, "{lacking:?}");
}

#[test]
fn everything_that_check_says_is_defined() {
    let root = tempdir().unwrap();
    let file = root.path().join("mine.json");
    let text = std::fs::read_to_string(scenario("quickstart")).unwrap();
    std::fs::write(&file, text.replace("\"friction\": 0.2", "\"friction\": -0.2")).unwrap();
    let file = file.to_str().unwrap();
    let mut all = answers(&["check", "--json", file, "nowhere.json"]);
    all.extend(answers(&["check", "--json", file, "--set", "contacts.ball.friction=-1"]));
    all.extend(answers(&[
        "check",
        "--json",
        file,
        "--set",
        "contacts.ball.friction=0.2",
        "--set",
        "bodies.wall={}",
    ]));
    assert!(all.len() == 4 && all[3]["ok"] == true && all[3]["warnings"][0]["line"].is_u64(), "{all:?}");
    // The first error and warnings have the keys of the errors.
    for answer in &mut all {
        let first = answer["error"].take();
        answer["error"] = json!(true);
        answer
            .get_mut("errors")
            .and_then(Value::as_array_mut)
            .into_iter()
            .for_each(|errors| errors.push(first.clone()));
        let warnings = answer.get_mut("warnings").and_then(Value::as_array_mut).into_iter().flatten();
        for warning in warnings {
            let kind = warning["kind"].take();
            assert!(!kind.is_null());
            let mut rest = warning.clone();
            rest.as_object_mut().unwrap().remove("kind");
            assert!(lacking("check --json", &[json!({ "errors": [rest] })]).is_empty());
            *warning = json!({ "kind": kind });
        }
    }
    assert_eq!(lacking("check --json", &all), Vec::<String>::new());
}

/// Heads of the tables of what was asked and found.
#[test]
fn every_head_of_what_validate_asks_is_defined() {
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation");
    let mut heads = BTreeSet::new();
    for name in listing(&pages).iter().filter(|name| name.ends_with(".md")) {
        let page = std::fs::read_to_string(pages.join(name)).unwrap();
        let head = page.lines().find(|line| line.contains("asked: at most |")).unwrap();
        heads.extend(head.split('|').map(|cell| cell.trim().to_owned()).filter(|cell| !cell.is_empty()));
    }
    assert!(heads.len() > 3, "{heads:?}");
    let lacking: Vec<_> = heads.iter().filter(|head| !defined("validate", head)).collect();
    assert!(lacking.is_empty(), "{lacking:?}");
}

/// Every option of `output` at once, also those that shut each other out in turn.
#[test]
fn everything_that_a_run_with_every_output_writes_is_defined() {
    let root = tempdir().unwrap();
    let every = [
        "output.events={\"kinds\": [\"reversal\", \"gross slip\"], \"contacts\": [\"ball\"], \"most\": 100}",
        "output.states=numbers",
        "output.float=9",
        "output.springs={\"count\": 11}",
        "output.fields={\"radii\": 5}",
        "output.memory={}",
    ];
    let cases: [(&str, &[&str]); 3] = [
        ("quickstart", &["output.last=2", "bodies.wall={}"]),
        ("fretting_sphere", &["output.window.from=1 ms"]),
        ("rocking_slider", &["output.window.from=1 ms"]),
    ];
    let mut files = BTreeSet::new();
    for (name, more) in cases {
        let set: Vec<&str> = every
            .iter()
            .chain(more)
            .filter(|one| name == "quickstart" || !one.contains("contacts"))
            .copied()
            .collect();
        let output = run(&scenario(name), root.path(), &set);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
        let folder = root.path().join(name);
        for file in listing(&folder).into_iter().filter(|file| file.ends_with(".csv")) {
            let head = Table::read(&folder.join(&file)).head;
            // Of events what follows source and kind is a row.
            let is_row = |column: &str| file == "events.csv" && defined("trace.csv", column);
            let lacking: Vec<_> =
                head.iter().filter(|column| !defined(&file, column) && !is_row(column)).collect();
            assert!(lacking.is_empty(), "{name}/{file}: {lacking:?}");
            files.insert(file);
        }
        let summary = summary(&folder);
        assert_eq!(lacking("summary.json", &[summary]), Vec::<String>::new(), "{name}");
    }
    let all = [
        "cycles.csv",
        "events.csv",
        "fields.csv",
        "friction.csv",
        "memory.csv",
        "springs.csv",
        "steps.csv",
        "trace.csv",
    ];
    assert_eq!(files.iter().collect::<Vec<_>>(), all);
}

/// What only holds others is explained by all that it holds.
#[test]
fn what_holds_figures_is_explained_by_them() {
    for (name, held) in [("drivers", "peak_current_A"), ("at_limit", "window_high")] {
        let output = stickslip().args(["explain", name]).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && said.contains(held), "{name}: {said}");
        assert!(said.lines().filter(|line| !line.starts_with(' ')).all(|line| line.contains(name)), "{said}");
    }
}

/// A symbol that stands in the tables of `info` is explained as what it is.
#[test]
fn symbols_are_explained() {
    for (symbol, name) in
        [("S0", "zero_step_stroke_m"), ("u_c", "gross_slip_displacement_m"), ("E*", "normal_modulus_Pa")]
    {
        let output = stickslip().args(["explain", symbol]).output().unwrap();
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        assert!(stdout(&output).contains(name), "{symbol}: {}", stdout(&output));
    }
}

/// With a clock, an empty loop before it and rows of springs tried.
#[test]
fn every_figure_of_a_loop_is_defined() {
    let out = tempdir().unwrap();
    let (file, folder) = (scenario("commanded"), out.path().to_str().unwrap().to_owned());
    let timing = ["--period", "1 ms", "--for", "20 ms", "--floor", "20 ms", "--json", "--quiet"];
    let told = answers(&[&["realtime", file.to_str().unwrap(), "--out", &folder], &timing[..]].concat());
    assert_eq!(lacking("realtime.json", &told), Vec::<String>::new());
    let known = definitions().into_iter().filter(|definition| definition.file == "realtime.json");
    let mut found = BTreeSet::new();
    keys(&told[0], "", &mut found);
    // And nothing is defined that is not there, but for lists that are empty.
    for definition in known.filter(|known| !["denied", "inputs"].contains(&known.name.as_ref())) {
        assert!(found.iter().any(|name| definition.defines("realtime.json", name)), "{}", definition.name);
    }
}

/// Terms of the field, Greek letters by their names, and words in the midst of texts.
#[test]
fn terms_are_explained_with_their_page() {
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    for term in stickslip_quantity::terms::TERMS {
        assert!(pages.join(term.page).is_file(), "{}", term.page);
        for name in term.names {
            let output = stickslip().args(["explain", name]).output().unwrap();
            assert_eq!(code(&output), 0, "{name}");
            assert!(stdout(&output).contains(term.text), "{name}: {}", stdout(&output));
        }
    }
    for (name, found) in [
        ("kappa", "κ = μE*/G*"),
        ("mu", "μ, coefficient of friction"),
        ("mean speed", "mean_speed_m_s"),
        ("slip ratio", "cycles.csv  slip_ratio"),
        ("contact resonance", "contact_resonance_Hz"),
        ("back-step", "steps.steady.back_step"),
        ("window", "actuators.NAME.driver.window"),
    ] {
        let output = stickslip().args(["explain", name]).output().unwrap();
        assert!(stdout(&output).contains(found), "{name}: {}", stdout(&output));
    }
}

/// A file, words of other programs and what lacks an argument are answered with the command that is meant.
#[test]
fn what_is_meant_is_named() {
    let cases = [
        (vec!["drive.json"], "did you mean `stickslip run drive.json`?"),
        (vec!["characterize"], "did you mean `stickslip curve`?"),
        (vec!["Optimise"], "did you mean `stickslip curve`?"),
        (vec!["stall"], "did you mean `stickslip curve FILE --curve force-speed`?"),
        (vec!["curve", "preload", "a.json"], "did you mean `stickslip curve FILE --curve preload`?"),
        (vec!["resume"], "did you mean `stickslip run --resume`?"),
        (vec!["branch", "drive.json"], "for example stickslip branch drive.json --vary "),
        (vec!["run"], "for example stickslip run drive.json"),
    ];
    for (words, meant) in cases {
        let output = stickslip().args(&words).output().unwrap();
        assert!(code(&output) == 2 && stderr(&output).contains(meant), "{words:?}: {}", stderr(&output));
    }
}
