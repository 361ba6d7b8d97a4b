//! Other shapes than sawtooth, triangle, sine and cycloid, by closed forms.

use super::*;

fn near(a: f64, b: f64, slack: f64) -> bool {
    (a - b).abs() <= slack
}

/// Compares value, rate and acceleration with a sample.
fn is(wave: &Waveform, t: f64, expected: [f64; 3], slack: f64) {
    let got = wave.sample(&wave.piece_at(t), t);
    let got = [got.value, got.rate, got.acceleration];
    assert!(got.iter().zip(expected).all(|(a, b)| near(*a, b, slack)), "{t}: {got:?} {expected:?}");
}

/// Times of the corners after `t`.
fn corners(wave: &Waveform, t: f64, count: usize) -> Vec<f64> {
    let mut piece = wave.piece_at(t);
    (0..count)
        .map(|_| {
            let end = piece.end;
            piece = wave.after(&piece);
            end
        })
        .collect()
}

/// ∫ value dt by Simpson's rule, exact for cubics.
fn area(wave: &Waveform, from: f64, to: f64) -> f64 {
    let (mut piece, mut sum) = (wave.piece_at(from), 0.0);
    while piece.start < to {
        let (a, b) = (piece.start.max(from), piece.end.min(to));
        let at = |t: f64| wave.sample(&piece, t).value;
        sum += (b - a) / 6.0 * (at(a) + 4.0 * at(0.5 * (a + b)) + at(b));
        piece = wave.after(&piece);
    }
    sum
}

#[test]
fn parabola_goes_by_constant_accelerations() {
    // S = 2, T = 4, turn 1: V = 4S/T = 2, acceleration 2V/(T-τ) = 4/3, of the turn -2V/τ = -4.
    let rounded = wave(Shape::Parabola { stroke: 2.0, turn: 1.0 }, Timing::every(4.0));
    assert_eq!(corners(&rounded, 0.0, 4), [1.5, 2.5, 4.0, 5.5]);
    is(&rounded, 0.0, [0.0, 0.0, 4.0 / 3.0], 1e-15);
    is(&rounded, 0.75, [0.375, 1.0, 4.0 / 3.0], 1e-15);
    is(&rounded, 1.5, [1.5, 2.0, -4.0], 1e-15);
    is(&rounded, 2.0, [2.0, 0.0, -4.0], 1e-15);
    is(&rounded, 3.25, [0.375, -1.0, 4.0 / 3.0], 1e-15);
    assert_eq!((rounded.range(), rounded.period(), rounded.has_jumps()), ((0.0, 2.0), Some(4.0), false));
    // Mean S/3 (1 + τ/T).
    assert!(near(area(&rounded, 0.0, 4.0), 4.0 * 2.0 / 3.0 * (1.0 + 0.25), 1e-14));
    // A cusp: ½at² up to the stroke, a = 8S/T², where the rate jumps from V to -V.
    let cusp = wave(Shape::Parabola { stroke: 2.0, turn: 0.0 }, Timing::every(4.0));
    assert_eq!(corners(&cusp, 0.0, 3), [2.0, 4.0, 6.0]);
    is(&cusp, 1.0, [0.5, 1.0, 1.0], 1e-15);
    let up = cusp.piece_at(1.0);
    assert_eq!(cusp.sample(&up, 2.0).value, 2.0);
    assert!(near(cusp.sample(&up, 2.0).rate, 2.0, 1e-15));
    assert!(near(cusp.sample(&cusp.after(&up), 2.0).rate, -2.0, 1e-15));
    assert!(near(area(&cusp, 0.0, 4.0), 4.0 * 2.0 / 3.0, 1e-14));
}

