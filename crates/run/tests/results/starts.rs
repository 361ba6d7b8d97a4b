//! Initial equilibrium.

use std::path::Path;
use stickslip_drive::scene::Axis;
use stickslip_run::Job;

/// A spring carries nearly all of the weight until the contact below is pressed. At first, friction holds less of the tangential load.
///
/// The equilibrium must be found near the start. What friction holds has slipped by less than u_c = μE*d/G* (Mindlin; E*/G* = (2 - ν)/(2 -
/// 2ν) for equal materials).
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
        // The larger the load, the farther the body slides.
        assert!(before < x && x < friction * ratio * -z, "{pull}: {x:e} m, {z:e} m deep");
        before = x;
    }
}
