//! Linear state-space models of scenarios, compared with the closed form of one slider.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use stickslip_run::linear::{LinearError, StateSpace};
use stickslip_run::{Job, Table};

fn job(name: &str, set: &[(&str, &str)]) -> Job {
    let file: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{name}.json"));
    let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    Job::prepare(&file, &set, Path::new("")).unwrap()
}

/// m ẍ = k (w - x) + c (ẇ - ẋ). With v = ẋ - (c/m) w, the input rate disappears.
#[test]
fn a_slider_on_a_driven_foot_is_an_oscillator() {
    let beta = 2e-6;
    let job = job("quickstart", &[("contacts.ball.damping", "2 us")]);
    let found = StateSpace::of(&job, |d| d.start).unwrap();
    let d = job.model.indentations(&job.start, 0).unwrap().start;
    let squared = job.model.contact_resonance(0, d).unwrap().powi(2);
    let rate = beta * squared;
    let near =
        |got: f64, expected: f64| assert!((got - expected).abs() <= 1e-14 * squared, "{got} {expected}");
    assert_eq!((&found.inputs[..], found.outputs.len()), (&["drive_m".to_owned()][..], 2));
    assert_eq!(found.outputs, ["slider.x_m", "slider.vx_m_s"]);
    near(found.a[0][1], 1.0);
    near(found.a[1][0], -squared);
    near(found.a[1][1], -rate);
    near(found.b[0][0], rate);
    near(found.b[1][0], squared - rate * rate);
    near(found.d[1][0], rate);
    let modes = stickslip_run::info::modes(&job);
    near((TAU * modes[0].frequency.0).powi(2), squared);
}

#[test]
fn what_has_no_linear_system_says_why() {
    let still = job("oblique_loading", &[]);
    assert!(matches!(StateSpace::of(&still, |d| d.start), Err(LinearError::NothingFree(_))));
    let balanced = job("fretting_force", &[]);
    let error = StateSpace::of(&balanced, |d| d.start).unwrap_err();
    assert!(error.to_string().contains("fretting_force"), "{error}");
}

/// Rows in memory of a run with a summary equal those of a bare run, and so do the events.
#[test]
fn rows_beside_a_summary_are_those_of_a_bare_run() {
    for name in ["quickstart", "rocking_slider", "piezo_stack"] {
        let job = job(name, &[]);
        let mut bare = Table::of(&job.columns);
        stickslip_drive::run(&job.model, &job.scenario.plan, &mut job.start.clone(), &mut bare).unwrap();
        let outcome = job.run_with_table(&());
        assert!(outcome.table.as_ref() == Some(&bare), "{name}");
        let again = job.with(&[("title".to_owned(), "other".to_owned())]).unwrap();
        assert_eq!((again.title(), &again.name), ("other", &job.name));
    }
}
