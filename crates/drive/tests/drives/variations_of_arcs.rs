//! Variations along arcs of swings, which have a closed form, against the equations integrated along them: a variation that leads
//! energies as well knows no closed form.

use crate::parts::{event, of_friction, of_profile, p1, push};
use crate::variations::size;
use crate::variations_by_parameters::{NUMBERS, built, parameter};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Axis, Scene};
use stickslip_drive::{Model, Parameter, Plan, Run};

/// Derivatives of x and ẋ of the slider at a time by all numbers.
fn varied((model, plan): (&Model, &Plan), parameters: &[Parameter], is_closed: bool) -> Vec<Vec<f64>> {
    let start = model.start(plan).unwrap();
    let mut variation = model.variation((plan, &start), parameters).unwrap();
    if !is_closed {
        variation = variation.with_energies();
    }
    let mut run = Run::new(model, plan, start).unwrap();
    run.advance(plan.duration, &mut variation).unwrap();
    run.stop(&mut ());
    variation.finish(run.state()).unwrap();
    let of = |j: usize| variation.coordinate(1, Axis::X, j).map(|(x, v)| vec![x, v]).unwrap();
    (0..parameters.len()).map(of).collect()
}

/// The benchmark drive on a profile, or on that and a paraboloid of less friction beside it.
fn drive(profile: &Profile, is_pair: bool, load: f64) -> Scene {
    let mut scene = p1();
    let paraboloid = scene.contacts[0].part.clone();
    scene.contacts[0].part = of_profile(profile.clone(), &paraboloid);
    if is_pair {
        scene.contacts.push(crate::parts::named("beside", of_friction(0.1, &paraboloid)));
    }
    scene.loads.push(push(1, load));
    scene
}

/// Cones, powers and the exact sphere, alone and beside a paraboloid, under a load or none: passages, arcs that are cut, arcs that
/// end in the centre, gross slip. To what the equations have next to the centre of a power 4, where the stiffness goes with the fourth root
/// of the height; elsewhere they agree to some 1e-10.
#[test]
fn arcs_vary_as_the_equations_along_them() {
    // The last piece of a cone bends where it begins: at less than this no step of the equations is short enough.
    let profiles = [
        (Profile::cone(0.01), 1e-10),
        (Profile::paraboloid(1e-3), 1e-13),
        (Profile::power(1e3, 3.0), 1e-13),
        (Profile::power(1e12, 4.0), 1e-13),
        (Profile::sphere(1e-3), 1e-13),
    ];
    let mut worst = 0.0_f64;
    for (profile, tolerance) in profiles.map(|(profile, tolerance)| (profile.unwrap(), tolerance)) {
        for (is_pair, load) in [(false, 0.0), (false, 0.05), (true, 0.0)] {
            let scene = drive(&profile, is_pair, load);
            let (model, plan) = (built(&scene), event(tolerance, 3.47e-3));
            let applies = |change: fn(&mut Scene, f64) -> bool| change(&mut scene.clone(), 1.0);
            let numbers = NUMBERS.iter().filter(|(name, change)| *name != "period" && applies(*change));
            let numbers: Vec<Parameter> = numbers
                .map(|(_, change)| {
                    let of = |by: f64| {
                        let mut scene = scene.clone();
                        change(&mut scene, by);
                        scene
                    };
                    parameter(&of, &model).unwrap()
                })
                .collect();
            let [closed, led] = [true, false].map(|is_closed| varied((&model, &plan), &numbers, is_closed));
            let scale = model.contact_natural(0).unwrap();
            let apart = closed.iter().zip(&led).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect());
            let off = size(apart, &led, [scale.displacement, scale.velocity]);
            println!("{profile:?} {is_pair} {load}: {} numbers, off by {off:.1e}", numbers.len());
            assert!(numbers.len() > 5);
            worst = worst.max(off);
        }
    }
    assert!(worst < 1e-8, "{worst:e}");
}
