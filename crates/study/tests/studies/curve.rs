//! Curves: points compared with simulations, independence of the number of cores, and errors.

use crate::prepared;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_drive::{Plan, Run};
use stickslip_run::{Job, Watcher};
use stickslip_study::curve::{Course, Curve, CurveError, Kind, Motion, Motionless, Point, csv, json};

type Checked = Result<(), Box<dyn Error>>;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenes").join(name)
}

fn curve(name: &str, set: &[(&str, &str)], kind: Kind) -> Result<Curve, CurveError> {
    let set: Vec<(String, String)> = set.iter().map(|(p, v)| ((*p).to_owned(), (*v).to_owned())).collect();
    Curve::new(prepared(&file(name), &set)?, kind)
}

fn motion(point: &Point) -> Result<Motion, Motionless> {
    point.motion.clone()
}

/// Returns the last of `periods` step lengths of a simulation with the overrides of a point, m.
fn last_step(name: &str, point: &Point, periods: u32) -> Result<f64, Box<dyn Error>> {
    let job = Job::prepare(&file(name), &point.set, Path::new(""))?;
    let body = job.scenario.figures.body.ok_or("a body")?;
    let period = motion(point)?.period;
    let plan = Plan { every: None, until_steady: None, duration: f64::MAX, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.start.clone())?;
    let mut x = [0.0; 2];
    for (x, count) in x.iter_mut().zip([periods - 1, periods]) {
        run.advance(f64::from(count) * period, &mut ())?;
        *x = run.state().body(&job.model, body).ok_or("a body")?.0;
    }
    Ok(x[1] - x[0])
}

/// Compares points with simulations, which use the tolerance of the file, 1e-9.
fn is_where_a_run_ends(name: &str, kind: Kind, values: &[f64], periods: u32, within: f64) -> Checked {
    let curve = curve(name, &[], kind)?;
    for point in &curve.trace(values, 1, &()).points {
        let found = motion(point).map_err(|error| format!("{}: {error}", point.value))?;
        let waited = last_step(name, point, periods)?;
        let off = (found.step - waited).abs() / curve.job.contact_scale(0).0;
        assert!(
            off <= within,
            "{name} at {:e}: {:e}, waited {waited:e}, {off:e} u_c",
            point.value,
            found.step
        );
        assert_eq!(found.course, Course::Steady, "{name} at {:e}", point.value);
    }
    Ok(())
}

#[test]
fn steps_over_the_stroke_are_those_of_long_runs() -> Checked {
    is_where_a_run_ends("ruby_drive.json", Kind::StepAmplitude, &[60e-9, 200e-9, 1e-6], 300, 1e-7)
}

#[test]
fn speeds_over_the_frequency_are_those_of_long_runs() -> Checked {
    is_where_a_run_ends("ruby_drive.json", Kind::SpeedFrequency, &[100.0, 1e3, 1e4], 300, 1e-7)
}

#[test]
fn speeds_against_a_load_are_those_of_long_runs() -> Checked {
    is_where_a_run_ends("ruby_drive.json", Kind::ForceSpeed, &[0.0, 0.05, 0.15], 300, 1e-7)
}

/// A driver has a state of its own; its periodic orbit is still found by shooting, with multipliers.
#[test]
fn a_driver_at_its_limit_has_a_curve() -> Checked {
    is_where_a_run_ends("driven_stage.json", Kind::SpeedFrequency, &[500.0, 2e3], 200, 1e-5)?;
    let curve = curve("driven_stage.json", &[], Kind::SpeedFrequency)?;
    for point in &curve.trace(&[500.0, 2e3], 2, &()).points {
        let found = motion(point)?;
        assert!(found.multiplier.is_some_and(|multiplier| multiplier.modulus() < 1.0), "{found:?}");
    }
    Ok(())
}

/// A load against steps to the left acts to the right: the mirrored drive has the mirrored curve.
#[test]
fn a_load_acts_against_the_steps() -> Checked {
    let mirrored = [("waveforms.drive.sawtooth.stroke", "-100 nm")];
    let values = [0.0, 0.05];
    let [right, left] = [&[][..], &mirrored].map(|set| curve("ruby_drive.json", set, Kind::ForceSpeed));
    let (right, left) = (right?, left?);
    let (to_right, to_left) = (right.trace(&values, 1, &()), left.trace(&values, 1, &()));
    assert_eq!((to_right.direction, to_left.direction), (1.0, -1.0));
    for (place, (a, b)) in to_right.points.iter().zip(&to_left.points).enumerate() {
        let (a, b) = (motion(a)?, motion(b)?);
        assert!((a.step + b.step).abs() <= 1e-8 * a.step.abs(), "{} {}", a.step, b.step);
        let (power, expected) = (to_left.power(&left, place).ok_or("a power")?, values[place] * a.speed());
        assert!((power - expected).abs() <= 1e-8 * expected.abs(), "{power} {expected}");
    }
    Ok(())
}

