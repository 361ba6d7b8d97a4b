//! Tests of waveforms against direct formulas, and of properties that steppers rely on.

mod pieces;
mod shapes;

use super::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn wave(shape: Shape, timing: Timing) -> Waveform {
    Waveform::new(shape, timing).unwrap()
}

fn value(wave: &Waveform, t: f64) -> f64 {
    wave.sample(&wave.piece_at(t), t).value
}

/// Splitmix64 (Steele, Lea, Flood 2014), for repeatable random tests.
struct Random(u64);

impl Random {
    /// Uniform on [low, high).
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn shape(&mut self, period: f64) -> Shape {
        let stroke = self.between(-1e-5, 1e-5);
        let flyback = if self.between(0.0, 1.0) < 0.3 { 0.0 } else { self.between(0.001, 0.999) * period };
        match self.between(0.0, 11.0) as u32 {
            6 => Shape::Parabola { stroke, turn: flyback },
            7 => {
                let times = [0; 4].map(|_| self.between(0.0, 1.0));
                let [rise, hold, fall, rest] = times;
                let unit = period / (rise + hold + fall + rest);
                Shape::Trapezoid { stroke, rise: rise * unit, hold: hold * unit, fall: fall * unit }
            }
            8 => {
                let flyback = self.between(0.01, 0.99) * period;
                let rounding = self.between(0.01, 0.25) * flyback.min(period - flyback);
                Shape::SCurve { stroke, flyback, rounding }
            }
            9 => {
                let least = stroke.abs() / (period - flyback);
                Shape::Limited { stroke, flyback, rate: least * self.between(1.0, 20.0) }
            }
            10 => {
                let flyback = self.between(0.01, 0.99) * period;
                let carriers = [
                    Shape::Cycloid { stroke, flyback },
                    Shape::Sine { amplitude: stroke, phase: 0.3, offset: 1e-6 },
                    Shape::Parabola { stroke, turn: 0.0 },
                ];
                let parts = vec![
                    Section::Run { cycles: 3, reversed: false },
                    Section::Rest { duration: self.between(0.1, 2.0) * period },
                    Section::Run { cycles: 2, reversed: true },
                ];
                let carrier = carriers[self.between(0.0, 3.0) as usize].clone();
                Shape::Pattern { carrier: Box::new(carrier), parts }
            }
            0 => Shape::Sawtooth { stroke, flyback },
            1 => Shape::Triangle { stroke },
            2 => Shape::Sine {
                amplitude: stroke,
                phase: self.between(-7.0, 7.0),
                offset: self.between(-1.0, 1.0),
            },
            3 => Shape::Harmonics {
                terms: (1..4)
                    .map(|n| Harmonic {
                        amplitude: self.between(-1.0, 1.0),
                        order: f64::from(n * n),
                        phase: self.between(-7.0, 7.0),
                    })
                    .collect(),
            },
            4 => Shape::Cycloid { stroke, flyback },
            _ => {
                let mut t = self.between(-1.0, 1.0) * period;
                let points = (0..9).map(|i| {
                    t += if i % 3 == 1 { 0.0 } else { self.between(0.01, 1.0) * period };
                    (t, self.between(-1.0, 1.0))
                });
                Shape::Table { points: points.collect() }
            }
        }
    }

    fn wave(&mut self) -> Waveform {
        let period = 10.0_f64.powf(self.between(-5.0, 1.0));
        let shape = self.shape(period);
        let mut timing = Timing { delay: self.between(-1.0, 4.0) * period, ..Timing::every(period) };
        if !matches!(shape, Shape::Table { .. }) {
            timing.phase = self.between(-10.0, 10.0);
            timing.cycles = (self.between(0.0, 1.0) < 0.5).then(|| self.between(0.1, 6.0));
        }
        wave(shape, timing)
    }
}

/// Value by the definition, away from corners, for a time clamped to the window.
fn direct(wave: &Waveform, t: f64) -> f64 {
    let Timing { period, delay, phase, cycles } = *wave.timing();
    let clamped = t.clamp(delay, cycles.map_or(f64::INFINITY, |n| delay + n * period));
    let turns = (clamped - delay) / period + phase / TAU;
    let x = turns.rem_euclid(1.0);
    if let Shape::Limited { stroke, flyback, rate } = wave.shape() {
        return limited(*stroke, (*flyback, period, *rate), (turns, phase == 0.0));
    }
    of_cycle(wave.shape(), period, x).unwrap_or_else(|| match wave.shape() {
        Shape::Table { points } => {
            let t = t - delay;
            let after = points.partition_point(|point| point.0 <= t);
            match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
                (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0),
                (Some(a), None) => a.1,
                (None, _) => points[0].1,
            }
        }
        other => panic!("{other:?} has tests of its own"),
    })
}

