//! Runs that a caller advances in frames, saves and resumes.
//!
//! Results equal those of an uninterrupted run: with identical bits where no step was cut, otherwise within the tolerance.

use crate::chains::chain;
use crate::lottery::{Draw, deal, on_rows};
use crate::parts::{
    FOOT_SLIDER, contact, damped, damper, event, foot_and_slider, named, p1, plan, push, wave,
};
use crate::soak::pressed;
use std::f64::consts::TAU;
use stickslip_contact::Profile;
use stickslip_drive::scene::{Normal, Scene, Side, Varying};
use stickslip_drive::{
    BytesError, Limits, Model, Plan, Run, RunError, Shape, State, Stepper, Timing, Trace, UntilSteady,
    Waveform, run,
};

const PERIOD: f64 = 1e-3;
const KEY: [u8; 32] = [7; 32];

/// Random models with both engines, and P1, with the period of their drive, s.
fn scenes() -> Vec<(Scene, f64, String)> {
    let drawn = (0..24).map(deal).flat_map(|drawn| {
        let rows = on_rows(&drawn.scene, 24);
        [(drawn.scene, drawn.period, drawn.title.clone()), (rows, drawn.period, drawn.title + ", rows")]
    });
    let begun_badly = (0..24).map(|seed| {
        let (scene, period) = pressed(seed);
        (scene, period, format!("pressed {seed}"))
    });
    // Events accumulate in the last one, so it is also interrupted during step doubling.
    let sawtooth = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 };
    let others = [
        (p1(), PERIOD, "P1".to_owned()),
        (dragged_back(), 7.8e-3, "dragged back".to_owned()),
        (chain(sawtooth, 6), PERIOD, "chain".to_owned()),
    ];
    drawn.chain(begun_badly).chain(others).collect()
}

/// Damped flat punch under a falling load: from 7.88 ms stick and slip alternate.
fn dragged_back() -> Scene {
    let table = |name: &str, points: &[(f64, f64)]| {
        let shape = Shape::Table { points: points.to_vec() };
        named(name, Waveform::new(shape, Timing::every(0.01)).unwrap())
    };
    let mut punch = damped(&contact(FOOT_SLIDER, Profile::flat(1e-5).unwrap(), 0.2, 1.0), 5e-6);
    punch.normal = Normal::Force(Varying::Follows(1));
    let way = table("way", &[(0.0, 0.0), (1e-3, 1e-6), (1.2e-3, 9.99e-7), (0.01, -3e-6)]);
    let mut scene = foot_and_slider(way, 1e-6, punch);
    scene.waveforms.push(table("load", &[(0.0, 2.0), (1e-3, 2.0), (0.01, 0.02)]));
    let mut spring = damper([Side::Ground, Side::Body(1)], 0.0);
    spring.stiffness = 5e4;
    scene.springs.push(named("spring", spring));
    scene
}

fn steppers(period: f64) -> [Stepper; 5] {
    [
        Stepper::Event { tolerance: 1e-4 },
        Stepper::Event { tolerance: 1e-8 },
        Stepper::Verlet { step: 1e-3 * period },
        Stepper::Rk4 { step: 1e-3 * period },
        Stepper::Frames { length: 7e-3 * period, accuracy: 1e-3 },
    ]
}

/// Final state and trace of a run, interrupted or not. None if a fixed step is too long.
pub(crate) fn finished(model: &Model, plan: &Plan, state: State, resumed: bool) -> Option<(State, Trace)> {
    let make = if resumed { Run::resume } else { Run::new };
    let mut run = make(model, plan, state).ok()?;
    let mut trace = Trace::new(model);
    let outcome = run.finish(&mut trace);
    assert!(!matches!(outcome, Err(RunError::StepTooSmall { .. })), "{outcome:?}");
    Some((run.into_state(), trace))
}

