//! What is no checkpoint, and what a run that goes on cannot change: each is told, and nothing is touched.

use crate::program::{code, listing, scenario, stderr, stickslip};
use sha2::Digest;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::{TempDir, tempdir};

/// A finished run of an example with a checkpoint.
struct Kept {
    _out: TempDir,
    folder: PathBuf,
}

impl Kept {
    fn new(name: &str, set: &[&str]) -> Self {
        let out = tempdir().unwrap();
        let mut command = stickslip();
        command
            .arg("run")
            .arg(scenario(name))
            .arg("--out")
            .arg(out.path())
            .args(["--checkpoint-every", "60 min"]);
        set.iter().for_each(|assignment| {
            command.args(["--set", assignment]);
        });
        let output = command.output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let folder = out.path().join(name);
        Self { _out: out, folder }
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.join("checkpoint").join(name)
    }

    /// What resuming says, which must be refused and leave everything as it is; the folder is called DIR.
    fn refused(&self, options: &[&str]) -> String {
        let before = contents(&self.folder);
        let output = stickslip().args(["run", "--resume"]).arg(&self.folder).args(options).output().unwrap();
        assert_eq!(code(&output), 2, "{}", stderr(&output));
        assert!(contents(&self.folder) == before, "something was touched");
        stderr(&output).replace(self.folder.to_str().unwrap(), "DIR")
    }

    /// What is said with other bytes in a file, which are put back after it.
    fn refused_with(&self, name: &str, bytes: &[u8]) -> String {
        let whole = fs::read(self.file(name)).unwrap();
        fs::write(self.file(name), bytes).unwrap();
        let said = self.refused(&[]);
        fs::write(self.file(name), whole).unwrap();
        said
    }
}

/// All files of a folder and of those in it, with their bytes.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    for name in listing(folder) {
        let path = folder.join(name);
        if path.is_dir() {
            all.extend(contents(&path));
        } else {
            // A pipe would be waited for.
            let bytes = if path.is_file() { fs::read(&path).unwrap() } else { Vec::new() };
            all.push((path, bytes));
        }
    }
    all
}

/// The state with a change, and the digest that belongs to it.
fn signed(mut bytes: Vec<u8>, change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    change(&mut bytes);
    let all = bytes.len() - 32;
    let digest = sha2::Sha256::digest(&bytes[..all]);
    bytes[all..].copy_from_slice(&digest);
    bytes
}

#[test]
fn what_is_no_checkpoint_is_refused_word_for_word() {
    let kept = Kept::new("p1", &["run.cycles=3"]);
    let state = fs::read(kept.file("state")).unwrap();
    let journal = fs::read(kept.file("journal")).unwrap();
    let (long, half) = (state.len(), state.len() / 2);
    for (bytes, said) in [
        (b"{}".to_vec(), "DIR/checkpoint/state: is not a checkpoint of stickslip\n".to_owned()),
        (Vec::new(), "DIR/checkpoint/state: is truncated: 0 bytes of 33\n".to_owned()),
        (state[..half].to_vec(), format!("DIR/checkpoint/state: is truncated: {half} bytes of {long}\n")),
        (
            signed(state.clone(), |bytes| bytes[21] = 9),
            "DIR/checkpoint/state: written by stickslip 0.1.0 in a format that this program, stickslip 0.1.0, does \
             not know\n"
                .to_owned(),
        ),
    ] {
        assert_eq!(kept.refused_with("state", &bytes), said);
    }
    for place in [30, half, long - 1] {
        let mut bytes = state.clone();
        bytes[place] ^= 4;
        let said = kept.refused_with("state", &bytes);
        assert!(said.contains("state: is damaged") || said.contains("truncated"), "{place}: {said}");
    }
    let length = journal.len();
    assert_eq!(
        kept.refused_with("journal", &journal[..length - 1]),
        format!("DIR/checkpoint/journal: is truncated: {} bytes of {length}\n", length - 1)
    );
    let mut bytes = journal.clone();
    bytes[length / 2] ^= 4;
    assert_eq!(
        kept.refused_with("journal", &bytes),
        "DIR/checkpoint/journal: is damaged, or does not belong to the checkpoint in this folder\n"
    );
}

#[test]
fn files_that_are_not_there_or_no_files_are_refused() {
    let help = "   help: `stickslip run FILE --checkpoint-every \"30 s\"` writes checkpoints\n";
    let none = format!("DIR: has no checkpoint\n{help}");
    let kept = Kept::new("p1", &["run.cycles=3"]);
    let moved = kept.folder.join("elsewhere");
    for (name, said) in [
        ("state", none.clone()),
        ("journal", "DIR/checkpoint/journal: cannot be read: No such file or directory\n".to_owned()),
        ("scenario.json", "DIR/checkpoint/scenario.json: there is no such file\n".to_owned()),
    ] {
        fs::rename(kept.file(name), &moved).unwrap();
        assert_eq!(kept.refused(&[]), said);
        fs::create_dir(kept.file(name)).unwrap();
        let found = kept.refused(&[]);
        let start = format!("DIR/checkpoint/{name}: ");
        assert!(
            found.starts_with(&start) && (found.contains("s a directory") || found.contains("a folder")),
            "{found}"
        );
        fs::remove_dir(kept.file(name)).unwrap();
        fs::rename(&moved, kept.file(name)).unwrap();
    }
    let out = tempdir().unwrap();
    let file = out.path().join("file");
    fs::write(&file, "").unwrap();
    for folder in [out.path().join("nowhere"), file] {
        let output = stickslip().args(["run", "--resume"]).arg(&folder).output().unwrap();
        let said = stderr(&output).replace(folder.to_str().unwrap(), "DIR");
        assert_eq!((code(&output), said), (2, none.clone()));
    }
}

