//! Stacks with data sheets and drivers, compared with closed forms, hand-computed tables and the output of `info`.

use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::{Path, PathBuf};
use stickslip_drive::{Trace, run};
use stickslip_run::{Job, Summary, info};
use stickslip_scenario::Scenario;

const STROKE: f64 = 4.6e-6;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name).with_extension("json")
}

fn value(name: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(data(name)).unwrap()).unwrap()
}

fn job(scenario: &Value) -> Job {
    let scenario = Scenario::from_str_alone(&scenario.to_string(), "test").unwrap();
    Job::new(scenario, "test".to_owned(), PathBuf::new()).unwrap()
}

/// Rows of a run by column name, and the positions of the bodies at its end.
struct Rows {
    job: Job,
    trace: Trace,
    ends: Vec<f64>,
}

fn rows(scenario: &Value) -> Rows {
    let job = job(scenario);
    let (mut state, mut trace) = (job.start.clone(), Trace::new(&job.model));
    run(&job.model, &job.scenario.plan, &mut state, &mut trace).unwrap();
    let bodies = 0..job.scenario.scene.bodies.len();
    let ends = bodies.map(|body| state.body(&job.model, body).unwrap().0).collect();
    Rows { job, trace, ends }
}

impl Rows {
    fn column(&self, name: &str) -> Vec<f64> {
        let place = self.job.model.channels().iter().position(|channel| channel.name == name).unwrap();
        self.trace.column(place).collect()
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// A flyback of 20 µs would need 43 A, but the limit is 2 A. The voltage falls at 2 A/7.2 µF until the next rise.
///
/// The same stage runs with a table of this voltage.
#[test]
fn the_stage_agrees_with_the_table_of_what_its_driver_can_do() {
    let mut driven = value("stage_by_voltage");
    driven["run"] = json!({ "duration": "12.3 ms", "stepper": { "event": { "tolerance": 1e-12 } } });
    let mut table = driven.clone();
    let (period, flyback) = (1e-3, 20e-6);
    let (rise, fall) = (STROKE / (period - flyback), STROKE / 120.0 * 2.0 / 7.2e-6);
    // STROKE - fall (t + flyback) = rise t, counted from the end of the period.
    let meets = (STROKE - fall * flyback) / (rise + fall);
    let mut points = vec![json!([0.0, 0.0])];
    for n in 1..=13 {
        let end = f64::from(n) * period;
        points.push(json!([end - flyback, STROKE]));
        points.push(json!([end + meets, rise * meets]));
    }
    table["waveforms"]["drive"] = json!({ "table": { "points": points } });
    table["actuators"]["stack"] = json!({
        "between": ["ground", "foot"], "stiffness": "100 N/um", "damping": "500 N s/m", "stroke": { "follows": "drive" }
    });
    table["figures"] = json!({ "body": "stage" });
    let (driven, table) = (rows(&driven), rows(&table));
    for (body, by_table) in driven.ends.iter().zip(&table.ends) {
        println!("{body:e} {by_table:e}");
        assert!((body - by_table).abs() < 1e-9 * STROKE, "{body:e} {by_table:e}");
    }
    assert!(driven.ends[1] > 2.0 * STROKE, "{:?}", driven.ends);
}

/// `info` reports before the run what the driver cannot follow, and the remaining stroke.
#[test]
fn info_says_which_corner_the_driver_cannot_follow() {
    let info = info::piezos(&job(&value("stage_by_voltage")));
    let (name, stack) = &info.0[0];
    let corner = stack.corner.as_ref().unwrap();
    assert_eq!(name, "stack");
    assert!((corner.needed.0 - 43.2).abs() < 1e-9 && corner.available.unwrap().0 == 2.0);
    assert!(
        (corner.slew.unwrap().0 - 2.0 / 7.2e-6).abs() < 1e-6
            && (corner.takes.unwrap().0 - 432e-6).abs() < 1e-12
    );
    assert_eq!(
        stack.words[0],
        "stack: the change from 120.0 V to 0 V in 20.00 µs needs 43.20 A, but the driver supplies 2.000 A: the voltage changes by 0.2778 V/us, and the whole change takes 432.0 µs"
    );
    assert!(
        stack.words[1].starts_with("stack: the commanded stroke is 4.600 µm, the driver leaves 3.25"),
        "{:?}",
        stack.words
    );
    assert_eq!(stack.words.len(), 2);
    // kα²/C, 100 N/µm, 4.6 µm/120 V, 7.2 µF.
    let coupling = 1e8 * (STROKE / 120.0_f64).powi(2) / 7.2e-6;
    assert!((stack.coupling.unwrap().0 - coupling).abs() < 1e-12 && (coupling - 0.0204).abs() < 1e-4);
}

/// At 2 % of the stroke, as in a cryostat, the stage makes no steps. This is reported before the run.
#[test]
fn info_says_that_a_stroke_is_below_its_zero_step_stroke() {
    let mut cold = value("stage_by_voltage");
    cold["waveforms"]["drive"]["sawtooth"]["stroke"] = json!("2.4 V");
    cold["actuators"]["stack"].as_object_mut().unwrap().remove("driver");
    let info = info::piezos(&job(&cold));
    assert_eq!(
        info.0[0].1.words,
        [
            "stack: the stroke of 92.00 nm is below the zero-step stroke of 114.1 nm of balls: an ideal sawtooth makes no step"
        ]
    );
}

/// ω² = k/(M + m), where m is the mass at the free end of a rod that rings at 40 kHz when clamped.
///
/// The stroke is α·V alone and less against a spring. At the blocking force it is 0.
#[test]
fn a_free_stack_rings_stretches_and_blocks_by_closed_forms() {
    let stiffness = 460.0 / STROKE;
    let own = stiffness / (TAU * 40e3_f64).powi(2);
    let omega = (stiffness / (0.1 + own)).sqrt();
    let mut free = value("free_stack");
    free["actuators"]["stack"]["damping"] = json!(0);
    let ring = rows(&free);
    let (t, x) = (ring.column("time_s"), ring.column("mass.x_m"));
    for (t, x) in t.into_iter().zip(x) {
        let exact = STROKE * (1.0 - (omega * t).cos());
        assert!((x - exact).abs() < 1e-10 * STROKE, "{t}: {x:e} {exact:e}");
    }
    let modes = info::modes(&job(&value("free_stack")));
    assert!((modes[0].frequency.0 / (omega / TAU) - 1.0).abs() < 1e-4, "{}", modes[0].frequency.0);
    // The quality factor of a soft ceramic: ζ = 1/2Q.
    assert!((modes[0].damping_ratio.0 - 0.01).abs() < 1e-12, "{}", modes[0].damping_ratio.0);
    let mut still = value("free_stack");
    still["run"]["start"] = json!("equilibrium");
    let place = |scenario: &Value| rows(scenario).ends[0];
    assert!((place(&still) / STROKE - 1.0).abs() < 1e-10);
    still["loads"] = json!([{ "on": "mass", "x": "-460 N" }]);
    assert!(place(&still).abs() < 1e-10 * STROKE);
    still["loads"] = json!([]);
    still["springs"] = json!({ "spring": { "between": ["ground", "mass"], "stiffness": "50 N/um" } });
    assert!((place(&still) / (STROKE * stiffness / (stiffness + 5e7)) - 1.0).abs() < 1e-10);
    assert!((own * PI * PI / 4.0 / job(&still).scenario.stacks[0].stack.mass - 1.0).abs() < 1e-12);
}

/// Returns the contact and the sawtooth of P1 on a foot of 5 g with a stack of 20 N/µm. A slider of 20 g carries a load of 20 mN.
///
/// The driver has a current limit, a resistance and a bandwidth.
fn p1() -> Value {
    let mut scenario = value("stage_by_voltage");
    scenario["materials"] = json!({ "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } });
    scenario["waveforms"]["drive"] =
        json!({ "sawtooth": { "stroke": "50 V", "period": "1 ms", "flyback": "0.1 ms" } });
    scenario["bodies"]["stage"]["mass"] = json!("20 g");
    scenario["contacts"]["balls"] = json!({
        "between": ["foot", "stage"], "materials": ["steel", "steel"], "profile": { "paraboloid": { "radius": "1 mm" } },
        "friction": 0.15, "normal": { "force": "1 N" }
    });
    scenario["actuators"]["stack"] = json!({
        "between": ["ground", "foot"], "stiffness": "20 N/um", "damping": "20 N s/m", "stroke_per_volt": "10 nm/V",
        "capacitance": "1 uF", "voltage": { "follows": "drive" },
        "driver": { "current": "0.3 A", "resistance": "10 ohm", "bandwidth": "20 kHz" }
    });
    scenario["loads"] = json!([{ "on": "stage", "x": "-0.02 N" }]);
    scenario["output"]["every"] = json!("7 us");
    scenario
}

#[test]
fn the_benchmark_on_a_driven_stack_converges_and_its_books_close() {
    let end = |tolerance: f64| {
        let mut scenario = p1();
        scenario["run"] = json!({ "cycles": 6, "stepper": { "event": { "tolerance": tolerance } } });
        rows(&scenario)
    };
    let (good, best) = (end(1e-10), end(1e-13));
    for (x, exact) in good.ends.iter().zip(&best.ends) {
        println!("{x:e} {exact:e}");
        assert!((x - exact).abs() < 1e-9 * 0.5e-6, "{x:e} {exact:e}");
    }
    assert!(best.ends[1] > 0.5e-6, "{:?}", best.ends);
    let [error, input] = ["energy.error_J", "energy.input_J"].map(|name| largest(&good.column(name)));
    assert!(error < 1e-8 * input, "{error:e} of {input:e}");
    let [source, stored, lost] =
        ["source_J", "stored_J", "lost_J"].map(|name| good.column(&format!("stack.{name}")));
    let open: Vec<f64> = (0..source.len()).map(|i| source[i] - stored[i] - lost[i]).collect();
    assert!(largest(&open) < 1e-8 * largest(&lost), "{:e} of {:e}", largest(&open), largest(&lost));
}

/// In a period of 1 ms, the driver is at its limit from 980 µs until it meets the next rise 286 µs later.
///
/// The source supplies CV²/2 minus the energy that is still stored.
#[test]
fn the_summary_says_what_the_driver_has_done() {
    let job = job(&value("stage_by_voltage"));
    let outcome = job.run(&());
    let summary: Value = serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
    let of = |key: &str| summary["drivers"]["stack"].pointer(key).unwrap().as_f64().unwrap();
    let (rise, fall) = (120.0 / 980e-6, 2.0 / 7.2e-6);
    let meets = (120.0 - fall * 20e-6) / (rise + fall);
    let low = rise * meets;
    assert!((of("/peak_current_A") - 2.0).abs() < 1e-12);
    let falling = (19.0 * (meets + 20e-6) + 20e-6) / 20e-3;
    assert!((of("/at_limit/current_down") - falling).abs() < 1e-9, "{}", summary["drivers"]);
    let way = 120.0 + 19.0 * 2.0 * (120.0 - low) + fall * 20e-6;
    assert!((of("/mean_current_A") / (7.2e-6 * way / 20e-3) - 1.0).abs() < 1e-6, "{}", summary["drivers"]);
    // While the voltage rises, the source supplies the stored energy. While it falls, it supplies energy only below zero.
    let stored = |from: f64, to: f64| 0.5 * 7.2e-6 * (to * to - from * from);
    let drawn = stored(0.0, 120.0) + 19.0 * stored(low, 120.0);
    assert!((of("/drawn_J") / drawn - 1.0).abs() < 1e-6, "{} {drawn}", summary["drivers"]);
    assert_eq!(of("/at_limit/window_low") + of("/at_limit/window_high") + of("/at_limit/current_up"), 0.0);
}

/// The summary reports a command that the window clips. A command that only touches its ends is not clipped.
#[test]
fn a_window_is_reported_where_it_clips_the_command() {
    let said = |window: [&str; 2], current: Option<&str>| {
        let mut scenario = value("stage_by_voltage");
        scenario["waveforms"]["drive"] = json!({ "sine": { "amplitude": "60 V", "frequency": "1 kHz", "offset": "60 V", "phase": "-90 deg" } });
        scenario["actuators"]["stack"]["driver"] = json!({ "window": window });
        if let Some(current) = current {
            scenario["actuators"]["stack"]["driver"]["current"] = json!(current);
        }
        let job = job(&scenario);
        Summary::new(&job, &job.run(&())).driver_limits().collect::<Vec<_>>()
    };
    assert_eq!(said(["0 V", "120 V"], None), Vec::<String>::new());
    // |sin| > 1/2 on one side of the mean.
    assert_eq!(
        said(["0 V", "90 V"], None),
        ["the driver of stack was 33.3 % of the time at an end of its window: the driver clips its command"]
    );
    let both = said(["0 V", "90 V"], Some("2 A"));
    assert!(
        both[0]
            .ends_with("at an end of its window: the stack lags behind its command, which the driver clips")
    );
}

/// With a sine of 80 V about 40 V, the source supplies energy whenever the voltage moves away from zero: C(120² + 40²)/2 per period.
#[test]
fn what_a_source_gives_is_counted_up_to_where_it_turns() {
    let mut scenario = value("stage_by_voltage");
    scenario["waveforms"]["drive"] =
        json!({ "sine": { "amplitude": "80 V", "frequency": "1 kHz", "offset": "40 V" } });
    scenario["actuators"]["stack"]["driver"] = json!({ "window": ["-60 V", "130 V"], "current": "20 A" });
    let drawn = 20.0 * 0.5 * 7.2e-6 * (120.0 * 120.0 + 40.0 * 40.0);
    for (tolerance, close) in [(1e-3, 3e-5), (1e-6, 1e-6), (1e-9, 1e-7)] {
        scenario["run"]["stepper"] = json!({ "event": { "tolerance": tolerance } });
        let job = job(&scenario);
        let outcome = job.run(&());
        let summary: Value = serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
        let told = summary["drivers"]["stack"]["drawn_J"].as_f64().unwrap();
        println!("{tolerance:e}: {:e}", told / drawn - 1.0);
        assert!((told / drawn - 1.0).abs() < close, "{tolerance:e}: {told} {drawn}");
    }
}

/// Fixed time steps cross the corners of the command, where the power of the source jumps. The reference is the event-driven integrator.
#[test]
fn steps_over_corners_give_no_more_than_there_is() {
    let drawn = |stepper: Value| {
        let mut scenario = value("stage_by_voltage");
        scenario["run"] = json!({ "duration": "4.1 ms", "stepper": stepper });
        scenario["actuators"]["stack"]["driver"] = json!({ "window": ["-1 V", "130 V"] });
        let job = job(&scenario);
        let outcome = job.run(&());
        let summary: Value = serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
        summary["drivers"]["stack"]["drawn_J"].as_f64().unwrap()
    };
    let exact = drawn(json!({ "event": { "tolerance": 1e-10 } }));
    for step in ["0.07 us", "0.7 us", "1.3 us"] {
        let told = drawn(json!({ "rk4": { "step": step } }));
        println!("{step}: {:e}", told / exact - 1.0);
        assert!((told / exact - 1.0).abs() < 2e-3, "{step}: {told} {exact}");
    }
}

/// Frames of a few microseconds and fixed time steps give the same steps of the stage.
#[test]
fn frames_and_fixed_steps_agree() {
    let end = |stepper: Value| {
        let mut scenario = value("stage_by_voltage");
        scenario["run"] = json!({ "duration": "4.1 ms", "stepper": stepper });
        rows(&scenario).ends[1]
    };
    let exact = end(json!({ "event": { "tolerance": 1e-10 } }));
    for stepper in [json!({ "rk4": { "step": "0.05 us" } }), json!({ "verlet": { "step": "0.05 us" } })] {
        let x = end(stepper.clone());
        assert!((x - exact).abs() < 1e-3 * STROKE, "{stepper}: {x:e} {exact:e}");
    }
    let x = end(json!({ "frames": { "length": "5 us", "accuracy": 1e-4 } }));
    assert!((x - exact).abs() < 1e-2 * STROKE, "frames: {x:e} {exact:e}");
}

/// Returns the steps of two stages in the last two of ten periods, m (`docs/piezo/hobby.json`).
///
/// Stroke 4.6 µm at 120 V, normal force 2.7 N, mass 50 g, friction coefficient 0.2, flybacks of 12 and 38 V/µs every 10 ms.
fn hobby(driver: &Value) -> [f64; 2] {
    let text = include_str!("../../../../docs/piezo/hobby.json");
    let mut scenario: Value = serde_json::from_str(text).unwrap();
    scenario["run"] = json!({ "cycles": 10 });
    scenario["output"]["every"] = json!("10 ms");
    scenario["plots"] = json!([]);
    if !driver.is_null() {
        for stack in ["slow_stack", "fast_stack"] {
            scenario["actuators"][stack]["driver"] = driver.clone();
        }
    }
    let rows = rows(&scenario);
    ["slow.x_m", "fast.x_m"].map(|stage| {
        let x = rows.column(stage);
        0.5 * (x[10] - x[8])
    })
}

/// With an ideal driver both flybacks give steps of nearly the whole stroke.
///
/// The foot accelerates at 46 000 m/s², and friction can accelerate the slider at 11 m/s² only. A driver that slows down the slower flyback
/// slows down the faster one equally. Current, resistance and bandwidth determine the fall of the voltage, not the command.
#[test]
fn a_driver_that_spoils_the_slow_flyback_spoils_the_fast_one() {
    let drivers = [
        Value::Null,
        json!({ "current": "10 A" }),
        json!({ "current": "2 A" }),
        json!({ "current": "1 A" }),
        json!({ "current": "0.5 A" }),
        json!({ "resistance": "1 ohm" }),
        json!({ "resistance": "10 ohm" }),
        json!({ "resistance": "50 ohm" }),
        json!({ "bandwidth": "30 kHz" }),
        json!({ "bandwidth": "3 kHz" }),
        json!({ "bandwidth": "0.5 kHz" }),
    ];
    let mut steps = Vec::new();
    for driver in &drivers {
        let [slow, fast] = hobby(driver);
        println!("{driver}: {:.3} µm at 12 V/µs, {:.3} µm at 38 V/µs", 1e6 * slow, 1e6 * fast);
        steps.push((slow, fast));
    }
    assert!(steps[0].0 > 0.95 * STROKE && steps[0].1 > 0.95 * STROKE, "{steps:?}");
    for (slow, fast) in &steps[2..5] {
        assert!((slow - fast).abs() < 0.05 * STROKE, "{steps:?}");
    }
}

/// A voltage from an ideal source acts as a stroke, without a block. Results and evaluations equal those of a foot on a damped spring.
#[test]
fn a_stack_without_a_driver_costs_what_a_damped_spring_costs() {
    let mut volts = value("stage_by_voltage");
    volts["actuators"]["stack"].as_object_mut().unwrap().remove("driver");
    let mut stroke = volts.clone();
    stroke["waveforms"]["drive"]["sawtooth"]["stroke"] = json!(STROKE / 120.0 * 120.0);
    stroke["actuators"]["stack"] = json!({
        "between": ["ground", "foot"], "stiffness": "100 N/um", "damping": "500 N s/m", "stroke": { "follows": "drive" }
    });
    let [volts, stroke] = [volts, stroke].map(|scenario| job(&scenario));
    assert!(volts.scenario.scene.blocks.is_empty() && volts.scenario.scene == stroke.scenario.scene);
    let [volts, stroke] = [volts, stroke].map(|job| job.run(&()).state);
    assert_eq!(volts.counts(), stroke.counts());
    assert!(volts == stroke);
}
