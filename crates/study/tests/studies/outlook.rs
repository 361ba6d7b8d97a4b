//! Cost limits of the search for the periodic orbit in the summary of a run.

use std::error::Error;
use std::path::Path;
use stickslip_drive::Counts;
use stickslip_run::Job;
use stickslip_run::outlook::Outlook;
use stickslip_study::steady::outlook;

fn p1(set: &[(&str, &str)]) -> Result<Job, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    let set: Vec<(String, String)> =
        set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    Ok(Job::prepare(&file, &set, Path::new(""))?)
}

/// Expensive time steps reduce the number of steps allowed for the search.
#[test]
fn the_dearer_a_step_the_fewer_are_spent() -> Result<(), Box<dyn Error>> {
    let row = p1(&[("contacts.ball.engine", r#"{"springs":{"count":64000}}"#), ("plots", "[]")])?;
    // 75 000 steps for up to 16 parts; this model has 1001 for the row of springs and one for the slider.
    let told = outlook(&row, None, &|| true);
    assert!(
        matches!(&told, Some(Outlook::NotFound { fault }) if fault.contains("within 1197 time steps")),
        "{told:?}"
    );
    Ok(())
}

#[test]
fn a_scenario_can_do_without() -> Result<(), Box<dyn Error>> {
    assert!(matches!(outlook(&p1(&[])?, None, &|| true), Some(Outlook::Found(_))));
    let without = p1(&[("figures.steady_motion", "false")])?;
    assert_eq!(outlook(&without, None, &|| true), None);
    // The setting is part of the resolved scenario only if it is given.
    assert!(without.resolved.contains("\"steady_motion\": false"));
    assert!(!p1(&[])?.resolved.contains("steady_motion"));
    Ok(())
}

/// The search uses at most a fifth of the time steps of the run, unless it is requested.
#[test]
fn beside_a_run_it_costs_a_fifth_of_its_steps_or_is_asked_for() -> Result<(), Box<dyn Error>> {
    let of = |steps: u64| Some(Counts { steps, rejected: 5, ..Counts::default() });
    let long = p1(&[("run.cycles", "100")])?;
    // The search needs about 90 steps in 12 periods. It is not started if the limit is obviously too small.
    let (short, scarce, enough) = (
        outlook(&p1(&[])?, of(140), &|| panic!("a period of a search for nothing")),
        outlook(&long, of(140), &|| true),
        outlook(&long, of(700), &|| true),
    );
    let is_told = |told: &Option<Outlook>| matches!(told, Some(Outlook::NotFound { fault }) if fault.contains("its limit of 29 time steps, a fifth of those of the run"));
    assert!(is_told(&short) && is_told(&scarce), "{short:?} {scarce:?}");
    assert!(matches!(enough, Some(Outlook::Found(_))), "{enough:?}");
    let asked = p1(&[("figures.steady_motion", "true")])?;
    assert_eq!(outlook(&asked, of(140), &|| true), enough);
    assert!(asked.resolved.contains("\"steady_motion\": true"));
    Ok(())
}

/// Gross slip of a row of springs must be detected, so that its drive makes steps.
#[test]
fn a_drive_on_a_row_of_springs_steps() -> Result<(), Box<dyn Error>> {
    let row = p1(&[("contacts.ball.engine", r#"{"springs":{"count":101}}"#), ("plots", "[]")])?;
    let (Some(Outlook::Found(row)), Some(Outlook::Found(curve))) =
        (outlook(&row, None, &|| true), outlook(&p1(&[])?, None, &|| true))
    else {
        return Err("no motion".into());
    };
    assert!(row.steps() && row.shaken_down.is_empty(), "{row:?}");
    // Accuracy of 101 springs.
    assert!((row.step.0 / curve.step.0 - 1.0).abs() < 0.01, "{} {}", row.step.0, curve.step.0);
    Ok(())
}
