//! Tests of the Prandtl–Ishlinskii block against play operators that follow a finely sampled input.

use super::parts::{PERIOD, SPAN, column, event, every, plan, reading, scene, shared, table, trace};
use crate::parts;
use stickslip_drive::{BytesError, Harmonic, Model, Plan, Run, Shape, State, Stepper, Timing, Waveform};
use stickslip_piezo::driver::{Control, Driver, Spec};
use stickslip_piezo::hysteresis::{PlayBlock, Plays};

fn law() -> Plays {
    Plays::of_loop(0.15, SPAN, 10).unwrap()
}

/// Play operators by definition: p changes only when v forces it to.
struct Walked {
    slots: Vec<(f64, f64, f64)>,
    direct: f64,
}

impl Walked {
    fn new(plays: &Plays) -> Self {
        let slots = plays.thresholds().iter().zip(plays.weights()).map(|(r, w)| (*r, *w, 0.0)).collect();
        Self { slots, direct: plays.direct() }
    }

    fn to(&mut self, v: f64) -> f64 {
        for (r, _, p) in &mut self.slots {
            if v - *p > *r {
                *p = v - *r;
            } else if *p - v > *r {
                *p = v + *r;
            }
        }
        self.direct * v + self.slots.iter().map(|(_, w, p)| w * p).sum::<f64>()
    }
}

const TAU: f64 = std::f64::consts::TAU;

/// Two harmonics: a large loop with minor loops.
fn two() -> Waveform {
    let term = |amplitude, order, phase| Harmonic { amplitude, order, phase };
    every(Shape::Harmonics { terms: vec![term(0.3 * SPAN, 1.0, 0.4), term(0.25 * SPAN, 5.0, 1.0)] })
}

fn two_at(t: f64) -> f64 {
    let phase = TAU * t / PERIOD;
    0.3 * SPAN * (phase + 0.4).sin() + 0.25 * SPAN * (5.0 * phase + 1.0).sin()
}

fn two_rate(t: f64) -> f64 {
    let phase = TAU * t / PERIOD;
    0.3 * (phase + 0.4).cos() + 1.25 * (5.0 * phase + 1.0).cos()
}

/// Samples of the input between two times, including its reversals.
fn two_between(from: f64, to: f64) -> Vec<f64> {
    let count = 16;
    let place = |k: i32| from + (to - from) * f64::from(k) / f64::from(count);
    let mut way = Vec::new();
    for k in 1..=count {
        let (mut a, mut b) = (place(k - 1), place(k));
        if two_rate(a) * two_rate(b) < 0.0 {
            let sign = two_rate(a);
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if two_rate(middle) * sign > 0.0 { a = middle } else { b = middle }
            }
            way.push(two_at(0.5 * (a + b)));
        }
        way.push(two_at(place(k)));
    }
    way
}

/// Compares the output at ten thousand times that are not related to the period.
#[test]
fn its_output_is_that_of_plays_walked_finely() {
    let scene = scene(two(), vec![shared("plays", PlayBlock::new(law(), reading(0)))]);
    let (model, _, trace) = trace(&scene, &event(3.0 * PERIOD), PERIOD / 3391.7);
    let (t, y) = (column(&model, &trace, "time_s"), column(&model, &trace, "plays.stroke_m"));
    let foot = column(&model, &trace, "foot.x_m");
    assert!(t.len() > 10_000, "{}", t.len());
    let mut walked = Walked::new(&law());
    walked.to(two_at(0.0));
    let (mut worst, mut last) = (0.0_f64, 0.0);
    for ((&t, &y), &foot) in t.iter().zip(&y).zip(&foot) {
        let direct = two_between(last, t).into_iter().fold(walked.to(two_at(last)), |_, v| walked.to(v));
        worst = worst.max((y - direct).abs());
        assert_eq!(y.to_bits(), foot.to_bits(), "the foot is where the block has it");
        last = t;
    }
    assert!(worst < 1e-12 * SPAN, "{worst}");
    let kinds: Vec<&str> = trace.events().map(|(event, _)| event.kind.name()).collect();
    let count = |name: &str| kinds.iter().filter(|kind| **kind == name).count();
    // Ten reversals per period, and engaged plays in between.
    assert_eq!(count("input turns"), 30, "{kinds:?}");
    assert!(count("play taken up") > 60, "{}", count("play taken up"));
}

