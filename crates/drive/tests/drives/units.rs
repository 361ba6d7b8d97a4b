//! Results do not depend on the units of a model: there are no absolute thresholds.

use crate::parts::{channel, event};
use crate::soak::{Units, pressed, pressed_in};
use stickslip_drive::{Model, Plan, Run, Scene};

const SEEDS: u64 = 60;

/// End of a run: positions and u_c (m), friction work (J), number of events.
struct End {
    unit: f64,
    x: f64,
    z: f64,
    friction: f64,
    events: u64,
}

fn end(scene: &Scene, plan: &Plan) -> End {
    let model = Model::new(scene).unwrap();
    let mut run = Run::new(&model, plan, model.start(plan).unwrap()).unwrap();
    run.finish(&mut ()).unwrap();
    let mut row = Vec::new();
    run.row(&mut row);
    let value = |name: &str| row[channel(&model, name)];
    End {
        unit: model.contact_natural(0).unwrap().displacement,
        x: value("slider.x_m"),
        z: value("slider.z_m"),
        friction: value("ball.friction_J"),
        events: run.state().counts().events,
    }
}

/// Powers of two scale without rounding, and so do square roots of even powers. Frictionless contacts are excluded, because their
/// method starts with a seventh root.
#[test]
fn other_units_are_the_same_scene() {
    let two = |exponent: i32| 2.0_f64.powi(exponent);
    let units = [(-40, -12, -10), (20, 12, 8), (0, -24, 0), (0, 0, -20)].map(|(m, l, t)| Units {
        mass: two(m),
        length: two(l),
        time: two(t),
    });
    let mut runs = 0;
    for seed in 0..SEEDS {
        let (scene, period) = pressed(seed);
        if scene.contacts[0].part.interface.friction() == 0.0 {
            continue;
        }
        for tolerance in [1e-6, 1e-8] {
            let here = end(&scene, &event(tolerance, 3.0 * period));
            for units in units {
                let (scene, period) = pressed_in(seed, units);
                let there = end(&scene, &event(tolerance, 3.0 * period));
                let off = [
                    (here.x - there.x / units.length) / here.unit,
                    (here.z - there.z / units.length) / here.unit,
                    // A contact without slip has done no work.
                    (here.friction - there.friction / units.energy()) / here.friction.abs().max(1e-300),
                ];
                assert!(off.iter().all(|off| off.abs() < 1e-12), "{seed} {tolerance:e}: {off:?}");
                assert_eq!(here.events, there.events, "{seed} {tolerance:e}");
                runs += 1;
            }
        }
    }
    println!("{runs} runs");
    assert!(runs > 300, "{runs}");
}
