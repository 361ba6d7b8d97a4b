//! S₀ and stall closed in on, against the closed form of the quasi-static, damped drive.

use crate::prepared;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use stickslip_run::Watcher;
use stickslip_study::curve::{Curve, CurveError, Kind, Landmark, csv, json};

type Checked = Result<(), Box<dyn Error>>;

/// Of the quickstart: tangential stiffness in full stick 2G*a of three balls and m = 10 g have a resonance of 4.151 kHz; 2√(km)
/// N s/m to ground damp it critically. A period is long against it, the flyback takes no time.
const DAMPING: f64 = 2.0 * 10e-3 * std::f64::consts::TAU * 4151.0;
const PERIOD: f64 = 0.1;
/// μF_N of three balls, N.
const LIMIT: f64 = 0.18;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

/// The quickstart without its load, critically damped, and u_c.
fn ideal(kind: Kind, stroke: f64) -> Result<(Curve, f64), CurveError> {
    let brake = format!(r#"{{"between": ["ground", "slider"], "damping": {DAMPING}}}"#);
    let set = [
        ("loads", "[]".to_owned()),
        ("springs.brake", brake),
        ("waveforms.drive.sawtooth.period", PERIOD.to_string()),
        ("waveforms.drive.sawtooth.flyback", "0".to_owned()),
        ("waveforms.drive.sawtooth.stroke", stroke.to_string()),
    ];
    let set: Vec<(String, String)> = set.into_iter().map(|(path, value)| (path.to_owned(), value)).collect();
    let curve = Curve::new(prepared(&file("quickstart.json"), &set)?, kind)?;
    let natural = curve.job.contact_scale(0).0;
    Ok((curve, natural))
}

/// S₀/u_c against a load of λμF_N on a paraboloid: the flyback slips as a whole, then u rises from F_x = -μF_N to λμF_N, by Masing's
/// rule twice a first loading to half of the difference: 2[1 - ((1-λ)/2)^(2/3)]; 0.74008 without load.
fn zero_step(share: f64) -> f64 {
    2.0 * (1.0 - (0.5 * (1.0 - share)).powf(2.0 / 3.0))
}

/// Where the damper pulls: the slider rises with the foot, by the stroke in a period.
fn pull(stroke: f64) -> f64 {
    DAMPING * stroke / PERIOD / LIMIT
}

fn only<'a>(landmarks: &'a [Landmark], name: &str) -> Result<&'a Landmark, Box<dyn Error>> {
    Ok(landmarks.iter().find(|landmark| landmark.name == name).ok_or("a landmark")?)
}

#[test]
fn the_zero_step_stroke_is_that_of_the_closed_form() -> Checked {
    let (curve, natural) = ideal(Kind::StepAmplitude, 40e-9)?;
    let mut traced = curve.trace(&[0.5, 0.7, 0.9, 1.1].map(|share| share * natural), 2, &());
    curve.mark(&mut traced, 1e-4, 2, &())?;
    let found = only(&traced.landmarks, "zero_step")?;
    let at = found.at.clone()? / natural;
    assert!((zero_step(0.0) - 0.74008).abs() < 5e-6);
    // The pull depends on the stroke a little.
    let wanted = (0..8).fold(0.74, |share, _| zero_step(pull(share * natural)));
    assert!((at / wanted - 1.0).abs() < 1e-4, "{at} {wanted}");
    assert!(found.half_width / natural <= 0.5e-4 * at && found.runs < 20, "{found:?}");
    Ok(())
}

/// Mirrored, steps go back: S₀ lies as far below 0, on a range by default, and on one across 0 where the far end is.
#[test]
fn negative_strokes_have_the_mirrored_zero_step() -> Checked {
    let (curve, natural) = ideal(Kind::StepAmplitude, -40e-9)?;
    let [from, to] = curve.range(&()).ok_or("a range")?;
    assert!((from / -80e-9 - 1.0).abs() < 1e-9 && (to / -2e-9 - 1.0).abs() < 1e-9, "{from} {to}");
    let wanted = (0..8).fold(0.74, |share, _| zero_step(pull(share * natural)));
    for shares in [[-1.1, -0.9, -0.7, -0.5], [-1.5, -1.0, -0.2, 1.0]] {
        let mut traced = curve.trace(&shares.map(|share| share * natural), 2, &());
        curve.mark(&mut traced, 1e-4, 2, &())?;
        let found = only(&traced.landmarks, "zero_step")?;
        let at = found.at.clone()? / natural;
        assert!((at / -wanted - 1.0).abs() < 1e-4 && !found.turns, "{at} {wanted}");
    }
    Ok(())
}

