//! Back-step and lost stroke: what `summary.json` says beside what the rows of the trace show, two periods joined, as a vibrometer sees them.

use crate::program::{Table, code, number, run, scenario, stderr, summary};
use serde_json::Value;
use std::path::{Path, PathBuf};
use tempfile::tempdir;

/// Rows of a column of the trace.
fn column(table: &Table, name: &str) -> Vec<f64> {
    table.column(name).iter().map(|value| value.parse().unwrap()).collect()
}

/// The largest fall after a maximum.
fn fall(x: &[f64]) -> f64 {
    let mut most = f64::NEG_INFINITY;
    x.iter().fold(0.0, |fall: f64, x| {
        most = most.max(*x);
        fall.max(most - x)
    })
}

fn width(x: &[f64]) -> f64 {
    let most = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most - x.iter().copied().fold(f64::INFINITY, f64::min)
}

/// A drive after so many periods, with rows every microsecond of the last two of them: its steps as told, and the trace.
fn settled(file: &Path, period: f64, cycles: u32) -> (Value, Table) {
    let root = tempdir().unwrap();
    let end = period * f64::from(cycles);
    let window = format!("output.window={{\"from\": {}, \"to\": {end}}}", end - 2.0 * period);
    let cycles = format!("run.cycles={cycles}");
    let output = run(file, root.path(), &[&cycles, "output.every=1 us", &window, "plots=[]"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let folder = root.path().join(file.file_stem().unwrap());
    (summary(&folder)["steps"].take(), Table::read(&folder.join("trace.csv")))
}

/// A drive, the bodies that step and that move it, and what it loses: fall in nm, share of the way forward in per cent, lost stroke in nm.
struct Drive {
    name: &'static str,
    bodies: [&'static str; 2],
    period: f64,
    cycles: u32,
    /// As rows of a microsecond had them when the definition was made.
    fall: f64,
    share: f64,
    is_lost_told: bool,
}

const DRIVES: [Drive; 7] = [
    drive("quickstart", ["slider", "foot"], 10e-3, 6, [71.0, 31.6], true),
    drive("ruby_drive", ["slider", "foot"], 10e-3, 6, [63.9, 50.8], true),
    drive("sine_drive", ["slider", "foot"], 1e-3, 12, [83.8, 8.9], false),
    drive("piezo_stack", ["slider", "foot"], 1e-3, 12, [16.9, 3.6], true),
    drive("walking_drive", ["rod", "feet_a"], 2e-3, 8, [25.7, 2.3], false),
    drive("driven_stage", ["stage", "foot"], 1e-3, 40, [520.0, 20.3], true),
    drive("../tests/cases/data_sheet_stage", ["stage", "foot"], 1e-3, 20, [447.0, 17.2], true),
];

const fn drive(
    name: &'static str,
    bodies: [&'static str; 2],
    period: f64,
    cycles: u32,
    [fall, share]: [f64; 2],
    is_lost_told: bool,
) -> Drive {
    Drive { name, bodies, period, cycles, fall, share, is_lost_told }
}

fn file(name: &str) -> PathBuf {
    scenario(name)
}

#[test]
fn the_back_step_is_the_fall_that_the_trace_shows() {
    for drive in DRIVES {
        let (steps, trace) = settled(&file(drive.name), drive.period, drive.cycles);
        let x = column(&trace, &format!("{}.x_m", drive.bodies[0]));
        let seen = fall(&x);
        let step = number(&steps, "/last_period/step_m");
        let told = number(&steps, "/last_period/back_step_m");
        assert!((told / seen - 1.0).abs() < 0.01, "{}: {told:e}, the trace falls by {seen:e}", drive.name);
        assert!((told * 1e9 / drive.fall - 1.0).abs() < 0.01, "{}: {told:e}", drive.name);
        let share = 100.0 * number(&steps, "/last_period/back_step");
        assert!((share - drive.share).abs() < 0.1, "{}: {share} %", drive.name);
        assert!((share / 100.0 - told / (step + told)).abs() < 1e-12);
        let steady = number(&steps, "/steady/back_step_m");
        assert!((steady / told - 1.0).abs() < 2e-3, "{}: steady {steady:e}, last {told:e}", drive.name);
    }
}

#[test]
fn the_lost_stroke_is_the_travel_of_the_foot_less_the_step() {
    for drive in DRIVES {
        let (steps, trace) = settled(&file(drive.name), drive.period, drive.cycles);
        let foot = column(&trace, &format!("{}.x_m", drive.bodies[1]));
        let told = steps.pointer("/last_period/lost_stroke_m").and_then(Value::as_f64);
        let why: Vec<&str> = steps["why"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        if !drive.is_lost_told {
            assert_eq!(told, None, "{}", drive.name);
            assert!(
                why.iter().any(|line| line.starts_with("lost stroke not computed: ")),
                "{}: {why:?}",
                drive.name
            );
            continue;
        }
        let seen = width(&foot[foot.len() / 2..]) - number(&steps, "/last_period/step_m").abs();
        let told = told.unwrap();
        assert!((told / seen - 1.0).abs() < 0.01, "{}: {told:e}, the trace has {seen:e}", drive.name);
        let steady = number(&steps, "/steady/lost_stroke_m");
        assert!((steady / told - 1.0).abs() < 2e-3, "{}: {steady:e} {told:e}", drive.name);
    }
}

/// 2 A take 306 µs to discharge the stack from 120 V to 35 V, C ΔV/I, and not the 20 µs of the command.
#[test]
fn a_stack_that_lags_is_told_by_its_own_times() {
    let (steps, trace) = settled(&file("driven_stage"), 1e-3, 40);
    let voltage = column(&trace, "stack.voltage_V");
    let discharge = 7.2e-6 * width(&voltage[voltage.len() / 2..]) / 2.0;
    assert!((discharge - 306e-6).abs() < 1e-6, "{discharge:e}");
    let way = steps["why"][0].as_str().unwrap();
    assert!(
        way.contains("and back in 305.9 µs (commanded: ") && way.contains("and back in 20.00 µs"),
        "{way}"
    );
}
