//! Zero-step stroke S₀ and stall force, compared with the closed form of the quasi-static, damped drive.

use crate::prepared;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use stickslip_run::Watcher;
use stickslip_study::curve::{Curve, CurveError, Kind, Landmark, csv, json};

type Checked = Result<(), Box<dyn Error>>;

/// Damping to ground, N s/m: critical for the quickstart, with a resonance of 4.151 kHz of m = 10 g on the tangential
/// stiffness 2G*a of three balls. The period, s, is long in comparison, and the flyback instantaneous.
const DAMPING: f64 = 2.0 * 10e-3 * std::f64::consts::TAU * 4151.0;
const PERIOD: f64 = 0.1;
/// Friction limit μF_N of three balls, N.
const LIMIT: f64 = 0.18;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

/// Returns the curve of the quickstart without load and critically damped, and u_c.
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

/// Returns S₀/u_c for a load of λμF_N on a paraboloid. After gross slip in the flyback, the force rises from F_x =
/// -μF_N to λμF_N. By Masing's rule this takes twice the displacement of half the force: 2[1 - ((1-λ)/2)^(2/3)];
/// 0.74008
/// without load.
fn zero_step(share: f64) -> f64 {
    2.0 * (1.0 - (0.5 * (1.0 - share)).powf(2.0 / 3.0))
}

/// Returns the mean force of the damper relative to μF_N, for a slider that follows the foot by one stroke per period.
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
    // The damper force depends slightly on the stroke.
    let wanted = (0..8).fold(0.74, |share, _| zero_step(pull(share * natural)));
    assert!((at / wanted - 1.0).abs() < 1e-4, "{at} {wanted}");
    assert!(found.half_width / natural <= 0.5e-4 * at && found.runs < 20, "{found:?}");
    Ok(())
}

/// For the mirrored drive S₀ is negative: with the default range, and with a range across 0 whose far end is negative.
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
    // S = S₀(λ): λ = 1 - 2(1 - S/2u_c)^(3/2), minus the part of the damper.
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
    // The step length is S - S₀(λ): maximum power is at the maximum of λ(S - S₀).
    let power = |load: f64| load * (50e-9 / natural - zero_step(load / LIMIT + pull(50e-9)));
    let best = only(&traced.landmarks, "best_power")?;
    let at = best.at.clone()?;
    let near = (1..200).map(|k| f64::from(k) / 200.0 * wanted).max_by(|a, b| power(*a).total_cmp(&power(*b)));
    assert!((at - near.ok_or("a load")?).abs() < 0.01 * wanted, "{at} {near:?}");
    Ok(())
}

/// Watcher that records the progress, which must not decrease.
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

/// Stall force and maximum power are computed in parallel, each with a part of the cores.
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
    assert!(why.contains("the drive makes no step at any point"), "{why}");
    // If all points have steps, S₀ is below them and is found there.
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
