//! The methods and treatments of contacts that [`stickslip_drive::Model::expected`] names include all that a run uses.
//!
//! All examples and random variants with a fixed seed are compared: profiles, engines, integrators, tolerances, friction, damping,
//! waveforms, loads, connections.

use crate::shared::{Lottery, drawn, scenarios};
use std::path::PathBuf;
use stickslip_drive::{Limits, Method, Model, Plan, Stepper, Treatment, run};
use stickslip_scenario::Scenario;

const VARIANTS: usize = 200;
/// Maximum simulated time of a variant, relative to that of the example.
const PART: f64 = 0.3;

/// Runs a scenario and compares. Returns false if it is invalid.
fn compare(file: &std::path::Path, set: &[(String, String)], part: f64) -> bool {
    let overrides: Vec<(&str, &str)> =
        set.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    let Ok(scenario) = Scenario::load_with(file, &overrides) else { return false };
    let Ok(model) = Model::new(&scenario.scene) else { return false };
    let limits = Limits { steps: 200_000, events: 20_000, wall: Some(2.0) };
    let plan = Plan { duration: part * scenario.plan.duration, limits, every: None, ..scenario.plan };
    let Ok(mut state) = model.start(&plan) else { return false };
    let expected = model.expected(&state, plan.stepper);
    // If a run stops itself, its results so far are compared.
    let _ = run(&model, &plan, &mut state, &mut ());
    let told = format!("{} {set:?}: {expected:?}, counted {:?}", file.display(), state.tally());
    for method in Method::ALL {
        assert!(state.tally().steps(method) == 0 || expected.takes(method), "{method:?} of {told}");
    }
    for c in 0..scenario.scene.contacts.len() {
        for treatment in Treatment::ALL {
            let counted = state.tally().intervals(c, treatment);
            assert!(
                counted == 0 || expected.treats(c, treatment).is_some(),
                "{treatment:?} of {c} in {told}"
            );
        }
    }
    // The first named method does most of the work, unless all of it was gross slip.
    let (first, _) = expected.methods[0];
    let done = state.counts().steps == 0
        || [first, Method::Parabola, Method::Brief, Method::BriefNystrom, Method::Graded]
            .iter()
            .any(|m| state.tally().steps(*m) > 0);
    assert!(done, "{first:?} first of {told}");
    true
}

#[test]
fn examples_do_what_is_told_of_them() {
    for file in scenarios() {
        assert!(compare(&file, &[], 1.0), "{}", file.display());
    }
}

/// P1 with a damped contact, below and above the limit of implicit steps.
#[test]
fn what_is_stepped_over_is_told() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    for (damping, stepped_over) in [("1 ms", false), ("1 s", true)] {
        assert!(compare(&file, &[("contacts.ball.damping".to_owned(), damping.to_owned())], 1.0));
        let scenario = Scenario::load_with(&file, &[("contacts.ball.damping", damping)]).unwrap();
        let model = Model::new(&scenario.scene).unwrap();
        let expected = model.expected(&model.start(&scenario.plan).unwrap(), scenario.plan.stepper);
        let told = (expected.takes(Method::Radau), model.is_stiff());
        assert_eq!(told, (stepped_over, stepped_over), "{expected:?}");
    }
}

#[test]
fn drawn_variants_do_what_is_told_of_them() {
    let files = scenarios();
    let mut lottery = Lottery(0x5eed_0f11);
    let (mut ran, mut refused) = (0, 0);
    while ran < VARIANTS {
        let file = &files[lottery.draw(files.len())];
        let base = Scenario::load(file).unwrap();
        let set = drawn(&base, &mut lottery);
        if compare(file, &set, PART) {
            ran += 1;
        } else {
            refused += 1;
        }
        assert!(refused < 3 * VARIANTS, "most variants make no scene");
    }
    println!("{ran} ran, {refused} made no scene");
}

/// A slider on a vibrating foot is moved in closed form, too, and a second ball does not prevent this.
#[test]
fn closed_forms_are_named_where_they_are_taken() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let expected = |name: &str, set: &[(&str, &str)]| {
        let scenario = Scenario::load_with(folder.join(name), set).unwrap();
        let model = Model::new(&scenario.scene).unwrap();
        model.expected(&model.start(&scenario.plan).unwrap(), Stepper::Event { tolerance: 1e-8 })
    };
    let vibrated = expected("vibrated_slider.json", &[]);
    assert!((0..2).all(|c| vibrated.treats(c, Treatment::Closed).is_some()), "{vibrated:?}");
    let second = r#"{"between":["foot","slider"],"materials":["ruby","steel"],"profile":{"paraboloid":{"radius":"0.5 mm"}},"friction":0.2,"normal":{"force":"0.3 N"}}"#;
    let doubled = expected("quickstart.json", &[("contacts.second", second)]);
    assert!(doubled.takes(Method::Parabola) && doubled.takes(Method::Swing), "{doubled:?}");
}
