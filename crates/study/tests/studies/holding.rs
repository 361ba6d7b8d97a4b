//! Holding forces, compared with closed forms and with runs of the drive at rest.

use crate::prepared;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_drive::{Plan, Run};
use stickslip_run::{Job, Watcher};
use stickslip_study::curve::CurveError;
use stickslip_study::curve::holding::{Held, Holding, Holdless, csv, json};

type Checked = Result<(), Box<dyn Error>>;

/// Run settings that replace those of the scenario.
const RUN: &str = r#"{"duration": "1 s", "stepper": {"event": {"tolerance": 1e-9}}}"#;
/// Relative tolerance.
const TOLERANCE: f64 = 1e-6;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

fn holding(name: &str, set: &[(&str, &str)], over: Option<&str>) -> Result<Holding, CurveError> {
    let set: Vec<(String, String)> = set.iter().map(|(p, v)| ((*p).to_owned(), (*v).to_owned())).collect();
    Holding::new(prepared(&file(name), &set)?, over)
}

type Ways = [Result<Held, Holdless>; 2];

/// Returns the holding forces along +x and -x at each value.
fn ways(holding: &Holding, values: &[f64]) -> Result<Vec<Ways>, CurveError> {
    Ok(holding.trace(values, TOLERANCE, 2, &())?.into_iter().map(|point| point.ways).collect())
}

fn are(ways: Ways, wanted: [f64; 2]) -> Checked {
    for (held, wanted) in ways.into_iter().zip(wanted) {
        let held = held?;
        assert!((held.force / wanted - 1.0).abs() <= TOLERANCE, "{held:?} {wanted}");
        assert!(held.half_width <= 0.5 * TOLERANCE * wanted * 1.001, "{held:?}");
    }
    Ok(())
}

/// The quickstart without load holds μF_N in both directions: 0.2 times the preload of three balls.
#[test]
fn one_contact_holds_its_friction() -> Checked {
    let holding = holding("quickstart.json", &[("loads", "[]")], None)?;
    let values = [0.05, 0.9, 30.0];
    for (value, ways) in values.into_iter().zip(ways(&holding, &values)?) {
        are(ways, [0.2 * value; 2])?;
    }
    Ok(())
}

/// An existing load reduces the holding force in its direction and increases it in the other.
#[test]
fn a_load_that_is_there_counts() -> Checked {
    let holding = holding("quickstart.json", &[], Some("contacts.ball.friction"))?;
    let [some, less] = &ways(&holding, &[0.2, 0.01])?[..] else { panic!("two") };
    are(some.clone(), [0.2 * 0.9 + 0.02, 0.2 * 0.9 - 0.02])?;
    // 9 mN of friction do not hold 20 mN.
    for way in less {
        let Err(Holdless::Without(lost)) = way else { panic!("{way:?}") };
        assert_eq!(lost.words(), "slider slides away");
    }
    Ok(())
}

/// On an incline α the weight acts along -x: μF_N ± m g sin α.
#[test]
fn an_incline_takes_the_weight_from_one_way_and_gives_it_to_the_other() -> Checked {
    let gravity = r#"{"acceleration": 9.81, "incline": "20 deg"}"#;
    let holding = holding("quickstart.json", &[("loads", "[]"), ("gravity", gravity)], None)?;
    let weight = 10e-3 * 9.81 * 20_f64.to_radians().sin();
    for (value, ways) in [0.3, 0.9].into_iter().zip(ways(&holding, &[0.3, 0.9])?) {
        are(ways, [0.2 * value + weight, 0.2 * value - weight])?;
    }
    Ok(())
}

/// Two contacts with different friction slip one after another; the sum of their limits is held.
#[test]
fn contacts_of_different_friction_hold_their_sum() -> Checked {
    let second = r#"{"between": ["ground", "slider"], "materials": ["ruby", "steel"],
        "profile": {"paraboloid": {"radius": "2 mm"}}, "friction": 0.05, "normal": {"force": "4 N"}}"#;
    let set = [("loads", "[]"), ("contacts.guide", second)];
    let holding = holding("quickstart.json", &set, Some("contacts.ball.friction"))?;
    for (friction, ways) in [0.02, 0.4].into_iter().zip(ways(&holding, &[0.02, 0.4])?) {
        are(ways, [friction * 0.9 + 0.05 * 4.0; 2])?;
    }
    Ok(())
}

