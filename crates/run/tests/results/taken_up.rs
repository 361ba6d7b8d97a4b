//! Resumption of a run during an impact, where the slip memory changes with every time step.

use std::path::Path;
use stickslip_drive::{Plan, Run, State};
use stickslip_run::Job;
use stickslip_run::checkpoint::model_key;

/// From the slip of the rebound to the lift-off, the run is saved and resumed at every time step. The results must be identical.
#[test]
fn an_impact_taken_up_anywhere_is_the_impact() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/bouncing_ball.json");
    let job = Job::prepare(&file, &[], Path::new("")).unwrap();
    let (key, whole) = (model_key(&job.scenario), Plan { duration: 0.031, every: None, ..job.scenario.plan });
    let mut undisturbed = Run::new(&job.model, &whole, job.start.clone()).unwrap();
    undisturbed.finish(&mut ()).unwrap();
    for k in 0..40 {
        let half = Plan { duration: 29.6e-3 + f64::from(k) * 5e-6, ..whole };
        let mut first = Run::new(&job.model, &half, job.start.clone()).unwrap();
        first.approach(&mut ()).unwrap();
        let bytes = first.state().to_bytes(&job.model, &key);
        let state = State::from_bytes(&job.model, &key, &bytes).unwrap();
        let mut second = Run::resume(&job.model, &whole, state).unwrap();
        second.finish(&mut ()).unwrap();
        assert!(second.state() == undisturbed.state(), "taken up at {:e} s", first.state().time());
    }
}