/// A run interrupted after any number of attempts continues with the same bits.
#[test]
fn a_run_taken_up_anywhere_goes_on_to_the_same_bits() {
    let mut taken = 0;
    for (scene, period, title) in scenes() {
        let Ok(model) = Model::new(&scene) else { continue };
        for stepper in steppers(period) {
            let whole = Plan { every: Some(0.037 * period), ..plan(stepper, 1.3 * period) };
            let Ok(start) = model.start(&whole) else { continue };
            let Some((end, rows)) = finished(&model, &whole, start.clone(), false) else { continue };
            let bytes = end.to_bytes(&model, &KEY);
            assert!(State::from_bytes(&model, &KEY, &bytes).unwrap() == end, "{title} {stepper:?}: its end");
            let mut draw = Draw::new(taken);
            for _ in 0..6 {
                let steps = (draw.bits() % (end.counts().steps + end.counts().rejected).max(2)).max(1);
                let short = Plan { limits: Limits { steps, ..Limits::default() }, ..whole };
                let (mut first, mut before) =
                    (Run::new(&model, &short, start.clone()).unwrap(), Trace::new(&model));
                if !matches!(first.approach(&mut before), Err(RunError::TooManySteps { .. })) {
                    continue;
                }
                let bytes = first.state().to_bytes(&model, &KEY);
                let state = State::from_bytes(&model, &KEY, &bytes).unwrap();
                assert!(&state == first.state(), "{title} {stepper:?} at {steps}: bytes");
                assert_eq!(state.to_bytes(&model, &KEY), bytes);
                let (other, after) = finished(&model, &whole, state, true).unwrap();
                assert!(
                    other == end,
                    "{title} {stepper:?} at {steps}\n{:?}\n{:?}",
                    other.counts(),
                    end.counts()
                );
                let joined: Vec<&[f64]> = before.rows().chain(after.rows()).collect();
                assert!(joined == rows.rows().collect::<Vec<_>>(), "{title} {stepper:?} at {steps}: rows");
                let joined: Vec<_> = before.events().chain(after.events()).collect();
                assert!(
                    joined == rows.events().collect::<Vec<_>>(),
                    "{title} {stepper:?} at {steps}: events"
                );
                taken += 1;
            }
        }
    }
    println!("{taken} runs taken up");
    assert!(taken > 1000, "{taken}");
}

/// A run to half its end, resumed before its last step, equals the whole run; rows do not depend on the end.
#[test]
fn no_number_depends_on_the_end() {
    for (scene, period, title) in scenes() {
        let Ok(model) = Model::new(&scene) else { continue };
        for stepper in steppers(period) {
            let every = Some(0.037 * period);
            let [half, whole] = [0.61, 1.3].map(|share| Plan { every, ..plan(stepper, share * period) });
            let Ok(start) = model.start(&whole) else { continue };
            let Some((end, rows)) = finished(&model, &whole, start.clone(), false) else { continue };
            let (mut first, mut before) =
                (Run::new(&model, &half, start.clone()).unwrap(), Trace::new(&model));
            if first.approach(&mut before).is_err() {
                continue;
            }
            let state = first.state().clone();
            let (on, after) = finished(&model, &whole, state, true).unwrap();
            assert!(on == end, "{title} {stepper:?}");
            let joined: Vec<&[f64]> = before.rows().chain(after.rows()).collect();
            assert!(joined == rows.rows().collect::<Vec<_>>(), "{title} {stepper:?}");
            // The first half alone; its last row is not on the grid of the whole run.
            let (_, alone) = finished(&model, &half, start, false).unwrap();
            let shared = alone.rows().len() - 1;
            assert!(alone.rows().take(shared).eq(rows.rows().take(shared)), "{title} {stepper:?}");
            first.finish(&mut before).unwrap();
            assert!(before.rows().eq(alone.rows()), "{title} {stepper:?}");
        }
    }
}

/// With an early end, a resumed run ends with the same period.
#[test]
fn an_early_end_is_found_again() {
    let frames = Stepper::Frames { length: 20e-6, accuracy: 1e-3 };
    let [verlet, rk4] = [Stepper::Verlet { step: 1e-6 }, Stepper::Rk4 { step: 1e-6 }];
    for stepper in [Stepper::Event { tolerance: 1e-8 }, verlet, rk4, frames] {
        ends_again(&p1(), stepper, 1e-4);
    }
    // Contacts reverse or begin gross slip in some of the last steps.
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    for part in 0..32 {
        let shape = Shape::Sine { amplitude: 1e-6, phase: TAU * f64::from(part) / 32.0, offset: 0.0 };
        let scene = foot_and_slider(wave("drive", shape, PERIOD), 0.02, ball.clone());
        let scene = Scene { loads: vec![push(1, -0.05)], ..scene };
        for stepper in [Stepper::Verlet { step: 7e-6 }, Stepper::Rk4 { step: 31e-6 }, frames] {
            ends_again(&scene, stepper, 1e-2);
        }
    }
}