#[test]
fn trapezoid_rises_holds_falls_and_rests() {
    let shape = Shape::Trapezoid { stroke: -3.0, rise: 1.0, hold: 2.0, fall: 0.5 };
    let whole = wave(shape, Timing::every(5.0));
    assert_eq!(corners(&whole, 0.0, 5), [1.0, 3.0, 3.5, 5.0, 6.0]);
    for (t, expected) in [(0.5, -1.5), (1.0, -3.0), (2.9, -3.0), (3.25, -1.5), (4.0, 0.0), (7.0, -3.0)] {
        assert_eq!(value(&whole, t), expected, "{t}");
    }
    assert_eq!((whole.range(), whole.is_straight(), whole.has_jumps()), ((-3.0, 0.0), true, false));
    assert!(near(area(&whole, 0.0, 5.0), -3.0 * (0.5 + 2.0 + 0.25), 1e-14));
    // Without rise, hold and rest it is a falling sawtooth.
    let saw = wave(
        Shape::Trapezoid { stroke: 1.0, rise: 0.0, hold: 0.0, fall: 2.0 },
        Timing { cycles: Some(2.0), ..Timing::every(2.0) },
    );
    assert_eq!((corners(&saw, 0.0, 2), saw.has_jumps()), (vec![2.0, 4.0], true));
    assert_eq!((value(&saw, 0.0), value(&saw, 1.5), value(&saw, 2.0)), (1.0, 0.25, 1.0));
    // Durations whose sum is the period up to rounding.
    let tenths = Shape::Trapezoid { stroke: 1.0, rise: 0.1, hold: 0.1, fall: 0.1 };
    let full = wave(tenths, Timing::every(0.3));
    assert!(corners(&full, 0.0, 6).windows(2).all(|pair| pair[1] - pair[0] > 0.09));
}

/// A trapezoid without a rise is the limit of one with a short rise.
#[test]
fn a_trapezoid_that_jumps_is_the_limit_of_one_that_rises() {
    let shape = |rise| Shape::Trapezoid { stroke: 2.0, rise, hold: 0.25, fall: 0.5 };
    let full = |rise| Shape::Trapezoid { stroke: 2.0, rise, hold: 0.5 - rise, fall: 0.5 };
    let timing = Timing { delay: 0.5, cycles: Some(2.0), ..Timing::every(1.0) };
    let burst = |rise| Shape::Pattern {
        carrier: Box::new(full(rise)),
        parts: vec![Section::Run { cycles: 2, reversed: false }, Section::Rest { duration: 0.5 }],
    };
    let rested = |rise| Shape::Pattern {
        carrier: Box::new(shape(rise)),
        parts: vec![Section::Rest { duration: 0.5 }, Section::Run { cycles: 1, reversed: false }],
    };
    let kinds: [&dyn Fn(f64) -> Shape; 4] = [&shape, &full, &burst, &rested];
    for (kind, of) in kinds.iter().enumerate() {
        let (jumps, rises) = (wave(of(0.0), timing), wave(of(1e-9), timing));
        for i in 0..700 {
            // Between corners.
            let t = 0.01 * f64::from(i) + 0.005;
            let (got, expected) = (value(&jumps, t), value(&rises, t));
            assert!(near(got, expected, 1e-8), "{kind} {t}: {got} {expected}");
        }
        assert_eq!((value(&jumps, 0.0), value(&jumps, 9.0), jumps.range()), (0.0, 0.0, (0.0, 2.0)));
        // Jumps are reported where they occur.
        let mut piece = jumps.piece_at(0.0);
        while piece.end < f64::INFINITY {
            let next = jumps.after(&piece);
            let jump = jumps.sample(&next, next.start).value - jumps.sample(&piece, piece.end).value;
            assert_eq!(jumps.jump_after(&piece), jump);
            assert!(jump == 0.0 || jump == 2.0, "{kind} {}: {jump}", piece.end);
            piece = next;
        }
    }
}