/// The block follows a driver with current limits. The voltage reverses exactly at a corner of the play model, at the time of the
/// driver's event. The block must detect this reversal.
#[test]
fn it_turns_with_the_driver_where_a_play_is_taken_up() {
    const GAIN: f64 = 74.47e-9;
    let spec = Spec {
        capacitance: 14.47e-6,
        gain: GAIN,
        window: None,
        current: Some((0.26, 0.568)),
        resistance: None,
        low: None,
        control: Control::Voltage,
    };
    let triangle = Waveform::new(Shape::Triangle { stroke: -26.23 * GAIN }, Timing::every(1.9e-3)).unwrap();
    let driver = Driver::new(spec, 0, triangle.range()).shared();
    for operators in [1, 2, 5] {
        let plays = Plays::of_loop(0.12, 2.4e-6, operators).unwrap();
        let block = shared("plays", PlayBlock::new(plays.clone(), reading(1)));
        let scene = scene(triangle.clone(), vec![parts::named("driver", driver.clone()), block]);
        let (model, _, trace) = trace(&scene, &event(5.7e-3), 1e-7);
        let [volts, y] = ["driver.voltage_V", "plays.stroke_m"].map(|name| column(&model, &trace, name));
        let mut walked = Walked::new(&plays);
        let off = volts.iter().zip(&y).map(|(v, y)| (walked.to(GAIN * v) - y).abs()).fold(0.0, f64::max);
        // Extreme values lie between rows.
        assert!(off < 1e-3 * 2.4e-6, "{operators} operators: {off:e}");
    }
}

/// The velocity of the foot is the slope of the branch times the rate of the input; compared with central differences between events.
#[test]
fn its_rate_is_that_of_the_branch() {
    let scene = scene(two(), vec![shared("plays", PlayBlock::new(law(), reading(0)))]);
    let (model, _, trace) = trace(&scene, &event(PERIOD), PERIOD / 40_000.0);
    let (y, v) = (column(&model, &trace, "foot.x_m"), column(&model, &trace, "foot.vx_m_s"));
    let step = PERIOD / 40_000.0;
    let mut off: Vec<f64> =
        (1..y.len() - 1).map(|k| ((y[k + 1] - y[k - 1]) / (2.0 * step) - v[k]).abs()).collect();
    off.sort_by(f64::total_cmp);
    // Samples next to one of about fifty events are excluded.
    assert!(off[off.len() - 200] < 1e-5 * SPAN / PERIOD, "{}", off[off.len() - 200]);
}

/// The block follows corners, jumps and rests of the input. A jump is a monotone change in zero time.
#[test]
fn it_follows_corners_and_jumps() {
    let points = [
        (0.0, 0.0),
        (0.4, 0.9),
        (0.4, 0.1),
        (0.6, 0.1),
        (0.8, 0.7),
        (0.8, 0.2),
        (1.0, 0.4),
        (1.0, 0.9),
        (1.4, 0.9),
        (1.7, 0.0),
        (1.9, 0.3),
    ];
    let scene = scene(table(&points), vec![shared("plays", PlayBlock::new(law(), reading(0)))]);
    let frames = Stepper::Frames { length: 1e-6, accuracy: 1e-6 };
    for stepper in [Stepper::Event { tolerance: 1e-9 }, frames] {
        let (model, _, trace) = trace(&scene, &plan(stepper, 2e-3), 3.7e-6);
        let (t, y) = (column(&model, &trace, "time_s"), column(&model, &trace, "plays.stroke_m"));
        let mut walked = Walked::new(&law());
        let mut turned = 0;
        let mut worst = 0.0_f64;
        for (&t, &y) in t.iter().zip(&y) {
            while turned < points.len() && 1e-3 * points[turned].0 <= t {
                walked.to(1e-6 * points[turned].1);
                turned += 1;
            }
            let v = match points.get(turned) {
                Some(next) => {
                    let from = points[turned - 1];
                    from.1 + (next.1 - from.1) * (1e3 * t - from.0) / (next.0 - from.0)
                }
                None => points[points.len() - 1].1,
            };
            worst = worst.max((y - walked.to(1e-6 * v)).abs());
        }
        // Fixed steps end at corners and engage plays at their ends. The error is at most the change in one step, 9 μm/s · 1 μs.
        let allowed = if matches!(stepper, Stepper::Event { .. }) { 1e-12 } else { 1e-3 };
        assert!(worst < allowed * SPAN, "{stepper:?}: {worst}");
    }
}

