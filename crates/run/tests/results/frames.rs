//! A run advanced in frames is the whole run: each frame cuts a step, and what that costs stays within ten tolerances.
//!
//! Compared are all places of bodies and contacts, x, z, u and d, in units of the smallest natural length u_c, on the rows of
//! sixteen common moments and at the end; frames are short and long against steps, and odd. P1 and the quick start leap, and
//! a leap that is cut stays under way: they are the same to the bit. The stage and the impact drive step, and what they lose
//! in each step adds up, framed or not: over a period or two, and an impact, frames take the run no more than ten tolerances
//! farther from one at 1e-12 than it is, over the whole of their scenarios no farther apart than ten times that distance, where it
//! is larger than the tolerance. (Ten tolerances would not hold there: 13.8 came of the stage at 1e-10, 93 of the impact drive,
//! whose whole run is 55 away from the exact one. From a whole run that is 11.8 away from it, as that of the impact at 1e-10, one
//! in frames may well be 14.1 away, and 2.3 from the exact one.)

use crate::shared::{Stage, verlet};
use stickslip_drive::{Accuracy, EventKind, Plan, Run, Stepper, Trace};

/// Lengths of frames, s.
const FRAMES: [f64; 5] = [1e-6, 20e-6, 500e-6, 3.7e-6, 91.3e-6];
/// Tolerances besides the scenario's own.
const TOLERANCES: [f64; 2] = [1e-3, 1e-10];
/// What stands in for the exact motion.
const EXACT: f64 = 1e-12;
/// What frames may cost, in tolerances.
const MOST: f64 = 10.0;

/// Whether a channel is a place, m.
fn is_place(name: &str) -> bool {
    [".x_m", ".z_m", ".u_m", ".d_m"].iter().any(|end| name.ends_with(end))
}

/// The run in frames, or whole.
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

/// Largest distance of all places on all rows that are at the same time, and at the end; in natural lengths.
fn apart(stage: &Stage, a: &Trace, b: &Trace) -> f64 {
    let model = &stage.job.model;
    let scales = (0..).map_while(|c| model.contact_natural(c)).map(|scale| scale.displacement);
    let unit = scales.fold(f64::INFINITY, f64::min);
    let channels = model.channels();
    let at = |trace: &Trace| -> Vec<Vec<f64>> {
        let mut rows: Vec<Vec<f64>> = trace.rows().map(<[f64]>::to_vec).collect();
        // Where frames end on the last row there may be two of it.
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

/// Compares all frames of one example, which ends at some time, s; whether errors that the motion multiplies are allowed for.
fn compare(name: &str, end: f64, is_long: bool) {
    let stage = Stage::example(name);
    let Accuracy::Tolerance(own) = stage.job.scenario.plan.stepper.accuracy() else { unreachable!() };
    let at = |tolerance, frame| rows(&stage, &stage.plan(Stepper::Event { tolerance }, end), frame);
    let exact = at(EXACT, None);
    for tolerance in [own, TOLERANCES[0], TOLERANCES[1]] {
        let whole = at(tolerance, None);
        let inherent = apart(&stage, &exact, &whole);
        // Over long, errors that the motion multiplies may take either run away from the exact one.
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

/// Cut leaps are the leaps themselves: no bit of a single slider's motion tells of frames.
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

/// Steps without located events notice them for whoever watches: one who begins to in the middle of a run sees the events from
/// there on, and no touch of what has been in contact all along.
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
