//! The examples.

use crate::program::{listing, number, run_example, scenario, summary};
use tempfile::tempdir;

#[test]
fn every_example_runs_to_its_end_and_balances() {
    let out = tempdir().unwrap();
    let folder = scenario("quickstart");
    let folder = folder.parent().unwrap();
    let names = listing(folder);
    let names: Vec<&str> = names.iter().filter_map(|name| name.strip_suffix(".json")).collect();
    assert!(names.len() >= 7);
    for name in names {
        let summary = summary(&run_example(name, out.path(), &[]));
        assert!(summary.get("notes").is_none(), "{name}: {}", summary["notes"]);
        // Local errors of the tolerance, 1e-8 or better, over up to some thousand steps.
        let error = number(&summary, "/energy/largest_error_relative");
        assert!(error < 1e-6, "{name}: {error:e}");
    }
}
