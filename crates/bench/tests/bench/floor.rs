//! Compares the minimal code for the benchmark drive with the event stepper at 1e-12.

use stickslip_bench::floor::{Floor, Rule};
use stickslip_drive::{Model, run};
use stickslip_scenario::Scenario;

const P1: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/p1.json");

/// Returns the position of the slider after a number of periods, m.
fn stepped(periods: &str) -> f64 {
    let set = [("run.stepper.event.tolerance", "1e-12"), ("run.cycles", periods)];
    let scenario = Scenario::load_with(P1, &set).unwrap();
    let model = Model::new(&scenario.scene).unwrap();
    let mut state = model.start(&scenario.plan).unwrap();
    run(&model, &scenario.plan, &mut state, &mut ()).unwrap();
    state.body(&model, 1).unwrap().0
}

/// Errors are in units of u_c. With 32 nodes only rounding errors remain, over 160 and 1 600 u_c of displacement. With 4, 10 and 16
/// nodes, quadrature errors remain.
#[test]
fn the_least_code_is_the_benchmark_drive() {
    let floor = Floor::p1();
    for (periods, name) in [(1, "1"), (20, "20"), (200, "200")] {
        let exact = stepped(name);
        let off = |place: f64| (place - exact).abs() / floor.length;
        let (coarse, middle) =
            (floor.place(periods, &Rule::<4>::default()), floor.place(periods, &Rule::<10>::default()));
        let fine = floor.place(periods, &Rule::<16>::default());
        let finest = floor.place(periods, &Rule::<32>::default());
        let errors = [coarse, middle, fine, finest].map(off);
        println!("{periods}: {errors:?}");
        let limits = [1e-3, 1e-6, 1e-8, 1e-10];
        assert!(errors.iter().zip(limits).all(|(error, limit)| error < &limit), "{periods}: {errors:?}");
    }
}
