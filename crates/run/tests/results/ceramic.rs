//! Hysteresis and creep of piezo stacks: the rows show the requested values, and compensation removes them.

use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use stickslip_drive::{Trace, run};
use stickslip_run::{Job, info};
use stickslip_scenario::Scenario;

const STROKE: f64 = 4.6e-6;
const PERIOD: f64 = 10e-3;

/// Returns the example: two periods of a sine from 0 to 120 V.
fn example() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/piezo_hysteresis.json");
    let mut scenario: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    scenario["run"] = json!({ "duration": "20 ms", "stepper": { "event": { "tolerance": 1e-9 } } });
    scenario["output"] = json!({ "every": "20 us" });
    scenario["plots"] = json!([]);
    // The driver only shows the voltage in the plot of the example.
    let stack = &mut scenario["actuators"]["stack"];
    stack.as_object_mut().unwrap().remove("driver");
    stack["data_sheet"].as_object_mut().unwrap().remove("capacitance");
    scenario
}

fn job(scenario: &Value) -> Job {
    let scenario = Scenario::from_str_alone(&scenario.to_string(), "test").unwrap();
    Job::new(scenario, "test".to_owned(), PathBuf::new()).unwrap()
}

fn columns(scenario: &Value, names: &[&str]) -> Vec<Vec<f64>> {
    let job = job(scenario);
    let (mut state, mut trace) = (job.start.clone(), Trace::new(&job.model));
    run(&job.model, &job.scenario.plan, &mut state, &mut trace).unwrap();
    let place = |name: &&str| job.model.channels().iter().position(|channel| channel.name == *name).unwrap();
    names.iter().map(|name| trace.column(place(name)).collect()).collect()
}

/// Returns the free stroke for the voltage 60 V(1 - cos 2πt/T) by the data sheet.
fn asked(t: f64) -> f64 {
    0.5 * STROKE * (1.0 - (std::f64::consts::TAU * t / PERIOD).cos())
}

/// The second period is a closed loop. The width is the distance of its two branches at equal voltage.
#[test]
fn a_loop_is_as_wide_as_asked_for_and_keeps_the_stroke() {
    for (percent, stroke) in [(12.0, None), (5.0, None), (12.0, Some(2.0 * STROKE))] {
        let mut scenario = example();
        let stack = &mut scenario["actuators"]["stack"];
        stack["hysteresis"] = json!({ "loop": { "percent": percent } });
        if let Some(stroke) = stroke {
            stack["hysteresis"]["loop"]["stroke"] = json!(stroke);
        }
        let [y] = &columns(&scenario, &["stack.hysteresis.stroke_m"])[..] else { panic!("one column") };
        let round = &y[500..=1000];
        let width = (0..=250).map(|k| (round[k] - round[500 - k]).abs()).fold(0.0, f64::max);
        let (low, high) = (round[0], round[250]);
        match stroke {
            None => {
                assert!((high - low - STROKE).abs() < 1e-12 * STROKE, "{}", high - low);
                assert!((width / STROKE - 0.01 * percent).abs() < 1e-12, "{width}");
            }
            // At half of the nominal stroke, the loop has a quarter of the width, except for the discretisation by ten play operators.
            Some(stroke) => assert!((width / stroke - 0.03).abs() < 2e-3, "{}", width / stroke),
        }
    }
}

/// The command is corrected by both inverse models, for voltages and for strokes. Without them the error is 12 %.
#[test]
fn compensation_leaves_less_than_a_billionth_of_the_stroke() {
    for by_voltage in [true, false] {
        let off = |compensate: bool| {
            let mut scenario = example();
            let stack = &mut scenario["actuators"]["stack"];
            stack["compensate"] = json!(compensate);
            // Creep that is visible within the run.
            stack["creep"] = json!({ "per_decade": 0.02, "from": "0.1 ms", "decades": 2 });
            if !by_voltage {
                stack["stroke"] = stack["voltage"].clone();
                stack.as_object_mut().unwrap().remove("voltage");
                scenario["waveforms"]["drive"]["sine"]["amplitude"] = json!("2.3 um");
                scenario["waveforms"]["drive"]["sine"]["offset"] = json!("2.3 um");
            }
            let [t, y] = &columns(&scenario, &["time_s", "stack.creep.stroke_m"])[..] else {
                panic!("two columns")
            };
            t.iter().zip(y).map(|(t, y)| (y - asked(*t)).abs()).fold(0.0, f64::max)
        };
        let (left, without) = (off(true), off(false));
        assert!(left < 1e-9 * STROKE, "{left}");
        assert!(without > 0.1 * STROKE, "{without}");
    }
}