#[test]
fn s_curve_has_one_jerk_on_each_way() {
    // Down: Δ = -1, L = 1, τ = 1/8: V = -4/3, J = V/τ² = -256/3, largest acceleration Jτ = -32/3.
    let shape = Shape::SCurve { stroke: 1.0, flyback: 1.0, rounding: 0.125 };
    let wave = wave(shape, Timing::every(4.0));
    let (speed, top) = (-4.0 / 3.0, -32.0 / 3.0);
    is(&wave, 3.0, [1.0, 0.0, 0.0], 1e-14);
    is(&wave, 3.125, [1.0 + speed * 0.125 / 6.0, 0.5 * speed, top], 1e-13);
    is(&wave, 3.25, [1.0 + speed * 0.125, speed, 0.0], 1e-13);
    is(&wave, 3.5, [0.5, speed, 0.0], 1e-14);
    is(&wave, 3.875, [-speed * 0.125 / 6.0, 0.5 * speed, -top], 1e-13);
    let down = [3.0, 3.125, 3.25, 3.75, 3.875, 4.0];
    assert_eq!(corners(&wave, 2.9, 6), down);
    // Rates and accelerations are continuous at corners.
    for pair in corners(&wave, 0.0, 40).windows(2) {
        let (left, right) = (wave.piece_at(0.5 * (pair[0] + pair[1])), wave.piece_at(pair[1]));
        let (left, right) = (wave.sample(&left, pair[1]), wave.sample(&right, pair[1]));
        assert!(near(left.rate, right.rate, 1e-13) && near(left.acceleration, right.acceleration, 1e-11));
    }
    // Phases that fill both strokes leave no time at constant velocity.
    let full = super::wave(Shape::SCurve { stroke: 1.0, flyback: 2.0, rounding: 0.5 }, Timing::every(4.0));
    assert_eq!(corners(&full, 0.0, 4), [0.5, 1.0, 1.5, 2.0]);
    is(&full, 1.0, [0.5, 1.0, 0.0], 1e-14);
}

/// The requested flyback rate is 2 per s, the limit is 1.
#[test]
fn a_limited_sawtooth_meets_what_is_asked_for_on_its_way_up() {
    // S = 2, T = 5, τ = 1, r = 1: s = 1/2, u = (2 - 1)/(1 + 1/2) = 2/3, value there 1/3.
    let shape = || Shape::Limited { stroke: 2.0, flyback: 1.0, rate: 1.0 };
    let limited = wave(shape(), Timing::every(5.0));
    assert_eq!((value(&limited, 0.0), value(&limited, 1.0)), (0.0, 0.5));
    let ends = corners(&limited, 0.0, 4);
    for (end, expected) in ends.iter().zip([4.0, 5.0 + 2.0 / 3.0, 9.0, 10.0 + 2.0 / 3.0]) {
        assert!(near(*end, expected, 1e-15 * 16.0), "{ends:?}");
    }
    is(&limited, 4.5, [1.5, -1.0, 0.0], 1e-15);
    is(&limited, 5.5, [0.5, -1.0, 0.0], 1e-15);
    is(&limited, 6.0, [0.5, 0.5, 0.0], 1e-15);
    assert_eq!((limited.range(), limited.period(), limited.has_jumps()), ((0.0, 2.0), Some(5.0), false));
    // After the first top it is a sawtooth with a reduced stroke and a longer flyback.
    let low = 1.0 / 3.0;
    let plain = wave(Shape::Sawtooth { stroke: 2.0 - low, flyback: 5.0 / 3.0 }, Timing::every(5.0));
    for i in 0..200 {
        let t = 4.0 + 0.1 * f64::from(i);
        assert!(near(value(&limited, t), low + value(&plain, t - 2.0 / 3.0), 1e-14), "{t}");
    }
    // A limited jump; a limit without effect; a limit equal to the rise.
    let jump = wave(Shape::Limited { stroke: -2.0, flyback: 0.0, rate: 4.0 }, Timing::every(5.0));
    assert!(!jump.has_jumps() && near(value(&jump, 5.25), -1.0, 1e-14));
    let easy = wave(Shape::Limited { stroke: 2.0, flyback: 1.0, rate: 2.0 }, Timing::every(5.0));
    assert_eq!(corners(&easy, 0.0, 3), [4.0, 5.0, 9.0]);
    let phased = wave(shape(), Timing { phase: 1e-3, ..Timing::every(5.0) });
    assert!(near(phased.range().0, low, 1e-15) && value(&phased, 0.0) > low);
    let slow = Waveform::new(Shape::Limited { stroke: 2.0, flyback: 1.0, rate: 0.4 }, Timing::every(5.0));
    assert_eq!(slow.unwrap_err(), WaveformError::Rate { least: 0.5, got: 0.4 });
}