/// Rate-limited sawtooth in closed form: it falls at the limit until it meets the requested one.
fn limited(stroke: f64, (flyback, period, rate): (f64, f64, f64), (turns, leads): (f64, bool)) -> f64 {
    let (size, rise) = (stroke.abs(), period - flyback);
    let up = size / rise;
    let asked = |time: f64| if time <= rise { up * time } else { size * (period - time) / flyback };
    let time = turns.rem_euclid(1.0) * period;
    let fresh = leads && turns < 1.0;
    let late = |since_top: f64| size - rate * since_top;
    let value = if time > rise {
        asked(time).max(late(time - rise))
    } else if fresh {
        asked(time)
    } else {
        asked(time).max(late(time + flyback))
    };
    value * stroke.signum()
}

/// Value at a fraction `x` of one period, by the definition.
fn of_cycle(shape: &Shape, period: f64, x: f64) -> Option<f64> {
    let cycloid = |x: f64| x - (TAU * x).sin() / TAU;
    let two_way = |stroke: f64, top: f64, law: &dyn Fn(f64) -> f64| {
        if x <= top { stroke * law(x / top) } else { stroke * (1.0 - law((x - top) / (1.0 - top))) }
    };
    Some(match shape {
        Shape::Sawtooth { stroke, flyback } => two_way(*stroke, 1.0 - flyback / period, &|x| x),
        Shape::Triangle { stroke } => two_way(*stroke, 0.5, &|x| x),
        Shape::Cycloid { stroke, flyback } => two_way(*stroke, 1.0 - flyback / period, &cycloid),
        Shape::Sine { amplitude, phase, offset } => offset + amplitude * (TAU * x + phase).sin(),
        Shape::Harmonics { terms } => {
            terms.iter().map(|h| h.amplitude * (h.order * TAU * x + h.phase).sin()).sum()
        }
        Shape::Input { initial, .. } => *initial,
        Shape::Generator(it) => two_way(it.initial.stroke, it.cycle.top(&it.initial) / period, &|x| x),
        Shape::Parabola { stroke, turn } => {
            // Distances from the bottom and from the top, in periods.
            let (from_bottom, from_top) = (x.min(1.0 - x), (x - 0.5).abs());
            let turn = turn / period;
            if from_top >= 0.5 * turn {
                stroke * 4.0 * from_bottom * from_bottom / (1.0 - turn)
            } else {
                stroke * (1.0 - 4.0 * from_top * from_top / turn)
            }
        }
        Shape::Trapezoid { stroke, rise, hold, fall } => {
            let t = x * period;
            stroke * (t / rise).min(((rise + hold + fall) - t) / fall).clamp(0.0, 1.0)
        }
        Shape::SCurve { stroke, flyback, rounding } => stroke * s_curve([period, *flyback, *rounding], x),
        Shape::Pattern { carrier, parts } => return of_pattern(carrier, parts, x * period, period),
        _ => return None,
    })
}

/// S-curve of stroke 1 at a fraction `x` of its period.
fn s_curve([period, flyback, rounding]: [f64; 3], x: f64) -> f64 {
    let way = |time: f64| {
        let tau = rounding / time;
        // Speed 1 in the middle; each end is the double integral of its jerk 1/τ².
        let begin = move |s: f64| {
            let cube = |s: f64| s.max(0.0).powi(3) / 6.0;
            if s > 2.0 * tau { s - tau } else { (cube(s) - 2.0 * cube(s - tau)) / (tau * tau) }
        };
        let length = 1.0 - 2.0 * tau;
        move |s: f64| if s <= 0.5 { begin(s) / length } else { 1.0 - begin(1.0 - s) / length }
    };
    let top = 1.0 - flyback / period;
    if x <= top { way(period - flyback)(x / top) } else { 1.0 - way(flyback)((x - top) / (1.0 - top)) }
}

/// Pattern of three cycles, a rest and two reversed cycles.
fn of_pattern(carrier: &Shape, parts: &[Section], time: f64, period: f64) -> Option<f64> {
    let Some(Section::Rest { duration }) = parts.get(1) else { panic!("{parts:?}") };
    let own = (period - duration) / 5.0;
    let part = if time <= 3.0 * own {
        (time / own).fract()
    } else if time <= 3.0 * own + duration {
        0.0
    } else {
        1.0 - ((time - 3.0 * own - duration) / own).fract()
    };
    of_cycle(carrier, own, part)
}