/// Backward, the sawtooth is reversed in time: a fast rise and a slow fall. This is the drive with a negative stroke,
/// which steps in the opposite direction. For a symmetric drive both directions are mirror images.
#[test]
fn backward_is_the_mirror_image_of_a_symmetric_drive() -> Checked {
    let [forward, backward] = Curve::both(prepared(&file("ruby_drive.json"), &[])?, &Kind::ForceSpeed)?;
    let values = [0.0, 0.05];
    let (to_right, to_left) = (forward.trace(&values, 1, &()), backward.trace(&values, 1, &()));
    assert_eq!((to_right.direction, to_left.direction), (1.0, -1.0));
    for (a, b) in to_right.points.iter().zip(&to_left.points) {
        let (there, back) = (motion(a)?, motion(b)?);
        assert!((there.step + back.step).abs() <= 1e-7 * there.step, "{} {}", there.step, back.step);
        // The overrides of the backward point reproduce it from the file.
        let waited = last_step("ruby_drive.json", b, 300)?;
        assert!((waited - back.step).abs() <= 1e-7 * 40e-9, "{waited:e} {:e}", back.step);
    }
    let ways = [(&forward, &to_right), (&backward, &to_left)];
    let table = csv(&ways);
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows[0].starts_with("load_N,direction,step_m,") && rows.len() == 5, "{rows:#?}");
    assert!(rows[1].starts_with("0e0,forward,") && rows[4].starts_with("5e-2,backward,-"), "{rows:#?}");
    let told = json(&ways);
    assert!(
        told.contains(r#""against":"+x","against_backward":"-x""#)
            && told.contains(r#""direction":"backward""#)
    );
    Ok(())
}

/// Waveforms with phases or delays relative to each other are reversed together. Reversing sin(ωt + φ) gives sin(-ωt +
/// φ) = sin(ωt + π - φ). The result must not depend on whether a shift is a phase or a delay.
#[test]
fn waveforms_are_reversed_together() -> Checked {
    let stroke = |job: &[(&str, &str)]| -> Result<Motion, Box<dyn Error>> {
        let curve = curve("walking_drive.json", job, Kind::StepAmplitude)?;
        Ok(motion(&curve.trace(&[300e-9], 1, &()).points[0])?)
    };
    let by_hand = stroke(&[
        ("waveforms.stride_a.sine.phase", "90 deg"),
        ("waveforms.stride_b.sine.phase", "270 deg"),
        ("waveforms.lift_a.sine.phase", "0 deg"),
        ("waveforms.lift_b.sine.phase", "180 deg"),
    ])?;
    // A phase of 270° equals -90°, which is a delay of 0.5 ms for a period of 2 ms.
    let delayed = [("waveforms.stride_b.sine.phase", "0 deg"), ("waveforms.stride_b.sine.delay", "0.5 ms")];
    for set in [&[][..], &delayed] {
        let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
        let [forward, backward] =
            Curve::both(prepared(&file("walking_drive.json"), &set)?, &Kind::StepAmplitude)?;
        let [there, back] = [forward, backward].map(|curve| curve.trace(&[300e-9], 1, &()));
        let [there, back] = [motion(&there.points[0])?, motion(&back.points[0])?];
        // Both orbits use their own finite differences and agree within their errors.
        let off = (back.step - by_hand.step).abs();
        assert!(there.step > 1e-6 && off <= back.error + by_hand.error, "{there:?} {back:?} {by_hand:?}");
        assert!(back.error + by_hand.error <= 1e-7 * there.step, "{back:?} {by_hand:?}");
        let [there, back] = [there.step, back.step];
        assert!((there + back).abs() <= 1e-3 * there, "{there} {back}");
    }
    Ok(())
}

/// The preload is the sum of the normal forces of all contacts, whose ratios are kept.
#[test]
fn a_preload_is_the_sum_of_all_contacts() -> Checked {
    let curve = curve("ruby_drive.json", &[], Kind::Preload)?;
    // Three balls with 0.3 N each.
    assert!((curve.variation.present.ok_or("a preload")? - 0.9).abs() < 1e-15);
    let traced = curve.trace(&[1.8], 1, &());
    let job = Job::prepare(&file("ruby_drive.json"), &traced.points[0].set, Path::new(""))?;
    assert!((job.contact_scale(0).1 - 0.6).abs() < 1e-12);
    Ok(())
}

/// Above μF_N = 0.173 · 1.66 N, or with too little friction for a load of 17 mN, the body accelerates without limit.
/// Rounding of its uniform increments must not be taken for a limit.
#[test]
fn what_no_friction_holds_slides_away() -> Checked {
    let friction = Kind::Vary("contacts.c.friction".to_owned());
    for (kind, values) in [(friction, [0.0, 0.005, 0.01]), (Kind::ForceSpeed, [0.3, 0.6, 1.6])] {
        let curve = Curve::new(prepared(&scene("loaded_sawtooth.json"), &[])?, kind)?;
        for point in &curve.trace(&values, 2, &()).points {
            let found = motion(point);
            let slides = matches!(found, Err(Motionless::SlidesAway { step, .. }) if step < 0.0);
            assert!(slides, "{:e}: {found:?}", point.value);
        }
    }
    Ok(())
}

/// A hopping slider: a run reports irregular motion and flight. Constant distances in the air must not count as steady steps.
#[test]
fn what_it_flies_in_a_period_is_no_steady_step() -> Checked {
    let curve = Curve::new(prepared(&scene("hopper.json"), &[])?, Kind::StepAmplitude)?;
    for point in &curve.trace(&[3.5e-8, 3.08e-7, 1.4e-6], 2, &()).points {
        let found = motion(point)?;
        assert_eq!(found.course, Course::Irregular, "{:e}: {found:?}", point.value);
        assert!(found.error > 0.0 && found.error < found.spread, "{:e}: {found:?}", point.value);
    }
    Ok(())
}

#[test]
fn any_number_of_cores_tells_the_same() -> Checked {
    let curve = curve("quickstart.json", &[], Kind::Vary("contacts.ball.friction".to_owned()))?;
    // Some values are invalid.
    let values: Vec<f64> = (0..12).map(|k| -0.1 + 0.05 * f64::from(k)).collect();
    let told = [1, 2, 3].map(|cores| {
        let traced = curve.trace(&values, cores, &());
        (csv(&[(&curve, &traced)]), json(&[(&curve, &traced)]))
    });
    assert_eq!(told[0], told[1]);
    assert_eq!(told[0], told[2]);
    let table: Vec<&str> = told[0].0.lines().collect();
    assert_eq!(table.len(), 13);
    assert!(table[0].starts_with("contacts.ball.friction,step_m,") && table[0].ends_with(",fault"));
    let fault = table[1].split('"').nth(1).ok_or("a fault")?;
    assert!(fault.contains("contacts.ball.friction: expected a number between 0 and 1000"), "{fault}");
    let columns = |line: &str| line.split('"').next().map(|numbers| numbers.matches(',').count());
    assert!(table.iter().all(|line| columns(line) == columns(table[0])), "{table:#?}");
    Ok(())
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
fn what_was_done_before_an_interrupt_is_kept() -> Checked {
    let curve = curve("ruby_drive.json", &[], Kind::StepAmplitude)?;
    let traced = curve.trace(&[1e-7; 6], 1, &Patience(AtomicUsize::new(0)));
    assert!(traced.is_cut());
    let done = traced.points.iter().filter(|point| point.motion.is_ok()).count();
    assert_eq!((done, traced.points[3].motion.clone().err()), (3, Some(Motionless::NotRun)));
    Ok(())
}

#[test]
fn scenes_without_such_a_curve_are_refused() {
    let refused =
        |name, set: &[(&str, &str)], kind| curve(name, set, kind).err().map(|error| error.to_string());
    let says = |refused: Option<String>, words: &str| {
        let refused = refused.unwrap_or_default();
        assert!(refused.contains(words), "{refused}");
    };
    says(refused("bouncing_ball.json", &[], Kind::StepAmplitude), "no waveform has a period");
    says(refused("worn_ball.json", &[], Kind::StepAmplitude), "no body of the model makes steps");
    says(refused("three_ball_stage.json", &[], Kind::Preload), "has a constant normal force");
    let vary = |path: &str| refused("ruby_drive.json", &[], Kind::Vary(path.to_owned()));
    says(vary("contacts.bal.friction"), "did you mean \"ball\"?");
    says(vary("contacts.ball.count"), "is a count");
    says(vary("run.cycles"), "has no effect on the motion");
    let both = |set: &[(&str, &str)]| {
        let set: Vec<_> = set.iter().map(|(p, v)| ((*p).to_owned(), (*v).to_owned())).collect();
        Curve::both(prepared(&file("ruby_drive.json"), &set).unwrap(), &Kind::Preload)
            .err()
            .map(|error| error.to_string())
    };
    says(both(&[("waveforms.drive.sawtooth.flyback", "0")]), "a waveform that jumps cannot be reversed");
    let burst = [("waveforms.drive.sawtooth.burst", r#"{"cycles": 2, "dwell": "5 ms"}"#)];
    says(both(&burst), "has a burst or a sequence");
    let table = r#"{"points": [[0, 0], [9.99e-3, 1e-7], [10e-3, 0]], "repeat": true}"#;
    let table = [("waveforms.drive.table", table)];
    let found = refused("ruby_drive.json", &table, Kind::StepAmplitude);
    says(found, "no single stroke or amplitude");
    says(both(&table), "is a table, which cannot be reversed");
    let still = [("waveforms.drive.sawtooth.stroke", "0")];
    let still =
        curve("ruby_drive.json", &still, Kind::StepAmplitude).map(|curve| curve.no_range().to_string());
    says(still.ok(), "no default range for stroke: it is 0");
}

/// Rise, hold and fall take 1.2 ms, so the largest frequency is 833 Hz.
#[test]
fn ranges_by_default_end_where_scenarios_are_refused() -> Checked {
    let drive = r#"{"trapezoid": {"stroke": "0.2 um", "frequency": "500 Hz", "rise": "0.5 ms", "hold": "0.5 ms", "fall": "0.2 ms"}}"#;
    let set = [("waveforms.drive", drive)];
    let curve = curve("ruby_drive.json", &set, Kind::SpeedFrequency)?;
    let [from, to] = curve.range(&()).ok_or("a range")?;
    assert!((from - 50.0).abs() < 1e-9 && (825.0..=1.0 / 1.2e-3).contains(&to), "{from} to {to}");
    assert!(curve.trace(&[from, to], 1, &()).points.iter().all(|point| point.motion.is_ok()));
    // A sawtooth allows the full range from one tenth to twice its frequency.
    let plain = self::curve("ruby_drive.json", &[], Kind::SpeedFrequency)?;
    assert_eq!(plain.range(&()), Some([10.0, 200.0]));
    Ok(())
}

/// A foot with a small stroke makes no steps: the default range ends slightly above the largest load that is held.
#[test]
fn loads_by_default_end_beyond_those_that_are_held() -> Checked {
    let curve = curve("ruby_drive.json", &[("waveforms.drive.sawtooth.stroke", "20 nm")], Kind::StepLoad)?;
    let [from, to] = curve.range(&()).ok_or("a range")?;
    let most = curve.variation.range.ok_or("a limit")?[1];
    assert!(from == 0.0 && to > 0.0 && to < 0.9 * most, "{to} of {most}");
    let traced = curve.trace(&[from, 0.85 * to, to], 2, &());
    let goes_back = |point: &Point| Some(point.motion.as_ref().ok()?.steps(-traced.direction));
    assert_eq!(
        traced.points.iter().map(goes_back).collect::<Vec<_>>(),
        [Some(false), Some(false), Some(true)]
    );
    Ok(())
}

/// A foot with a small stroke: step, motion and power are consistently reported as zero.
#[test]
fn a_steady_motion_without_a_step_is_called_so() -> Checked {
    let curve = curve("ruby_drive.json", &[("waveforms.drive.sawtooth.stroke", "2 nm")], Kind::ForceSpeed)?;
    let traced = curve.trace(&[0.0, 0.01], 1, &());
    let table = csv(&[(&curve, &traced)]);
    let column = |row: usize, head: &str| -> Option<String> {
        let place = table.lines().next()?.split(',').position(|other| other == head)?;
        Some(table.lines().nth(row)?.split(',').nth(place)?.to_owned())
    };
    for row in [1, 2] {
        assert_eq!(column(row, "motion").as_deref(), Some("no step"), "{table}");
        assert_eq!(column(row, "power_W").as_deref(), Some("0e0"), "{table}");
    }
    assert_eq!(json(&[(&curve, &traced)]).matches(r#""motion":"no step""#).count(), 2);
    Ok(())
}