/// Before its first top it is a ramp, wherever it stops.
#[test]
fn a_limited_sawtooth_that_stops_early_has_only_risen() {
    for delay in [0.0, 3.0, 1e3] {
        // A delayed return of the previous period would end at 2/3.
        for stop in [0.25, 0.5, 2.0 / 3.0, 1.0, 3.5] {
            let timing = Timing { delay, cycles: Some(stop / 5.0), ..Timing::every(5.0) };
            let short = wave(Shape::Limited { stroke: 2.0, flyback: 1.0, rate: 1.0 }, timing);
            for (t, expected) in
                [(-0.1, 0.0), (0.0, 0.0), (0.5, 0.25), (0.999, 0.4995), (1.001, 0.5), (9.0, 0.5)]
            {
                let t = delay + t * stop;
                assert!(
                    near(value(&short, t), expected * stop, 1e-12),
                    "{delay} {stop} {t}: {}",
                    value(&short, t)
                );
            }
            let last = short.after(&short.piece_at(delay));
            assert_eq!((last.end, short.jump_after(&last)), (f64::INFINITY, 0.0));
        }
        // A delayed return so short that its end rounds to the start.
        let timing = Timing { delay, ..Timing::every(5.0) };
        let hair = wave(Shape::Limited { stroke: 2.0, flyback: 1.0, rate: 2.0 * (1.0 - 1e-15) }, timing);
        assert!(
            near(value(&hair, delay + 2.0), 1.0, 1e-12) && near(hair.piece_at(delay).end - delay, 4.0, 1e-12)
        );
    }
}

#[test]
fn chirp_sweeps_its_frequency_linearly() {
    // From 1 to 3 Hz in 2 s: turns s + s²/2, four in all.
    let sweep = Sweep { amplitude: 2.0, offset: 5.0, phase: 0.0, from: 1.0, to: 3.0, duration: 2.0 };
    let timing = Timing { delay: 1.0, ..Timing::every(1.0) };
    let chirp = wave(Shape::Chirp(sweep), timing);
    assert_eq!((chirp.window(), chirp.period(), chirp.range()), ((1.0, 3.0), None, (3.0, 7.0)));
    // Cubic pieces do not limit steps.
    let parabola = wave(Shape::Parabola { stroke: 1.0, turn: 0.125 }, Timing::every(1.0));
    assert_eq!((parabola.resolution(), parabola.quickest()), (f64::INFINITY, 0.125));
    assert_eq!((value(&chirp, 0.0), chirp.resolution()), (5.0, 0.25 / 3.0));
    let s = 0.7;
    let (angle, omega) = (TAU * (s + 0.5 * s * s), TAU * (1.0 + s));
    let sample = [
        5.0 + 2.0 * angle.sin(),
        2.0 * omega * angle.cos(),
        2.0 * (TAU * angle.cos() - omega * omega * angle.sin()),
    ];
    is(&chirp, 1.0 + s, sample, 1e-12);
    // The mean is crossed at half turns: s = √(1 + n) - 1.
    for n in 1..8 {
        assert!(near(value(&chirp, f64::from(1 + n).sqrt()), 5.0, 1e-13), "{n}");
    }
    // Constant afterwards, without a jump.
    let last = chirp.piece_at(2.9);
    assert_eq!((last.end, chirp.jump_after(&last)), (3.0, 0.0));
    assert!(near(value(&chirp, 9.0), 5.0, 1e-13));
    // With equal frequencies it is a sine; below a quarter of a turn its extremes are at its ends.
    let even = Sweep { from: 3.0, phase: 0.4, ..sweep };
    let (even, sine) = (
        wave(Shape::Chirp(even), Timing::every(1.0)),
        wave(Shape::Sine { amplitude: 2.0, phase: 0.4, offset: 5.0 }, Timing::every(1.0 / 3.0)),
    );
    for i in 0..40 {
        let t = 0.049 * f64::from(i);
        assert!(near(value(&even, t), value(&sine, t), 1e-13), "{t}");
    }
    let short = Sweep { from: 0.0, to: 0.1, ..sweep };
    let (low, high) = wave(Shape::Chirp(short), Timing::every(1.0)).range();
    assert!(low == 5.0 && near(high, 5.0 + 2.0 * (TAU * 0.1).sin(), 1e-15));
    let down = Sweep { amplitude: -2.0, ..short };
    let (low, high) = wave(Shape::Chirp(down), Timing::every(1.0)).range();
    assert!(high == 5.0 && near(low, 5.0 - 2.0 * (TAU * 0.1).sin(), 1e-15));
    for (from, to, key) in [(0.0, 0.0, "to"), (-1.0, 2.0, "from"), (1.0, f64::NAN, "to")] {
        let error = Waveform::new(Shape::Chirp(Sweep { from, to, ..sweep }), timing).unwrap_err();
        assert_eq!(error.key(), key);
    }
}