#[test]
fn a_checkpoint_of_another_run_is_refused() {
    let kept = Kept::new("p1", &["run.cycles=3"]);
    let said = "DIR/checkpoint/scenario.json: is not the scenario of the checkpoint: more than its end has changed\n";
    for set in [&["run.cycles=3", "contacts.ball.friction=0.2"][..], &["run.cycles=3", "output.every=1 ms"]] {
        let other = Kept::new("p1", set);
        assert_eq!(kept.refused_with("scenario.json", &fs::read(other.file("scenario.json")).unwrap()), said);
        let state = fs::read(other.file("state")).unwrap();
        assert_eq!(kept.refused_with("state", &state), said);
    }
    let row = r#"contacts.ball.engine={"springs": {"count": 64}}"#;
    let other = Kept::new("p1", &["run.cycles=3", row, "output={}", "plots=[]"]);
    assert_eq!(kept.refused_with("scenario.json", &fs::read(other.file("scenario.json")).unwrap()), said);
}

#[test]
fn only_the_end_and_the_limits_can_be_changed() {
    let kept = Kept::new("p1", &["run.cycles=3"]);
    let help = "   help: run the scenario again to change other keys\n";
    for set in ["contacts.ball.friction=0.2", "run.limitsx=9", "title=x"] {
        assert_eq!(
            kept.refused(&["--set", set]),
            format!(
                "--set {set}  a resumed run can only change its end, by run.cycles, and run.limits\n{help}"
            )
        );
    }
    assert_eq!(
        kept.refused(&["--set", "run.duration=1 s"]),
        "--set run.duration=1 s  the end of this run is given by run.cycles\n   help: --set run.cycles=…\n"
    );
    let said = kept.refused(&["--set", "run.cycles=-1"]);
    assert!(said.starts_with("--set run.cycles=-1  run.cycles: expected a number above 0"), "{said}");
    let said = kept.refused(&["--set", "run.cycles=1"]);
    let reached = said.split(" t = ").nth(1).unwrap().split(' ').next().unwrap();
    assert!(reached.parse::<f64>().unwrap() > 2e-3, "{said}");
    assert_eq!(
        said,
        format!(
            "DIR: the run has reached t = {reached} s and cannot end at 1e-3 s\n   help: give a later end, or run the \
             scenario again\n"
        )
    );
}

/// The last period, whose memory P1 shows, is another one with another end: much of it has passed.
#[test]
fn an_end_that_asks_for_looks_at_what_has_passed_is_refused() {
    let kept = Kept::new("p1", &["run.cycles=3"]);
    let said = kept.refused(&["--set", "run.cycles=3.4"]);
    let t = said.split("t = ").nth(1).unwrap().split(' ').next().unwrap();
    assert!((t.parse::<f64>().unwrap() - (3.4 - 5.0 / 6.0) * 1e-3).abs() < 1e-12, "{said}");
    assert_eq!(
        said,
        format!(
            "DIR: with this end the run would write contact states at t = {t} s, which it has already passed\n   \
             help: give another end, or run the scenario again with times for output.memory and output.springs\n"
        )
    );
}

#[test]
fn one_folder_is_not_resumed_twice_at_once() {
    let kept = Kept::new("p1", &["run.cycles=3"]);
    let output =
        stickslip().args(["run", "--resume"]).args([&kept.folder, &kept.folder.join(".")]).output().unwrap();
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).ends_with(": is named twice\n"), "{}", stderr(&output));
}

#[test]
fn a_stepper_that_keeps_no_checkpoints_is_refused_at_once() {
    let out = tempdir().unwrap();
    let mut command = stickslip();
    command.arg("run").arg(scenario("quickstart")).arg("--out").arg(out.path());
    command.args(["--checkpoint-every", "30 s", "--set", r#"run.stepper={"dopri5": {}}"#]);
    let output = command.output().unwrap();
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(said.contains("run.stepper: the stepper \"dopri5\" has no checkpoints\n"), "{said}");
    let help = "   help: use \"event\", \"verlet\" or \"rk4\", or run without --checkpoint-every\n";
    assert!(said.ends_with(help), "{said}");
    assert!(listing(out.path()).is_empty());
}

#[test]
fn an_interval_is_a_time_above_zero() {
    for (every, words) in
        [("0 s", "expected a time above 0"), ("3 m", "expected a time"), ("soon", "expected a")]
    {
        let mut command = stickslip();
        let output =
            command.arg("run").arg(scenario("p1")).args(["--checkpoint-every", every]).output().unwrap();
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

/// A pipe would be waited for until somebody writes into it.
#[cfg(unix)]
#[test]
fn what_is_no_plain_file_is_not_waited_for() {
    let kept = Kept::new("p1", &["run.cycles=3"]);
    for name in ["journal", "state"] {
        let path = kept.file(name);
        fs::remove_file(&path).unwrap();
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
        assert_eq!(kept.refused(&[]), format!("DIR/checkpoint/{name}: cannot be read: not a regular file\n"));
    }
}
