//! Maps: borders between slip regimes compared with closed forms, for prescribed motions and for runs; grids compared with studies.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use stickslip_study::map::{Asked, Field, Map, MapError, Overlay, Regime};

/// κ = μE*/G* of the ball below: equal materials with a Poisson's ratio of 0.3.
const KAPPA: f64 = 0.6 * (2.0 - 0.3) / (2.0 * (1.0 - 0.3));

/// A ball moved along x by one waveform and pressed by another.
fn ball(shake: &Value, normal: &Value, press: Option<Value>) -> Value {
    let mut waveforms = json!({ "shake": shake });
    if let Some(press) = press {
        waveforms["press"] = press;
    }
    json!({
        "stickslip": 1,
        "materials": { "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
        "waveforms": waveforms,
        "bodies": { "rig": { "x": { "follows": "shake" } } },
        "contacts": { "ball": {
            "between": ["rig", "ground"], "materials": ["steel", "steel"], "profile": { "paraboloid": { "radius": "5 mm" } },
            "friction": 0.6, "normal": normal,
        } },
        "run": { "duration": "4 s" },
    })
}

fn sine(amplitude: f64, phase: f64, offset: f64) -> Value {
    json!({ "sine": { "amplitude": amplitude, "phase": phase, "offset": offset, "period": 1.0 } })
}

/// Returns a map of a scenario in a temporary file.
fn map(scenario: &Value, asked: &Asked) -> Result<Map, MapError> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ball.json");
    fs::write(&file, scenario.to_string()).unwrap();
    Map::new(crate::prepared(&file, &[]).unwrap(), (&file, &[]), asked)
}

fn asked(x: (&str, &str), y: (&str, &str), by_runs: bool) -> Asked {
    let owned = |(path, range): (&str, &str)| (path.to_owned(), range.to_owned());
    Asked { x: owned(x), y: owned(y), of: "contacts.ball.regime".to_owned(), by_runs, ..Asked::default() }
}

fn field(map: &Map) -> Field {
    map.compute(Path::new("unused"), 2, &()).unwrap()
}

/// Returns the points of the border between partial and gross slip.
fn gross(field: &Field) -> Vec<[f64; 2]> {
    let all = field.borders.iter().filter(|border| border.between == [Regime::Partial, Regime::Gross]);
    all.flat_map(|border| border.points.clone()).collect()
}

const AMPLITUDE: &str = "waveforms.shake.sine.amplitude";

#[test]
fn the_border_of_a_ball_goes_with_the_force_to_two_thirds() {
    let scenario = ball(&sine(4e-7, 0.0, 0.0), &json!({ "force": "10 N" }), None);
    for by_runs in [false, true] {
        let asked = asked(("contacts.ball.normal.force", "0.5N..20N"), (AMPLITUDE, "0..1.5um"), by_runs);
        let map = map(&scenario, &asked).unwrap();
        let found = field(&map);
        let points = gross(&found);
        // d = (9F²/(16 E*² R))^{1/3}.
        let modulus = 210e9 / (2.0 * (1.0 - 0.09));
        let depth = |force: f64| (9.0 * force * force / (16.0 * modulus * modulus * 5e-3)).cbrt();
        let off = points.iter().map(|[force, amplitude]| (amplitude / (KAPPA * depth(*force)) - 1.0).abs());
        let off = off.fold(0.0, f64::max);
        if by_runs {
            // Accuracy relative to the ranges.
            let near = |[force, amplitude]: &[f64; 2]| {
                let slope = 2.0 / 3.0 * KAPPA * depth(*force) / force * 19.5 / 1.5e-6;
                (amplitude - KAPPA * depth(*force)).abs() / 1.5e-6 / (1.0 + slope * slope).sqrt() < 1e-4
            };
            assert!(points.iter().all(near) && points.len() >= 12 && found.runs <= 109, "{}", found.runs);
        } else {
            assert!(off < 1e-9 && points.len() >= 40 && found.runs == 0);
            // Without motion everything sticks; this adds neither an area nor a border.
            assert!(found.borders.len() == 1 && found.values[0] == f64::from(Regime::Stick as u8));
        }
    }
}

