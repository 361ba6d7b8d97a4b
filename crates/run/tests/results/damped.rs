//! Damped contacts whose damping force has kinks: located by `event`, which agrees with fixed steps on the full force law.

use crate::real_time::rows;
use crate::shared::{Stage, example};
use stickslip_drive::Stepper;

/// Leads that turn in gross slip, in an impact, and that run through paths of growth ahead of the slip front, in an impact drive. Fixed steps
/// evaluate the slip memory itself; halving their length shows their own error.
#[test]
fn kinks_of_the_damping_force_are_found() {
    let impact = [("contacts.foot.friction", "0.064"), ("contacts.foot.damping", "\"0.3 us\"")];
    let drive = [
        ("contacts.front.friction", "0.49"),
        ("contacts.front.damping", "\"100 us\""),
        ("contacts.rear.friction", "0.164"),
        ("contacts.rear.damping", "\"10 us\""),
    ];
    let scenes = [
        ("measured_impact.json", &impact[..], 30e-6, 0.02e-6),
        ("impact_drive.json", &drive[..], 4e-3, 0.5e-6),
    ];
    for (name, set, end, step) in scenes {
        let set: Vec<_> = set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        let stage = Stage::of(&example(name), &set).unwrap();
        let of = |stepper| -> Vec<Vec<f64>> {
            let trace = rows(&stage, stepper, end);
            let channels = stage.job.model.channels();
            let places = (0..channels.len()).filter(|&k| channels[k].name.ends_with(".u_m"));
            places.map(|k| trace.column(k).collect()).collect()
        };
        let apart = |a: &[Vec<f64>], b: &[Vec<f64>]| {
            let travel = a.iter().flatten().fold(0.0, |most: f64, u| most.max(u.abs()));
            let pairs = a.iter().flatten().zip(b.iter().flatten());
            pairs.map(|(a, b)| (a - b).abs() / travel).fold(0.0, f64::max)
        };
        let [coarse, fine] = [step, 0.5 * step].map(|step| of(Stepper::Rk4 { step }));
        let own = apart(&coarse, &fine);
        let off = [1e-6, 1e-9].map(|tolerance| apart(&of(Stepper::Event { tolerance }), &fine));
        println!("{name}: {off:?}, fixed steps {own:e}");
        assert!(own < 3e-4, "{name}: {own:e}");
        assert!(off[0] < 1e-5 + 2.0 * own && off[1] < 1e-7 + 2.0 * own, "{name}: {off:?} {own:e}");
    }
}
