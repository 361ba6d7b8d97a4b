//! Files of results are whole or absent, whatever ends a run: a signal, a full disk.

use crate::program::{
    Table, code, listing, number, run_example, scenario, sha256, stderr, stdout, stickslip, summary,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::tempdir;

const OLD: [&str; 3] = ["run.duration=15 ms", "output.every=1 us", "plots=[\"loop\", \"events\"]"];
const NEW: [&str; 4] = [
    "run.duration=15 ms",
    "output.every=1 us",
    "plots=[\"loop\", \"trajectory\"]",
    "contacts.ball.friction=0.25",
];

/// All files of a folder with their hashes; of the summary all but the time taken.
fn contents(folder: &Path) -> BTreeMap<String, String> {
    let content = |name: String| {
        let mut bytes = fs::read(folder.join(&name)).unwrap();
        if name == "summary.json" {
            let mut summary = summary(folder);
            summary.as_object_mut().unwrap().remove("timing");
            bytes = summary.to_string().into_bytes();
        }
        (name, sha256(&bytes))
    };
    listing(folder).into_iter().filter(|name| !name.starts_with('.')).map(content).collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for name in listing(from) {
        fs::copy(from.join(&name), to.join(&name)).unwrap();
    }
}

/// The new run, in a folder where the old one has left its results.
fn begun(out: &Path) -> std::process::Child {
    let mut command = stickslip();
    command.arg("run").arg(scenario("quickstart")).arg("--out").arg(out);
    command.args(NEW.iter().flat_map(|set| ["--set", set]));
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// How often runs are killed here; `STICKSLIP_KILLS=100` takes its time.
fn kills() -> usize {
    std::env::var("STICKSLIP_KILLS").map_or(6, |count| count.parse().unwrap())
}

/// Once a kill between two renames left a new trace beside an old summary, which `plot` drew and stamped with the old scenario.
#[test]
#[allow(clippy::print_stdout, reason = "the numbers of a longer test")]
fn a_killed_run_leaves_the_old_results_the_new_ones_or_a_mark() {
    let root = tempdir().unwrap();
    let old = run_example("quickstart", &root.path().join("old"), &OLD);
    let wall = Instant::now();
    let new = run_example("quickstart", &root.path().join("new"), &NEW);
    let wall = wall.elapsed().as_secs_f64();
    let (before, after) = (contents(&old), contents(&new));
    let mut found = [0; 3];
    for k in 0..kills() {
        let out = root.path().join(format!("{k}"));
        let folder = out.join("quickstart");
        copy(&old, &folder);
        let mut child = begun(&out);
        if k % 2 == 0 {
            std::thread::sleep(Duration::from_secs_f64(wall * (0.4 + 0.7 * k as f64 / kills() as f64)));
        } else {
            // As soon as it begins to give the files their names.
            while folder.join("summary.json").exists() && child.try_wait().unwrap().is_none() {
                std::hint::spin_loop();
            }
        }
        child.kill().unwrap();
        child.wait().unwrap();
        let state = if folder.join("summary.json").exists() {
            let now = contents(&folder);
            assert!(now == before || now == after, "{k}: {now:?}");
            assert!(code(&stickslip().arg("plot").arg(&folder).arg("-q").output().unwrap()) == 0);
            assert_eq!(code(&stickslip().arg("compare").args([&folder, &folder]).output().unwrap()), 0);
            if now == before { 0 } else { 2 }
        } else {
            refused_by_all(&folder);
            1
        };
        found[state] += 1;
        // Nothing of the killed run is left by the next one.
        run_example("quickstart", &out, &NEW);
        assert_eq!(contents(&folder), after, "{k}");
        assert!(!listing(&folder).iter().any(|name| name.starts_with('.')), "{:?}", listing(&folder));
        fs::remove_dir_all(&out).unwrap();
    }
    let [whole, marked, done] = found;
    println!("{} kills: {whole} left the old results, {marked} a mark, {done} the new results", kills());
}

/// Results without their summary are read by nobody.
fn refused_by_all(folder: &Path) {
    let message =
        "incomplete: the run was killed while it published its results\n   help: run the scenario again";
    let picture = listing(folder).into_iter().find(|name| name.ends_with(".png"));
    let mut calls =
        vec![vec!["plot".into(), folder.to_owned()], vec!["compare".into(), folder.into(), folder.into()]];
    calls.extend(picture.map(|picture| vec!["repro".into(), folder.join(picture)]));
    for call in calls {
        let output = stickslip().args::<_, PathBuf>(call).output().unwrap();
        assert_eq!((code(&output), stdout(&output)), (2, String::new()));
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
}

#[test]
fn results_without_a_summary_are_refused_and_say_what_to_do() {
    let out = tempdir().unwrap();
    let folder = run_example("quickstart", out.path(), &["run.duration=15 ms", "plots=[\"loop\"]"]);
    fs::remove_file(folder.join("summary.json")).unwrap();
    refused_by_all(&folder);
    // With a checkpoint there is another way.
    fs::create_dir(folder.join("checkpoint")).unwrap();
    fs::write(folder.join("checkpoint/state"), "").unwrap();
    let help = format!(
        "run the scenario again, or resume it from its checkpoint with `stickslip run --resume {}`\n",
        folder.display()
    );
    let output = stickslip().arg("plot").arg(&folder).output().unwrap();
    assert!(stderr(&output).ends_with(&help), "{}", stderr(&output));
    // Killed under way, a run has published nothing.
    let begun = out.path().join("begun");
    fs::create_dir(&begun).unwrap();
    fs::write(begun.join(".trace.csv-abc123"), "").unwrap();
    let output = stickslip().arg("plot").arg(&begun).output().unwrap();
    let message = "no results: the run was killed before it published them, or is still running";
    assert!(code(&output) == 2 && stderr(&output).contains(message), "{}", stderr(&output));
}

#[test]
fn what_killed_commands_left_is_swept() {
    let out = tempdir().unwrap();
    let folder = run_example("p1", out.path(), &["run.cycles=1", "plots=[\"loop\"]"]);
    let draft = |name: &str| {
        let file = fs::File::create(folder.join(name)).unwrap();
        file.set_modified(std::time::SystemTime::now() - Duration::from_secs(61)).unwrap();
    };
    let hidden = || listing(&folder).into_iter().filter(|name| name.starts_with('.')).collect::<Vec<_>>();
    draft(".loop.png-abc123");
    assert_eq!(code(&stickslip().arg("plot").arg(&folder).output().unwrap()), 0);
    assert!(hidden().is_empty());
    // Nobody has it open, however new it is: its command was killed.
    fs::write(folder.join(".loop.png-abc123"), "").unwrap();
    assert_eq!(code(&stickslip().arg("plot").arg(&folder).output().unwrap()), 0);
    assert!(hidden().is_empty(), "{:?}", hidden());
    draft(".difference.png-abc123");
    let picture = folder.join("difference.png");
    let compare =
        stickslip().arg("compare").args([&folder, &folder]).arg("--plot").arg(picture).output().unwrap();
    assert!(code(&compare) == 0 && hidden().is_empty(), "{:?}", hidden());
    [".loop.png-abc123", ".summary.json-abc123", ".trace.csv-abc123"].into_iter().for_each(draft);
    run_example("p1", out.path(), &["run.cycles=1"]);
    assert!(hidden().is_empty());
}

/// A file named `...json` has the stem `..`: its results went into the folder above, where pictures were deleted.
/// The second took the drafts of the first away, whose work was lost when it came to its end.
#[test]
fn a_folder_into_which_another_command_is_writing_is_refused() {
    let root = tempdir().unwrap();
    let folder = root.path().join("quickstart");
    fs::create_dir_all(&folder).unwrap();
    let draft = folder.join(".trace.csv-ab12cd");
    fs::write(&draft, "").unwrap();
    // As every command locks it that writes into it.
    let written = fs::File::open(&folder).unwrap();
    written.lock().unwrap();
    let run = || {
        let mut command = stickslip();
        command.arg("run").arg(scenario("quickstart")).arg("--out").arg(root.path());
        command.args(["--set", "run.cycles=1"]).output().unwrap()
    };
    let refused = run();
    let said = stderr(&refused);
    assert_eq!(code(&refused), 2, "{said}");
    assert!(said.contains("another command is writing into this folder") && said.contains("--out"), "{said}");
    assert_eq!(listing(&folder), [".trace.csv-ab12cd"]);
    let file = scenario("p1");
    let curve = ["curve", file.to_str().unwrap(), "--curve", "step-amplitude", "--points", "3", "--out"];
    let refused = stickslip().args(curve).arg(&folder).output().unwrap();
    assert!(
        code(&refused) == 2 && stderr(&refused).contains("another command is writing"),
        "{}",
        stderr(&refused)
    );
    drop(written);
    assert_eq!(code(&run()), 0);
    assert!(!draft.exists() && folder.join("summary.json").exists());
}

#[test]
fn a_file_whose_name_is_no_folder_is_refused() {
    let root = tempdir().unwrap();
    let out = root.path().join("results");
    fs::create_dir(&out).unwrap();
    fs::write(root.path().join("loop.png"), "mine").unwrap();
    for (name, stem) in [("...json", ".."), ("..json", ".")] {
        let file = root.path().join(name);
        fs::copy(scenario("p1"), &file).unwrap();
        let before = listing(root.path());
        for command in ["run", "check"] {
            let mut call = stickslip();
            call.arg(command).arg(&file);
            if command == "run" {
                call.arg("--out").arg(&out);
            }
            let output = call.output().unwrap();
            let message = format!("{name}: \"{stem}\" cannot be the name of its results folder\n");
            assert!(code(&output) == 2 && stderr(&output).contains(&message), "{}", stderr(&output));
        }
        assert_eq!(listing(root.path()), before);
        assert!(listing(&out).is_empty());
    }
}

/// A run of which no file may have more than so many blocks of 512 bytes.
#[cfg(unix)]
fn run_with_small_files(blocks: usize, out: &Path, more: &[&str]) -> std::process::Output {
    let mut command = Command::new("sh");
    // A signal comes with it, which would end the program by default.
    command.args(["-c", &format!("ulimit -f {blocks}; exec \"$@\""), "sh", env!("CARGO_BIN_EXE_stickslip")]);
    command.arg("run").arg(scenario("quickstart")).arg("--out").arg(out).args(more).output().unwrap()
}

/// A table that could not be written any further once cost everything that had been computed.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_keeps_what_was_computed() {
    let root = tempdir().unwrap();
    let whole = run_example("quickstart", &root.path().join("whole"), &["plots=[]"]);
    let text = fs::read_to_string(whole.join("trace.csv")).unwrap();
    for (k, more) in
        [&["--set", "plots=[]"][..], &[], &["--checkpoint-every", "1 ms"]].into_iter().enumerate()
    {
        let out = root.path().join(format!("{k}"));
        let output = run_with_small_files(2048, &out, more);
        assert_eq!((code(&output), stdout(&output)), (3, String::new()), "{}", stderr(&output));
        let said = stderr(&output);
        let first = "quickstart: stopped: the results could not be written completely: File too large\n   help: free disk space";
        assert!(said.starts_with(first), "{said}");
        let folder = out.join("quickstart");
        assert!(said.contains(&format!("the results so far are in {}", folder.display())), "{said}");
        let found = summary(&folder);
        assert_eq!((&found["status"], &found["cut"]), (&"stopped".into(), &true.into()));
        let cut = fs::read_to_string(folder.join("trace.csv")).unwrap();
        assert!(text.starts_with(&cut) && cut.ends_with('\n'), "{k}");
        // With checkpoints their journal is full first.
        assert!(cut.len() > if k < 2 { 900_000 } else { 100_000 }, "{k}: {}", cut.len());
        assert_eq!(
            number(&found, "/tables/trace.csv/rows") as usize,
            Table::read(&folder.join("trace.csv")).rows.len()
        );
        assert!(!listing(&folder).iter().any(|name| name.starts_with('.') || name.ends_with(".png")));
        // What is there can be drawn, and compared as far as it goes.
        assert_eq!(code(&stickslip().args(["plot", "--plots", "loop"]).arg(&folder).output().unwrap()), 0);
        let compared = stickslip().arg("compare").args([&whole, &folder]).output().unwrap();
        let account = stdout(&compared);
        assert_eq!(code(&compared), 1, "{account}{}", stderr(&compared));
        assert!(
            account.contains("B: the tables end at t = ") && account.ends_with("\nequal\n")
                || account.contains("status: done in A, stopped in B"),
            "{account}"
        );
        assert!(!account.contains("DIFFERS"), "{account}");
        if k == 2 {
            assert!(
                said.contains(&format!(
                    "`stickslip run --resume {}` resumes the run from the last checkpoint",
                    folder.display()
                )),
                "{said}"
            );
            let resumed = stickslip().args(["run", "--resume"]).arg(&folder).output().unwrap();
            assert_eq!(code(&resumed), 0, "{}", stderr(&resumed));
            assert_eq!(fs::read_to_string(folder.join("trace.csv")).unwrap(), text);
        }
    }
}

/// Pictures that have no room cost the run nothing else.
#[cfg(target_os = "linux")]
#[test]
fn pictures_without_room_leave_the_rest() {
    let out = tempdir().unwrap();
    let set = ["--set", "run.duration=1 ms", "--scale", "2", "--set", "plots=[\"loop\", \"trajectory\"]"];
    let output = run_with_small_files(160, out.path(), &set);
    let folder = out.path().join("quickstart");
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    let help =
        format!("   help: free disk space, then draw the plots with `stickslip plot {}`\n", folder.display());
    assert!(
        stderr(&output).contains("not all plots could be written: File too large\n"),
        "{}",
        stderr(&output)
    );
    assert!(stderr(&output).ends_with(&help), "{}", stderr(&output));
    let found = summary(&folder);
    assert_eq!(found["status"], "done");
    assert!(found["notes"].to_string().contains(".png could not be written: File too large"), "{found}");
    assert_eq!(code(&stickslip().arg("plot").arg(&folder).output().unwrap()), 0);
}
