//! Optima, compared with closed forms.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use stickslip_study::optimum::Optimum;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/optimise")
}

fn optimum(file: &Value) -> Optimum {
    let made = Optimum::from_str(&file.to_string(), ("study.json", "study"), &folder());
    made.unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the error message of a study.
fn refused(file: &Value) -> String {
    Optimum::from_str(&file.to_string(), ("study.json", "study"), &folder()).err().unwrap().to_string()
}

fn found(file: &Value) -> Value {
    let (optimum, out) = (optimum(file), tempfile::tempdir().unwrap());
    let best = optimum.run(out.path(), (2, false), &()).unwrap();
    serde_json::to_value(optimum.report(&best)).unwrap()
}

/// Half of the peak-to-peak value of sin θ + sin(2θ)/4, with extremes at cos θ = (√3 - 1)/2.
fn half_stroke() -> f64 {
    let y = (3.0_f64.sqrt() - 1.0) / 2.0;
    (1.0 - y * y).sqrt() * (1.0 + y / 2.0)
}

/// A heavy slider whose contact is nearly always in gross slip. Its velocity is the median of the foot's velocity, so that friction forces
/// balance. For A(sin ωt - b sin 2ωt) it is 2bAω up to b = 1/4; the maximum is 0.454167 in units of half the stroke times ω.
fn heavy(keys: &Value) -> Value {
    let mut file = json!({
        "stickslip_study": 1, "scenario": "heavy.json", "maximise": "steady_motion.speed_m_s", "worst_of_period": false,
    });
    for (key, value) in keys.as_object().unwrap() {
        file[key] = value.clone();
    }
    file
}

#[test]
fn the_share_of_the_second_harmonic_is_a_quarter() {
    let file =
        heavy(&json!({ "over": { "waveforms.drive.two_harmonics.second": [-0.25, -0.01] }, "starts": 2 }));
    let found = found(&file);
    assert_eq!(found["best"]["set"], json!(["waveforms.drive.two_harmonics.second=-0.25"]));
    let speed =
        found["best"]["value"].as_f64().unwrap() / (half_stroke() * 5e-6 * std::f64::consts::TAU * 1e4);
    assert!((speed - 0.454_166_7).abs() < 2e-4, "{speed}");
    let limits = found["limits"].to_string();
    assert!(limits.contains("at its lower bound"), "{limits}");
}

#[test]
fn of_all_waveforms_of_two_harmonics_that_one_is_found() {
    let waveform = json!({ "path": "waveforms.drive", "harmonics": 2, "window": ["-5 um", "5 um"] });
    let found = found(&heavy(&json!({ "waveform": waveform, "starts": 4 })));
    let speed = found["best"]["value"].as_f64().unwrap() / (5e-6 * std::f64::consts::TAU * 1e4);
    assert!((speed - 0.454_166_7).abs() < 2e-4, "{speed}");
    let set = found["best"]["set"][0].as_str().unwrap();
    let form: Value = serde_json::from_str(set.split_once('=').unwrap().1).unwrap();
    let terms = &form["harmonics"]["terms"];
    let amplitude = |term: usize| terms[term]["amplitude"].as_f64().unwrap();
    assert!((amplitude(1) / amplitude(0) - 0.25).abs() < 1e-3, "{form}");
    assert!((terms[1]["phase"].as_f64().unwrap().abs() - std::f64::consts::PI).abs() < 0.05, "{form}");
}

/// P1 with negligible inertia moves its slider by the stroke minus a loss in the contact, so the largest stroke is the
/// best. Minima are also found, and failed cases count as the worst.
#[test]
fn bounds_minima_and_failed_cases() {
    let p1 = |keys: Value| {
        let mut file = json!({
            "stickslip_study": 1, "scenario": "../../scenarios/p1.json", "starts": 2, "evaluations": 40,
            "set": { "run.stepper.event.tolerance": 1e-6, "run.cycles": 5 },
        });
        keys.as_object().unwrap().iter().for_each(|(key, value)| file[key] = value.clone());
        found(&file)
    };
    let over = json!({ "waveforms.drive.sawtooth.stroke": ["0.3 um", "0.6 um"] });
    let largest = p1(json!({ "maximise": "slider.x_m", "over": over }));
    assert_eq!(largest["best"]["set"], json!(["waveforms.drive.sawtooth.stroke=6e-7"]));
    let smallest = p1(json!({ "minimise": "slider.x_m", "over": over }));
    assert_eq!(smallest["best"]["set"], json!(["waveforms.drive.sawtooth.stroke=3e-7"]));
    assert!(smallest["best"]["value"].as_f64() < largest["best"]["value"].as_f64());
    // Worst result of the three periods, for maximum and minimum.
    let values = |found: &Value| {
        let values = found["periods"].as_array().unwrap().iter().map(|at| at["value"].as_f64().unwrap());
        values.collect::<Vec<_>>()
    };
    let [most, least] = [values(&largest), values(&smallest)];
    assert_eq!(
        largest["best"]["value"].as_f64().unwrap(),
        most.iter().copied().fold(f64::INFINITY, f64::min)
    );
    assert_eq!(smallest["best"]["value"].as_f64().unwrap(), least.iter().copied().fold(0.0, f64::max));
    assert_eq!((most.len(), least.len()), (3, 3));
    let masses = json!({ "bodies.slider.mass": ["-10 g", "40 g"] });
    let failing = p1(json!({ "maximise": "slider.x_m", "over": masses }));
    assert!(failing["failed"].as_u64().unwrap() > 0);
    assert!(failing["best"]["value"].as_f64().unwrap() > 0.0);
}

/// The polygon for a driver with 2 A stays within window and rate, and is better than the sawtooth from which it starts.
#[test]
fn corners_stay_within_window_and_current() {
    let file = json!({
        "stickslip_study": 1, "scenario": "stage.json", "maximise": "steady_motion.speed_m_s",
        "worst_of_period": false, "starts": 2, "evaluations": 30,
        "waveform": { "path": "waveforms.drive", "corners": 8, "period": ["0.5 ms", "0.7 ms"] },
    });
    let found = found(&file);
    let waveform = &found["waveform"];
    let two = |key: &str| [0, 1].map(|i| waveform[key][i].as_f64().unwrap());
    let ([low, high], rates) = (two("range"), two("rates"));
    assert!(
        low >= 0.0 && high <= 120.0 && rates.iter().all(|rate| *rate <= 2.0 / 7.2e-6 * 1.000_001),
        "{waveform}"
    );
    assert!(found["best"]["value"].as_f64().unwrap() > 2e-3);
    assert!(found["starts"][0]["to"].as_f64() >= found["starts"][0]["from"].as_f64());
}

/// Each set of keys gives a study that is rejected with a message.
fn all_refused<const N: usize>(cases: [(Value, &str); N]) {
    for (keys, message) in cases {
        let mut file = json!({ "stickslip_study": 1, "scenario": "stage.json" });
        keys.as_object().unwrap().iter().for_each(|(key, value)| file[key] = value.clone());
        let said = refused(&file);
        assert!(said.contains(message), "{file}\n{said}");
    }
}

#[test]
fn what_is_no_optimum_is_refused_with_its_place() {
    let over = json!({ "contacts.balls.friction": [0.1, 0.2] });
    let speed = "steady_motion.speed_m_s";
    let cases = [
        (json!({ "over": over }), "the result to optimise is missing"),
        (json!({ "maximise": speed }), "no variable to optimise"),
        (json!({ "maximise": speed, "minimise": speed, "over": over }), "either"),
        (
            json!({ "maximise": "steady_motion.sped_m_s", "over": over }),
            "did you mean \"steady_motion.speed_m_s\"?",
        ),
        (json!({ "maximise": "steps.settling.state", "over": over }), "is a word"),
        (json!({ "maximise": speed, "over": over, "cases": 3 }), "has no \"cases\""),
        (json!({ "maximise": speed, "over": { "contacts.balls.friction": [0.2, 0.1] } }), "must be below"),
        (json!({ "maximise": speed, "over": { "contacts.balls.friction": [0.2, 0.2] } }), "must be below"),
        (
            json!({ "maximise": speed, "over": { "contacts.balls.fricton": [0.1, 0.2] } }),
            "did you mean \"friction\"?",
        ),
        (json!({ "maximise": speed, "over": { "contacts.balls.count": [1, 3] } }), "is a count"),
        (json!({ "maximise": speed, "over": over, "starts": 0 }), "from 1 to 64"),
        (
            json!({ "maximise": speed, "waveform": { "path": "waveforms.driv", "corners": 8 } }),
            "did you mean \"waveforms.drive\"?",
        ),
        (
            json!({ "maximise": speed, "waveform": { "path": "waveforms.drive", "corners": 25 } }),
            "from 3 to 24",
        ),
        (json!({ "maximise": speed, "waveform": { "path": "waveforms.drive" } }), "either \"corners\" or"),
        (
            json!({ "maximise": speed, "waveform": { "path": "waveforms.drive", "harmonics": 8, "bandwidth": "3 kHz" } }),
            "allows 3 harmonics",
        ),
        (
            json!({ "maximise": speed, "over": { "waveforms.drive.sawtooth.flyback": [0, 1e-4] }, "waveform": { "path": "waveforms.drive", "corners": 8 } }),
            "so it has no such number",
        ),
        (
            json!({ "vary": { "contacts.balls.friction": { "list": [0.1] } }, "results": [speed] }),
            "`stickslip study run`",
        ),
    ];
    all_refused(cases);
}

#[test]
fn more_than_six_numbers_are_refused() {
    let seven: serde_json::Map<String, Value> = [
        "contacts.balls.friction",
        "bodies.foot.mass",
        "bodies.stage.mass",
        "contacts.balls.normal.force",
        "waveforms.drive.sawtooth.stroke",
        "waveforms.drive.sawtooth.flyback",
        "waveforms.drive.sawtooth.frequency",
    ]
    .map(|path| (path.to_owned(), json!([1, 2])))
    .into_iter()
    .collect();
    let file = json!({ "maximise": "steady_motion.speed_m_s", "over": seven });
    all_refused([(file, "at most 6 numbers, got 7")]);
}
