//! Starts in equilibrium.

use std::path::Path;
use stickslip_drive::scene::Axis;
use stickslip_run::Job;

/// A spring takes nearly all of the weight until the contact below is pressed as much as it is stiff: until then friction holds less of
/// the pull than in the end. The search slid for want of it, and was in balance metres away. What friction holds has slid by less
/// than u_c = μE*d/G* (Mindlin; E*/G* = (2 - ν)/(2 - 2ν) of equal materials).
#[test]
fn what_friction_holds_is_found_where_it_began() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pulled_on_a_spring.json");
    let (friction, poisson) = (0.1, 0.3);
    let ratio = (2.0 - poisson) / (2.0 - 2.0 * poisson);
    let mut before = 0.0;
    for pull in ["1 mN", "3 mN", "5 mN", "8 mN", "12 mN", "16 mN"] {
        let set = [("loads[1].x".to_owned(), pull.to_owned())];
        let job = Job::prepare(&file, &set, Path::new("")).unwrap();
        let place = |axis| job.start.coordinate(&job.model, 0, axis).unwrap().0;
        let [x, z] = [Axis::X, Axis::Z].map(place);
        // The more it pulls the farther it slides.
        assert!(before < x && x < friction * ratio * -z, "{pull}: {x:e} m, {z:e} m deep");
        before = x;
    }
}