/// A body on top of the slider slides with it. The holding force is μF_N of the slider's own contact, or of both if the upper body has a
/// contact of its own. Equilibria of sliding pairs that rounding simulates at distances of hundreds of metres must not count.
#[test]
fn what_slides_together_is_not_held_by_rounding() -> Checked {
    let body = ("bodies.rider", r#"{"mass": "10 g", "x": "free"}"#);
    let loaded = ("figures", r#"{"body": "slider"}"#);
    let rides = r#"{"between": ["slider", "rider"], "materials": ["steel", "steel"],
        "profile": {"cone": {"slope": 0.02}}, "friction": 0.3, "normal": {"force": "0.5 N"}, "count": 2}"#;
    let found = holding(
        "quickstart.json",
        &[("loads", "[]"), body, loaded, ("contacts.top", rides)],
        Some("contacts.ball.normal.force"),
    )?;
    let forces = [0.01, 1.0];
    for (force, ways) in forces.into_iter().zip(ways(&found, &forces)?) {
        are(ways, [0.2 * 3.0 * force; 2])?;
    }
    let hung = r#"{"between": ["slider", "rider"], "stiffness": 1e5}"#;
    let own = r#"{"between": ["ground", "rider"], "materials": ["steel", "steel"],
        "profile": {"paraboloid": {"radius": "1 mm"}}, "friction": 0.15, "normal": {"force": "1 N"}}"#;
    let set =
        [("loads", "[]"), body, loaded, ("springs", &format!(r#"{{"tie": {hung}}}"#)), ("contacts.own", own)];
    let found = holding("quickstart.json", &set, Some("contacts.ball.normal.force"))?;
    for (force, ways) in forces.into_iter().zip(ways(&found, &forces)?) {
        are(ways, [0.2 * 3.0 * force + 0.15; 2])?;
    }
    Ok(())
}

/// Bodies pressed by their own weight: the holding force is μN minus or plus the existing load.
#[test]
fn what_slides_under_its_own_weight_is_not_held_by_rounding() -> Checked {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/stacked.json");
    let found = Holding::new(prepared(Path::new(file), &[])?, Some("contacts.c00.friction"))?;
    let (normal, pull) =
        (0.09110279481868781 + 0.2582944690591921, 0.0030996927685020804 + 0.004467301331380124);
    let values = [0.03, 0.1, 0.17];
    for (friction, ways) in values.into_iter().zip(ways(&found, &values)?) {
        are(ways, [friction * normal + pull, friction * normal - pull])?;
    }
    Ok(())
}

/// The load on the driven stage is carried by its balls, with a friction limit of 3·0.15·5 N, and through the foot by the stack.
#[test]
fn a_stage_is_held_by_the_contacts_of_its_foot() -> Checked {
    let holding = holding("driven_stage.json", &[], Some("contacts.balls.friction"))?;
    for (friction, ways) in [0.15, 0.6].into_iter().zip(ways(&holding, &[0.15, 0.6])?) {
        let lost = ways[0].clone()?.lost;
        assert_eq!(lost.words(), "stage slides away");
        are(ways, [friction * 15.0; 2])?;
    }
    Ok(())
}

/// A sledge presses three equal balls by its weight: two balls with friction hold μ 2mg/3; without friction nothing is held.
#[test]
fn what_its_weight_presses_is_held_by_its_weight() -> Checked {
    let set = [
        ("loads", "[]"),
        ("gravity", r#"{"acceleration": 9.81}"#),
        ("contacts.front.friction", "0"),
        ("bodies.stage.pitch", r#""fixed""#),
    ];
    let found = holding("three_ball_stage.json", &set, Some("contacts.rear.friction"))?;
    let [none, some] = &ways(&found, &[0.0, 0.3])?[..] else { panic!("two") };
    are(some.clone(), [0.3 * 50e-3 * 9.81 * 2.0 / 3.0; 2])?;
    for way in none {
        let held = way.clone()?;
        assert!(held.force == 0.0 && held.half_width < 1e-10, "{held:?}");
    }
    Ok(())
}

/// A stage that may pitch: friction acts h = 6 mm below the load. A normal force of F h/2a moves from one end to the
/// other, with a = 12 mm. Balls of different friction then hold F = (μ₁N₁ + μ₂N₂)/(1 ± (μ₂ - μ₁) h/2a).
#[test]
fn a_load_above_the_contacts_presses_one_end() -> Checked {
    let set = [("gravity", r#"{"acceleration": 9.81}"#)];
    let found = holding("three_ball_stage.json", &set, Some("contacts.rear.friction"))?;
    let weight = 50e-3 * 9.81 + 0.6;
    // The additional 0.3 N act 8 mm in front of the middle.
    let (front, rear) = (0.5 * weight + 0.3 * 20.0 / 24.0, 0.5 * weight + 0.3 * 4.0 / 24.0);
    for (friction, ways) in [0.1, 0.4].into_iter().zip(ways(&found, &[0.1, 0.4])?) {
        let (sum, moved) = (0.2 * front + friction * rear, (friction - 0.2) * 6.0 / 24.0);
        are(ways, [sum / (1.0 + moved), sum / (1.0 - moved)])?;
    }
    Ok(())
}

/// A block on two feet, h below its centre, tips over the front foot at F = m g a/h. Lever arms do not change for small
/// rotations; equilibria at large angles, which rounding simulates, must not count.
#[test]
fn a_block_holds_what_does_not_tip_it() -> Checked {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/tipping_block.json");
    for (mass, ahead, behind) in
        [(0.05, 8e-3, 8e-3), (2e-3, 20e-3, 3e-3), (0.4, 1e-3, 11e-3), (3.0, 5e-3, 0.5e-3)]
    {
        let [mass_is, ahead_is, behind_is] = [mass, ahead, -behind].map(|number: f64| number.to_string());
        let set = [
            ("bodies.b.mass", mass_is),
            ("contacts.front.at.b.x", ahead_is),
            ("contacts.rear.at.b.x", behind_is),
        ];
        let set = set.map(|(path, value)| (path.to_owned(), value));
        let found = Holding::new(prepared(Path::new(file), &set)?, Some("contacts.front.friction"))?;
        let point = found.trace(&[2.0], 1e-7, 1, &())?.remove(0);
        for (way, arm) in point.ways.into_iter().zip([ahead, behind]) {
            let (held, tips) = (way?, mass * 9.80665 * arm / 20e-3);
            assert!((held.force - tips).abs() <= held.half_width, "{held:?} {tips}");
            assert!(
                held.half_width < 1e-7 * mass * 9.80665 && held.lost.words() == "b slides or tips over",
                "{held:?}"
            );
        }
    }
    Ok(())
}

#[test]
fn a_spring_has_no_finite_holding_force() -> Checked {
    let spring = r#"{"between": ["ground", "slider"], "stiffness": "1 N/mm"}"#;
    let holding = holding("quickstart.json", &[("springs.clamp", spring)], None)?;
    for way in &ways(&holding, &[0.9])?[0] {
        assert!(matches!(way, Err(Holdless::Endless { load }) if *load > 10.0), "{way:?}");
    }
    let told = csv(&holding, &holding.trace(&[0.9], 1e-3, 1, &())?);
    assert!(told.contains("no finite holding force: "), "{told}");
    Ok(())
}

/// Comparison with runs: the load rises in 0.2 s and remains for 0.2 s. Slightly below the holding force the body only
/// creeps; slightly above it slides away.
#[test]
fn runs_slide_away_beyond_it_and_creep_below() -> Checked {
    let drawn = |name: &str, set: &[(&str, &str)], body: &str| -> Checked {
        let holding = holding(name, set, None)?;
        let value = holding.variation.present.ok_or("a preload")?;
        let [along, against] = ways(&holding, &[value])?.remove(0);
        for (sense, held) in [(1.0, along?), (-1.0, against?)] {
            for share in [0.98, 1.02] {
                let load = sense * share * held.force;
                let ramp = format!(r#"{{"table": {{"points": [[0, 0], [0.2, {load}]]}}}}"#);
                let on = format!(r#"{{"on": "{body}", "x": {{"follows": "pull"}}}}"#);
                let rest = r#"{"table": {"points": [[0, 0], [1, 0]]}}"#;
                let pull = ("waveforms.pull", ramp.as_str());
                let more = [("run", RUN), ("waveforms.drive", rest), pull, ("loads[+]", on.as_str())];
                let all = set.iter().chain(&more);
                let all: Vec<(String, String)> =
                    all.map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
                let job = Job::prepare(&file(name), &all, Path::new(""))?;
                let b = job.scenario.figures.body.ok_or("a body")?;
                let plan = Plan { every: None, duration: f64::MAX, ..job.scenario.plan };
                let mut run = Run::new(&job.model, &plan, job.start.clone())?;
                run.advance(0.4, &mut ())?;
                let way = sense * run.state().body(&job.model, b).ok_or("a body")?.0;
                let natural = job.contact_scale(0).0;
                match share < 1.0 {
                    true => assert!(way.abs() < 3.0 * natural, "{name} {load}: {way}"),
                    false => assert!(way > 1e3 * natural, "{name} {load}: {way}"),
                }
            }
        }
        Ok(())
    };
    let gravity = r#"{"acceleration": 9.81, "incline": "20 deg"}"#;
    drawn("quickstart.json", &[("gravity", gravity)], "slider")?;
    drawn("ruby_drive.json", &[], "slider")
}

/// Watcher that interrupts after a number of points.
struct Patience(AtomicUsize);

impl Watcher for Patience {
    fn reached(&self, done: f64) {
        self.0.store(done as usize, Ordering::Relaxed);
    }
    fn goes_on(&self) -> bool {
        self.0.load(Ordering::Relaxed) < 3
    }
}

#[test]
fn any_number_of_cores_tells_the_same_and_an_interrupt_keeps_what_is_done() -> Checked {
    let holding = holding("quickstart.json", &[], Some("contacts.ball.friction"))?;
    // Some values are invalid, some do not hold the load.
    let values: Vec<f64> = (0..12).map(|k| -0.1 + 0.05 * f64::from(k)).collect();
    let told = [1, 2, 3].map(|cores| holding.trace(&values, 1e-4, cores, &()));
    assert!(told[0] == told[1] && told[0] == told[2]);
    let points = told[0].clone()?;
    assert!(matches!(points[0].ways[0], Err(Holdless::Scenario(_))), "{:?}", points[0]);
    let table = csv(&holding, &points);
    assert_eq!(table.lines().count(), 13);
    assert!(json(&holding, &points).contains(r#""status":"done","curve":"holding-force""#));
    let cut = holding.trace(&[0.2; 6], 1e-4, 1, &Patience(AtomicUsize::new(0)))?;
    assert_eq!(cut.iter().filter(|point| point.is_done()).count(), 3);
    assert!(json(&holding, &cut).contains(r#""status":"interrupted""#));
    Ok(())
}

#[test]
fn scenes_that_hold_nothing_are_refused() {
    let refused =
        |name, set: &[(&str, &str)], over| holding(name, set, over).err().map(|error| error.to_string());
    let says = |refused: Option<String>, words: &str| {
        let refused = refused.unwrap_or_default();
        assert!(refused.contains(words), "{refused}");
    };
    says(refused("worn_ball.json", &[], None), "no body is free along x");
    says(refused("three_ball_stage.json", &[], None), "has a constant normal force");
    let smooth = [("contacts.ball.friction", "0")];
    says(refused("ruby_drive.json", &smooth, None), "has friction");
    assert_eq!(refused("ruby_drive.json", &smooth, Some("contacts.ball.friction")), None);
    says(refused("ruby_drive.json", &[], Some("contacts.bal.friction")), "did you mean \"ball\"?");
    let found = holding("ruby_drive.json", &[], None).and_then(|found| found.trace(&[0.9], 0.5, 1, &()));
    assert_eq!(found.err(), Some(CurveError::Tolerance(0.5)));
}
