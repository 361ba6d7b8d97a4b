//! The library answers what the program answers.

use crate::program::{listing, run_example, scenario, summary};
use serde_json::Value;
use std::path::Path;
use stickslip_run::Job;
use tempfile::tempdir;

/// A summary without what only files and clocks know.
fn told(mut summary: Value) -> String {
    summary.as_object_mut().unwrap().retain(|key, _| !["timing", "files", "tables"].contains(&key.as_str()));
    serde_json::to_string_pretty(&summary).unwrap()
}

#[test]
fn the_summary_of_every_example_is_that_of_the_library() {
    let out = tempdir().unwrap();
    let set = [("plots".to_owned(), "[]".to_owned())];
    for name in listing(scenario("p1").parent().unwrap()) {
        let Some(name) = name.strip_suffix(".json") else { continue };
        let job = Job::prepare(&scenario(name), &set, Path::new("")).unwrap();
        let (own, _) = stickslip_study::summary(&job, &job.run(&()), &|| true);
        let program = summary(&run_example(name, out.path(), &["plots=[]"]));
        assert_eq!(told(serde_json::from_str(&own.pretty().unwrap()).unwrap()), told(program), "{name}");
    }
}