/// With charge control neither effect occurs. Absent effects have neither blocks nor columns.
#[test]
fn what_is_absent_or_idle_has_no_block() {
    let mut plain = example();
    let stack = plain["actuators"]["stack"].as_object_mut().unwrap();
    stack.remove("hysteresis");
    stack.remove("creep");
    assert!(job(&plain).scenario.scene.blocks.is_empty());
    let mut charged = example();
    let stack = &mut charged["actuators"]["stack"];
    stack["capacitance"] = json!("7.2 uF");
    stack["driver"] = json!({ "control": "charge", "current": "2 A" });
    let names: Vec<String> =
        job(&charged).scenario.scene.blocks.iter().map(|block| block.name.clone()).collect();
    assert_eq!(names, ["stack"]);
    let words = info::piezos(&job(&charged)).0[0].1.words.join("\n");
    assert!(
        words.contains("stack: hysteresis and creep have no effect, because the charge is controlled"),
        "{words}"
    );
}

#[test]
fn info_tells_the_laws() {
    let mut scenario = example();
    scenario["actuators"]["stack"]["compensate"] = json!(true);
    let words = info::piezos(&job(&scenario)).0[0].1.words.clone();
    for said in [
        "stack: hysteresis of 10 play operators, loop width 12 % at a stroke of 4.600 µm",
        "stack: creep by 7 exponentials of 125.9 ms to 12.59 ks; the deviation from the logarithm is 0.00013 of a stroke",
        "stack: the command passes the inverse model first",
    ] {
        assert!(words.iter().any(|word| word == said), "{said}\n{words:#?}");
    }
}

/// Waveforms with many reversals per period, and play operators that engage simultaneously, do not accumulate events.
#[test]
fn many_turns_in_one_repeat_are_no_accumulation() {
    let zigzag: Vec<Value> =
        (0..=200).map(|k| json!([0.2e-3 * f64::from(k), format!("{} V", 60 * (k % 2))])).collect();
    let drives = [
        (
            json!({ "sine": { "amplitude": "60 V", "offset": "60 V", "frequency": "1 kHz",
            "burst": { "cycles": 5, "period": "100 ms" } } }),
            "10 ms",
        ),
        (
            json!({ "chirp": { "amplitude": "60 V", "offset": "60 V", "from": "0.1 kHz", "to": "2 kHz",
            "duration": "30 ms" } }),
            "30 ms",
        ),
        (
            json!({ "harmonics": { "period": "100 ms", "terms": [
            { "amplitude": "10 V", "order": 1 }, { "amplitude": "50 V", "order": 60 }] } }),
            "40 ms",
        ),
        (json!({ "table": { "points": zigzag } }), "40 ms"),
        (json!({ "sawtooth": { "stroke": "120 V", "period": "10 ms", "flyback": "0.01 ms" } }), "20 ms"),
    ];
    let loops = [
        json!({ "loop": { "percent": 12, "operators": 10 } }),
        json!({ "loop": { "percent": 12, "operators": 64 } }),
        json!({ "bouc_wen": { "slope": 0.3, "limit": "0.5 um", "share": 0.7, "exponent": 1 } }),
    ];
    for (drive, duration) in &drives {
        for hysteresis in &loops {
            let mut scenario = example();
            scenario.as_object_mut().unwrap().remove("figures");
            scenario["waveforms"]["drive"] = drive.clone();
            scenario["actuators"]["stack"]["hysteresis"] = hysteresis.clone();
            scenario["run"] = json!({ "duration": duration, "stepper": { "event": { "tolerance": 1e-6 } } });
            let job = job(&scenario);
            let (mut state, mut trace) = (job.start.clone(), Trace::new(&job.model));
            let ended = run(&job.model, &job.scenario.plan, &mut state, &mut trace);
            assert!(ended.is_ok(), "{drive} {hysteresis}: {ended:?}");
        }
    }
}