#[test]
fn a_harmonic_press_and_shake_have_an_ellipse() {
    // U/(κd₀) = √[(1-e²)/(1-e²cos²φ)], e = D/d₀.
    let (d0, mut worst) = (1e-6, 0.0_f64);
    for phase in [0.0, 0.3, 0.25 * TAU, 2.0, 0.5 * TAU] {
        for profile in ["paraboloid", "cone"] {
            let mut scenario = ball(
                &sine(4e-7, phase, 0.0),
                &json!({ "indentation": { "follows": "press" } }),
                Some(sine(1e-7, 0.0, d0)),
            );
            if profile == "cone" {
                scenario["contacts"]["ball"]["profile"] = json!({ "cone": { "slope": 0.01 } });
            }
            let asked =
                asked(("waveforms.press.sine.amplitude", "0.1um..0.9um"), (AMPLITUDE, "0.05um..1um"), false);
            let found = field(&map(&scenario, &Asked { points: Some([9, 9]), ..asked }).unwrap());
            let points = gross(&found);
            assert!(points.len() >= 12 && found.runs == 0, "{phase}: {}", points.len());
            // Columns of the grid are at e = 0.1 … 0.9.
            let columns =
                points.iter().filter(|[press, _]| ((press * 1e7).round() * 1e-7 - press).abs() < 1e-20);
            assert!(phase == 0.0 || phase == 0.5 * TAU || columns.count() >= 9);
            for [press, amplitude] in points {
                let e = press / d0;
                let border = ((1.0 - e * e) / (1.0 - (e * math::cos(phase)).powi(2))).sqrt();
                worst = worst.max((amplitude / (KAPPA * d0 * border) - 1.0).abs());
            }
        }
    }
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn in_phase_a_contact_sticks_as_a_whole_up_to_the_slope_of_the_limit() {
    let scenario = ball(
        &sine(4e-7, 0.0, 0.0),
        &json!({ "indentation": { "follows": "press" } }),
        Some(sine(1e-7, 0.0, 1e-6)),
    );
    let asked = asked(("waveforms.press.sine.amplitude", "0.1um..0.9um"), (AMPLITUDE, "0.01um..1um"), false);
    let found = field(&map(&scenario, &asked).unwrap());
    let stick =
        found.borders.iter().find(|border| border.between == [Regime::Stick, Regime::Partial]).unwrap();
    assert!(stick.points.iter().all(|[press, amplitude]| (amplitude / (KAPPA * press) - 1.0).abs() < 1e-9));
    // Above d₀ the contact opens. After renewed contact on a steep path, it slips as a whole.
    let wide = Asked { x: (asked.x.0.clone(), "0.1um..1.5um".to_owned()), ..asked.clone() };
    let between: Vec<[Regime; 2]> =
        field(&map(&scenario, &wide).unwrap()).borders.iter().map(|one| one.between).collect();
    for wanted in
        [[Regime::Stick, Regime::Partial], [Regime::Partial, Regime::Gross], [Regime::Stick, Regime::Gross]]
    {
        assert!(between.contains(&wanted), "{between:?}");
    }
    // With a small phase shift, some springs slip.
    let scenario = ball(
        &sine(4e-7, 0.01, 0.0),
        &json!({ "indentation": { "follows": "press" } }),
        Some(sine(1e-7, 0.0, 1e-6)),
    );
    let found = field(&map(&scenario, &asked).unwrap());
    assert!(found.borders.iter().all(|border| border.between == [Regime::Partial, Regime::Gross]));
}

/// Triangle waveforms for normal and tangential motion; two periods of one are three of the other.
fn triangles() -> Value {
    let shake = json!({ "triangle": { "stroke": 8e-7, "period": 3.0, "phase": 0.7 } });
    let mut scenario =
        ball(&shake, &json!("coupled"), Some(json!({ "triangle": { "stroke": 4e-7, "period": 2.0 } })));
    scenario["bodies"]["rig"] = json!({ "x": { "follows": "shake" }, "z": { "follows": "press" } });
    scenario["contacts"]["ball"]["gap"] = json!(-1e-6);
    scenario["run"]["duration"] = json!("12 s");
    scenario
}

/// Returns the value of a triangle waveform at t, between 0 and 1.
fn triangle(t: f64, period: f64, phase: f64) -> f64 {
    let part = (t / period + phase / TAU).rem_euclid(1.0);
    1.0 - (2.0 * part - 1.0).abs()
}

#[test]
fn two_periods_of_a_press_on_three_of_a_shake_have_the_border_of_a_dense_evaluation() {
    let asked = |by_runs: bool| Asked {
        points: by_runs.then_some([5, 5]),
        ..asked(
            ("waveforms.press.triangle.stroke", "0.1um..0.9um"),
            ("waveforms.shake.triangle.stroke", "0.5um..3um"),
            by_runs,
        )
    };
    // These instants include the corners of both waveforms: multiples of a quarter, and those shifted by the phase.
    let moments: Vec<f64> = (0..24)
        .map(|k| 0.25 * f64::from(k))
        .chain((-2..6).map(|k| 1.5 * f64::from(k) - 3.0 * 0.7 / TAU))
        .collect();
    let border = |press: f64| {
        // max(u-κd) = min(u+κd) is piecewise linear in the stroke: bisection to rounding.
        let reached = |stroke: f64| {
            let at =
                |t: &f64| (stroke * triangle(*t, 3.0, 0.7), KAPPA * (1e-6 + press * triangle(*t, 2.0, 0.0)));
            let low = moments.iter().map(at).map(|(u, d)| u - d).fold(f64::NEG_INFINITY, f64::max);
            let high = moments.iter().map(at).map(|(u, d)| u + d).fold(f64::INFINITY, f64::min);
            low > high
        };
        let halve = |[low, high]: [f64; 2], _| {
            let middle = 0.5 * (low + high);
            if reached(middle) { [low, middle] } else { [middle, high] }
        };
        (0..60).fold([0.0, 1e-5], halve)[0]
    };
    for by_runs in [false, true] {
        let found = field(&map(&triangles(), &asked(by_runs)).unwrap());
        let points = gross(&found);
        assert!(points.len() >= 12);
        let off = points.iter().map(|[press, stroke]| (stroke - border(*press)).abs()).fold(0.0, f64::max);
        let allowed = if by_runs { 1e-4 * 2.5e-6 * 1.5 } else { 1e-9 * 1e-6 };
        assert!(off < allowed && found.runs <= if by_runs { 109 } else { 0 }, "{off:e}, {} runs", found.runs);
    }
}

#[test]
fn a_grid_is_that_of_a_study_and_its_parts_are_kept() {
    let scenario = ball(&sine(4e-7, 0.0, 0.0), &json!({ "force": "10 N" }), None);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ball.json");
    fs::write(&file, scenario.to_string()).unwrap();
    let asked = Asked {
        of: "contacts.ball.fretting.dissipated_J".to_owned(),
        points: Some([4, 3]),
        logarithmic: [true, false],
        ..asked(("contacts.ball.normal.force", "1N..100N"), (AMPLITUDE, "0.1um..0.5um"), false)
    };
    let parts = folder.path().join("parts");
    let map = Map::new(crate::prepared(&file, &[]).unwrap(), (&file, &[]), &asked).unwrap();
    let found = map.compute(&parts, 2, &()).unwrap();
    assert_eq!((found.values.len(), found.words, found.xs[3]), (12, None, 100.0));
    assert!((found.xs[1] / 100.0_f64.cbrt() - 1.0).abs() < 1e-14);
    // By columns: losses increase with the amplitude.
    assert!(found.values.chunks(3).all(|column| column[0] < column[1] && column[1] < column[2]));
    let parts_of_study = fs::read_dir(&parts).unwrap().next().unwrap().unwrap().path();
    assert_eq!(fs::read_dir(&parts_of_study).unwrap().count(), 4);
    let before = fs::metadata(parts_of_study.join("part-000000.parquet")).unwrap().modified().unwrap();
    assert_eq!(map.compute(&parts, 1, &()).unwrap().values, found.values);
    assert_eq!(fs::metadata(parts_of_study.join("part-000000.parquet")).unwrap().modified().unwrap(), before);
}

#[test]
fn what_is_wrong_with_a_map_is_told() {
    let scenario = ball(&sine(4e-7, 0.0, 0.0), &json!({ "force": "10 N" }), None);
    let force = ("contacts.ball.normal.force", "1N..2N");
    let told = |asked: Asked| map(&scenario, &asked).err().unwrap().to_string();
    assert!(
        told(asked(("contacts.ball.normal.forse", "1N..2N"), (AMPLITUDE, "0..1um"), false)).contains("force")
    );
    assert!(
        told(asked(("contacts.ball.normal.force", "2N..1N"), (AMPLITUDE, "0..1um"), false))
            .contains("--x  expected a range")
    );
    assert!(told(asked(force, force, false)).contains("another parameter"));
    let of = |of: &str| Asked { of: of.to_owned(), ..asked(force, (AMPLITUDE, "0..1um"), false) };
    assert!(told(of("contacts.bal.regime")).contains("ball"));
    assert!(told(of("contacts.ball.peak_fy_N")).contains("peak_fx_N"));
    assert!(told(Asked { logarithmic: [false, true], ..of("contacts.ball.regime") }).contains("above 0"));
    let map = map(&scenario, &of("contacts.ball.regime")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("measured.csv");
    let overlay = |text: &str| {
        fs::write(&table, text).unwrap();
        Overlay::load(&table, &map)
    };
    let read =
        overlay("contacts.ball.normal.force_N,y,regime\n1.5,0.4 um,gross\n1.2,2e-7,partial\n").unwrap();
    assert_eq!(
        read.classes,
        [("gross".to_owned(), vec![[1.5, 4e-7]]), ("partial".to_owned(), vec![[1.2, 2e-7]])]
    );
    assert!(overlay("x,z\n1,2\n").unwrap_err().to_string().contains("there is no column y"));
    assert!(overlay("x,y\n1,2\n1,many\n").unwrap_err().to_string().contains("line 3, column y"));
    assert!(overlay("x,y\n").unwrap_err().to_string().contains("no points"));
    assert!(Overlay::load(Path::new("nowhere.csv"), &map).is_err());
}
