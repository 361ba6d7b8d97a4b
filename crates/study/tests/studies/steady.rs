//! Periodic orbits by shooting, compared with simulations.

use std::error::Error;
use std::path::Path;
use stickslip_drive::{Model, Plan, Run, State, Stepper};
use stickslip_run::Job;
use stickslip_study::steady::continuation::{Bifurcation, Continuation, Course};
use stickslip_study::steady::{self, Ending, Kind, Options, Steady, SteadyError, Way};

type Checked = Result<(), Box<dyn Error>>;

/// Tolerance of simulations, and default of the search.
const TOLERANCE: f64 = 1e-12;

fn job(name: &str, set: &[(&str, &str)]) -> Result<Job, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
    let set: Vec<(String, String)> =
        set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    Ok(Job::prepare(&file, &set, Path::new(""))?)
}

fn plan(job: &Job) -> Plan {
    plan_at(job, TOLERANCE)
}

fn plan_at(job: &Job, tolerance: f64) -> Plan {
    let stepper = Stepper::Event { tolerance };
    Plan { duration: f64::MAX, stepper, every: None, until_steady: None, ..job.scenario.plan }
}

fn x(model: &Model, state: &State, body: usize) -> Result<f64, Box<dyn Error>> {
    Ok(state.body(model, body).ok_or("a body")?.0)
}

/// Returns the mean of the last tenth of `periods` simulated step lengths, m. A single step of the walking drive has an error of 10⁻⁹ u_c.
fn last_steps(
    job: &Job,
    (plan, from): (&Plan, State),
    period: f64,
    periods: u32,
) -> Result<f64, Box<dyn Error>> {
    let model = &job.model;
    let body = job.scenario.figures.body.ok_or("a body")?;
    let start = from.time();
    let mut run = Run::new(model, plan, from)?;
    let end = |count: u32| start + f64::from(count) * period;
    let last = periods.div_ceil(10);
    run.advance(end(periods - last), &mut ())?;
    let before = x(model, run.state(), body)?;
    run.advance(end(periods), &mut ())?;
    Ok((x(model, run.state(), body)? - before) / f64::from(last))
}

/// Compares the orbit with a simulation from t = 0.
fn settles_on(name: &str, periods: u32) -> Checked {
    settles_on_with((name, &[]), periods, TOLERANCE)
}

fn settles_on_with((name, set): (&str, &[(&str, &str)]), periods: u32, tolerance: f64) -> Checked {
    let job = job(name, set)?;
    let found = steady::find(&job, &Options { tolerance, ..Options::default() })?;
    // The simulation uses the model of the scenario, not that of the search.
    let plan = plan_at(&job, tolerance);
    let waited = last_steps(&job, (&plan, job.model.start(&plan)?), found.period, periods)?;
    let off = (found.step.ok_or("a step")? - waited).abs() / job.contact_scale(0).0;
    // The edge at which damping is limited is not located, so that a step has an error of 10⁻⁹ u_c.
    let within = if (0..job.model.contacts().count()).any(|c| job.is_damped(c)) { 1e-9 } else { 1e-10 };
    assert!(off <= within, "{name}: {off:e} u_c");
    Ok(())
}

#[test]
fn p1_settles_on_the_step_after_ten_thousand_periods() -> Checked {
    settles_on("p1.json", 10_000)
}

#[test]
fn the_piezo_stack_settles_on_the_step() -> Checked {
    settles_on("piezo_stack.json", 1_000)
}

/// The slider moves along a damper to ground, which does not hold it at a position.
#[test]
fn a_slider_that_a_damper_brakes_settles_on_the_step() -> Checked {
    let brake = r#"{"between": ["ground", "slider"], "damping": "500 N s/m"}"#;
    settles_on_with(("quickstart.json", &[("loads", "[]"), ("springs.brake", brake)]), 100, TOLERANCE)
}

