//! Same scenario, same bytes; output never changes the trajectory.

use crate::program::{Table, code, listing, run, run_example, scenario, sha256, stderr, stdout, stickslip};
use std::path::Path;
use tempfile::tempdir;

const SHORT: &str = "run.duration=30 ms";

fn assert_same(first: &Path, second: &Path, names: &[&str]) {
    for name in names {
        assert!(
            std::fs::read(first.join(name)).unwrap() == std::fs::read(second.join(name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn the_same_scenario_gives_the_same_bytes_twice() {
    let (first, second) = (tempdir().unwrap(), tempdir().unwrap());
    for name in ["quickstart", "fretting_sphere", "piezo_stack"] {
        let set = if name == "fretting_sphere" { "run.duration=2 s" } else { "run.limits.steps=100000000" };
        let runs = [&first, &second].map(|out| run_example(name, out.path(), &[set]));
        assert_same(&runs[0], &runs[1], &["trace.csv", "events.csv", "scenario.json", "loop.png"]);
    }
    assert_same(&first.path().join("quickstart"), &second.path().join("quickstart"), &["trajectory.png"]);
}

#[test]
fn the_resolved_scenario_runs_to_the_same_bytes() {
    let out = tempdir().unwrap();
    for name in ["quickstart", "oblique_loading", "vibrated_slider"] {
        let first = run_example(name, out.path(), &[]);
        let again = tempdir().unwrap();
        let output = run(&first.join("scenario.json"), again.path(), &[]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_same(&first, &again.path().join("scenario"), &["trace.csv", "events.csv", "scenario.json"]);
    }
}

#[test]
fn rows_do_not_change_the_trajectory() {
    let out = tempdir().unwrap();
    let run = |name: &str, set: &[&str]| {
        let folder = run_example("quickstart", &out.path().join(name), &[&[SHORT], set].concat());
        (Table::read(&folder.join("trace.csv")).rows, std::fs::read(folder.join("events.csv")).unwrap())
    };
    let (rows, events) = run("given", &[]);
    let (halved, halved_events) = run("halved", &["output.every=5 us"]);
    let (none, none_events) = run("none", &["output={}"]);
    assert_eq!((rows.len(), halved.len(), none.len()), (3_001, 6_001, 2));
    assert!(halved.iter().step_by(2).eq(&rows), "rows at common times");
    assert_eq!((&none[0], &none[1]), (&rows[0], &rows[3_000]));
    assert!(events == halved_events && events == none_events);
}

#[test]
fn fewer_channels_are_the_same_numbers() {
    let out = tempdir().unwrap();
    let all = run_example("quickstart", &out.path().join("all"), &[SHORT]);
    let channels = r#"output.channels=["ball.state", "slider.x_m"]"#;
    let few = run_example("quickstart", &out.path().join("few"), &[SHORT, channels]);
    for name in ["trace.csv", "events.csv"] {
        let (all, few) = (Table::read(&all.join(name)), Table::read(&few.join(name)));
        let extra = if name == "trace.csv" { vec![] } else { vec!["source", "kind"] };
        assert_eq!(few.head, [vec!["time_s"], extra, vec!["ball.state", "slider.x_m"]].concat());
        for column in &few.head {
            assert_eq!(few.column(column), all.column(column), "{name}: {column}");
        }
    }
    let bytes = |folder: &Path| std::fs::read(folder.join("trajectory.png")).unwrap().len();
    assert!(bytes(&few) > 10_000, "pictures do not need the columns of the table");
}

#[test]
fn runs_side_by_side_give_the_same_and_speak_in_order() {
    let (one, two) = (tempdir().unwrap(), tempdir().unwrap());
    // The slowest comes first: its message must not come last.
    let names = ["quickstart", "oblique_loading", "fretting_sphere"];
    let call = |out: &Path, threads: &str| {
        let mut command = stickslip();
        command.arg("run").args(names.map(scenario)).arg("--out").arg(out).args(["--threads", threads]);
        let output = command.output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let said = stdout(&output);
        names.map(|name| said.find(&format!("{name}: ")).unwrap())
    };
    assert!(call(one.path(), "1").is_sorted());
    assert!(call(two.path(), "3").is_sorted());
    for name in names {
        assert_same(&one.path().join(name), &two.path().join(name), &["trace.csv", "events.csv", "loop.png"]);
    }
}

/// What the page says of every example, and what they give; without pictures, in an environment.
fn examples(environment: &[(&str, &str)]) -> String {
    let out = tempdir().unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let files: Vec<String> = listing(&folder).into_iter().filter(|name| name.ends_with(".json")).collect();
    let mut command = stickslip();
    command.arg("run").args(files.iter().map(|name| folder.join(name)));
    command.args(["--set", "plots=[]", "--quiet", "--out"]).arg(out.path()).envs(environment.iter().copied());
    let output = command.output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let line = |name: &String| {
        let name = name.strip_suffix(".json").unwrap();
        let [trace, events] = ["trace.csv", "events.csv"]
            .map(|table| sha256(&std::fs::read(out.path().join(name).join(table)).unwrap())[..16].to_owned());
        format!("| {name} | `{trace}` | `{events}` |\n")
    };
    files.iter().map(line).collect()
}

#[test]
fn the_examples_give_the_bytes_on_the_page_with_and_without_fma() {
    const HEAD: &str = "| scenario | trace.csv | events.csv |\n| --- | --- | --- |\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reproducibility.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let (before, table) = page.split_once(HEAD).unwrap();
    let found = examples(&[]);
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        std::fs::write(&path, [before, HEAD, &found].concat()).unwrap();
    } else {
        assert_eq!(table, found, "what a run gives has changed; to write it down: STICKSLIP_WRITE=1");
    }
    // The C library of GNU then uses other code for exponentials and angles; others do not know the variable.
    assert_eq!(found, examples(&[("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F")]));
}

#[test]
#[cfg(target_os = "linux")]
#[expect(clippy::print_stdout, reason = "says that it has looked at nothing")]
fn no_function_of_the_c_library_that_rounds_its_own_way_is_called() {
    let Ok(listed) = std::process::Command::new("nm").args(["-D", env!("CARGO_BIN_EXE_stickslip")]).output()
    else {
        return println!("no nm here: imported functions are not looked at");
    };
    let listed = stdout(&listed);
    assert!(listed.contains(" U "), "{listed}");
    // `fmod` is exact.
    const NAMES: &str = "acos acosh asin asinh atan atan2 atanh cbrt cos cosh exp exp10 exp2 expm1 fma hypot lgamma log log10 log1p \
                         log2 pow sin sincos sinh tan tanh tgamma";
    let imported = listed.lines().filter_map(|line| line.split_once(" U ")?.1.split('@').next());
    let called: Vec<&str> = imported
        .filter(|name| {
            NAMES
                .split_whitespace()
                .any(|known| known == *name || name.strip_suffix(['f', 'l']) == Some(known))
        })
        .collect();
    assert!(called.is_empty(), "{called:?}");
}
