//! A run advanced in frames agrees with an uninterrupted run. Each frame end cuts a time step, which may cost up to ten tolerances.
//!
//! All positions x, z, u and d at sixteen common times and at the end are compared, in units of the smallest u_c. P1 and the quickstart use
//! closed-form leaps and are identical. The stage and the impact drive use time steps, whose errors add up. Over a period or two, frames
//! may increase the distance from a run at 1e-12 by ten tolerances. Over the whole scenario, the allowed distance is ten times that of the
//! uninterrupted run.

use crate::shared::{Stage, frames, rk4, verlet};
use std::collections::BTreeMap;
use stickslip_drive::{Accuracy, EventKind, Plan, Run, Stepper, Trace};

/// Frame lengths, s.
const FRAMES: [f64; 5] = [1e-6, 20e-6, 500e-6, 3.7e-6, 91.3e-6];
/// Tolerances in addition to that of the scenario.
const TOLERANCES: [f64; 2] = [1e-3, 1e-10];
/// Tolerance of the reference.
const EXACT: f64 = 1e-12;
/// Allowed error of frames, in tolerances.
const MOST: f64 = 10.0;

/// Returns whether a channel is a position, m.
fn is_place(name: &str) -> bool {
    [".x_m", ".z_m", ".u_m", ".d_m"].iter().any(|end| name.ends_with(end))
}

/// Runs in frames, or uninterrupted.
fn rows(stage: &Stage, plan: &Plan, frame: Option<f64>) -> Trace {
    let model = &stage.job.model;
    let (mut run, mut trace) =
        (Run::new(model, plan, stage.start(plan).unwrap()).unwrap(), Trace::new(model));
    let Some(frame) = frame else {
        run.finish(&mut trace).unwrap();
        return trace;
    };
    let mut k = 0.0;
    while run.state().time() < plan.duration {
        k += 1.0;
        run.advance(plan.duration.min(k * frame), &mut trace).unwrap();
    }
    run.stop(&mut trace);
    trace
}

/// Returns the largest distance of all positions in rows at equal times and at the end, in natural lengths.
fn apart(stage: &Stage, a: &Trace, b: &Trace) -> f64 {
    let model = &stage.job.model;
    let scales = (0..).map_while(|c| model.contact_natural(c)).map(|scale| scale.displacement);
    let unit = scales.fold(f64::INFINITY, f64::min);
    let channels = model.channels();
    let at = |trace: &Trace| -> Vec<Vec<f64>> {
        let mut rows: Vec<Vec<f64>> = trace.rows().map(<[f64]>::to_vec).collect();
        // If frames end at the last row, it may occur twice.
        rows.dedup_by(|a, b| a[0] == b[0]);
        rows
    };
    let (a, b) = (at(a), at(b));
    assert_eq!(a.len(), b.len());
    let mut most = 0.0_f64;
    for (a, b) in a.iter().zip(&b) {
        assert_eq!(a[0], b[0]);
        let places = channels.iter().zip(a.iter().zip(b)).filter(|(channel, _)| is_place(&channel.name));
        most = places.fold(most, |most, (_, (a, b))| most.max((a - b).abs() / unit));
    }
    most
}

/// Compares all frame lengths of an example up to a time, s. `is_long` allows for errors that the motion amplifies.
fn compare(name: &str, end: f64, is_long: bool) {
    let stage = Stage::example(name);
    let Accuracy::Tolerance(own) = stage.job.scenario.plan.stepper.accuracy() else { unreachable!() };
    let at = |tolerance, frame| rows(&stage, &stage.plan(Stepper::Event { tolerance }, end), frame);
    let exact = at(EXACT, None);
    for tolerance in [own, TOLERANCES[0], TOLERANCES[1]] {
        let whole = at(tolerance, None);
        let inherent = apart(&stage, &exact, &whole);
        // Over long times, errors that the motion amplifies may move either run away from the exact one.
        let (from, allowed) = if is_long {
            (&whole, MOST * tolerance.max(inherent))
        } else {
            (&exact, inherent + MOST * tolerance)
        };
        let off = FRAMES.map(|frame| apart(&stage, from, &at(tolerance, Some(frame))));
        let told = off.map(|off| format!("{:.3}", off / tolerance)).join(" | ");
        println!("| {name} | {:.1} | {tolerance:e} | {:.3} | {told} |", 1e3 * end, inherent / tolerance);
        let worst = off.into_iter().fold(0.0, f64::max);
        assert!(worst <= allowed, "{name} at {tolerance:e}: {off:?}, inherent {inherent:e}");
    }
}

