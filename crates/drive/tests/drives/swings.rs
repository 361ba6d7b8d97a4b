//! Closed-form oscillations compared with the stepper. A single slider under constant load is solved from event to event; two
//! independent sliders are stepped.

use crate::parts::{column, contact, end, event, follower, foot_and_slider, free, p1, push, trace, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Contact, Named, Scene, Side};
use stickslip_drive::{Shape, Timing, Waveform};

/// x(20 ms) of P1, m (`tests/data/drive_p1.json`).
const KNOWN: f64 = 1.008_428_628_032_074_9e-5;
const STROKE: f64 = 0.5e-6;

/// Data of one slider: contacts with the foot (radius, friction, force, count), mass and load.
type Part = (Vec<(f64, f64, f64, u32)>, f64, f64);

const PERIOD: f64 = 1e-3;

/// Foot on a waveform with sliders on it.
fn sliders(drive: &Named<Waveform>, parts: &[Part]) -> Scene {
    let mut scene = Scene { waveforms: vec![drive.clone()], ..Scene::default() };
    scene.bodies.push(Named { name: "foot".into(), part: follower(0) });
    for (i, (contacts, mass, force)) in parts.iter().enumerate() {
        let body = scene.bodies.len();
        scene.bodies.push(Named { name: format!("slider{i}"), part: free(*mass) });
        for (k, (radius, friction, load, count)) in contacts.iter().enumerate() {
            let profile = Profile::paraboloid(*radius).unwrap();
            let ball = contact([Side::Body(0), Side::Body(body)], profile, *friction, *load);
            scene
                .contacts
                .push(Named { name: format!("ball{i}{k}"), part: Contact { count: *count, ..ball } });
        }
        if *force != 0.0 {
            scene.loads.push(push(body, *force));
        }
    }
    scene
}

fn drives() -> Vec<Named<Waveform>> {
    let trapezium = |points: &[(f64, f64)]| {
        let shape = Shape::Table { points: points.iter().map(|(t, x)| (t * PERIOD, *x)).collect() };
        Named { name: "drive".to_owned(), part: Waveform::new(shape, Timing::every(PERIOD)).unwrap() }
    };
    vec![
        wave("drive", Shape::Sawtooth { stroke: STROKE, flyback: 0.1 * PERIOD }, PERIOD),
        wave("drive", Shape::Sawtooth { stroke: 2e-6, flyback: 1e-3 * PERIOD }, PERIOD),
        wave("drive", Shape::Sawtooth { stroke: 20e-9, flyback: 0.4 * PERIOD }, PERIOD),
        // Constant between its strokes.
        trapezium(&[(0.0, 0.0), (0.2, 0.6e-6), (0.5, 0.6e-6), (0.53, 0.0), (1.0, 0.0)]),
    ]
}

/// Largest velocity of a waveform, m/s.
fn fastest(drive: &Named<Waveform>) -> f64 {
    let mut piece = drive.part.piece_at(0.0);
    let mut fastest = 0.0_f64;
    while piece.end < PERIOD {
        fastest = fastest.max(drive.part.sample(&piece, piece.start).rate.abs());
        piece = drive.part.after(&piece);
    }
    fastest.max(drive.part.sample(&piece, piece.start).rate.abs())
}

fn pairs() -> [[Part; 2]; 3] {
    let ball = (1e-3, 0.2, 1.0, 1);
    [
        [(vec![(1e-3, 0.15, 1.0, 1)], 0.02, 0.0), (vec![(2e-3, 0.3, 0.4, 3)], 0.05, 0.0)],
        // Contacts that slip and reverse at different times; under a load.
        [
            (vec![(1e-3, 0.1, 0.6, 1), (5e-3, 0.4, 0.3, 2)], 0.03, 0.01),
            (vec![(0.5e-3, 0.05, 0.2, 1)], 0.001, -0.004),
        ],
        [(vec![ball, ball, (1e-2, 0.6, 0.05, 1)], 0.2, -0.1), (vec![(1e-3, 0.9, 2.0, 1)], 0.01, 0.3)],
    ]
}