fn ends_again(scene: &Scene, stepper: Stepper, change: f64) {
    let model = Model::new(scene).unwrap();
    let steady = Some(UntilSteady { waveform: 0, body: 1, change });
    let asked = Plan { until_steady: steady, ..plan(stepper, 1000.0 * PERIOD) };
    let start = model.start(&asked).unwrap();
    let (end, _) = finished(&model, &asked, start.clone(), false).unwrap();
    let mut first = Run::new(&model, &asked, start).unwrap();
    first.approach(&mut ()).unwrap();
    let (before, last) = (first.state().time(), end.time());
    assert!(before < last && last < 100.0 * PERIOD, "{stepper:?}: {before} {last}");
    let (on, _) = finished(&model, &asked, first.state().clone(), true).unwrap();
    assert!(on == end, "{stepper:?} {} {}", on.time(), end.time());
}

/// Frames cut steps within the tolerance; closed-form intervals of P1 continue with the same bits.
#[test]
fn frames_are_the_whole_run() {
    for frame in [1.7e-6, 20e-6, 137e-6] {
        let model = Model::new(&p1()).unwrap();
        let whole = event(1e-8, 5.0 * PERIOD);
        let (mut once, mut frames) =
            (model.start(&whole).unwrap(), Run::new(&model, &whole, model.start(&whole).unwrap()).unwrap());
        run(&model, &whole, &mut once, &mut ()).unwrap();
        let mut k = 0.0_f64;
        while frames.state().time() < 5.0 * PERIOD {
            k += 1.0;
            frames.advance((k * frame).min(5.0 * PERIOD), &mut ()).unwrap();
            // A copy of the state may replace the run.
            if k % 50.0 == 0.0 {
                let state = frames.state().clone();
                assert!(State::from_bytes(&model, &KEY, &state.to_bytes(&model, &KEY)).unwrap() == state);
                frames = Run::resume(&model, &whole, state).unwrap();
            }
        }
        assert_eq!(frames.state().body(&model, 1), once.body(&model, 1), "{frame:e}");
        assert_eq!(frames.state().counts().events, once.counts().events);
    }
}

/// Random models with steps: within ten tolerances of their natural length, unless the motion amplifies errors.
#[test]
fn frames_of_steps_keep_the_tolerance() {
    for seed in 0..24 {
        let drawn = deal(seed);
        let Ok(model) = Model::new(&drawn.scene) else { continue };
        let end = 1.1 * drawn.period;
        let at = |tolerance: f64, frame: f64| {
            let plan = event(tolerance, end);
            let mut run = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
            let mut t = 0.0;
            while t < end {
                t = (t + frame).min(end);
                run.advance(t, &mut ()).unwrap();
            }
            (0..drawn.scene.bodies.len())
                .filter_map(|i| run.state().body(&model, i))
                .map(|b| b.0)
                .collect::<Vec<f64>>()
        };
        let (exact, whole) = (at(1e-11, end), at(1e-8, end));
        let unit = model.contact_natural(0).unwrap().displacement;
        let off = |other: &[f64]| {
            exact.iter().zip(other).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs() / unit))
        };
        for frame in [0.013, 0.11] {
            let frames = off(&at(1e-8, frame * drawn.period));
            assert!(frames <= 10.0 * off(&whole).max(1e-8), "{seed}: {frames:e}, whole {:e}", off(&whole));
        }
    }
}