/// Bursts and sequences keep their pauses and runs when they are continued without end.
#[test]
fn bursts_and_sequences_settle_on_the_step() -> Checked {
    for (key, value) in [
        ("burst", r#"{"cycles": 3, "dwell": "20 ms"}"#),
        ("burst", r#"{"cycles": 2, "dwell": "3 ms"}"#),
        ("sequence", r#"[{"cycles": 2}]"#),
        ("sequence", r#"[{"cycles": 3}, {"cycles": 1, "reversed": true}]"#),
    ] {
        let key = format!("waveforms.drive.sawtooth.{key}");
        settles_on_with(("quickstart.json", &[(&key, value)]), 40, TOLERANCE)?;
    }
    Ok(())
}

/// Slightly above the zero-step stroke gross slip is short, and memory remains at every instant of the period. The
/// memory must drift with the slider.
#[test]
fn a_drive_whose_contact_never_forgets_settles_on_the_step() -> Checked {
    for stroke in ["49 nm", "49.5 nm", "50 nm"] {
        let set = [("waveforms.drive.sawtooth.stroke", &*format!("\"{stroke}\""))];
        let found = steady::find(&job("quickstart.json", &set)?, &Options::default())?;
        assert!(found.unknowns.iter().any(|unknown| unknown.contains("knot")), "{:?}", found.unknowns);
        settles_on_with(("quickstart.json", &set), 200, TOLERANCE)?;
    }
    Ok(())
}

/// Energies increase from period to period and are not part of the state.
#[test]
fn the_driven_stage_settles_on_the_step() -> Checked {
    settles_on("driven_stage.json", 200)
}

#[test]
fn other_drives_settle_on_the_step() -> Checked {
    for (name, periods) in [("quickstart.json", 60), ("ruby_drive.json", 60), ("sine_drive.json", 500)] {
        settles_on(name, periods)?;
    }
    // The simulation converges slowly, and a tolerance of 1e-12 is not sufficient.
    settles_on_with(("walking_drive.json", &[]), 1_000, 1e-13)?;
    // The slowest disturbance has decayed by 0.717³⁰⁰ = 5e-44.
    settles_on("three_ball_stage.json", 300)
}

/// Returns the sum of |x - x of the fixed point| over a window of simulated periods, m. Oscillations average out over
/// whole periods of the oscillation.
fn strayed(job: &Job, found: &Steady, z: usize, (first, count): (u32, u32)) -> Result<f64, Box<dyn Error>> {
    let section = stickslip_drive::section::Section::new(&found.model, found.state.clone());
    let numbers = section.unknowns().len();
    let mut by = vec![0.0; numbers];
    by[z] = 1e-6 * section.scales()[z];
    let mut state = section.moved(&found.state, &by).ok_or("a state beside")?;
    let mut sum = 0.0;
    for period in 0..first + count {
        let until = state.time() + found.period;
        let mut run = Run::new(&found.model, &plan(job), state)?;
        run.advance(until, &mut ())?;
        run.stop(&mut ());
        state = section.back(run.into_state()).0;
        if period >= first {
            let off = section.difference(&state, &found.state).ok_or("the same knots")?;
            sum += off[z].powi(2);
        }
    }
    Ok(sum.sqrt())
}

/// Over `beats` oscillations, a simulation that starts 1e-6 off grows or decays as the largest multiplier predicts, within 1 %.
fn turns_as_told(name: &str, stable: bool, beats: f64) -> Checked {
    turns_as_told_with((name, &[]), stable, beats)
}

fn turns_as_told_with((name, set): (&str, &[(&str, &str)]), stable: bool, beats: f64) -> Checked {
    let job = job(name, set)?;
    let found = steady::find(&job, &Options::default())?;
    let largest = found.multipliers.first().ok_or("a multiplier")?;
    assert_eq!((found.is_stable(), largest.kind() == Kind::Grows), (stable, !stable), "{name}");
    let window = (beats * largest.beat().ok_or("a beat")?).round() as u32;
    // The other disturbances have vanished by then.
    let (early, late) =
        (strayed(&job, &found, 0, (60, window))?, strayed(&job, &found, 0, (60 + window, window))?);
    let (measured, told) = ((late / early).ln() / f64::from(window), largest.modulus().ln());
    assert!((measured / told - 1.0).abs() < 1e-2, "{name}: {measured:e} a period, told {told:e}");
    Ok(())
}

#[test]
fn the_impact_drive_fades_as_its_multiplier_says() -> Checked {
    turns_as_told("impact_drive.json", true, 25.0)
}

#[test]
#[ignore = "takes long: .ci/full"]
fn the_climber_grows_as_its_multiplier_says() -> Checked {
    turns_as_told("vertical_climber.json", false, 40.0)
}

/// With more damping of the clamp, the growing oscillation becomes stable at the parameter that the branch gives.
/// Simulations on both sides grow and decay.
#[test]
fn the_climber_stops_growing_where_its_branch_says() -> Checked {
    let damping = "springs.clamp.damping";
    let of =
        Continuation::new(job("vertical_climber.json", &[(damping, "0.0103")])?, damping, [0.0102, 0.0107])?;
    let branch = of.follow(&Course { accuracy: 1e-6, ..Course::default() })?;
    let mut beats = branch.marks.iter().filter(|mark| matches!(mark.kind, Bifurcation::NeimarkSacker { .. }));
    let (Some(mark), None) = (beats.next(), beats.next()) else {
        return Err(format!("{:?}", branch.marks).into());
    };
    assert_eq!(mark.stable, [false, true]);
    for (share, stable) in [(0.5, false), (1.5, true)] {
        let value = format!("{:e}", share * mark.value);
        turns_as_told_with(("vertical_climber.json", &[(damping, &value)]), stable, 40.0)?;
    }
    Ok(())
}

/// Each Newton step leaves at most a tenth of the defect, below 10⁻⁴ and until the tolerance of the runs is reached.
fn falls_fast(name: &str) -> Checked {
    let job = job(name, &[])?;
    let options = Options { settling: 2, ..Options::default() };
    let found = steady::find(&job, &options)?;
    let told: Vec<String> =
        found.defects.iter().map(|defect| format!("{:.1e} {:?}", defect.size, defect.way)).collect();
    let steps = found.defects.windows(2).filter(|pair| pair[1].way == Way::Newton && pair[0].size < 1e-4);
    let sizes: Vec<[f64; 2]> = steps.map(|pair| [pair[0].size, pair[1].size]).collect();
    assert!(!sizes.is_empty(), "{name}: {told:?}");
    for [before, after] in sizes {
        assert!(after < 0.1 * before + 1e-11, "{name}: {told:?}");
    }
    let numbers = found.unknowns.len() as u32;
    assert!(found.work <= 8 * (numbers + 1), "{name}: {} periods for {numbers} numbers", found.work);
    Ok(())
}

#[test]
fn defects_fall_fast() -> Checked {
    ["piezo_stack.json", "three_ball_stage.json", "vertical_climber.json"]
        .into_iter()
        .try_for_each(falls_fast)
}

#[test]
fn what_has_no_period_or_is_commanded_is_refused() -> Checked {
    let refused = |name| Ok::<_, Box<dyn Error>>(steady::find(&job(name, &[])?, &Options::default()).err());
    assert_eq!(refused("bouncing_ball.json")?, Some(SteadyError::NoPeriod));
    assert_eq!(refused("commanded.json")?, Some(SteadyError::Commanded("drive".to_owned())));
    assert_eq!(refused("worn_ball.json")?, Some(SteadyError::NothingFree));
    Ok(())
}

/// A second waveform acts on the slider of P1, whose period is 1 ms.
fn pulled(period: &str) -> Result<Result<Steady, SteadyError>, Box<dyn Error>> {
    let hum = format!(r#"{{"sine":{{"amplitude":"1 mN","period":"{period}"}}}}"#);
    let set = [
        ("figures.waveform", "drive"),
        ("waveforms.hum", hum.as_str()),
        ("loads[+]", r#"{"on":"slider","x":{"follows":"hum"}}"#),
    ];
    Ok(steady::find(&job("p1.json", &set)?, &Options::default()))
}

#[test]
fn two_waveforms_have_a_period_in_common_or_are_refused() -> Checked {
    let found = pulled("0.75 ms")??;
    assert!((found.period - 3e-3).abs() < 1e-15, "{}", found.period);
    let refused = pulled("0.70710678 ms")?.err();
    assert!(matches!(refused, Some(SteadyError::Incommensurate { .. })), "{refused:?}");
    Ok(())
}

/// Two bodies are connected to each other only, and both fall.
#[test]
fn what_nothing_holds_is_refused_by_its_name() -> Checked {
    let set = [
        ("bodies.slider.z", "free"),
        ("bodies.other", r#"{"mass":"1 g","z":"free"}"#),
        ("springs.tie", r#"{"between":["slider","other"],"direction":"z","stiffness":"1 N/m"}"#),
    ];
    let refused = steady::find(&job("p1.json", &set)?, &Options::default()).err();
    let expected = SteadyError::Drifts { body: "slider".to_owned(), axis: "z" };
    assert_eq!(refused, Some(expected));
    Ok(())
}

/// A load lifts the slider, which rises without end. z is not a drift, because the contact could close again.
#[test]
fn a_slider_that_lifts_for_ever_has_no_steady_motion() -> Checked {
    let set = [
        ("bodies.slider.z", "free"),
        ("contacts.ball.normal", "coupled"),
        ("loads[+]", r#"{"on":"slider","z":"1 N"}"#),
    ];
    let options = Options { periods: 40, ..Options::default() };
    let refused = steady::find(&job("p1.json", &set)?, &options).err();
    assert!(matches!(refused, Some(SteadyError::NoConvergence { .. })), "{refused:?}");
    Ok(())
}

/// Every period adds the same amount to the slider; the search must end early.
fn gains(job: &Job) -> Checked {
    let told = std::cell::Cell::new(0);
    let count = |periods| told.set(periods);
    let refused = steady::find(job, &Options { told: &count, ..Options::default() }).err();
    let is_told = matches!(&refused, Some(SteadyError::Gains { number, .. }) if number.contains("slider"));
    assert!(is_told && told.get() < 400, "{refused:?} after {}", told.get());
    Ok(())
}

/// The load exceeds μF_N = 0.15 N: the velocity increases by the same amount in every period.
#[test]
fn a_slider_that_is_pulled_away_has_no_steady_motion() -> Checked {
    gains(&job("p1.json", &[("loads[+]", r#"{"on":"slider","x":"-0.2 N"}"#)])?)
}

/// Resonance of an undamped oscillator: x = (a/2)(sin ωt - ωt cos ωt) on a foot a sin ωt, ω = √(k/m). The amplitude
/// increases by the same amount in every period.
#[test]
fn a_swing_at_its_own_frequency_has_no_steady_motion() -> Checked {
    let frequency = format!("{:e}", (2e6_f64 / 0.02).sqrt() / std::f64::consts::TAU);
    let drive = format!(r#"{{"sine":{{"amplitude":"100 nm","frequency":{frequency}}}}}"#);
    let spring = r#"{"k":{"between":["foot","slider"],"stiffness":"2 N/um"}}"#;
    gains(&job(
        "p1.json",
        &[("waveforms.drive", &drive), ("contacts", "{}"), ("springs", spring), ("plots", "[]")],
    )?)
}

/// Contacts without gross slip are named: with the orbit of the vibrated slider, and in the error for a drive that only sticks.
#[test]
fn a_shakedown_is_named() -> Checked {
    let found = steady::find(&job("vibrated_slider.json", &[])?, &Options::default())?;
    // Rounding decides whether the memory is an unknown of the map. Stability is unknown in both cases.
    assert_eq!((found.shaken_down.len(), found.comes_back()), (1, None));
    let stuck = job("p1.json", &[("waveforms.drive", r#"{"triangle":{"stroke":"20 nm","period":"1 ms"}}"#)])?;
    let refused = steady::find(&stuck, &Options { periods: 60, ..Options::default() }).err();
    assert!(
        matches!(&refused, Some(SteadyError::Shakedown { contacts, .. }) if contacts == &["ball"]),
        "{refused:?}"
    );
    Ok(())
}

/// An undamped bounce preserves volume in the phase space of z (Liouville): its two multipliers have the product 1. If
/// a whole number of bounces takes one period, both are 1 within the square root of the error of the Jacobian.
#[test]
#[ignore = "takes long: .ci/full"]
fn a_body_that_bounces_by_itself_is_neither_stable_nor_not() -> Checked {
    let cone = r#"{"cone": {"slope": 0.01}}"#;
    let ball = r#"{"paraboloid": {"radius": "0.5 mm"}}"#;
    for (profile, start) in [(ball, "20 nm"), (ball, "-100 nm"), (cone, "-10 nm")] {
        let start = format!(r#"{{"z": "{start}"}}"#);
        let set = [
            ("bodies.slider.z", "free"),
            ("bodies.slider.start", &start),
            ("contacts.ball.normal", "coupled"),
            ("contacts.ball.profile", profile),
            ("loads", r#"[{"on": "slider", "z": "-0.3 N"}]"#),
        ];
        let job = job("ruby_drive.json", &set)?;
        for tolerance in [1e-12, 1e-10, 1e-9] {
            let found = steady::find(&job, &Options { tolerance, ..Options::default() })?;
            let told = format!("{profile}, {start}, {tolerance}: {:?}", found.multipliers);
            assert!(found.multipliers.iter().all(|one| one.kind() != Kind::Grows), "{told}");
            assert_eq!(found.comes_back(), None, "{told}");
            let [first, second] = [found.multipliers[0], found.multipliers[1]];
            let other = if first.im > 0.0 { first } else { second };
            let product = first.modulus() * other.modulus();
            assert!((product - 1.0).abs() <= 2.0 * first.error, "{told}");
        }
    }
    Ok(())
}

/// A contact is damped along x but not along z, where two Hertzian contacts bear a constant load: λ = exp(±iωT) with
/// mω² = 2 · 2E*√(Rd). Differences are one-sided, because a lifted body reaches another contact first. Second-order
/// differences are
/// necessary to obtain |λ| = 1.
#[test]
fn what_nothing_damps_stays_by_differences_to_one_side() -> Checked {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenes/damped_along_x.json");
    let job = Job::prepare(&file, &[], Path::new(""))?;
    let (modulus, radius) = (210e9 / (2.0 * (1.0 - 0.3 * 0.3)), 0.5e-3_f64);
    let (load, mass, period) = (1.2483566605584056 / 2.0, 0.09976172515042198, 0.00016197108713516606);
    let depth = (0.75 * load / (modulus * radius.sqrt())).powf(2.0 / 3.0);
    let turn = (4.0 * modulus * (radius * depth).sqrt() / mass).sqrt() * period;
    for tolerance in [1e-13, 1e-12, 1e-9] {
        let found = steady::find(&job, &Options { tolerance, ..Options::default() })?;
        let first = found.multipliers[0];
        let told = format!("{tolerance}: {:?}, {}", found.multipliers, turn.cos());
        assert!((first.modulus() - 1.0).abs() < 1e-8 && first.kind() == Kind::Stays, "{told}");
        assert!((first.re - turn.cos()).abs() < 1e-6, "{told}");
    }
    Ok(())
}

/// Some differences are one-sided and do not show curvature. A multiplier of five must still be classified as growing.
#[test]
fn a_slider_that_is_thrown_up_leaves_its_motion() -> Checked {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenes/thrown_slider.json");
    let job = Job::prepare(&file, &[], Path::new(""))?;
    for tolerance in [1e-12, 1e-9] {
        let found = steady::find(&job, &Options { tolerance, ..Options::default() })?;
        let kinds: Vec<Kind> = found.multipliers.iter().map(|one| one.kind()).collect();
        assert_eq!(kinds, [Kind::Grows, Kind::Fades, Kind::Fades], "{tolerance}: {:?}", found.multipliers);
    }
    Ok(())
}

#[test]
fn too_few_periods_are_told_with_the_best_defect() -> Checked {
    let options = Options { periods: 1, ..Options::default() };
    let refused = steady::find(&job("impact_drive.json", &[])?, &options).err();
    assert!(matches!(refused, Some(SteadyError::NoConvergence { best, .. }) if best.is_finite()));
    Ok(())
}

#[test]
fn a_search_can_be_interrupted() -> Checked {
    let options = Options { goes_on: &|| false, ..Options::default() };
    let refused = steady::find(&job("p1.json", &[])?, &options).err();
    assert!(matches!(refused, Some(SteadyError::Interrupted(_))), "{refused:?}");
    Ok(())
}

/// Contacts without gross slip whose memory is not an unknown of the map: a flat end with an undamped oscillation, |λ| = 1, and a contact
/// with oscillating normal force. Stability is reported as unknown, and the step length is within its error.
#[test]
fn of_what_holds_and_is_led_along_nothing_is_claimed() -> Checked {
    for name in ["flat_end", "pressed_glass"] {
        let job = job(&format!("../crates/study/tests/scenes/{name}.json"), &[])?;
        let found = steady::find(&job, &Options::default())?;
        assert_eq!(found.named(&found.holding()), ["ball"], "{name}");
        assert_eq!((found.comes_back(), found.multipliers.len()), (None, 0), "{name}");
        if name == "pressed_glass" {
            let plan = plan_at(&job, 1e-11);
            let plain = last_steps(&job, (&plan, job.model.start(&plan)?), found.period, 1000)?;
            let step = found.step.ok_or("a step")?;
            assert!(
                plain.abs() < 1e-16 && (step - plain).abs() <= found.bound,
                "{step:e} {plain:e} {}",
                found.bound
            );
        }
    }
    Ok(())
}

/// There are two final motions, and rounding decides between them. Simulations end on steps of -16.827 and 203.098 nm alternately, or on
/// five steps of 408.302, -171.837, 275.318, 168.479 and 83.333 nm. During the approach an oscillation decays, which nearly repeats every
/// few dozen periods.
#[test]
#[ignore = "takes long: .ci/full"]
fn the_climber_ends_where_plain_runs_do() -> Checked {
    let job = job("vertical_climber.json", &[])?;
    let found = steady::find(&job, &Options::default())?;
    let ends = found.aftermath(&job, &Options::default())?.ok_or("an end")?;
    let steps: &[f64] = match ends.ending {
        Ending::Repeats(2) => &[-16.827, 203.098],
        Ending::Repeats(5) => &[-171.837, 408.302, 275.318, 168.479, 83.333],
        _ => panic!("{:?}: {}", ends.ending, ends.words()),
    };
    let expected = [steps.iter().sum::<f64>() / steps.len() as f64, steps[0], steps[1]];
    for (got, expected) in ends.range().ok_or("steps")?.iter().zip(expected) {
        assert!((got * 1e9 - expected).abs() < 2e-3, "{got:e} {expected}: {}", ends.words());
    }
    Ok(())
}