#[test]
fn step_jumps_once() {
    let step = wave(Shape::Step { height: -2.0, at: 0.5 }, Timing { delay: 1.0, ..Timing::every(1.0) });
    let before = step.piece_at(0.0);
    assert_eq!((before.end, step.jump_after(&before), step.has_jumps()), (1.5, -2.0, true));
    assert_eq!(
        (value(&step, 1.5_f64.next_down()), value(&step, 1.5), step.range()),
        (0.0, -2.0, (-2.0, 0.0))
    );
}

/// A pattern of one run has the bits of its shape; one of runs and rests agrees with a table of the same corners.
#[test]
fn a_pattern_is_its_shape_run_by_run() {
    let saw = || Shape::Sawtooth { stroke: 1.0, flyback: 0.25 };
    let run = |cycles, reversed| Section::Run { cycles, reversed };
    let pattern =
        |parts: Vec<Section>, timing| wave(Shape::Pattern { carrier: Box::new(saw()), parts }, timing);
    let (single, plain) = (pattern(vec![run(1, false)], Timing::every(2.0)), wave(saw(), Timing::every(2.0)));
    for i in 0..100 {
        let t = 0.377 * f64::from(i);
        assert_eq!(value(&single, t), value(&plain, t), "{t}");
    }
    let parts = vec![run(2, false), Section::Rest { duration: 1.5 }, run(1, true)];
    let whole = pattern(parts.clone(), Timing::every(2.0));
    assert_eq!((whole.period(), whole.range()), (Some(7.5), (0.0, 1.0)));
    let points =
        [(0.0, 0.0), (1.75, 1.0), (2.0, 0.0), (3.75, 1.0), (4.0, 0.0), (5.5, 0.0), (5.75, 1.0), (7.5, 0.0)];
    let table = wave(Shape::Table { points: points.to_vec() }, Timing::every(1.0));
    for i in 0..75 {
        let t = 0.1 * f64::from(i);
        assert!(near(value(&whole, t), value(&table, t), 1e-14), "{t}");
        assert!(near(value(&whole, t + 7.5), value(&table, t), 1e-13), "{t}");
    }
    assert_eq!(corners(&whole, 0.0, 8), [1.75, 2.0, 3.75, 4.0, 5.5, 5.75, 7.5, 9.25]);
    // The phase counts in cycles of the shape.
    let ahead = pattern(parts.clone(), Timing { phase: 3.0 * PI, ..Timing::every(2.0) });
    assert!((0..70).all(|i| near(
        value(&ahead, 0.1 * f64::from(i)),
        value(&whole, 3.0 + 0.1 * f64::from(i)),
        1e-13
    )));
    // Cycles count whole patterns.
    let once = pattern(parts, Timing { cycles: Some(1.0), ..Timing::every(2.0) });
    assert_eq!((once.window(), value(&once, 100.0)), ((0.0, 7.5), 0.0));
}

#[test]
fn a_burst_of_sines_begins_anew_each_time() {
    let sine = Shape::Sine { amplitude: 2.0, phase: 0.0, offset: 1.0 };
    let parts = vec![Section::Run { cycles: 3, reversed: false }, Section::Rest { duration: 0.7 }];
    let burst = wave(Shape::Pattern { carrier: Box::new(sine), parts }, Timing::every(0.1));
    assert!(near(burst.period().unwrap(), 1.0, 1e-15));
    for k in 0..5 {
        let k = f64::from(k);
        assert!(near(value(&burst, k + 0.025), 3.0, 1e-12) && value(&burst, k + 0.5) == 1.0);
        is(
            &burst,
            k + 0.11,
            [1.0 + 2.0 * (0.2 * PI).sin(), 40.0 * PI * (0.2 * PI).cos(), -800.0 * PI * PI * (0.2 * PI).sin()],
            1e-9,
        );
    }
    // At the end of a run the rate from the left is that of the sine; the value is exactly that of the rest.
    let run = burst.piece_at(0.2);
    assert_eq!((burst.jump_after(&run), burst.is_straight()), (0.0, false));
    assert!(near(burst.sample(&run, run.end).rate, 40.0 * PI, 1e-10));
}