/// Rows and events do not affect the state: it has the same bits with or without a record.
#[test]
fn who_watches_frames_changes_no_bit() {
    let mut compared = 0;
    for (scene, period, title) in scenes() {
        let Ok(model) = Model::new(&scene) else { continue };
        let stepper = Stepper::Frames { length: 7e-3 * period, accuracy: 1e-3 };
        let seen = Plan { every: Some(0.037 * period), ..plan(stepper, 1.3 * period) };
        let unseen = Plan { every: None, ..seen };
        let Ok(start) = model.start(&seen) else { continue };
        let Ok(mut watched) = Run::new(&model, &seen, start.clone()) else { continue };
        let mut alone = Run::new(&model, &unseen, start).unwrap();
        let mut trace = Trace::new(&model);
        for k in 1..=150 {
            let t = f64::from(k) * 7e-3 * period;
            let reached = watched.advance(t, &mut trace);
            assert_eq!(reached.is_ok(), alone.advance(t, &mut ()).is_ok(), "{title}");
            if reached.is_err() {
                break;
            }
            let bytes = |run: &Run<'_>| run.state().to_bytes(&model, &KEY);
            assert!(bytes(&watched) == bytes(&alone), "{title}: frame {k}");
            compared += 1;
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// Frames that end at corners give the bits of the whole run, although their times are rounded differently.
#[test]
fn frames_that_end_at_corners_are_the_whole_run() {
    let model = Model::new(&p1()).unwrap();
    for length in [20e-6, 50e-6, 100e-6] {
        let plan = plan(Stepper::Frames { length, accuracy: 1e-3 }, 1.0);
        let [mut whole, mut frames] =
            [(); 2].map(|()| Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap());
        let last = (20e-3 / length).round() as i32;
        for k in 1..=last {
            frames.advance(f64::from(k) * length, &mut ()).unwrap();
        }
        whole.advance(f64::from(last) * length, &mut ()).unwrap();
        let bytes = |run: &Run<'_>| run.state().to_bytes(&model, &KEY);
        assert_eq!(whole.state().body(&model, 1), frames.state().body(&model, 1), "{length}");
        assert!(bytes(&whole) == bytes(&frames), "{length}");
    }
}

/// After two seconds rounding of time exceeds 1e-9 of a step; frames still have their exact number of steps.
#[test]
fn frames_far_from_the_start_take_their_own_steps() {
    let (model, length) = (Model::new(&p1()).unwrap(), 1e-6);
    let accuracy = (1..).map(|k| 1e-3 / f64::from(k)).find(|a| model.substeps(length, *a) == 5.0).unwrap();
    let plan = plan(Stepper::Frames { length, accuracy }, 3.0);
    let mut run = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    run.advance(2.0, &mut ()).unwrap();
    let before = run.state().counts().steps;
    for k in 2_000_001..=2_001_000 {
        run.advance(f64::from(k) * length, &mut ()).unwrap();
    }
    let steps = run.state().counts().steps - before;
    // Two corners in a thousand frames, and ends of some branches.
    assert!((5000..5100).contains(&steps), "{steps}");
}

/// Damaged bytes give an error or the same state, never a panic.
#[test]
fn damaged_bytes_are_refused() {
    let (mut draw, mut refused) = (Draw::new(5), 0);
    for seed in 0..8 {
        let drawn = deal(seed);
        let Ok(model) = Model::new(&drawn.scene) else { continue };
        let plan = event(1e-6, drawn.period);
        let mut run = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
        run.advance(0.43 * drawn.period, &mut ()).unwrap();
        let whole = run.state().to_bytes(&model, &KEY);
        assert_eq!(State::from_bytes(&model, &[8; 32], &whole).err(), Some(BytesError::OtherModel));
        assert_eq!(State::from_bytes(&model, &KEY, b"solid stickslip").err(), Some(BytesError::Foreign));
        for _ in 0..2500 {
            let mut bytes = whole.clone();
            let place = draw.bits() as usize % bytes.len();
            match draw.bits() % 3 {
                0 => bytes.truncate(place),
                1 => bytes[place] ^= 1 << (draw.bits() % 8),
                _ => bytes.extend([0; 8].iter().take(1 + place % 8)),
            }
            assert!(State::from_bytes(&model, &KEY, &bytes).is_err());
            // With a corrected checksum only the words can show the damage.
            let mut forged = whole.clone();
            for _ in 0..=draw.bits() % 4 {
                let word = 7 + draw.bits() as usize % (forged.len() / 8 - 8);
                let value = if draw.bits() & 1 == 0 { draw.bits() } else { draw.bits() % 5 };
                forged[8 * word..8 * word + 8].copy_from_slice(&value.to_le_bytes());
            }
            let end = forged.len() - 8;
            let sum = u64::from(crc32fast::hash(&forged[..end]));
            forged[end..].copy_from_slice(&sum.to_le_bytes());
            refused += 1 + u32::from(State::from_bytes(&model, &KEY, &forged).is_err());
        }
    }
    println!("{refused} refused");
}