#[test]
fn frames_are_the_whole_run() {
    println!(
        "In tolerances, by the length of a frame in us; from the exact run, over long from the whole run:"
    );
    let frames = FRAMES.map(|frame| format!("{:.1}", 1e6 * frame)).join(" | ");
    println!("| drive | ms | tolerance | from the exact run | {frames} |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for (name, short) in
        [("three_ball_stage.json", 3e-3), ("impact_drive.json", 4.1e-3), ("oblique_impact.json", 150e-6)]
    {
        compare(name, short, false);
    }
    for (name, long) in [("three_ball_stage.json", 20e-3), ("impact_drive.json", 40e-3)] {
        compare(name, long, true);
    }
    for (name, long) in [("p1.json", 20e-3), ("quickstart.json", 100e-3)] {
        compare(name, long, false);
    }
}

/// Closed-form leaps that are cut remain identical, so the motion of a single slider does not depend on frames.
#[test]
fn cut_leaps_are_whole_leaps() {
    for name in ["p1.json", "quickstart.json"] {
        let stage = Stage::example(name);
        for tolerance in TOLERANCES {
            let plan = stage.plan(Stepper::Event { tolerance }, 0.2 * stage.job.scenario.plan.duration);
            let whole = rows(&stage, &plan, None);
            for frame in FRAMES {
                let off = apart(&stage, &whole, &rows(&stage, &plan, Some(frame)));
                assert_eq!(off, 0.0, "{name} at {tolerance:e} in {frame:e} s");
            }
        }
    }
}

/// Fixed time steps detect events only for an observer. One that starts within a run receives the events from then on, and no touch of
/// contacts that were closed before.
#[test]
fn who_watches_late_sees_what_happens_from_there_on() {
    let stage = Stage::example("p1.json");
    let (model, plan) = (&stage.job.model, stage.plan(stage.step(0.3, verlet).unwrap(), 4e-3));
    let after = |trace: &Trace, t: f64| -> Vec<(f64, EventKind)> {
        trace.events().map(|(event, _)| (event.t, event.kind)).filter(|(at, _)| *at > t).collect()
    };
    let mut run = Run::new(model, &plan, stage.start(&plan).unwrap()).unwrap();
    let (mut always, mut late) = (Trace::new(model), Trace::new(model));
    [0.77e-3, 4e-3].into_iter().for_each(|t| run.advance(t, &mut always).unwrap());
    let mut run = Run::new(model, &plan, stage.start(&plan).unwrap()).unwrap();
    run.advance(0.77e-3, &mut ()).unwrap();
    run.advance(4e-3, &mut late).unwrap();
    assert!(after(&always, 0.77e-3).len() > 10, "{:?}", after(&always, 0.0));
    assert_eq!(after(&late, 0.0), after(&always, 0.77e-3));
}

/// Methods with a fixed time step report as many events of each contact and driver as `event` locates. They report no corners and closed
/// loops.
#[test]
fn fixed_steps_report_what_is_located() {
    for name in ["driven_stage.json", "vibrated_slider.json", "p1.json"] {
        let stage = Stage::example(name);
        let counts = |stepper: Stepper| {
            let trace = rows(&stage, &stage.plan(stepper, stage.job.scenario.plan.duration), None);
            let silent = [EventKind::Corner, EventKind::LoopClosed];
            let told = trace.events().map(|(event, _)| (format!("{:?}", event.source), event.kind));
            let mut counts = BTreeMap::new();
            told.filter(|(_, kind)| !silent.contains(kind))
                .for_each(|(source, kind)| *counts.entry((source, format!("{kind:?}"))).or_insert(0) += 1);
            counts
        };
        let located = counts(Stepper::Event { tolerance: 1e-8 });
        assert!(located.values().sum::<i32>() > 50, "{name}: {located:?}");
        for stepper in [rk4(1e-6), verlet(1e-6), frames(20e-6)] {
            assert_eq!(counts(stepper), located, "{name} {stepper:?}");
        }
    }
}
