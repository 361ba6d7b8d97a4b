//! Variations by where contacts, springs and loads lie on their bodies, against differences of runs and of their books.

use crate::lottery::Draw;
use crate::parts::{follower, named, of_profile, wave};
use crate::stages::{Foot, earth, force_at, stage, upright};
use crate::variations_by_parameters::apart;
use crate::variations_of_energies;
use std::f64::consts::TAU;
use stickslip_contact::Profile;
use stickslip_drive::scene::{Coordinate, Direction, Point, Scene, Side, Spring};
use stickslip_drive::{Shape, VariationError};

/// A place in a scene: what multiplies it by a factor; false where it moves nothing.
type Place = (&'static str, fn(&mut Scene, f64) -> bool);

const PLACES: [Place; 7] = [
    ("contact on the stage, x", |scene, by| multiplies(&mut scene.contacts[0].part.at[1].x, by)),
    ("contact on the stage, z", |scene, by| multiplies(&mut scene.contacts[0].part.at[1].z, by)),
    ("contact on the foot, x", |scene, by| {
        multiplies(&mut scene.contacts[0].part.at[0].x, by)
            && scene.bodies[0].part.pitch != Coordinate::default()
    }),
    ("contact on the foot, z", |scene, by| {
        multiplies(&mut scene.contacts[0].part.at[0].z, by)
            && scene.bodies[0].part.pitch != Coordinate::default()
    }),
    ("spring that presses", |scene, by| multiplies(&mut scene.springs[0].part.at[1].x, by)),
    ("spring that drags", |scene, by| multiplies(&mut scene.springs[1].part.at[1].z, by)),
    ("load", |scene, by| multiplies(&mut scene.loads[0].at.x, by)),
];

fn multiplies(place: &mut f64, by: f64) -> bool {
    *place *= by;
    true
}

/// A stage on two or three places of a foot that moves to and fro and, by turns, pitches; springs press and drag it, and a load pulls, none
/// of them at its centre.
fn drawn(seed: u64) -> Scene {
    let mut draw = Draw::new(seed);
    let feet = [-1.0, 1.0, 0.1]
        .map(|side| Foot { x: side * draw.between(6e-3, 14e-3), count: 1 + (draw.bits() % 2) as u32 });
    let mut scene =
        stage(&feet[..2 + (seed % 2) as usize], draw.between(3e-3, 8e-3), draw.between(0.12, 0.3));
    let period = draw.between(0.7e-3, 1.4e-3);
    let stroke = draw.between(1e-7, 4e-7);
    let shape = match seed % 3 {
        0 => Shape::Sawtooth { stroke, flyback: 0.1 * period },
        1 => Shape::Sine { amplitude: stroke, phase: 0.0, offset: 0.0 },
        _ => Shape::Cycloid { stroke, flyback: 0.15 * period },
    };
    let mut foot = follower(0);
    scene.waveforms.push(wave("drive", shape, period));
    if seed % 4 < 2 {
        let tilt =
            Shape::Sine { amplitude: draw.between(2e-7, 8e-7), phase: draw.between(0.0, TAU), offset: 0.0 };
        scene.waveforms.push(wave("tilt", tilt, 0.6 * period));
        foot.pitch = Coordinate::follows(1);
    }
    scene.bodies.insert(0, named("foot", foot));
    let profile = match seed % 4 {
        0 => Profile::paraboloid(draw.spread(5e-4, 3e-3)),
        1 => Profile::cone(draw.between(0.01, 0.03)),
        2 => Profile::sphere(draw.spread(5e-4, 3e-3)),
        _ => Profile::power(1e10, 4.0),
    };
    for contact in &mut scene.contacts {
        contact.part.between = [Side::Body(0), Side::Body(1)];
        contact.part.at[0].z = draw.between(1e-3, 3e-3);
        contact.part = of_profile(profile.clone().unwrap(), &contact.part);
    }
    let press = Spring {
        damping: draw.between(0.0, 3.0),
        ..upright(1, Point { x: draw.between(-4e-3, 4e-3), z: 4e-3 }, 1e4, -draw.between(0.3, 0.8))
    };
    let drag = Spring {
        direction: Direction::X,
        stiffness: draw.spread(1e3, 1e5),
        preload: 0.0,
        at: [Point::default(), Point { x: 0.0, z: draw.between(-4e-3, 4e-3) }],
        ..press
    };
    scene.springs = vec![named("press", press), named("drag", drag)];
    scene.loads = vec![force_at(1, (draw.between(-4e-3, 4e-3), 3e-3), (draw.between(-0.02, 0.02), -0.05))];
    scene.gravity = earth(0.0);
    scene
}

/// Each place of twelve drawn stages: motions of the stage and energies of the run, to 1e-7 where differences are good to 1e-8.
#[test]
#[ignore = "takes long: .ci/full"]
fn drawn_stages_vary_by_where_their_parts_lie() {
    let (mut told, mut sharp) = ([0; 2], [0; 2]);
    for seed in 0..12 {
        let scene = drawn(seed);
        let until = Draw::new(4_000 + seed).between(0.5, 1.8) * 1e-3;
        for (name, change) in PLACES {
            if !change(&mut scene.clone(), 1.0) {
                continue;
            }
            let of = |by: f64| {
                let mut scene = scene.clone();
                change(&mut scene, by);
                scene
            };
            let motions = match apart(&of, until) {
                Ok(motions) => motions,
                // A cycloid begins without an acceleration.
                Err(VariationError::Grazes { .. }) => continue,
                Err(error) => panic!("{seed}, {name}: {error}"),
            };
            let energies = variations_of_energies::apart(&of, until);
            for (kind, found) in [Some(motions), energies].into_iter().enumerate() {
                let Some((off, doubt)) = found else { continue };
                println!(
                    "{seed}, {name}: {} off by {off:.1e}, differences by {doubt:.1e}",
                    ["motions", "energies"][kind]
                );
                told[kind] += 1;
                sharp[kind] += usize::from(doubt < 1e-8);
                assert!(
                    doubt > 1e-8 || off < 1e-7,
                    "{seed}, {name}: off by {off:e}, differences by {doubt:e}"
                );
            }
        }
    }
    println!("{sharp:?} of {told:?}");
    assert!(sharp.iter().all(|sharp| *sharp > 30), "{sharp:?} of {told:?}");
}
