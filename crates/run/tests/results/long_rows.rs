//! Spring rows under varying normal loads with long travel (`vertical_climber`, `impact_drive`).
//!
//! Rounding of time and position must not cause endless detours or stops.

use std::path::Path;
use stickslip_drive::{Counts, Run};
use stickslip_run::Job;

/// Returns the work after half and after all of `cycles` periods, with a row of 64 springs in every contact.
fn halves(name: &str, cycles: u32) -> [Counts; 2] {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name).with_extension("json");
    let plain = Job::prepare(&file, &[], Path::new("")).unwrap();
    let rows = plain.scenario.scene.contacts.iter();
    let rows =
        rows.map(|c| (format!("contacts.{}.engine", c.name), r#"{"springs":{"count":64}}"#.to_owned()));
    let long = [("run.cycles", cycles.to_string()), ("output.every", "1e3".to_owned())];
    let set: Vec<_> = rows.chain(long.map(|(key, value)| (key.to_owned(), value))).collect();
    let job = Job::prepare(&file, &set, Path::new("")).unwrap();
    let plan = job.scenario.plan;
    let mut run = Run::new(&job.model, &plan, job.start.clone()).unwrap();
    run.advance(0.5 * plan.duration, &mut ()).unwrap();
    let half = run.state().counts();
    run.finish(&mut ()).unwrap();
    [half, run.state().counts()]
}

fn costs_the_same_all_along(name: &str, cycles: u32) {
    let [half, whole] = halves(name, cycles);
    assert_eq!(whole.detours, 0, "{name}: {whole:?}");
    assert!(whole.steps < 23 * half.steps / 10, "{name}: {half:?}, {whole:?}");
}

#[test]
fn an_impact_drive_on_rows_costs_the_same_all_along() {
    costs_the_same_all_along("impact_drive", 100);
}

#[test]
fn a_climber_on_rows_costs_the_same_all_along() {
    costs_the_same_all_along("vertical_climber", 100);
}

/// Two bodies start 4 µm above the equilibrium of springs of 98 and 67 N/mm. The spring energy goes into one contact after the other.
///
/// The spring rows must be wide enough for this energy. A span given by the user is kept.
#[test]
fn rows_hold_what_a_stack_out_of_balance_presses() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/stack_out_of_balance.json");
    let job = Job::prepare(&file, &[], Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let given = r#"{"springs": {"count": 60, "span": "72 um"}}"#;
    let set = [("contacts.b1l.engine".to_owned(), given.to_owned())];
    let job = Job::prepare(&file, &set, Path::new("")).unwrap();
    assert!(job.run(&()).error.is_some());
}
