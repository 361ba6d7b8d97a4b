//! What is looked for beside a run costs what it is worth, and nothing where nobody wants it.

use std::error::Error;
use std::path::Path;
use stickslip_results::Job;
use stickslip_results::outlook::Outlook;
use stickslip_study::steady::outlook;

fn p1(set: &[(&str, &str)]) -> Result<Job, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    let set: Vec<(String, String)> =
        set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    Ok(Job::prepare(&file, &set, Path::new(""))?)
}

/// Seconds went by beside a run of milliseconds, whatever its limits were.
#[test]
fn the_dearer_a_step_the_fewer_are_spent() -> Result<(), Box<dyn Error>> {
    let row = p1(&[("contacts.ball.engine", r#"{"springs":{"count":64000}}"#), ("plots", "[]")])?;
    // 75 000 steps for 16 parts, of which this row counts for 1 001 and the slider for one.
    let told = outlook(&row, &|| true);
    assert!(
        matches!(&told, Some(Outlook::NotFound { fault }) if fault.contains("within 1197 steps")),
        "{told:?}"
    );
    Ok(())
}

#[test]
fn a_scenario_can_do_without() -> Result<(), Box<dyn Error>> {
    assert!(matches!(outlook(&p1(&[])?, &|| true), Some(Outlook::Found(_))));
    let without = p1(&[("figures.steady_motion", "false")])?;
    assert_eq!(outlook(&without, &|| true), None);
    // What it says is kept, and costs those nothing who say nothing.
    assert!(without.resolved.contains("\"steady_motion\": false"));
    assert!(!p1(&[])?.resolved.contains("steady_motion"));
    Ok(())
}

/// Rows of springs told no gross slip, and so the drive was said to make no step.
#[test]
fn a_drive_on_a_row_of_springs_steps() -> Result<(), Box<dyn Error>> {
    let row = p1(&[("contacts.ball.engine", r#"{"springs":{"count":101}}"#), ("plots", "[]")])?;
    let (Some(Outlook::Found(row)), Some(Outlook::Found(curve))) =
        (outlook(&row, &|| true), outlook(&p1(&[])?, &|| true))
    else {
        return Err("no motion".into());
    };
    assert!(row.steps() && row.shaken_down.is_empty(), "{row:?}");
    // 101 springs are as exact as that.
    assert!((row.step.0 / curve.step.0 - 1.0).abs() < 0.01, "{} {}", row.step.0, curve.step.0);
    Ok(())
}