#[test]
fn corners_stay_exact_over_a_million_periods() {
    let (period, flyback, stroke, delay) = (1e-3, 1e-5, 2e-7, 3e-4);
    let wave = wave(Shape::Sawtooth { stroke, flyback }, Timing { delay, ..Timing::every(period) });
    let mut piece = wave.piece_at(delay);
    for k in 0..1_000_000_u32 {
        let begin = f64::from(k) * period + delay;
        for (from, to) in [(0.0, stroke), (stroke, 0.0)] {
            if from == 0.0 {
                assert_eq!(piece.start, begin);
            }
            let (left, right) = (wave.sample(&piece, piece.start), wave.sample(&piece, piece.end));
            assert_eq!((left.value, right.value), (from, to));
            let next = wave.after(&piece);
            assert_eq!((piece.end, piece.index + 1), (next.start, next.index));
            piece = next;
        }
    }
    assert_eq!(piece.index, 2_000_001);
    // The spacing of floating-point times is 1.1e-13 s there.
    assert!((piece.start - 1000.0003).abs() < 2.3e-13);
}

#[test]
fn limits_from_left_and_right() {
    let wave = wave(Shape::Triangle { stroke: 6.0 }, Timing::every(4.0));
    let up = wave.piece_at(1.0);
    let down = wave.after(&up);
    assert_eq!((up.start, up.end, down.end), (0.0, 2.0, 4.0));
    assert_eq!(wave.sample(&up, 2.0), Sample { value: 6.0, rate: 3.0, acceleration: 0.0 });
    assert_eq!(wave.sample(&down, 2.0), Sample { value: 6.0, rate: -3.0, acceleration: 0.0 });
    assert_eq!(wave.piece_at(2.0), down);
    assert_eq!(wave.jump_after(&up), 0.0);
    assert_eq!(wave.sample(&wave.piece_at(-1.0), -1.0), Sample { value: 0.0, rate: 0.0, acceleration: 0.0 });
}

#[test]
fn zero_flyback_jumps() {
    let wave = wave(Shape::Sawtooth { stroke: 5.0, flyback: 0.0 }, Timing::every(0.1));
    assert!(wave.has_jumps());
    let mut piece = wave.piece_at(0.0);
    for _ in 0..1000 {
        assert_eq!(wave.sample(&piece, piece.end).value, 5.0);
        assert_eq!(wave.jump_after(&piece), -5.0);
        piece = wave.after(&piece);
        assert_eq!(wave.sample(&piece, piece.start).value, 0.0);
    }
}

#[test]
fn delay_phase_and_cycles() {
    let shape = Shape::Triangle { stroke: 1.0 };
    let timing = Timing { period: 0.3, delay: 0.7, phase: PI, cycles: Some(2.0) };
    let wave = wave(shape, timing);
    // With a phase of π it starts on its top, without a very short piece.
    let before = wave.piece_at(0.0);
    assert_eq!((before.index, before.end, wave.jump_after(&before)), (0, 0.7, 0.0));
    let mut piece = before;
    for expected in [0.7, 0.85, 1.0, 1.15, 1.3] {
        piece = wave.after(&piece);
        assert!((piece.start - expected).abs() < 1e-15, "{}", piece.start);
    }
    assert_eq!((piece.index, piece.end), (5, f64::INFINITY));
    assert_eq!(wave.after(&piece), piece);
    for (t, expected) in
        [(0.0, 1.0), (0.7, 1.0), (0.775, 0.5), (0.85, 0.0), (1.225, 0.5), (1.3, 1.0), (9.0, 1.0)]
    {
        assert!((value(&wave, t) - expected).abs() < 1e-14, "{t}");
    }
    assert_eq!(value(&wave, 0.7), 1.0);
}

#[test]
fn a_last_jump_takes_place_and_a_cut_period_holds_where_it_was() {
    let shape = || Shape::Sawtooth { stroke: 4.0, flyback: 0.0 };
    let whole = wave(shape(), Timing { cycles: Some(3.0), ..Timing::every(0.1) });
    let last = whole.piece_at(0.29);
    assert_eq!((last.end, whole.jump_after(&last), value(&whole, 1.0)), (3.0 * 0.1, -4.0, 0.0));
    let cut = wave(shape(), Timing { cycles: Some(2.5), ..Timing::every(0.1) });
    assert!((value(&cut, 1.0) - 2.0).abs() < 1e-14);
    assert_eq!(cut.jump_after(&cut.piece_at(0.24)), 0.0);
}

