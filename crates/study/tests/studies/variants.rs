//! Runs that reuse the memory of earlier runs: the results are those of single runs, without allocations.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use stickslip_drive::{Model, Plan, Scene, Variants, run};
use stickslip_scenario::Scenario;

/// Returns an example scenario with overrides.
fn scenario(name: &str, set: &[(&str, &str)]) -> Scenario {
    let file = format!("{}/../../scenarios/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut scenario = Scenario::load_with(file, set).unwrap();
    scenario.plan.every = None;
    scenario
}

/// Returns a number between -1 and 1 that depends on the variant.
fn spread(variant: usize, number: u32) -> f64 {
    2.0 * (variant as f64 * f64::from(number).sqrt()).fract() - 1.0
}

/// Different scenarios and methods reuse the same memory one after another.
#[test]
fn a_room_knows_nothing_of_who_had_it_before() {
    let names = [
        "p1",
        "ruby_drive",
        "sine_drive",
        "oblique_impact",
        "three_ball_stage",
        "impact_drive",
        "bouncing_ball",
    ];
    let mut variants = Variants::new();
    for turn in 0..3 {
        for (k, name) in names.into_iter().enumerate() {
            let mut own = scenario(name, &[("run.stepper.event.tolerance", "1e-5")]);
            own.plan.duration = own.plan.duration.min(10e-3);
            let mass = own.scene.bodies.iter_mut().filter_map(|body| body.part.mass.as_mut());
            mass.for_each(|mass| *mass *= 1.0 + 0.01 * spread(turn + k, 3));
            let model = Model::new(&own.scene).unwrap();
            let mut state = model.start(&own.plan).unwrap();
            let alone = run(&model, &own.plan, &mut state, &mut ());
            let shared = variants.run(&own.scene, &own.plan, &mut ());
            assert_eq!(alone.is_ok(), shared.is_ok(), "{name}");
            assert_eq!(&model, variants.model(), "{name}");
            assert_eq!(&state, variants.state(), "{name}");
        }
    }
}

/// Returns the number of allocations of some variants with different masses, friction and initial positions.
fn allocations(scene: &mut Scene, plan: &Plan, variants: &mut Variants, count: usize) -> u64 {
    let mut each = |i: usize| {
        let mass = scene.bodies.iter_mut().filter_map(|body| body.part.mass.as_mut());
        mass.for_each(|mass| *mass *= 1.0 + 1e-3 * spread(i, 2));
        let place = scene.bodies.iter_mut().filter(|body| body.part.is_free());
        place.for_each(|body| body.part.x.position += 1e-9 * spread(i, 3));
        let law = &mut scene.contacts[0].part.interface;
        law.set_friction(law.friction() * (1.0 + 1e-3 * spread(i, 5))).unwrap();
        variants.run(scene, plan, &mut ()).unwrap();
    };
    each(0);
    allocation_counter::measure(|| (1..=count).for_each(&mut each)).count_total
}

#[test]
fn variants_allocate_nothing() {
    for name in ["p1", "ruby_drive", "sine_drive"] {
        let Scenario { mut scene, mut plan, .. } = scenario(name, &[("run.stepper.event.tolerance", "1e-6")]);
        plan.duration = plan.duration.min(20e-3);
        let mut variants = Variants::new();
        assert_eq!(allocations(&mut scene, &plan, &mut variants, 20), 0, "{name}");
    }
}
