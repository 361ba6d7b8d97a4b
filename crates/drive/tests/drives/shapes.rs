//! Runs on every shape of a waveform, compared with the same motion as a table or as sines.

use crate::parts::{FOOT_SLIDER, contact, end, event, foot_and_slider, named};
use stickslip_contact::Profile;
use stickslip_drive::{Harmonic, Plan, Scene, Section, Shape, Sweep, Timing, Waveform};

const PERIOD: f64 = 1e-3;
const STROKE: f64 = 0.5e-6;
const DURATION: f64 = 6.0 * PERIOD;

fn on(shape: Shape) -> Scene {
    on_wave(Waveform::new(shape, Timing::every(PERIOD)).unwrap())
}

fn on_wave(waveform: Waveform) -> Scene {
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    foot_and_slider(named("drive", waveform), 0.02, ball)
}

/// Final position of the slider, m.
fn reach(scene: &Scene, plan: &Plan) -> f64 {
    let (model, state) = end(scene, plan);
    state.body(&model, 1).unwrap().0
}

fn agree(one: &Scene, other: &Scene, slack: f64) {
    let plan = event(1e-11, DURATION);
    let (a, b) = (reach(one, &plan), reach(other, &plan));
    println!("{a:e} {b:e} {:e}", (a - b) / STROKE);
    assert!((a - b).abs() < slack * STROKE, "{a:e} {b:e}");
    // The slider has moved.
    assert!(a.abs() > 0.05 * STROKE, "{a:e}");
}

/// Repeated table with the corners of one period.
fn table(corners: &[(f64, f64)], period: f64) -> Scene {
    let mut points = Vec::new();
    for k in 0..(DURATION / period).ceil() as u32 {
        points.extend(corners.iter().map(|(t, v)| (t * PERIOD + f64::from(k) * period, v * STROKE)));
    }
    points.push((2.0 * DURATION, 0.0));
    points.dedup();
    on(Shape::Table { points })
}

#[test]
fn a_trapezoid_is_the_table_of_its_corners() {
    let shape = Shape::Trapezoid { stroke: STROKE, rise: 0.6e-3, hold: 0.2e-3, fall: 0.02e-3 };
    let corners = [(0.0, 0.0), (0.6, 1.0), (0.8, 1.0), (0.82, 0.0)];
    agree(&on(shape), &table(&corners, PERIOD), 1e-9);
}

/// S = 0.5 µm in 0.98 ms, back in 0.02 ms with a limit of 2 mm/s: it lags by u = (S - rτ)/(r + s).
#[test]
fn a_limited_sawtooth_is_the_table_of_what_it_meets() {
    let rate = 2e-3;
    let shape = Shape::Limited { stroke: STROKE, flyback: 0.02e-3, rate };
    let up = STROKE / 0.98e-3;
    let late = (STROKE - rate * 0.02e-3) / (rate + up) / PERIOD;
    let low = up * late * PERIOD / STROKE;
    let mut points = vec![(0.0, 0.0)];
    for k in 0..8 {
        let k = f64::from(k);
        points.push(((k + 0.98) * PERIOD, STROKE));
        points.push(((k + 1.0 + late) * PERIOD, low * STROKE));
    }
    agree(&on(shape), &on(Shape::Table { points }), 1e-9);
}

#[test]
fn a_sequence_is_the_table_of_its_runs_and_rests() {
    let saw = Shape::Sawtooth { stroke: STROKE, flyback: 0.1e-3 };
    let parts = vec![
        Section::Run { cycles: 2, reversed: false },
        Section::Rest { duration: 0.5e-3 },
        Section::Run { cycles: 1, reversed: true },
    ];
    let corners = [(0.0, 0.0), (0.9, 1.0), (1.0, 0.0), (1.9, 1.0), (2.0, 0.0), (2.5, 0.0), (2.6, 1.0)];
    agree(&on(Shape::Pattern { carrier: Box::new(saw), parts }), &table(&corners, 3.5e-3), 1e-9);
}

/// Reversed runs move the slider in the opposite direction, step by step.
#[test]
fn what_is_reversed_steps_the_other_way() {
    let saw = || Box::new(Shape::Sawtooth { stroke: STROKE, flyback: 0.02e-3 });
    let run = |reversed| Shape::Pattern { carrier: saw(), parts: vec![Section::Run { cycles: 1, reversed }] };
    let plan = event(1e-11, 20.0 * PERIOD);
    let [forth, back] = [false, true].map(|reversed| reach(&on(run(reversed)), &plan));
    println!("{forth:e} {back:e}");
    assert!(forth > 10.0 * STROKE && back < -10.0 * STROKE, "{forth:e} {back:e}");
    // Mirrored in time and space, a steady drive differs by its start only.
    assert!((forth + back).abs() < 2.0 * STROKE, "{forth:e} {back:e}");
}