#[test]
fn table_is_straight_held_and_jumps() {
    let points = vec![(1.0, 2.0), (2.0, 4.0), (2.0, -1.0), (4.0, -1.0), (5.0, 3.0)];
    let wave = wave(Shape::Table { points }, Timing { delay: 10.0, ..Timing::every(1.0) });
    assert_eq!((wave.period(), wave.range(), wave.has_jumps()), (None, (-1.0, 4.0), true));
    for (t, expected) in
        [(0.0, 2.0), (11.0, 2.0), (11.5, 3.0), (12.0, -1.0), (13.0, -1.0), (14.25, 0.0), (99.0, 3.0)]
    {
        assert_eq!(value(&wave, t), expected, "{t}");
    }
    let first = wave.piece_at(11.0);
    assert_eq!((wave.sample(&first, 12.0).value, wave.jump_after(&first)), (4.0, -5.0));
    let mut ends = Vec::new();
    let mut piece = wave.piece_at(0.0);
    while piece.end.is_finite() {
        ends.push(piece.end);
        piece = wave.after(&piece);
    }
    assert_eq!(ends, [11.0, 12.0, 14.0, 15.0]);
}

#[test]
fn tables_that_are_one_point_or_one_jump() {
    let one = wave(Shape::Table { points: vec![(1.0, 7.0)] }, Timing::every(1.0));
    assert_eq!((value(&one, 0.0), value(&one, 1.0), value(&one, 2.0)), (7.0, 7.0, 7.0));
    let step = wave(Shape::Table { points: vec![(1.0, 7.0), (1.0, 8.0)] }, Timing::every(1.0));
    let before = step.piece_at(0.0);
    assert_eq!((before.end, step.jump_after(&before)), (1.0, 1.0));
    assert_eq!((value(&step, 0.999), value(&step, 1.0)), (7.0, 8.0));
    // Jumps at both ends.
    let points = vec![(0.0, 1.0), (0.0, 2.0), (1.0, 3.0), (1.0, 4.0)];
    let both = wave(Shape::Table { points }, Timing::every(1.0));
    assert_eq!((value(&both, -1.0), value(&both, 0.0), value(&both, 1.0)), (1.0, 2.0, 4.0));
    assert_eq!(both.jump_after(&both.piece_at(0.5)), 1.0);
}

#[test]
fn cycloid_by_its_law() {
    // At half the duration: half the stroke at twice the mean rate. At a quarter: 1/4 - 1/2π of the stroke at the mean rate, with
    // the acceleration 2πΔ/L².
    let wave = wave(Shape::Cycloid { stroke: 3.0, flyback: 2.0 }, Timing::every(10.0));
    let up = wave.piece_at(1.0);
    let half = wave.sample(&up, 4.0);
    assert!(
        (half.value - 1.5).abs() < 1e-15
            && (half.rate - 0.75).abs() < 1e-15
            && half.acceleration.abs() < 1e-15
    );
    let quarter = wave.sample(&up, 2.0);
    assert!((quarter.value - 3.0 * (0.25 - 1.0 / TAU)).abs() < 1e-15);
    assert!((quarter.rate - 0.375).abs() < 1e-15 && (quarter.acceleration - TAU * 3.0 / 64.0).abs() < 1e-15);
    assert_eq!(wave.sample(&up, 8.0), Sample { value: 3.0, rate: 0.0, acceleration: 0.0 });
    assert_eq!(wave.resolution(), 0.5);
    let down = wave.after(&up);
    assert!((wave.sample(&down, 9.0).rate + 3.0).abs() < 1e-15);
}

