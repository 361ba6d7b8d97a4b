//! A drive with gross slip in the forward stroke only during its start. On the periodic orbit its slip memory remains
//! and becomes an unknown that the first periods do not have.

use std::error::Error;
use std::path::Path;
use stickslip_drive::{Model, Plan, Run, Stepper};
use stickslip_run::Job;
use stickslip_study::steady::{self, Options};

const PERIOD: f64 = 167.2e-6;

/// Simulated step lengths approach the steady one with the ratio of the largest multiplier.
#[test]
fn what_a_contact_comes_to_hold_is_a_number_of_the_motion() -> Result<(), Box<dyn Error>> {
    let set = [
        ("bodies.slider.mass", "6 g"),
        ("contacts.ball.friction", "0.0043"),
        ("contacts.ball.normal.force", "1.46 N"),
        ("waveforms.drive.sawtooth.stroke", "42.3 nm"),
        ("waveforms.drive.sawtooth.flyback", "47.2 us"),
        ("waveforms.drive.sawtooth.period", "167.2 us"),
    ];
    let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/p1.json");
    let job = Job::prepare(Path::new(file), &set, Path::new(""))?;
    let model = Model::new(&job.scenario.scene)?;
    let plan = Plan { duration: f64::MAX, stepper: Stepper::Event { tolerance: 1e-13 }, ..job.scenario.plan };
    let mut run = Run::new(&model, &plan, model.start(&plan)?)?;
    let mut places = Vec::new();
    for period in 1..=24 {
        run.advance(f64::from(period) * PERIOD, &mut ())?;
        places.push(run.state().body(&model, 1).ok_or("no slider")?.0);
    }
    let differences = |of: &[f64]| of.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<f64>>();
    let steps = differences(&places);
    let changes = differences(&steps);
    let fades = changes[14] / changes[13];
    let found = steady::find(&job, &Options::default())?;
    let largest = found.multipliers.first().ok_or("no multiplier")?;
    assert!((largest.re - fades).abs() < 1e-3 && largest.im == 0.0, "{largest:?} {fades}");
    assert!((found.step.ok_or("no step")? - steps[22]).abs() < 1e-16);
    Ok(())
}