#[test]
fn patterns_that_make_no_sense_are_refused_by_name() {
    let refuse = |carrier: Shape, parts: &[Section]| {
        let shape = Shape::Pattern { carrier: Box::new(carrier), parts: parts.to_vec() };
        Waveform::new(shape, Timing::every(1.0)).unwrap_err()
    };
    let (run, back) =
        (Section::Run { cycles: 2, reversed: false }, Section::Run { cycles: 2, reversed: true });
    let rest = |duration| Section::Rest { duration };
    let saw = || Shape::Sawtooth { stroke: 1.0, flyback: 0.1 };
    assert_eq!(refuse(saw(), &[run, rest(0.0)]).key(), "dwell");
    assert_eq!(refuse(saw(), &[rest(1.0)]).key(), "sequence");
    assert_eq!(refuse(saw(), &[Section::Run { cycles: 0, reversed: false }]).key(), "cycles");
    assert_eq!(refuse(saw(), &[Section::Run { cycles: 10_001, reversed: false }]).key(), "cycles");
    let jump = Shape::Sawtooth { stroke: 1.0, flyback: 0.0 };
    assert_eq!(refuse(jump, &[run, back]), WaveformError::Reversed);
    let limited = Shape::Limited { stroke: 1.0, flyback: 0.1, rate: 2.0 };
    assert_eq!(refuse(limited, &[run]), WaveformError::Carrier);
    assert_eq!(refuse(Shape::Table { points: vec![(0.0, 1.0), (1.0, 2.0)] }, &[run]), WaveformError::Carrier);
}

/// Rates by the formula of Fritsch and Butland for slopes 1, 2 and -1 over 1, 2 and 1 s.
#[test]
fn a_curve_is_its_cubics() {
    let points = vec![(0.0, 0.0), (1.0, 1.0), (3.0, 5.0), (4.0, 4.0)];
    let shape = |smooth, repeated| Shape::Curve { points: points.clone(), smooth, repeated };
    let curve = wave(shape(true, false), Timing { delay: 10.0, ..Timing::every(1.0) });
    // Start: ((2·1 + 2)·1 - 1·2)/3 = 2/3. At 1 s: weights 5 and 4, 9/(5/1 + 4/2) = 9/7. A top at 3 s: 0. End: ((2 + 2)(-1) - 2)/3 = -2.
    let rates = [2.0 / 3.0, 9.0 / 7.0, 0.0, -2.0];
    for ((t, v), rate) in points.iter().zip(rates) {
        let at = 10.0 + t;
        if at < 14.0 {
            let sample = curve.sample(&curve.piece_at(at), at);
            assert!(sample.value == *v && near(sample.rate, rate, 1e-14), "{t} {sample:?}");
        }
        if *t > 0.0 {
            let before = curve.sample(&curve.piece_at(at - 0.5), at);
            assert!(before.value == *v && near(before.rate, rate, 1e-14), "{t} {before:?}");
        }
    }
    assert_eq!((corners(&curve, 10.0, 3), curve.range()), (vec![11.0, 13.0, 14.0], (0.0, 5.0)));
    assert_eq!((value(&curve, 0.0), value(&curve, 99.0), curve.period()), (0.0, 4.0, None));
    // Linear and once it is the table.
    let table = wave(Shape::Table { points: points.clone() }, Timing::every(1.0));
    let straight = wave(shape(false, false), Timing::every(1.0));
    assert!((0..90).all(|i| value(&straight, 0.05 * f64::from(i)) == value(&table, 0.05 * f64::from(i))));
    // Repeated without closing it jumps; its period begins at the first point.
    let again = wave(shape(false, true), Timing::every(1.0));
    assert_eq!(
        (again.period(), again.has_jumps(), value(&again, 4.0), value(&again, 9.0)),
        (Some(4.0), true, 0.0, 1.0)
    );
}

