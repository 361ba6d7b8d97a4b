//! Runs without files, progress bars and terminals.

use std::cell::{Cell, RefCell};
use stickslip_drive::RunError;
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Real, Recorder, Summary, Watcher};
use stickslip_scenario::Scenario;

const QUICKSTART: &str = include_str!("../../../../scenarios/quickstart.json");

fn quickstart(overrides: &[(&str, &str)]) -> Job {
    let scenario = Scenario::from_str_with(QUICKSTART, "quickstart", "", overrides).unwrap();
    Job::new(scenario, "quickstart".to_owned(), "".into()).unwrap()
}

/// Returns a summary without values that differ from run to run.
fn figures(job: &Job, outcome: &stickslip_run::Outcome) -> serde_json::Value {
    let mut summary = serde_json::to_value(Summary::new(job, outcome)).unwrap();
    summary.as_object_mut().unwrap().remove("timing");
    summary
}

#[test]
fn a_run_in_memory_is_the_run_that_writes_tables() {
    let job = quickstart(&[]);
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::make(root.path()).unwrap();
    let recorder = Recorder::new(&job, &()).fingerprinted().with_tables(&folder).unwrap();
    let (written, drafts) = job.run_recorded(recorder).unwrap();
    let in_memory = job.run(&());
    let names: Vec<&str> = drafts.iter().map(|draft| draft.name).collect();
    assert_eq!(names, ["trace.csv", "events.csv", "steps.csv"]);
    assert_eq!((in_memory.rows, &in_memory.state), (written.rows, &written.state));
    assert_eq!(in_memory.kept.series, written.kept.series);
    assert_eq!(figures(&job, &in_memory), figures(&job, &written));
    // The folder contains none of the files yet, and nothing was written to the working directory.
    drop(drafts);
    assert_eq!(std::fs::read_dir(root.path()).unwrap().count(), 0);
}

/// JSON has no representation of such numbers.
#[test]
fn a_summary_notes_which_numbers_are_not_finite() {
    let job = quickstart(&[("run.duration", "30 ms")]);
    let mut summary = Summary::new(&job, &job.run(&()));
    assert!(!summary.pretty().unwrap().contains("null") && !summary.line().unwrap().contains("null"));
    summary.simulated = Real(f64::NAN);
    summary.steps.as_mut().unwrap().mean_speed = Real(f64::INFINITY);
    for text in [summary.pretty().unwrap(), summary.line().unwrap()] {
        let read: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert!(read["simulated_s"].is_null() && read["steps"]["mean_speed_m_s"].is_null());
        let note = "null stands for a number that is not finite: simulated_s, steps.mean_speed_m_s";
        assert_eq!(read["notes"], serde_json::json!([note]));
        assert!(!text.contains("\"inf\"") && !text.contains("\"NaN\""));
    }
}

#[test]
fn events_have_their_names_where_a_picture_of_them_is_wanted() {
    let named = quickstart(&[("plots", r#"["events"]"#)]).run(&());
    let tracks = named.kept.tracks.unwrap();
    let sources: Vec<&str> = tracks.all().iter().map(|track| track.source.as_str()).collect();
    assert!(sources.contains(&"ball") && sources.contains(&"drive"), "{sources:?}");
    let nameless = quickstart(&[("plots", "[]")]).run(&());
    assert!(nameless.kept.tracks.is_none());
    assert_eq!(nameless.kept.series.time(), named.kept.series.time());
}

/// A watcher that ends a run at a time, s, and records its calls.
struct Impatient {
    until: f64,
    now: Cell<f64>,
    told: RefCell<Vec<f64>>,
}

impl Watcher for Impatient {
    fn reached(&self, t: f64) {
        self.now.set(t);
        self.told.borrow_mut().push(t);
    }

    fn goes_on(&self) -> bool {
        self.now.get() < self.until
    }
}

#[test]
fn a_watcher_is_told_how_far_a_run_has_come_and_may_end_it() {
    let job = quickstart(&[]);
    let watcher = Impatient { until: 0.03, now: Cell::new(0.0), told: RefCell::default() };
    let outcome = job.run(&watcher);
    assert!(matches!(outcome.error, Some(RunError::Interrupted { .. })), "{:?}", outcome.error);
    let end = outcome.state.time();
    // The watcher is asked at intervals, not at every time step.
    assert!((0.03..0.1).contains(&end), "{end}");
    let told = watcher.told.into_inner();
    assert!(told.len() > 100 && told.iter().all(|t| (0.0..=end).contains(t)), "{}", told.len());
    // The results computed before are available.
    assert_eq!(outcome.kept.series.time().last(), Some(&end));
}
