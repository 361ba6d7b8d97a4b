//! Convergence of the step lengths of drives, and the validity of steady step lengths.

use serde_json::Value;
use std::path::{Path, PathBuf};
use stickslip_measure::{Bounds, Settling};
use stickslip_run::outlook::{Outlook, Repetition};
use stickslip_run::{Job, Real, Summary};

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name).with_extension("json")
}

/// Returns a stage of 100 g on three balls with a foot of 5 g on a stack: 5 N, 1 ms, 4.6 µm.
fn stage() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/stage.json")
}

/// Returns the steps part of the summary, with all step lengths.
fn steps(file: &Path, cycles: usize, set: &[(&str, &str)]) -> Value {
    let set = set.iter().copied().chain([("output.every", "1e3"), ("plots", "[]")]);
    let set: Vec<_> = set.map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
    let set = [vec![("run.cycles".to_owned(), cycles.to_string())], set].concat();
    let job = Job::prepare(file, &set, Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let summary: Value = serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
    let mut steps = summary["steps"].clone();
    steps["lengths_m"] = outcome.step_lengths().into();
    steps
}

fn number(value: &Value, key: &str) -> f64 {
    value.pointer(key).unwrap_or_else(|| panic!("no {key} in {value}")).as_f64().unwrap()
}

fn state(steps: &Value) -> &str {
    steps["settling"]["state"].as_str().unwrap()
}

fn lengths(steps: &Value) -> Vec<f64> {
    steps["lengths_m"].as_array().unwrap().iter().map(|length| length.as_f64().unwrap()).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The steady step length agrees with the mean of 10 000 further periods within its error.
#[test]
#[ignore = "takes long: .ci/full"]
fn settled_steps_hold_for_ten_thousand_periods() {
    for (file, cycles) in
        [(example("p1"), 20), (example("ruby_drive"), 8), (example("vibrated_slider"), 60), (stage(), 12)]
    {
        let short = steps(&file, cycles, &[]);
        assert_eq!(state(&short), "settled", "{}", file.display());
        let (step, error) = (number(&short, "/steady/step_m"), number(&short, "/steady/error_m"));
        let long = lengths(&steps(&file, cycles + 10_000, &[]));
        let off = (step - mean(&long[cycles..])).abs();
        println!("{}: {step:e}, error {error:.1e}, off {off:.1e}", file.display());
        assert!(off <= error, "{}: {off:e} off, error {error:e}", file.display());
        assert!(error < 1e-3 * step);
    }
}

/// At 20 kHz the step length increases over thousands of periods. Its limit can be extrapolated early.
#[test]
fn a_step_on_its_way_is_not_settled_and_its_limit_is_foreseen() {
    let fast = [("waveforms.drive.sawtooth.period", "\"50 us\"")];
    let short = steps(&stage(), 100, &fast);
    assert_eq!(state(&short), "not_settled");
    assert!(short.get("steady").is_none());
    let last = lengths(&short)[98..].to_vec();
    assert_eq!(number(&short, "/settling/change_m"), last[1] - last[0]);
    // The remaining change exceeds the change so far, so no limit is extrapolated.
    assert!(short["settling"].get("limit_m").is_none());
    let long = lengths(&steps(&stage(), 6000, &fast));
    let later = steps(&stage(), 1000, &fast);
    let (limit, error) = (number(&later, "/settling/limit_m"), number(&later, "/settling/limit_error_m"));
    println!("limit {limit:e} ± {error:e}, {:e} after 6 000 periods", long[5999]);
    assert!((limit - long[5999]).abs() < error, "{limit:e} ± {error:e}, {:e}", long[5999]);
}

/// A load of 0.5 N exceeds the friction limit of 0.45 N, so the stage drifts.
#[test]
fn a_load_that_runs_away_drifts() {
    let set = [("contacts.balls.normal.force", "\"1 N\""), ("loads", r#"[{"on":"stage","x":"-0.5 N"}]"#)];
    let found = steps(&stage(), 20, &set);
    assert_eq!(state(&found), "drifts", "{found}");
    assert!(found.get("steady").is_none());
}

/// Without damping the stack rings for two hundred periods.
#[test]
fn an_undamped_stack_is_on_its_way_for_long() {
    let set = [("actuators.stack.damping", "0")];
    let found = steps(&stage(), 20, &set);
    assert_eq!(state(&found), "not_settled", "{found}");
    assert!(found.get("steady").is_none());
    let long = steps(&stage(), 600, &set);
    let (limit, error) = (number(&found, "/settling/limit_m"), number(&found, "/settling/limit_error_m"));
    let step = number(&long, "/steady/step_m");
    assert!((limit - step).abs() < error, "{limit:e} ± {error:e}, {step:e}");
}

/// Oscillations of the examples: one decays by 0.33 % per period, one grows by 0.1 %.
#[test]
fn beats_fade_or_grow() {
    let impact = steps(&example("impact_drive"), 100, &[]);
    assert_eq!(state(&impact), "oscillates");
    assert!((number(&impact, "/settling/periods") - 12.0).abs() < 1.0, "{}", impact["settling"]);
    assert!((-0.02..-0.001).contains(&number(&impact, "/settling/growth")), "{}", impact["settling"]);
    let climber = steps(&example("vertical_climber"), 60, &[]);
    assert_eq!(state(&climber), "oscillates");
    assert!((number(&climber, "/settling/periods") - 7.5).abs() < 0.1, "{}", climber["settling"]);
    assert!((0.0005..0.002).contains(&number(&climber, "/settling/growth")), "{}", climber["settling"]);
}

/// A slider with chaotic rocking. Forty of its periods rarely give a pattern, and there is none.
#[test]
fn chaos_is_said_to_have_no_pattern() {
    let set = [("run.stepper.event.tolerance", "1e-6")];
    let found = steps(&example("rocking_slider"), 4000, &set);
    assert_eq!(state(&found), "irregular", "{found}");
    let lengths = lengths(&found);
    let bounds = Bounds { least: 0.0, most: f64::INFINITY, error: 0.0 };
    let parts: Vec<_> =
        (100..3960).step_by(20).map(|from| Settling::of(&lengths[from..from + 40], bounds)).collect();
    let patterns = parts.iter().filter(|part| !matches!(part, Settling::Irregular { .. })).count();
    println!("{patterns} patterns in {} parts of forty periods", parts.len());
    assert!(patterns <= parts.len() / 30, "{patterns} patterns in {} parts", parts.len());
}

/// Slow decay is hidden by fast decay. The error of a settled step includes the distance from the periodic orbit, if the steps converge to
/// it.
#[test]
fn a_settled_step_is_as_far_off_as_it_is_from_the_steady_motion() {
    let set = [("plots", "[]")].map(|(key, value)| (key.to_owned(), value.to_owned()));
    let job = Job::prepare(&example("ruby_drive"), &set, Path::new("")).unwrap();
    let outcome = job.run(&());
    let told = |beside: Option<(f64, bool)>| {
        let mut summary = Summary::new(&job, &outcome);
        let steady = summary.steps.as_ref().unwrap().steady.as_ref().unwrap().step.0;
        summary.set_outlook(beside.map(|(share, stable)| {
            Outlook::Found(Repetition {
                step: Real((1.0 + share) * steady),
                error: Real(0.0),
                speed: Real(0.0),
                stable: Some(stable),
                periods: 1,
                radius: Real(0.5),
                beat: None,
                fold: None,
                words: String::new(),
                carried: Vec::new(),
                shaken_down: Vec::new(),
            })
        }));
        let steady = summary.steps.unwrap().steady.unwrap();
        steady.error.0 / steady.step.0.abs()
    };
    let own = told(None);
    assert!(own < 1e-6, "{own:e}");
    assert!((told(Some((1e-5, true))) / 1e-5 - 1.0).abs() < 1e-6);
    // Another orbit, or one that runs leave, does not affect the error.
    for beside in [(1e-2, true), (1e-5, false), (0.0, true)] {
        assert!((told(Some(beside)) / own - 1.0).abs() < 1e-9, "{beside:?}");
    }
}

/// Six strokes of a burst move a slider by more than twice the stroke in each period. This is no drift.
#[test]
fn a_burst_steps_farther_than_its_stroke() {
    let burst = r#"{"cycles": 6, "dwell": "1 ms"}"#;
    let steps = steps(&example("ruby_drive"), 20, &[("waveforms.drive.sawtooth.burst", burst)]);
    assert_eq!(state(&steps), "settled", "{steps}");
    assert!(number(&steps, "/steady/step_m") > 2.0 * 100e-9);
}