#[test]
fn sine_and_harmonics_by_their_formula() {
    let timing = Timing { delay: 0.5, phase: FRAC_PI_2, ..Timing::every(2.0) };
    let sine = wave(Shape::Sine { amplitude: 3.0, phase: 0.25, offset: 1.0 }, timing);
    let sample = sine.sample(&sine.piece_at(1.2), 1.2);
    let angle = PI * 0.7 + FRAC_PI_2 + 0.25;
    assert!((sample.value - 1.0 - 3.0 * angle.sin()).abs() < 1e-15);
    assert!((sample.rate - 3.0 * PI * angle.cos()).abs() < 1e-14);
    assert!((sample.acceleration + 3.0 * PI * PI * angle.sin()).abs() < 1e-13);
    assert_eq!(sine.range(), (-2.0, 4.0));
    assert!((value(&sine, 0.0) - 1.0 - 3.0 * 0.25_f64.cos()).abs() < 1e-15);
    assert_eq!(sine.resolution(), 0.5);
    // sin θ + ¼ sin 2θ has its extremes at cos θ = (√3-1)/2: ±1.100917 (closed form from cos θ + ½ cos 2θ = 0).
    let terms = [(1.0, 1.0), (0.25, 2.0)].map(|(amplitude, order)| Harmonic { amplitude, order, phase: 0.0 });
    let sum = wave(Shape::Harmonics { terms: terms.to_vec() }, Timing::every(2.0));
    let cos = (3.0_f64.sqrt() - 1.0) / 2.0;
    let top = (1.0 - cos * cos).sqrt() * (1.0 + 0.5 * cos);
    assert_eq!(sum.resolution(), 0.25);
    let (low, high) = sum.range();
    assert!(high >= top && high < top + 1e-5 && low <= -top && low > -top - 1e-5, "{low} {high} {top}");
}

#[test]
fn a_fall_to_zero_never_undershoots() {
    // Evaluation from the end nearer to 0 keeps the sign.
    let mut random = Random(7);
    for _ in 0..2000 {
        let period = random.between(1e-4, 1.0);
        let shape =
            Shape::Sawtooth { stroke: random.between(0.0, 1.0), flyback: random.between(0.1, 0.9) * period };
        let wave = wave(shape, Timing::every(period));
        let mut piece = wave.piece_at(random.between(0.0, 1e3));
        for _ in 0..4 {
            for t in [piece.start, piece.start.next_up(), piece.end.next_down(), piece.end] {
                assert!(wave.sample(&piece, t).value >= 0.0);
            }
            piece = wave.after(&piece);
        }
    }
}

#[test]
fn random_waveforms_are_chains_of_their_formula() {
    let mut random = Random(1);
    for case in 0..3000 {
        let wave = random.wave();
        let period = wave.timing().period;
        let (low, high) = wave.range();
        let size = low.abs().max(high.abs());
        let mut piece = wave.piece_at(random.between(-2.0, 20.0) * period);
        for _ in 0..12 {
            // The piece does not depend on how it is reached, and pieces join.
            if piece.start.is_finite() {
                assert_eq!(wave.piece_at(piece.start), piece, "{case}");
            }
            let from = if piece.start.is_finite() { piece.start } else { piece.end - 3.0 * period };
            let to = piece.end.min(from + 3.0 * period);
            for _ in 0..4 {
                let t = from + (to - from) * random.between(0.01, 0.99);
                assert_eq!(wave.piece_at(t), piece, "{case}");
                let sample = wave.sample(&piece, t);
                // Times have a relative rounding of 1e-15, multiplied by the rate.
                let steep = sample.rate.abs() * 4e-15 * (t.abs() + wave.timing().delay.abs() + 3.0 * period);
                let slack = 1e-13 * size + steep;
                assert!((sample.value - direct(&wave, t)).abs() <= slack, "{case} {wave:?} {t}");
                assert!(sample.value >= low - 1e-15 * size && sample.value <= high + 1e-15 * size, "{case}");
            }
            if piece.end == f64::INFINITY {
                break;
            }
            let next = wave.after(&piece);
            assert_eq!((next.start, next.index), (piece.end, piece.index + 1), "{case}");
            if !wave.has_jumps() {
                assert_eq!(
                    wave.sample(&piece, piece.end).value,
                    wave.sample(&next, next.start).value,
                    "{case}"
                );
                assert_eq!(wave.jump_after(&piece), 0.0);
            }
            piece = next;
        }
    }
}

#[test]
fn rates_are_the_derivatives_of_values() {
    let mut random = Random(3);
    for case in 0..1000 {
        let wave = random.wave();
        let piece = wave.piece_at(random.between(0.0, 4.0) * wave.timing().period);
        let (from, to) = (piece.start.max(-1.0), piece.end.min(piece.start.max(-1.0) + wave.timing().period));
        let (t, h) = (0.5 * (from + to), 1e-4 * (to - from));
        let at = |t: f64| wave.sample(&piece, t);
        let size = wave.range().1.abs().max(wave.range().0.abs()) / (to - from);
        let rate = (at(t + h).value - at(t - h).value) / (2.0 * h);
        let acceleration = (at(t + h).rate - at(t - h).rate) / (2.0 * h);
        // Central differences: h² times a third derivative of up to (9·2π)³.
        assert!((rate - at(t).rate).abs() < 1e-3 * size, "{case}");
        assert!((acceleration - at(t).acceleration).abs() < 0.1 * size / (to - from), "{case}");
    }
}

