//! The memory of a run does not grow with its duration, and the memory limit is applied.

use std::path::Path;
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Outcome, Recorder, Summary};

fn job(name: &str, set: &[(&str, &str)]) -> Job {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name).with_extension("json");
    let set: Vec<_> = set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Job::prepare(&file, &set, Path::new("")).unwrap()
}

/// Runs a job with tables in a temporary folder. Also returns the number of lines of one table.
fn written(job: &Job, table: &str) -> (Outcome, usize) {
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::make(root.path()).unwrap();
    let recorder = Recorder::new(job, &()).with_tables(&folder).unwrap();
    let (outcome, drafts) = job.run_recorded(recorder).unwrap();
    assert!(outcome.error.is_none());
    let draft = drafts.iter().find(|draft| draft.name == table).unwrap();
    let text = std::fs::read_to_string(draft.file.path()).unwrap();
    (outcome, text.lines().count() - 1)
}

#[test]
fn ten_times_the_periods_keep_no_more() {
    let bytes = [10_000, 100_000].map(|periods: u32| {
        let cycles = periods.to_string();
        let set = [("run.cycles", cycles.as_str()), ("output", "{}"), ("plots", "[]")];
        let tolerance = ("run.stepper.event.tolerance", "1e-6");
        let (outcome, steps) = written(&job("p1", &[set[0], set[1], set[2], tolerance]), "steps.csv");
        assert_eq!(steps, periods as usize);
        // Most events are thinned out, including some of the last ones.
        assert!(outcome.events.taken < 260_000 && outcome.events.seen >= 6 * u64::from(periods));
        outcome.bytes
    });
    assert!(bytes[1] <= bytes[0] + bytes[0] / 10 && bytes[1] < 1_000_000, "{bytes:?}");
}

#[test]
fn thousands_of_cycles_are_not_kept() {
    let bytes = [500, 5000].map(|periods: u32| {
        let duration = format!("\"{periods} s\"");
        let set = [("run.duration", duration.as_str()), ("output", r#"{"events": "off"}"#), ("plots", "[]")];
        let job = job("fretting_sphere", &set);
        let (outcome, cycles) = written(&job, "cycles.csv");
        assert_eq!(cycles, job.model.contacts().count() * periods as usize);
        assert_eq!(outcome.events.taken, 0);
        outcome.bytes
    });
    // All cycles would take 2 MB. Neither run reaches the 16 384 samples by which a replay may lag behind.
    assert!(bytes.iter().all(|bytes| *bytes < 100_000), "{bytes:?}");
}

/// In memory the cycles are stored and equal those of the table.
#[test]
fn a_run_in_memory_has_the_cycles_of_the_table() {
    let job = job("fretting_sphere", &[("plots", "[]")]);
    let (_, lines) = written(&job, "cycles.csv");
    let outcome = job.run(&());
    let counts = (0..job.model.contacts().count()).map(|c| outcome.cycles(c).len());
    assert_eq!(counts.sum::<usize>(), lines);
}

#[test]
fn a_run_that_keeps_too_much_stops_and_says_what_to_change() {
    let mut job = job("p1", &[("run.cycles", "2000"), ("output.every", "\"20 us\"")]);
    // This is less than its plots need, so the estimate would have rejected the run.
    job.scenario.memory_limit = Some(1e6);
    let outcome = job.run(&());
    let excess = outcome.excess.unwrap();
    assert!(excess.kept > 1e6 && excess.kept < 3e6 && excess.t < 1.0, "{excess:?}");
    let summary = Summary::new(&job, &outcome);
    let (message, advice) = summary.stop().unwrap();
    assert!(message.contains("more than run.limits.memory, 1.000 MB"), "{message}");
    assert!(advice.contains("increase run.limits.memory"));
    assert_eq!(summary.status, stickslip_run::summary::Status::Stopped);
}

#[test]
fn a_run_that_would_keep_too_much_is_refused() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    let limit = ("run.limits.memory".to_owned(), "\"500 kB\"".to_owned());
    let error = Job::prepare(&file, std::slice::from_ref(&limit), Path::new("")).err().unwrap().to_string();
    assert!(error.contains("run.limits.memory: the run would keep 736.6 kB in memory"), "{error}");
    assert!(error.contains("for its plots (loop, trajectory, events)"), "{error}");
    // Without plots the memory does not grow.
    let none = ("plots".to_owned(), "[]".to_owned());
    assert!(Job::prepare(&file, &[limit, none], Path::new("")).is_ok());
}

#[test]
fn a_run_without_events_has_an_estimate() {
    let limit = ("run.limits.memory", "\"512 MB\"");
    job("p1", &[("output.events", "\"off\""), limit]);
}

/// The plot of the events stores the time of each event.
#[test]
fn moments_of_events_are_in_the_estimate() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    let set = [
        ("run.limits.memory", "\"500 kB\""),
        ("run.cycles", "20000"),
        ("output", r#"{"events": "all"}"#),
        ("plots", r#"["events"]"#),
    ];
    let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let error = Job::prepare(&file, &set, Path::new("")).err().unwrap().to_string();
    assert!(error.contains("for its plots (events)"), "{error}");
}

/// The memory for a fingerprint does not grow, and the memory limit does not apply to it.
#[test]
fn a_fingerprint_alone_needs_no_room() {
    let mut job = job("p1", &[("run.cycles", "2000"), ("output.every", "\"20 us\"")]);
    let recorder = Recorder::new(&job, &()).only_fingerprinted().unwrap();
    let (outcome, _) = job.run_recorded(recorder).unwrap();
    assert!(outcome.bytes < 600_000 && outcome.error.is_none(), "{}", outcome.bytes);
    let whole = Recorder::new(&job, &()).fingerprinted();
    assert_eq!(outcome.kept.fingerprint(), job.run_recorded(whole).unwrap().0.kept.fingerprint());
    job.scenario.memory_limit = Some(1.0);
    let recorder = Recorder::new(&job, &()).only_fingerprinted().unwrap();
    let (limited, _) = job.run_recorded(recorder).unwrap();
    assert!(limited.excess.is_none() && limited.kept.fingerprint() == outcome.kept.fingerprint());
}