/// A smooth closed curve through a sine has continuous rates at its seam.
#[test]
fn a_curve_that_closes_has_no_seam() {
    let mut points: Vec<(f64, f64)> =
        (0..=64).map(|i| f64::from(i) / 64.0).map(|t| (t, (TAU * t).cos())).collect();
    points[64].1 = points[0].1;
    let shape = Shape::Curve {
        points: points.iter().map(|(t, v)| (t + 2.0, *v)).collect(),
        smooth: true,
        repeated: true,
    };
    let wave = wave(shape, Timing::every(1.0));
    assert_eq!((wave.period(), wave.window().0, wave.has_jumps()), (Some(1.0), 2.0, false));
    for i in 0..500 {
        let t = 2.0 + 0.00731 * f64::from(i);
        // The method has second order at extremes.
        assert!(near(value(&wave, t), (TAU * t).cos(), 2e-3), "{t}");
    }
    let seam = wave.piece_at(2.99);
    let (left, right) = (wave.sample(&seam, seam.end), wave.sample(&wave.after(&seam), seam.end));
    assert_eq!((left.value, left.rate), (right.value, right.rate));
    assert!(wave.range() == (-1.0, 1.0));
}

/// The value stays between those of the adjacent points.
#[test]
fn smooth_curves_keep_the_shape_of_their_points() {
    let mut random = Random(23);
    for _ in 0..300 {
        let mut t = 0.0;
        let points: Vec<(f64, f64)> = (0..12)
            .map(|_| {
                t += 10.0_f64.powf(random.between(-3.0, 1.0));
                // Includes plateaus.
                (t, (random.between(-1.0, 1.0) * 4.0).round() * random.between(0.5, 1.0))
            })
            .collect();
        let curve =
            wave(Shape::Curve { points: points.clone(), smooth: true, repeated: false }, Timing::every(1.0));
        for pair in points.windows(2) {
            let (low, high) = (pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1));
            let piece = curve.piece_at(0.5 * (pair[0].0 + pair[1].0));
            for i in 0..=20 {
                let t = (pair[0].0 + (pair[1].0 - pair[0].0) * f64::from(i) / 20.0).min(pair[1].0);
                let sample = curve.sample(&piece, t);
                assert!(sample.value >= low - 1e-15 && sample.value <= high + 1e-15, "{pair:?} {t}");
                let mean = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
                assert!(sample.rate * mean >= -1e-12 * mean * mean, "{pair:?} {t}");
            }
        }
    }
}

#[test]
fn what_leaves_no_time_is_refused_by_name() {
    let refuse = |shape: Shape| Waveform::new(shape, Timing::every(1.0)).unwrap_err().key();
    assert_eq!(refuse(Shape::Parabola { stroke: 1.0, turn: 1.0 }), "turn");
    assert_eq!(refuse(Shape::Parabola { stroke: 1.0, turn: -0.1 }), "turn");
    assert_eq!(refuse(Shape::Trapezoid { stroke: 1.0, rise: 0.5, hold: 0.5, fall: 0.1 }), "rise");
    assert_eq!(refuse(Shape::Trapezoid { stroke: 1.0, rise: 0.0, hold: 0.0, fall: 0.0 }), "rise");
    assert_eq!(refuse(Shape::Trapezoid { stroke: 1.0, rise: 0.1, hold: -0.1, fall: 0.1 }), "hold");
    assert_eq!(refuse(Shape::SCurve { stroke: 1.0, flyback: 0.2, rounding: 0.06 }), "rounding");
    assert_eq!(refuse(Shape::SCurve { stroke: 1.0, flyback: 0.2, rounding: 0.0 }), "rounding");
    assert_eq!(refuse(Shape::SCurve { stroke: 1.0, flyback: 0.0, rounding: 0.1 }), "flyback");
    let repeat =
        |points: &[(f64, f64)]| Shape::Curve { points: points.to_vec(), smooth: true, repeated: true };
    assert_eq!(refuse(repeat(&[(1.0, 1.0)])), "points");
    assert_eq!(refuse(repeat(&[(1.0, 1.0), (0.5, 1.0)])), "points");
    assert_eq!(refuse(Shape::Step { height: f64::NAN, at: 0.0 }), "height");
}

/// A linear piece is no larger than its own data requires.
#[test]
fn a_piece_is_as_small_as_its_straight_way() {
    use crate::waveform::shape::Law;
    use crate::waveform::straight::Straight;
    assert_eq!(size_of::<Law>(), size_of::<Straight>() + size_of::<u64>());
    assert_eq!(size_of::<Piece>(), size_of::<Law>() + 3 * size_of::<u64>());
}