#[test]
fn pieces_shorter_than_the_spacing_of_doubles_are_skipped() {
    // At 1e4 s a flyback of 1e-13 s is a jump.
    let wave = wave(Shape::Sawtooth { stroke: 1.0, flyback: 1e-13 }, Timing::every(1.0));
    let piece = wave.piece_at(1e4 + 0.5);
    let next = wave.after(&piece);
    assert!(next.start < next.end && (next.start - 10_001.0).abs() < 1e-11);
    assert_eq!(wave.jump_after(&piece), -1.0);
    assert!(wave.sample(&next, next.start).rate.is_finite());
}

#[test]
fn nonsense_is_refused_by_name() {
    let refuse = |shape: Shape, timing: Timing| Waveform::new(shape, timing).unwrap_err();
    let every = Timing::every(0.01);
    let error = refuse(Shape::Sawtooth { stroke: 1.0, flyback: 0.01 }, every);
    assert_eq!(
        error.to_string(),
        "flyback: expected a time of at least 0 and below the period of 0.01 s, got 0.01"
    );
    assert_eq!(refuse(Shape::Cycloid { stroke: 1.0, flyback: -1e-9 }, every).key(), "flyback");
    assert_eq!(refuse(Shape::Cycloid { stroke: 1.0, flyback: f64::NAN }, every).key(), "flyback");
    assert_eq!(refuse(Shape::Triangle { stroke: f64::INFINITY }, every).key(), "stroke");
    assert_eq!(refuse(Shape::Triangle { stroke: 1.0 }, Timing::every(0.0)).key(), "period");
    assert_eq!(refuse(Shape::Triangle { stroke: 1.0 }, Timing { delay: f64::NAN, ..every }).key(), "delay");
    assert_eq!(
        refuse(Shape::Triangle { stroke: 1.0 }, Timing { cycles: Some(0.0), ..every }).key(),
        "cycles"
    );
    assert_eq!(refuse(Shape::Harmonics { terms: vec![] }, every), WaveformError::Empty { key: "terms" });
    let half = Harmonic { amplitude: 1.0, order: 1.5, phase: 0.0 };
    assert_eq!(refuse(Shape::Harmonics { terms: vec![half] }, every).key(), "order");
    let table = |points: &[(f64, f64)]| Shape::Table { points: points.to_vec() };
    assert_eq!(refuse(table(&[]), every).key(), "points");
    assert_eq!(
        refuse(table(&[(0.0, 0.0), (2.0, 1.0), (1.0, 1.0)]), every),
        WaveformError::Times { place: 2, before: 2.0, got: 1.0 }
    );
    assert_eq!(
        refuse(table(&[(0.0, 0.0), (1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]), every),
        WaveformError::Crowd { place: 3, time: 1.0 }
    );
    assert_eq!(refuse(table(&[(0.0, 0.0)]), Timing { phase: 1.0, ..every }).key(), "phase");
}

/// A stroke of 1e308 in a millisecond has an infinite rate.
#[test]
fn values_that_change_beyond_all_numbers_are_refused() {
    let steep = [
        Shape::Sawtooth { stroke: 1e308, flyback: 1e-4 },
        Shape::Sawtooth { stroke: 1e-6, flyback: 5e-324 },
        Shape::Cycloid { stroke: 1e303, flyback: 1e-4 },
        Shape::Triangle { stroke: 1e307 },
        Shape::Sine { amplitude: 1e304, phase: 0.0, offset: 0.0 },
        Shape::Sine { amplitude: 1e302, phase: 0.0, offset: f64::MAX },
        Shape::Harmonics { terms: vec![Harmonic { amplitude: 1e300, order: 1e3, phase: 0.0 }] },
        Shape::Table { points: vec![(0.0, -1e308), (1.0, 1e308)] },
        Shape::Table { points: vec![(0.0, 0.0), (0.0, -1e308), (1e-3, 1.0)] },
    ];
    for shape in steep {
        let text = format!("{shape:?}");
        let error = Waveform::new(shape, Timing::every(0.01)).expect_err(&text);
        assert!(error.to_string().contains("changes at a finite rate"), "{text}: {error}");
    }
}