#[test]
fn the_stall_is_that_of_the_closed_form() -> Checked {
    let (curve, natural) = ideal(Kind::ForceSpeed, 50e-9)?;
    // S = S₀(λ): λ = 1 - 2(1 - S/2u_c)^(3/2), of which the damper takes its part.
    let share = 1.0 - 2.0 * (1.0 - 0.5 * 50e-9 / natural).powf(1.5);
    let wanted = LIMIT * (share - pull(50e-9));
    let [from, to] = curve.range(&()).ok_or("a range")?;
    assert!(from == 0.0 && (1.05..1.2).contains(&(to / wanted)), "{to} {wanted}");
    let values: Vec<f64> = (0..8).map(|k| f64::from(k) / 7.0 * to).collect();
    let mut traced = curve.trace(&values, 2, &());
    curve.mark(&mut traced, 1e-4, 2, &())?;
    let stall = only(&traced.landmarks, "stall")?;
    let at = stall.at.clone()?;
    assert!((at / wanted - 1.0).abs() < 1e-4, "{at} {wanted}");
    assert!(stall.runs < 20, "{stall:?}");
    // Steps fall along a curve that is S - S₀(λ): the most power is where λ(S - S₀) is largest.
    let power = |load: f64| load * (50e-9 / natural - zero_step(load / LIMIT + pull(50e-9)));
    let best = only(&traced.landmarks, "best_power")?;
    let at = best.at.clone()?;
    let near = (1..200).map(|k| f64::from(k) / 200.0 * wanted).max_by(|a, b| power(*a).total_cmp(&power(*b)));
    assert!((at - near.ok_or("a load")?).abs() < 0.01 * wanted, "{at} {near:?}");
    Ok(())
}

/// What is told, and how much of the way is behind, which never falls.
#[derive(Default)]
struct Told(Mutex<Vec<f64>>);

impl Watcher for Told {
    fn reached(&self, behind: f64) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(behind);
    }
    fn goes_on(&self) -> bool {
        true
    }
}

/// Stall and most power side by side, each on its share of the cores.
#[test]
fn any_number_of_cores_finds_the_same_places() -> Checked {
    let (curve, _) = ideal(Kind::ForceSpeed, 50e-9)?;
    let traced = curve.trace(&[0.0, 0.02, 0.04, 0.06, 0.08, 0.1], 2, &());
    let mut found = Vec::new();
    for cores in [1, 2, 3, 6] {
        let (mut traced, told) = (traced.clone(), Told::default());
        curve.mark(&mut traced, 1e-3, cores, &told)?;
        let told = told.0.into_inner()?;
        assert!(told.is_sorted() && told.last() == Some(&1.0), "{cores}: {told:?}");
        found.push((traced.landmarks.clone(), csv(&[(&curve, &traced)]), json(&[(&curve, &traced)])));
    }
    assert!(found.iter().all(|other| *other == found[0]), "{found:?}");
    assert!(found[0].0.iter().all(|landmark| landmark.at.is_ok()), "{found:?}");
    Ok(())
}

#[test]
fn what_is_not_within_the_range_is_said() -> Checked {
    let (curve, natural) = ideal(Kind::StepAmplitude, 40e-9)?;
    let mut traced = curve.trace(&[0.3, 0.5].map(|share| share * natural), 1, &());
    curve.mark(&mut traced, 1e-4, 2, &())?;
    let why = traced.landmarks[0].at.clone().err().map(|why| why.to_string()).unwrap_or_default();
    assert!(why.contains("the drive steps at none"), "{why}");
    // Where all points step it lies below them, and is found there.
    let mut traced = curve.trace(&[0.9, 1.1].map(|share| share * natural), 1, &());
    curve.mark(&mut traced, 1e-4, 2, &())?;
    let found = only(&traced.landmarks, "zero_step")?;
    let wanted = (0..8).fold(0.74, |share, _| zero_step(pull(share * natural)));
    let at = found.at.clone()? / natural;
    assert!((at / wanted - 1.0).abs() < 1e-4, "{at} {wanted}");
    assert_eq!(found.below, Some(0.9 * natural));
    let mut traced = curve.trace(&[0.9 * natural], 1, &());
    assert_eq!(curve.mark(&mut traced, 0.5, 1, &()), Err(CurveError::Tolerance(0.5)));
    Ok(())
}