#[test]
fn alone_and_side_by_side_they_move_alike() {
    let plan = event(1e-11, 5.0 * PERIOD);
    let pairs = pairs();
    for (drive, parts) in drives().iter().flat_map(|drive| pairs.iter().map(move |parts| (drive, parts))) {
        let rows = |parts: &[Part]| {
            let scene = sliders(drive, parts);
            let (model, state, rows) = trace(&scene, &plan, PERIOD / 64.0);
            let column = |name: &str| column(&model, &rows, name);
            let x: Vec<Vec<f64>> = (0..parts.len()).map(|i| column(&format!("slider{i}.x_m"))).collect();
            (x, column("energy.input_J"), column("energy.error_J"), state.counts())
        };
        let (both, input, _, stepped) = rows(parts);
        let mut sum = vec![0.0; input.len()];
        for (i, part) in parts.iter().enumerate() {
            let (alone, work, missing, counts) = rows(std::slice::from_ref(part));
            let travel = alone[0].iter().chain([&STROKE]).map(|x| x.abs()).fold(0.0, f64::max);
            let off = alone[0].iter().zip(&both[i]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let throughput = work.iter().map(|w| w.abs()).fold(0.0, f64::max);
            let open = missing.iter().map(|e| e.abs()).fold(0.0, f64::max);
            println!(
                "{:?}: off by {:.1e}, books {:.1e}, {counts:?}",
                drive.part.period(),
                off / travel,
                open / throughput
            );
            assert!(off < 1e-9 * travel, "{off:e} of {travel:e}");
            // The work of a fast prescribed motion is limited by rounding of velocities.
            let rounding = 1e-14 * part.1 * fastest(drive).powi(2);
            assert!(open < 1e-12 * throughput + rounding, "{open:e} of {throughput:e}");
            // Fewer steps show that the closed form was used.
            assert!(3 * counts.steps < 2 * stepped.steps, "{counts:?} {stepped:?}");
            sum.iter_mut().zip(work).for_each(|(sum, work)| *sum += work);
        }
        let off = sum.iter().zip(&input).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let throughput = input.iter().map(|w| w.abs()).fold(0.0, f64::max);
        assert!(off < 1e-8 * throughput, "{off:e} of {throughput:e}");
    }
}

/// P1 has errors a thousand times smaller than each tolerance, down to the accuracy of the reference.
#[test]
fn p1_keeps_every_tolerance() {
    for exponent in 2..=13 {
        let tolerance = 10_f64.powi(-exponent);
        let (model, state) = end(&p1(), &event(tolerance, 20.0 * PERIOD));
        let error = (state.body(&model, 1).unwrap().0 - KNOWN).abs() / STROKE;
        println!("{tolerance:e}: {error:.1e}, {:?}", state.counts());
        assert!(error < 1e-3 * tolerance + 2e-13, "{tolerance:e}: {error:e}");
        assert!(state.counts().steps < 150 && state.counts().rejected == 0);
    }
}

/// Rows within a closed-form interval equal those of a run that ends there.
#[test]
fn rows_lie_on_the_swing() {
    let scene = p1();
    let plan = event(1e-10, 2.0 * PERIOD);
    let (model, _, rows) = trace(&scene, &plan, PERIOD / 32.0);
    let [t, x, v] = ["time_s", "slider.x_m", "slider.vx_m_s"].map(|name| column(&model, &rows, name));
    for ((t, x), v) in t.iter().zip(&x).zip(&v).skip(1) {
        let (model, state) = end(&scene, &event(1e-10, *t));
        let (there, speed) = state.body(&model, 1).unwrap();
        assert!((there - x).abs() < 1e-11 * STROKE, "{t:e}: {x:e} {there:e}");
        assert!((speed - v).abs() < 1e-11 * STROKE * 2.5e4, "{t:e}: {v:e} {speed:e}");
    }
}

/// Random drives, with strokes from a thousandth to ten thousand times the gross slip displacement, agree with their stepped copies.
#[test]
fn drawn_drives_move_as_their_stepped_twins() {
    let mut seed = 12345_u64;
    let mut draw = move |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low * (high / low).powf((seed >> 11) as f64 / (1_u64 << 53) as f64)
    };
    let mut worst = 0.0_f64;
    for case in 0..100 {
        let mut ball = |count: u32| (draw(1e-4, 1e-1), draw(0.01, 1.5), draw(1e-3, 10.0), count);
        let contacts = (0..=case % 3).map(|_| ball(1 + case % 4)).collect();
        let part: Part = (contacts, draw(1e-4, 1.0), if case % 5 == 0 { draw(1e-4, 1e-1) } else { 0.0 });
        let shape = if case % 7 == 3 {
            Shape::Triangle { stroke: draw(1e-9, 1e-4) }
        } else {
            Shape::Sawtooth { stroke: draw(1e-9, 1e-4), flyback: draw(1e-4, 0.9) * PERIOD }
        };
        let drive = wave("drive", shape, PERIOD);
        let twin = (vec![(1e-3, 0.9, 2.0, 1)], 0.01, 0.0);
        let [alone, beside] = [vec![part.clone()], vec![part, twin]].map(|parts| {
            let (model, state, rows) =
                trace(&sliders(&drive, &parts), &event(1e-10, 5.0 * PERIOD), PERIOD / 64.0);
            (column(&model, &rows, "slider0.x_m"), state.counts().steps)
        });
        let travel = alone.0.iter().map(|x| x.abs()).fold(1e-9, f64::max);
        let off = alone.0.iter().zip(&beside.0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / travel;
        worst = worst.max(off);
        // Next to a prescribed motion of up to 50 m/s velocities have its rounding.
        assert!(off < 1e-9, "case {case}: {off:e}");
        assert!(alone.1 < beside.1, "case {case}: {} {}", alone.1, beside.1);
    }
    println!("off by {worst:.1e} at most");
}

/// A frictionless guide that carries part of the load changes no bit.
#[test]
fn a_contact_without_friction_is_no_reason_to_step() {
    let plain = p1();
    let mut guided = plain.clone();
    let guide = contact([Side::Ground, Side::Body(1)], Profile::paraboloid(1e-2).unwrap(), 0.0, 2.0);
    guided.contacts.push(Named { name: "guide".into(), part: guide });
    let [alone, beside] = [plain, guided].map(|scene| {
        let (model, state) = end(&scene, &event(1e-9, 20.0 * PERIOD));
        (state.body(&model, 1), state.counts().steps)
    });
    assert_eq!(alone, beside);
}

/// Below its zero-step stroke a drive oscillates periodically, and its turning points close the loops of the previous period. The
/// order of both events is rounding and must not affect the motion.
#[test]
fn a_loop_that_closes_where_the_slide_turns_delays_no_turn() {
    let (period, from) = (2e-3, 40);
    let cone = contact([Side::Body(0), Side::Body(1)], Profile::cone(0.005).unwrap(), 0.25, 0.354);
    let reach = cone.interface.stick_slope() * cone.interface.indentation(0.354);
    let drive = wave("drive", Shape::Sawtooth { stroke: 1e-7, flyback: 0.5e-3 }, period);
    let scene = foot_and_slider(drive, 0.005, cone);
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let (model, state, rows) = trace(&scene, &event(tolerance, 150.0 * period), period);
        let place = column(&model, &rows, "slider.x_m");
        let steps = place.windows(2).skip(from).map(|w| ((w[1] - w[0]) / reach).abs());
        let most = steps.fold(0.0, f64::max);
        println!("{tolerance:e}: {most:e} u_c, {:?}", state.counts());
        assert!(most < 3e-12, "{tolerance:e}: {most:e}");
    }
}
