//! Prescribed paths along straight lines have closed forms, independent of tolerances.
//!
//! References with 30 digits from single springs (`tests/data/straight_walks.json` has the method).

use crate::parts::{column, contact, event, follower, named, trace};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Body, Coordinate, Named, Normal, Scene, Side, Varying};
use stickslip_drive::{Model, Shape, Timing, Trace, Waveform};

/// Time between corners, s; four rows each.
const LEG: f64 = 1e-3;
const TOLERANCES: [f64; 6] = [1e-1, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12];

/// Known data of a path: title, profile, corners (d, u) in m, rows of F_x (N), elastic energy and friction work (J).
struct Known {
    title: String,
    profile: Profile,
    corners: Vec<[f64; 2]>,
    rows: Vec<[f64; 3]>,
}

fn known() -> Vec<Known> {
    let text = include_str!("../data/straight_walks.json");
    let file: serde_json::Value = serde_json::from_str(text).unwrap();
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let histories = file["histories"].as_array().unwrap();
    let of = |history: &serde_json::Value| {
        let profile = &history["profile"];
        Known {
            title: history["title"].as_str().unwrap().to_owned(),
            profile: match profile["kind"].as_str().unwrap() {
                "paraboloid" => Profile::paraboloid(number(&profile["radius_m"])).unwrap(),
                _ => Profile::power(number(&profile["coefficient"]), number(&profile["exponent"])).unwrap(),
            },
            corners: serde_json::from_value(history["corners"].clone()).unwrap(),
            rows: serde_json::from_value(history["rows"].clone()).unwrap(),
        }
    };
    histories.iter().map(of).collect()
}

fn table(name: &str, values: impl Iterator<Item = f64>) -> Named<Waveform> {
    let points = values.enumerate().map(|(i, value)| (i as f64 * LEG, value)).collect();
    named(name, Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap())
}

/// Foot on the ground, moved along u and pressed to d; no coordinate is free.
fn rig(known: &Known) -> Scene {
    let mut ball = contact([Side::Body(0), Side::Ground], known.profile.clone(), 0.15, 1.0);
    ball.normal = Normal::Indentation(Varying::Follows(1));
    Scene {
        waveforms: vec![
            table("u", known.corners.iter().map(|[_, u]| u - known.corners[0][1])),
            table("d", known.corners.iter().map(|[d, _]| *d)),
        ],
        bodies: vec![named("foot", follower(0))],
        contacts: vec![named("ball", ball)],
        ..Scene::default()
    }
}

/// The same, pressed by the motion of the bodies.
fn coupled_rig(known: &Known) -> Scene {
    let mut scene = rig(known);
    scene.bodies[0].part = Body { z: Coordinate::follows(1), ..follower(0) };
    let ball = &mut scene.contacts[0].part;
    (ball.normal, ball.gap) = (Normal::Coupled, 0.0);
    scene
}

fn walk(known: &Known, scene: &Scene, tolerance: f64) -> (Model, Trace) {
    let duration = (known.corners.len() - 1) as f64 * LEG;
    let (model, _, trace) = trace(scene, &event(tolerance, duration), 0.25 * LEG);
    (model, trace)
}

/// Input work is integrated separately, so the balance closes to the tolerance instead of rounding.
#[test]
fn books_of_straight_walks_close_to_the_tolerance() {
    for known in known() {
        for tolerance in TOLERANCES {
            let (model, trace) = walk(&known, &rig(&known), tolerance);
            let work = known.rows.iter().fold(0.0, |most: f64, row| most.max(row[1] + row[2]));
            let left = column(&model, &trace, "energy.error_J");
            let left = left.iter().fold(0.0, |most: f64, left| most.max(left.abs())) / work;
            println!("{} at {tolerance:e}: {left:e}", known.title);
            assert!(left < 100.0 * tolerance + 1e-13, "{} at {tolerance:e}: {left:e}", known.title);
        }
    }
}

/// Largest errors of force, elastic energy and friction work, relative to the largest value of each.
fn errors(known: &Known, scene: &Scene, tolerance: f64) -> [f64; 3] {
    let (model, trace) = walk(known, scene, tolerance);
    let channels = ["ball.fx_N", "ball.elastic_J", "ball.friction_J"];
    let columns = channels.map(|name| column(&model, &trace, name));
    let off = |k: usize| {
        let largest = known.rows.iter().fold(0.0, |most: f64, row| most.max(row[k].abs()));
        assert_eq!(columns[k].len(), known.rows.len(), "{}", known.title);
        let pairs = columns[k].iter().zip(&known.rows);
        pairs.fold(0.0, |most: f64, (value, row)| most.max((value - row[k]).abs() / largest))
    };
    [off(0), off(1), off(2)]
}

#[test]
fn walks_along_straight_lines_do_not_depend_on_the_tolerance() {
    for known in known() {
        for scene in [rig(&known), coupled_rig(&known)] {
            for tolerance in TOLERANCES {
                let errors = errors(&known, &scene, tolerance);
                println!("{} at {tolerance:e}: {errors:?}", known.title);
                for error in errors {
                    assert!(error < 1e-13, "{} at {tolerance:e}: {errors:?}", known.title);
                }
            }
        }
    }
}
