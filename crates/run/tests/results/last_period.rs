//! The evaluation of the last period, compared with rows that are a hundred to a thousand times denser than the events.

use serde_json::Value;
use std::path::Path;
use stickslip_drive::{Trace, Waveform};
use stickslip_run::{Job, Summary};

/// Rows of a run by column name.
struct Rows {
    names: Vec<String>,
    trace: Trace,
    waveform: Waveform,
}

impl Rows {
    fn column(&self, name: &str) -> Vec<f64> {
        let place = self.names.iter().position(|it| it == name).unwrap_or_else(|| panic!("no {name}"));
        self.trace.column(place).collect()
    }

    /// Returns the row indices of the last period and of the first row after it.
    fn last_period(&self, steps: &Value) -> std::ops::Range<usize> {
        let [from, to] = ["/last_period/from_s", "/last_period/to_s"].map(|key| number(steps, key));
        let (hair, t) = (1e-9 * (to - from), self.column("time_s"));
        let at = |end: f64| t.partition_point(|t| *t < end - hair);
        at(from)..at(to)
    }
}

/// Returns the evaluation and the rows of an example.
fn account(name: &str, set: &[(&str, &str)]) -> (Value, Rows) {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = ["../../scenarios", "tests/data"].map(|it| crates.join(it).join(name).with_extension("json"));
    let file = files.iter().find(|file| file.exists()).unwrap();
    let set: Vec<_> = set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let job = Job::prepare(file, &set, Path::new("")).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none());
    let summary = serde_json::to_value(Summary::new(&job, &outcome)).unwrap();
    let mut trace = Trace::new(&job.model);
    let mut state = job.start.clone();
    stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut trace).unwrap();
    let names = job.model.channels().into_iter().map(|channel| channel.name).collect();
    let waveform = &job.scenario.scene.waveforms[job.scenario.figures.waveform.unwrap()].part;
    (summary["steps"].clone(), Rows { names, trace, waveform: waveform.clone() })
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("no {pointer} in {value}"))
}

fn near(got: f64, want: f64, within: f64, what: &str) {
    assert!((got - want).abs() <= within, "{what}: {got:e}, not {want:e}");
}

/// Compares the evaluation with rows: travel of body and foot, energies, and time in gross slip.
fn check(name: &str, body: &str, contact: &str, set: &[(&str, &str)]) -> Value {
    let (steps, series) = account(name, set);
    let rows = series.last_period(&steps);
    let (t, x) = (series.column("time_s"), series.column(&format!("{body}.x_m")));
    let rate = |t: f64| series.waveform.sample(&series.waveform.piece_at(t), t).rate;
    let (mut travel, mut time, mut slip) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let states = series.column(&format!("{contact}.state"));
    for i in rows.clone() {
        // Displacement of the drive between two rows.
        let side = usize::from(rate(0.5 * (t[i] + t[i + 1])) < 0.0);
        travel[side] += x[i + 1] - x[i];
        time[side] += t[i + 1] - t[i];
        slip[side] += if states[i] == 3.0 && states[i + 1] == 3.0 { t[i + 1] - t[i] } else { 0.0 };
    }
    let stretches = rows.clone().filter(|i| states[*i] != 3.0 && states[i + 1] == 3.0).count() as f64;
    let forth = usize::from(time[1] > time[0]);
    let row = t[rows.start + 1] - t[rows.start];
    let fastest = series.column(&format!("{body}.vx_m_s"))[rows.clone()]
        .iter()
        .fold(0.0, |most: f64, v| most.max(v.abs()));
    for (way, side) in [("forward", forth), ("return", 1 - forth)] {
        let of = |key: &str| number(&steps, &format!("/last_period/{way}/{key}"));
        // A reversal is between two rows, where the body is at most as fast as its maximum velocity.
        near(of("time_s"), time[side], 2.0 * row, "time");
        near(of("travel_m"), travel[side], 2.0 * row * fastest, "travel");
        let share = number(&steps, &format!("/last_period/contacts/{contact}/slip_share_{way}"));
        // Both ends of each slip interval are between two rows.
        near(share, slip[side] / time[side], 2.0 * row * (1.0 + stretches) / time[side], "slip");
    }
    let grown = |name: &str| {
        let energy = series.column(&format!("energy.{name}"));
        energy[rows.end] - energy[rows.start]
    };
    let work = |key: &str| number(&steps, &format!("/last_period/work/{key}"));
    let through = work("friction_J") + work("damping_J");
    near(work("friction_J"), grown("friction_J"), 1e-9 * through, "friction");
    near(work("damping_J"), grown("damping_J"), 1e-9 * through, "damping");
    near(work("stored_J"), grown("kinetic_J") + grown("elastic_J"), 1e-9 * through, "stored");
    let closed = work("load_J") + work("friction_J") + work("damping_J") + work("stored_J");
    near(work("drive_J"), closed, 1e-7 * through, "books");
    near(work("drive_J") - work("load_J"), grown("input_J"), 1e-9 * through, "input");
    near(number(&steps, "/last_period/step_m"), x[rows.end] - x[rows.start], 1e-15, "step");
    steps
}