/// A run that is stored as bytes in the middle of a loop and resumed has identical results.
#[test]
fn a_run_that_is_resumed_in_a_loop_is_the_same() {
    let scene = scene(two(), vec![shared("plays", PlayBlock::new(law(), reading(0)))]);
    let model = Model::new(&scene).unwrap();
    let plan = Plan { every: Some(PERIOD / 300.0), ..event(2.0 * PERIOD) };
    let bytes = |state: &State| state.to_bytes(&model, &[7; 32]);
    for cut in [0.137, 0.5, 0.81] {
        let begun = || {
            let mut run = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
            run.advance(cut * PERIOD, &mut ()).unwrap();
            run
        };
        let mut whole = begun();
        whole.finish(&mut ()).unwrap();
        let back = State::from_bytes(&model, &[7; 32], &bytes(begun().state())).unwrap();
        let mut rest = Run::resume(&model, &plan, back).unwrap();
        rest.finish(&mut ()).unwrap();
        assert!(bytes(rest.state()) == bytes(whole.state()), "{cut}");
        assert!(whole.state().counts().events > 80);
    }
}

/// With fixed steps, modes change at the ends of steps, and the error decreases with the step size.
#[test]
fn fixed_steps_come_near() {
    let scene = scene(two(), vec![shared("plays", PlayBlock::new(law(), reading(0)))]);
    let end = |plan: &Plan| {
        let (model, _, trace) = trace(&scene, plan, PERIOD / 97.0);
        column(&model, &trace, "plays.stroke_m")
    };
    let exact = end(&event(2.0 * PERIOD));
    let off = |step: f64| {
        let stepped = end(&plan(Stepper::Rk4 { step }, 2.0 * PERIOD));
        stepped.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (off(1e-6), off(1e-7));
    assert!(coarse < 3e-3 * SPAN && fine < 0.2 * coarse, "{coarse} {fine}");
}

/// CRC-32 of Ethernet, bit by bit.
fn checksum(bytes: &[u8]) -> u32 {
    let step = |sum: u32| if sum & 1 == 1 { 0xEDB8_8320 ^ (sum >> 1) } else { sum >> 1 };
    !bytes.iter().fold(u32::MAX, |sum, byte| (0..8).fold(sum ^ u32::from(*byte), |sum, _| step(sum)))
}

/// A state with a wrong number of plays or an invalid mode is rejected.
#[test]
fn a_forged_state_is_refused() {
    const KEY: [u8; 32] = [7; 32];
    let of = |count| {
        let plays = Plays::of_loop(0.15, SPAN, count).unwrap();
        let scene = scene(two(), vec![shared("plays", PlayBlock::new(plays, reading(0)))]);
        let model = Model::new(&scene).unwrap();
        let state = model.start(&event(PERIOD)).unwrap();
        (model, state)
    };
    let ((model, state), (other, _)) = (of(10), of(9));
    let bytes = state.to_bytes(&model, &KEY);
    assert!(State::from_bytes(&model, &KEY, &bytes).unwrap() == state);
    assert!(matches!(State::from_bytes(&other, &KEY, &bytes), Err(BytesError::Unfit)));
    // The mode precedes the memory of ten numbers.
    let word = |place: usize| u64::from_le_bytes(bytes[place..place + 8].try_into().unwrap());
    let end = bytes.len() - 8;
    let laws: Vec<usize> =
        (56..end - 8).step_by(8).filter(|place| word(*place) < 22 && word(place + 8) == 10).collect();
    let forged = |place: usize, law: u64| {
        let mut forged = bytes.clone();
        forged[place..place + 8].copy_from_slice(&law.to_le_bytes());
        let sum = u64::from(checksum(&forged[..end]));
        forged[end..].copy_from_slice(&sum.to_le_bytes());
        State::from_bytes(&model, &KEY, &forged)
    };
    let [place] = laws[..] else { panic!("{laws:?}") };
    assert!(forged(place, 21).is_ok());
    assert!(matches!(forged(place, 22), Err(BytesError::Unfit)));
    assert!(matches!(forged(place, u64::MAX), Err(BytesError::Unfit)));
}