#[test]
fn two_harmonics_and_a_chirp_of_one_frequency_are_their_sines() {
    let even = Sweep { amplitude: STROKE, offset: 0.0, phase: 0.3, from: 1e3, to: 1e3, duration: 1.0 };
    let phased = Shape::Sine { amplitude: STROKE, phase: 0.3, offset: 0.0 };
    agree(&on(Shape::Chirp(even)), &on(phased), 1e-8);
    // A burst without a rest is its carrier.
    let term = |amplitude, order| Harmonic { amplitude, order, phase: 0.0 };
    let sum = || Shape::Harmonics { terms: vec![term(STROKE, 1.0), term(-0.25 * STROKE, 2.0)] };
    let parts = vec![Section::Run { cycles: 2, reversed: false }];
    agree(&on(Shape::Pattern { carrier: Box::new(sum()), parts }), &on(sum()), 1e-8);
}

/// A step of the foot is a path of zero duration, like that of a table.
#[test]
fn a_step_is_the_jump_of_a_table() {
    let step = on(Shape::Step { height: STROKE, at: 1e-3 });
    let points = vec![(1e-3, 0.0), (1e-3, STROKE)];
    agree(&step, &on(Shape::Table { points }), 1e-12);
}

/// Waveform as a table of points, with chords accurate to 1e-7 of the stroke.
fn chords(waveform: &Waveform) -> Scene {
    let mut points = Vec::new();
    let mut piece = waveform.piece_at(0.0);
    // The last piece has no end and is followed by itself.
    loop {
        let (from, to) = (piece.start.max(0.0), piece.end.min(2.0 * DURATION));
        let count = (12_000.0 * (to - from) / PERIOD).ceil().max(50.0);
        for k in 0..=count as u32 {
            let t = if f64::from(k) < count { from + (to - from) * f64::from(k) / count } else { to };
            points.push((t, waveform.sample(&piece, t).value));
        }
        if piece.end >= DURATION {
            break;
        }
        piece = waveform.after(&piece);
    }
    points.dedup();
    on(Shape::Table { points })
}

/// Curved pieces give the same motion as their chords.
#[test]
fn curved_shapes_are_their_chords() {
    let points: Vec<(f64, f64)> = [(0.0, 0.0), (0.3, 0.2), (0.6, 0.55), (0.9, 1.0), (0.95, 0.8), (1.0, 0.0)]
        .map(|(t, v)| (t * PERIOD, v * STROKE))
        .to_vec();
    let sweep = Sweep { amplitude: STROKE, offset: 0.0, phase: 0.0, from: 200.0, to: 3e3, duration: 4e-3 };
    let shapes = [
        Shape::Parabola { stroke: STROKE, turn: 0.0 },
        Shape::Parabola { stroke: STROKE, turn: 0.1e-3 },
        Shape::SCurve { stroke: STROKE, flyback: 0.1e-3, rounding: 0.02e-3 },
        Shape::Chirp(sweep),
        Shape::Curve { points, smooth: true, repeated: true },
    ];
    for shape in shapes {
        let scene = on(shape);
        let waveform = &scene.waveforms[0].part;
        let plan = event(1e-10, DURATION);
        let [a, b] = [&scene, &chords(waveform)].map(|scene| reach(scene, &plan));
        println!("{:?} {a:e} {b:e} {:e}", waveform.shape(), (a - b) / STROKE);
        assert!((a - b).abs() < 1e-5 * STROKE && a.abs() > 0.05 * STROKE, "{a:e} {b:e}");
    }
}

/// Below the largest friction acceleration the slider sticks to the foot and has its velocity at the cusp.
#[test]
fn the_parabola_carries_as_fast_as_its_turn() {
    // 2V/T = 8S/T² = 4 m/s² is below μF_N/m = 7.5 m/s²: the slider sticks up to the cusp, and continues at V = 4S/T.
    let scene = on(Shape::Parabola { stroke: STROKE, turn: 0.0 });
    let (model, state) = end(&scene, &event(1e-10, 0.5 * PERIOD));
    let (x, v) = state.body(&model, 1).unwrap();
    println!("{x:e} {v:e}");
    assert!(
        (x - STROKE).abs() < 0.1 * STROKE && (v - 4.0 * STROKE / PERIOD).abs() < 0.2 * 4.0 * STROKE / PERIOD
    );
}
