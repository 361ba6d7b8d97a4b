//! Samples of contact memories: times and values.

use crate::lottery::{deal, on_rows};
use crate::parts::{Looker, channel, contact, event, follower, look, named, p1, plan, wave};
use std::f64::consts::PI;
use stickslip_contact::{Memory, Profile, SpringState, Springs};
use stickslip_drive::scene::{Normal, Scene, Side, Varying};
use stickslip_drive::{Due, Entry, Model, Moments, Plan, Record, Shape, Stepper, run};

const PERIOD: f64 = 1e-3;

/// Foot that follows `shape` on the ground; no coordinate is free.
fn rig(shape: Shape) -> Scene {
    let between = [Side::Body(0), Side::Ground];
    Scene {
        waveforms: vec![wave("drive", shape, PERIOD)],
        bodies: vec![named("foot", follower(0))],
        contacts: vec![named("ball", contact(between, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0))],
        ..Scene::default()
    }
}

/// The same with a load that starts at zero, separates the bodies and closes the contact again, at other times than the foot's reversals.
fn pounding_rig() -> Scene {
    let mut scene = rig(Shape::Sine { amplitude: 80e-9, phase: 0.0, offset: 0.0 });
    let depth = Shape::Sine { amplitude: 1e-6, phase: -0.5 * PI, offset: 0.6e-6 };
    scene.waveforms.push(wave("depth", depth, 0.7 * PERIOD));
    scene.contacts[0].part.normal = Normal::Indentation(Varying::Follows(1));
    scene
}

#[test]
fn a_contact_under_constant_load_is_the_closed_form_at_every_look() {
    // First loading to u: p = 0 up to h = d-u/κ, then the edge u-κ(d-h). Back from u₁ to u: the new edge u+κ(d-h) meets the old
    // one at d-h = (u₁-u)/2κ.
    let stroke = 50e-9;
    let scene = rig(Shape::Triangle { stroke });
    let plan = event(1e-10, PERIOD);
    let times = vec![0.0, 0.07e-3, 0.11e-3, 0.3001e-3, 0.5e-3, 0.51e-3, 0.77e-3, 0.9e-3];
    let (model, _, looker) = look(&scene, &plan, Moments::At(times.clone()));
    let law = model.contacts().next().unwrap().1;
    let (u_c, _) = model.contact_scale(0).unwrap();
    let (d, slope) = (u_c / law.stick_slope(), law.stick_slope());
    assert!(stroke < u_c);
    assert_eq!(looker.seen.iter().map(|(t, _)| *t).collect::<Vec<_>>(), times);
    for (t, memories) in &looker.seen {
        let u = stroke * (1.0 - (2.0 * t / PERIOD - 1.0).abs());
        let known = if *t == 0.0 {
            vec![(0.0, 0.0), (d, 0.0)]
        } else if *t <= 0.5 * PERIOD {
            vec![(0.0, 0.0), (d - u / slope, 0.0), (d, u)]
        } else {
            let half = (d - (stroke - u) / (2.0 * slope), 0.5 * (stroke + u));
            vec![(0.0, 0.0), (d - stroke / slope, 0.0), half, (d, u)]
        };
        let Memory::Curve(curve) = &memories[0] else { panic!("a curve") };
        assert_eq!(curve.knot_count(), known.len(), "{t}");
        for ((h, p), (known_h, known_p)) in curve.knots().zip(known) {
            assert!((h - known_h).abs() < 1e-14 * d && (p - known_p).abs() < 1e-14 * u_c, "{t}: {h} {p}");
        }
    }
}

#[test]
fn a_look_sees_what_the_row_beside_it_says() {
    // Values of a row come from a trial, those of a sample from a commit.
    let steppers = [
        Stepper::Event { tolerance: 1e-8 },
        Stepper::Verlet { step: 1e-6 },
        Stepper::Rk4 { step: 3e-6 },
        Stepper::Dopri5 { tolerance: 1e-6 },
    ];
    let mut scenes: Vec<_> =
        [0, 5, 7, 11, 17, 23].map(deal).into_iter().map(|d| (d.scene, d.period)).collect();
    scenes.extend([(p1(), PERIOD), (pounding_rig(), PERIOD), (on_rows(&p1(), 64), PERIOD)]);
    for (scene, period) in scenes {
        for stepper in steppers {
            let every = 0.0137 * period;
            let plan = Plan { every: Some(every), ..plan(stepper, 2.0 * period) };
            let (model, _, looker) = look(&scene, &plan, Moments::Every(every));
            // The last row is the end, which is no multiple.
            assert_eq!(looker.seen.len() + 1, looker.rows.len());
            for ((t, memories), row) in looker.seen.iter().zip(&looker.rows) {
                assert_eq!(*t, row[0]);
                for (c, (memory, (name, law))) in memories.iter().zip(model.contacts()).enumerate() {
                    let value = |quantity: &str| row[channel(&model, &format!("{name}.{quantity}"))];
                    let now = memory.preview(law, memory.apex());
                    let count = f64::from(scene.contacts[c].part.count);
                    let width = model.contact_width(c).unwrap();
                    let limit = count * law.friction() * law.normal_force(law.profile().depth(0.5 * width));
                    assert_eq!((memory.apex().d, memory.apex().u), (value("d_m"), value("u_m")));
                    assert!((count * now.force - value("fx_N")).abs() <= 1e-9 * limit, "{stepper:?} {t}");
                    assert!((now.stick_radius - value("stick_m")).abs() <= 1e-6 * width, "{stepper:?} {t}");
                }
            }
        }
    }
}