#[test]
fn a_sawtooth_on_three_balls() {
    let steps = check(
        "quickstart",
        "slider",
        "ball",
        &[("run.duration", "\"50 ms\""), ("output.every", "\"0.1 us\""), ("plots", "[]")],
    );
    // The step lifts a load of 0.02 N.
    let step = number(&steps, "/last_period/step_m");
    near(number(&steps, "/last_period/work/load_J"), 0.02 * step, 1e-12 * step, "load");
    // 812 reversals in ten periods, nearly all from ringing: at 4.15 kHz two per period, for 9.99 ms.
    near(
        number(&steps, "/last_period/contacts/ball/reversals_forward"),
        2.0 * 4.15e3 * 9.99e-3,
        4.0,
        "reversals",
    );
    // Travel, lost stroke, ball, work.
    assert_eq!(steps["why"].as_array().unwrap().len(), 4);
}

#[test]
fn bodies_that_swing_and_slip_under_a_moving_normal() {
    let dense = [("output.every", "\"0.1 us\""), ("plots", "[]")];
    check("three_ball_stage", "stage", "rear", &dense);
    check("impact_drive", "carrier", "rear", &dense);
}

/// The turning points of harmonics are not corners, so the evaluation samples them.
#[test]
fn a_drive_that_turns_on_a_curve() {
    let terms = r#"{"harmonics": {"period": "1 ms", "terms": [
        {"amplitude": "200 nm", "order": 1}, {"amplitude": "50 nm", "order": 2, "phase": "90 deg"}]}}"#;
    let set = [
        ("waveforms.drive", terms),
        ("run.duration", "\"10 ms\""),
        ("output.every", "\"0.02 us\""),
        ("plots", "[]"),
    ];
    check("quickstart", "slider", "ball", &set);
}

/// A flyback with limited rate extends into the next period. The first period has none.
#[test]
fn a_flyback_that_is_late() {
    let saw = r#"{"sawtooth": {"stroke": "200 nm", "period": "1 ms", "rate": "0.6 mm/s"}}"#;
    let set = [
        ("waveforms.drive", saw),
        ("run.duration", "\"10 ms\""),
        ("output.every", "\"0.02 us\""),
        ("plots", "[]"),
    ];
    let steps = check("quickstart", "slider", "ball", &set);
    // Falling at 0.6 mm/s, it meets the rise of 0.2 mm/s after S/(0.6 + 0.2) mm/s = 0.25 ms.
    near(number(&steps, "/last_period/return/time_s"), 0.25e-3, 1e-9, "time");
    near(number(&steps, "/last_period/return/stroke_m"), -150e-9, 1e-15, "stroke");
}