#[test]
fn a_look_is_the_end_of_a_run_that_ends_there() {
    // In a run with other steps memory knots agree within the tolerance, and in growth within the resolution of a path (256 chords).
    for (scene, period, bound) in
        [(pounding_rig(), PERIOD, 1e-6), (p1(), PERIOD, 1e-8), (deal(5).scene, deal(5).period, 1e-6)]
    {
        let long = event(1e-10, period);
        let times: Vec<f64> = (1..12).map(|k| f64::from(k) * 0.0813 * period).collect();
        let (model, _, looker) = look(&scene, &long, Moments::At(times));
        let law = model.contacts().next().unwrap().1;
        let width = model.contact_width(0).unwrap();
        let deepest = law.profile().depth(0.5 * width);
        for (t, memories) in &looker.seen {
            let (_, ended, _) = look(&scene, &Plan { duration: *t, ..long }, Moments::At(Vec::new()));
            let (Memory::Curve(seen), Memory::Curve(known)) = (&memories[0], &ended.memories()[0]) else {
                panic!("curves")
            };
            for k in 0..200 {
                let h = (f64::from(k) + 0.5) / 200.0 * deepest;
                let apart = (seen.stretch(h) - known.stretch(h)).abs();
                assert!(apart < bound * law.gross_slip_displacement(deepest), "{t}: {apart:e} at {h:e}");
            }
        }
    }
}

#[test]
fn springs_of_a_curve_are_those_of_a_row() {
    // The row uses 4096 chords per period of the load, the curve the path itself.
    const COUNT: usize = 301;
    let plan = event(1e-10, 2.0 * PERIOD);
    let scene = pounding_rig();
    let moments = || Moments::Every(0.0171 * PERIOD);
    let (model, _, curves) = look(&scene, &plan, moments());
    let (_, _, rows) = look(&on_rows(&scene, COUNT), &plan, moments());
    let law = model.contacts().next().unwrap().1;
    let grid = Springs::new(law.profile(), COUNT, model.contact_width(0).unwrap()).unwrap();
    let u_c = law.gross_slip_displacement(1.6e-6);
    let (mut states, mut strays) = ([0; 4], 0);
    for ((t, curve), (_, row)) in curves.seen.iter().zip(&rows.seen) {
        let both = curve[0].springs(law, &grid).zip(row[0].springs(law, &grid));
        for (of_curve, of_row) in both {
            assert_eq!(of_curve.x, of_row.x);
            assert!((of_curve.stretch - of_row.stretch).abs() < 1e-4 * u_c, "{t}: {of_curve:?} {of_row:?}");
            let place =
                [SpringState::Open, SpringState::Stick, SpringState::SlipForward, SpringState::SlipBackward];
            states[place.iter().position(|state| *state == of_curve.state).unwrap()] += 1;
            strays += usize::from(of_curve.state != of_row.state);
        }
    }
    // Near a front or an edge both may differ by a spring.
    assert!(states.iter().all(|count| *count > 500), "{states:?}");
    assert!(strays <= 4 * curves.seen.len(), "{strays} of {states:?}");
}

#[test]
fn a_row_that_is_outgrown_stops_the_run_and_not_the_look() {
    let mut scene = pounding_rig();
    scene.contacts[0].part.engine =
        stickslip_drive::scene::EngineChoice::Springs { count: 50, span: Some(40e-6) };
    for stepper in [Stepper::Event { tolerance: 1e-8 }, Stepper::Rk4 { step: 1e-6 }] {
        let plan = plan(stepper, PERIOD);
        let model = Model::new(&scene).unwrap();
        let mut state = model.start(&plan).unwrap();
        let mut looker = Looker::new(Moments::Every(1e-7), &plan);
        assert!(run(&model, &plan, &mut state, &mut looker).is_err());
        let (last, memories) = looker.seen.last().unwrap();
        assert!(memories[0].apex().d <= 0.4e-6 && *last < 0.5 * PERIOD, "{last}");
    }
}

/// Requests times that do not ascend.
struct Restless(Vec<f64>, Vec<f64>);

impl Record for Restless {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Look(t, _) = entry {
            self.1.push(t);
        }
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => self.0.pop(),
            Due::Mark => None,
        }
    }
}

#[test]
fn moments_that_do_not_ascend_end_the_looks() {
    let model = Model::new(&p1()).unwrap();
    for (mut asked, seen) in [
        (vec![-1e-3, 1e-4, 3e-4, 2e-4, 5e-4], vec![1e-4, 3e-4]),
        (vec![1e-4, 1e-4, 1e-4], vec![1e-4]),
        (vec![f64::NAN, 1e-4], vec![]),
        (vec![0.0, PERIOD, 2.0 * PERIOD], vec![0.0, PERIOD]),
    ] {
        asked.reverse();
        let plan = event(1e-8, PERIOD);
        let mut state = model.start(&plan).unwrap();
        let mut record = Restless(asked, Vec::new());
        run(&model, &plan, &mut state, &mut record).unwrap();
        assert_eq!(record.1, seen);
    }
}