/// With a damper to the ground, the ringing decays below 5 % of the friction limit long before the flyback.
#[test]
fn ringing_settles_when_the_extremes_of_the_rows_say_so() {
    let set = [
        ("springs.brake", r#"{"between": ["ground", "slider"], "damping": "20 N s/m"}"#),
        ("output.every", "\"0.1 us\""),
        ("plots", "[]"),
    ];
    let (steps, series) = account("quickstart", &set);
    let rows = series.last_period(&steps);
    let (t, force) = (series.column("time_s"), series.column("ball.fx_N"));
    let flyback = number(&steps, "/last_period/from_s") + number(&steps, "/last_period/forward/time_s");
    // Extremes of the force in the forward stroke, including the friction limit at its start; μF_N = 0.18 N.
    let mut extreme = force[rows.start];
    let mut last = None;
    for i in rows.start + 1..rows.end {
        let turns = (force[i] - force[i - 1]) * (force[i + 1] - force[i]) < 0.0;
        if turns && t[i] < flyback {
            if 0.5 * (force[i] - extreme).abs() > 0.05 * 0.18 {
                last = Some(t[i] - t[rows.start]);
            }
            extreme = force[i];
        }
    }
    near(number(&steps, "/last_period/contacts/ball/settling_s"), last.unwrap(), 2e-7, "settling");
    assert!(number(&steps, "/last_period/contacts/ball/ringing_left") < 0.05);
}

/// A stroke that the contacts take up gives no step, and the summary states this.
#[test]
fn a_stroke_below_the_zero_step_stroke_is_called_that() {
    let set = [("waveforms.drive.sawtooth.stroke", "\"20 nm\""), ("plots", "[]"), ("loads", "[]")];
    let (steps, _) = account("quickstart", &set);
    let why = steps["why"].to_string();
    // S₀ = 2u_c[1 - (1/2)^{2/3}] = 0.74008 u_c = 29.377 nm.
    assert!(why.contains("no step") && why.contains("below the zero-step stroke of 29.38 nm"), "{why}");
}

/// Returns the number of reversals of u in the forward stroke from rows, and the relative amplitude of the last force oscillation.
fn turns(series: &Rows, steps: &Value, contact: &str, friction: f64) -> (f64, f64) {
    let rows = series.last_period(steps);
    let column = |quantity: &str| series.column(&format!("{contact}.{quantity}"));
    let (t, u, force, normal) = (series.column("time_s"), column("u_m"), column("fx_N"), column("fn_N"));
    let rate = |t: f64| series.waveform.sample(&series.waveform.piece_at(t), t).rate;
    let is_turn = |i: &usize| (u[*i] - u[i - 1]) * (u[i + 1] - u[*i]) < 0.0;
    let all: Vec<usize> = (1..rows.end).filter(is_turn).collect();
    let forth: Vec<usize> = all.iter().copied().filter(|i| *i >= rows.start && rate(t[*i]) > 0.0).collect();
    let last = *forth.last().unwrap();
    let before = all[all.iter().position(|i| *i == last).unwrap() - 1];
    let limit = 0.5 * friction * (normal[before] + normal[last]);
    (forth.len() as f64, 0.5 * (force[last] - force[before]).abs() / limit)
}

/// A slider pressed by a vertically moving foot reverses in full stick, without an event, at half of its oscillations. A spring row has an
/// event at each.
#[test]
fn turns_in_full_stick_are_turns() {
    let name = "swings_under_a_moving_foot";
    let springs = r#"{"springs": {"count": 400}}"#;
    for engine in [r#""curve""#, springs] {
        // At 1e-5 two reversals are within one time step, which detects neither.
        for tolerance in ["1e-7", "1e-8", "1e-10"] {
            let set = [
                ("contacts.c.engine", engine),
                ("run.stepper.event.tolerance", tolerance),
                ("output.every", "\"0.5 us\""),
            ];
            let (steps, series) = account(name, &set);
            let (count, swing) = turns(&series, &steps, "c", 0.25);
            let of = |key: &str| number(&steps, &format!("/last_period/contacts/c/{key}"));
            assert!(count >= 2.0 && of("reversals_forward") == count, "{engine}: {steps}");
            // Half a row from a reversal, the force error is quadratic.
            near(of("ringing_left"), swing, 1e-3 * swing, "swing");
            assert!(steps.pointer("/last_period/contacts/c/settling_s").is_none(), "{steps}");
        }
    }
}

/// Fixed time steps count the same reversals.
#[test]
fn a_fixed_step_counts_the_same_turns() {
    let set = [("run.stepper", r#"{"rk4": {"step": "0.2 us"}}"#), ("output.every", "\"1 us\"")];
    let (steps, series) = account("swings_under_a_moving_foot", &set);
    let (count, swing) = turns(&series, &steps, "c", 0.25);
    let of = |key: &str| number(&steps, &format!("/last_period/contacts/c/{key}"));
    assert_eq!(of("reversals_forward"), count);
    near(of("ringing_left"), swing, 1e-2 * swing, "swing");
}

/// Since |F_x| ≤ μF_N at both extremes, the relative amplitude is at most 1.
#[test]
fn no_swing_is_more_than_its_limit() {
    for cycles in ["2", "3", "4"] {
        let (steps, _) = account("rocks_and_lifts", &[("run.duration", &format!("\"{cycles} ms\""))]);
        for contact in ["l", "r", "tl"] {
            let left = number(&steps, &format!("/last_period/contacts/{contact}/ringing_left"));
            assert!(left <= 1.0 + 1e-6, "{contact}: {left}");
        }
    }
}

/// 0.2 N against 50 N s/m gives 4 mm/s once friction is overcome on average, ten strokes per period.
#[test]
fn what_is_pulled_along_drifts() {
    let (steps, _) = account("pulled_along", &[("output.every", "\"1 ms\"")]);
    assert_eq!(steps["settling"]["state"], "drifts", "{steps}");
    assert!(steps.get("steady").is_none() && number(&steps, "/last_m").abs() > 2.0 * 200e-9);
}

/// A body with an initial indentation of 50 µm is thrown off and makes no steps.
#[test]
fn what_flies_off_has_no_steps() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/thrown_off.json");
    let job = Job::prepare(&file, &[], Path::new("")).unwrap();
    let outcome = job.run(&());
    let summary = serde_json::to_value(Summary::new(&job, &outcome)).unwrap();
    assert_eq!(summary["steps"]["settling"]["state"], "drifts");
    let flight = |it: &&Value| it["kind"] == "flight";
    assert!(summary["warnings"].as_array().unwrap().iter().any(|it| flight(&it)), "{}", summary["warnings"]);
    // At rest on its foot, no such state is reported.
    let set =
        [("bodies.s", r#"{"mass": "20 g", "x": "free", "z": "free"}"#), ("run.start", "\"equilibrium\"")];
    let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let job = Job::prepare(&file, &set, Path::new("")).unwrap();
    let summary = serde_json::to_value(Summary::new(&job, &job.run(&()))).unwrap();
    assert!(!summary["warnings"].as_array().unwrap().iter().any(|it| flight(&it)), "{}", summary["warnings"]);
}

/// Without friction the slider slips all the time and does not follow its foot.
#[test]
fn a_contact_without_friction_slides() {
    let (steps, series) = account("without_friction", &[("run.cycles", "3")]);
    for way in ["forward", "return"] {
        let share = number(&steps, &format!("/last_period/contacts/c/slip_share_{way}"));
        near(share, 1.0, 1e-12, "slip");
    }
    assert!(series.column("c.state").iter().all(|state| *state == 3.0));
}

/// A body that follows a waveform makes no steps. A note states this if another body is free.
#[test]
fn the_body_of_figures_must_be_free() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/without_friction.json");
    let set = [("figures", r#"{"body": "foot", "waveform": "w"}"#), ("run.cycles", "2")];
    let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let job = Job::prepare(&file, &set, Path::new("")).unwrap();
    let summary = serde_json::to_value(Summary::new(&job, &job.run(&()))).unwrap();
    let notes = summary["notes"].to_string();
    assert!(
        summary.get("steps").is_none() && notes.contains("\\\"foot\\\", the body of figures, is not free"),
        "{notes}"
    );
}

/// After gross slip, the force of a flat punch returns to its limit at a reversal. By rounding alone this could count as slip.
///
/// The reference is Verlet's method with the slip states of all time steps of the last period.
#[test]
fn a_force_that_comes_back_to_its_limit_does_not_slip_until_the_next_event() {
    for friction in ["0.2", "0.20001", "0.1999", "0.2003"] {
        let set = [("contacts.c.friction", friction), ("figures.steady_motion", "false")];
        let (steps, _) = account("back_to_the_limit", &set);
        let verlet =
            [&set[..], &[("run.stepper", r#"{"verlet":{"step":"50 ns"}}"#), ("output.every", "50 ns")]]
                .concat();
        let (_, rows) = account("back_to_the_limit", &verlet);
        let range = rows.last_period(&steps);
        let (states, t) = (rows.column("c.state"), rows.column("time_s"));
        let (from, turn) = (t[range.start], 0.88e-3);
        let slips = |forth: bool| {
            let of = range.clone().filter(|i| (t[*i] - from < turn) == forth);
            let (all, slipping) =
                of.fold((0, 0), |(all, slipping), i| (all + 1, slipping + u32::from(states[i] == 3.0)));
            f64::from(slipping) / f64::from(all)
        };
        for (key, forth) in [("forward", true), ("return", false)] {
            let told = number(&steps, &format!("/last_period/contacts/c/slip_share_{key}"));
            near(told, slips(forth), 5e-3, &format!("{friction} {key}"));
        }
    }
}

/// A spring row slips as long as the exact memory curve.
#[test]
fn a_row_of_springs_slips_for_as_long_as_the_curve() {
    let engine = ("contacts.ball.engine", r#"{"springs":{"count":1001}}"#);
    let plain = [("figures.steady_motion", "false"), ("plots", "[]")];
    let [(curve, _), (row, _)] = [&plain[..], &[engine, plain[0], plain[1]]].map(|set| account("p1", set));
    for key in ["slip_share_forward", "slip_share_return"] {
        let of = |steps: &Value| number(steps, &format!("/last_period/contacts/ball/{key}"));
        assert!(of(&curve) > 0.9 || key == "slip_share_forward", "{}", of(&curve));
        near(of(&row), of(&curve), 5e-3, key);
    }
}

/// Without a step, the rising stroke of a sine is the forward stroke, whatever the rounding of the step.
#[test]
fn without_a_step_the_rising_way_is_forth() {
    for amplitude in ["0.4 um", "0.4000001 um", "0.401 um", "0.39 um"] {
        let (steps, _) = account("held_by_a_spring", &[("waveforms.drive.sine.amplitude", amplitude)]);
        let stroke = number(&steps, "/last_period/forward/stroke_m");
        assert!(stroke > 7e-7, "{amplitude}: {stroke:e}");
    }
}

/// Fixed time steps miss the ends of the flyback. Its duration is taken from the waveform.
#[test]
fn fixed_steps_know_how_long_a_flyback_takes() {
    let steppers = [
        r#"{"frames":{"length":"40 us"}}"#,
        r#"{"rk4":{"step":"3.7 us"}}"#,
        r#"{"verlet":{"step":"10 us"}}"#,
    ];
    for stepper in steppers {
        let (steps, _) = account("quickstart", &[("run.stepper", stepper), ("plots", "[]")]);
        near(number(&steps, "/last_period/return/time_s"), 10e-6, 1e-12, stepper);
        near(number(&steps, "/last_period/forward/time_s"), 9.99e-3, 1e-12, stepper);
        near(number(&steps, "/last_period/return/stroke_m"), -200e-9, 1e-18, stepper);
    }
}

/// Frames with an error of a thousandth of a stroke determine the step of 200 nm only to this accuracy.
#[test]
fn a_step_of_frames_is_not_told_more_exactly_than_they_promise() {
    let set = [
        ("run.stepper", r#"{"frames":{"length":"40 us"}}"#),
        ("plots", "[]"),
        ("figures.steady_motion", "false"),
    ];
    let (steps, _) = account("quickstart", &set);
    near(number(&steps, "/steady/error_m"), 0.2e-9, 1e-15, "error");
}
