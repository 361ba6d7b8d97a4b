//! Pieces by index, and supplied pieces.

use super::*;
use Interpolation::{Held, Linear};

fn input(initial: f64, range: (f64, f64), interpolation: Interpolation) -> Waveform {
    wave(Shape::Input { initial, range, interpolation }, Timing::every(1.0))
}

/// All bits of a piece: times, index, values and derivatives at three times.
fn bits(wave: &Waveform, piece: &Piece) -> Vec<u64> {
    let from = if piece.start.is_finite() { piece.start } else { piece.end - 1.0 };
    let to = if piece.end.is_finite() { piece.end } else { from + 1.0 };
    let samples = [from, 0.7 * from + 0.3 * to, to].map(|t| wave.sample(piece, t));
    let values = samples.iter().flat_map(|sample| [sample.value, sample.rate, sample.acceleration]);
    [piece.start, piece.end].into_iter().chain(values).map(f64::to_bits).chain([piece.index]).collect()
}

/// Compares the pieces from `t` on with those by index, and returns their number.
fn walk(wave: &Waveform, t: f64) -> usize {
    let mut piece = wave.piece_at(t);
    for count in 1..=400 {
        let same = wave.piece(piece.index).unwrap_or_else(|| panic!("{wave:?} has no {}", piece.index));
        assert_eq!(same, piece);
        assert_eq!(bits(wave, &same), bits(wave, &piece), "{wave:?}");
        if piece.end == f64::INFINITY {
            // No piece follows the last one.
            assert_eq!(wave.piece(piece.index + 1), None, "{wave:?}");
            assert_eq!(wave.piece(u64::MAX), None, "{wave:?}");
            return count;
        }
        piece = wave.after(&piece);
    }
    400
}

#[test]
fn every_piece_is_given_back_by_its_index() {
    let mut random = Random(11);
    let mut walked = [0_usize; 11];
    for _ in 0..600 {
        let wave = random.wave();
        let kind = match wave.shape() {
            Shape::Sawtooth { .. } => 0,
            Shape::Triangle { .. } => 1,
            Shape::Sine { .. } => 2,
            Shape::Harmonics { .. } => 3,
            Shape::Cycloid { .. } => 4,
            Shape::Parabola { .. } => 6,
            Shape::Trapezoid { .. } => 7,
            Shape::SCurve { .. } => 8,
            Shape::Limited { .. } => 9,
            Shape::Pattern { .. } => 10,
            _ => 5,
        };
        // From t = 0, and from before the delay or the first point.
        walked[kind] = walked[kind].max(walk(&wave, 0.0));
        walked[kind] = walked[kind].max(walk(&wave, -1e9));
    }
    // Chains of corners are endless; sines have three pieces; a table of nine points has at most eight segments.
    assert!([0, 1, 4, 6, 7, 8, 9, 10].iter().all(|kind| walked[*kind] == 400), "{walked:?}");
    assert_eq!((walked[2], walked[3]), (3, 3));
    assert!((4..=10).contains(&walked[5]), "{walked:?}");
}

#[test]
fn pieces_of_single_steps_and_beyond_skipped_ones_are_given_back() {
    let step = wave(Shape::Table { points: vec![(1.0, 7.0), (1.0, 8.0)] }, Timing::every(1.0));
    assert_eq!((walk(&step, 0.0), step.piece(2)), (2, None));
    let far = wave(Shape::Sawtooth { stroke: 1.0, flyback: 1e-13 }, Timing::every(1.0));
    assert_eq!(walk(&far, 1e4 + 0.5), 400);
    let sine = wave(Shape::Sine { amplitude: 1.0, phase: 0.0, offset: 0.0 }, Timing::every(1.0));
    // An endless sine has no piece after it.
    assert_eq!((walk(&sine, -1.0), sine.piece(2)), (2, None));
    let delayed = Timing { delay: 1.0, cycles: Some(2.0), ..Timing::every(1.0) };
    let sine = wave(Shape::Sine { amplitude: 1.0, phase: 0.0, offset: 0.0 }, delayed);
    assert_eq!((walk(&sine, 0.0), sine.piece(3)), (3, None));
}

#[test]
fn an_input_holds_its_initial_value_at_all_times() {
    for interpolation in [Held, Linear] {
        let wave = input(3.0, (-1.0, 4.0), interpolation);
        for t in [-1e9, -1.0, 0.0, 1e-9, 1.0, 1e12] {
            let piece = wave.piece_at(t);
            assert!(piece.start <= 0.0 && piece.end == f64::INFINITY, "{piece:?}");
            assert_eq!(wave.sample(&piece, t), Sample { value: 3.0, rate: 0.0, acceleration: 0.0 });
            assert_eq!((wave.after(&piece), wave.jump_after(&piece)), (piece, 0.0));
            assert_eq!(wave.piece(piece.index), None);
        }
        assert_eq!(wave.first(), Sample { value: 3.0, rate: 0.0, acceleration: 0.0 });
        assert_eq!((wave.period(), wave.range(), wave.resolution()), (None, (-1.0, 4.0), f64::INFINITY));
        assert_eq!((wave.is_straight(), wave.interpolation()), (true, Some(interpolation)));
        assert_eq!(wave.has_jumps(), interpolation == Held);
        // A range of one value allows no jump.
        assert!(!input(3.0, (3.0, 3.0), interpolation).has_jumps());
    }
    let sawtooth = wave(Shape::Sawtooth { stroke: 1.0, flyback: 0.1 }, Timing::every(1.0));
    assert_eq!(sawtooth.interpolation(), None);
}

#[test]
fn supplied_pieces_jump_end_and_are_kept() {
    let wave = input(0.0, (-10.0, 10.0), Held);
    let (first, second) = (wave.piece_at(0.0), Piece::held(0.25, 4.0));
    // A held piece ends where the next one starts.
    assert_eq!(wave.jump_between(&first, &second), 4.0);
    assert_eq!(wave.jump_between(&second, &Piece::held(0.5, -1.5)), -5.5);
    let wave = input(0.0, (-10.0, 10.0), Linear);
    let rise = Piece::straight((1.0, -2.0), (3.0, 6.0));
    assert_eq!(wave.sample(&rise, 1.0), Sample { value: -2.0, rate: 4.0, acceleration: 0.0 });
    assert_eq!(wave.sample(&rise, 1.5).value, 0.0);
    assert_eq!(wave.sample(&rise, 3.0).value, 6.0);
    // The final value is held without a jump.
    let kept = wave.after(&rise);
    assert_eq!((kept.start, kept.end, wave.jump_after(&rise)), (3.0, f64::INFINITY, 0.0));
    assert_eq!(wave.sample(&kept, 9.0), Sample { value: 6.0, rate: 0.0, acceleration: 0.0 });
    // Cut at half its time, the value is half way.
    assert_eq!(wave.jump_between(&rise, &Piece::straight((2.0, 2.0), (4.0, 0.0))), 0.0);
    assert_eq!(wave.jump_between(&rise, &Piece::held(2.0, 3.0)), 1.0);
}

/// An input that is fed the corners of a sawtooth has the same bits.
#[test]
fn a_sawtooth_fed_piece_by_piece_has_the_same_bits() {
    let mut random = Random(5);
    for _ in 0..200 {
        let period = 10.0_f64.powf(random.between(-5.0, 1.0));
        let stroke = random.between(-1e-5, 1e-5);
        // Half of them jump.
        let flyback = if random.between(0.0, 1.0) < 0.5 { 0.0 } else { random.between(0.01, 0.9) * period };
        let saw = wave(Shape::Sawtooth { stroke, flyback }, Timing::every(period));
        let fed = input(0.0, (stroke.min(0.0), stroke.max(0.0)), Linear);
        let supplied = |piece: &Piece| {
            let at = |t: f64| (t, saw.sample(piece, t).value);
            Piece { index: piece.index, ..Piece::straight(at(piece.start), at(piece.end)) }
        };
        let mut piece = saw.piece_at(0.0);
        for _ in 0..50 {
            let next = saw.after(&piece);
            let (own, own_next) = (supplied(&piece), supplied(&next));
            assert_eq!(bits(&fed, &own), bits(&saw, &piece));
            let jumps =
                [saw.jump_after(&piece), saw.jump_between(&piece, &next), fed.jump_between(&own, &own_next)];
            assert_eq!(jumps.map(f64::to_bits), [jumps[0].to_bits(); 3], "{jumps:?}");
            piece = next;
        }
    }
}

#[test]
fn inputs_that_make_no_sense_are_refused_by_name() {
    let every = Timing::every(1.0);
    let refuse = |initial: f64, range: (f64, f64), timing: Timing| {
        let shape = Shape::Input { initial, range, interpolation: Linear };
        Waveform::new(shape, timing).unwrap_err()
    };
    let error = refuse(0.0, (2.0, 1.0), every);
    assert_eq!(error, WaveformError::Range { low: 2.0, high: 1.0 });
    assert_eq!(error.key(), "range");
    let error = refuse(3.0, (1.0, 2.0), every);
    assert_eq!(error, WaveformError::Initial { low: 1.0, high: 2.0, got: 3.0 });
    assert_eq!(error.to_string(), "initial: expected a value in the range from 1 to 2, got 3");
    for initial in [f64::NAN, f64::INFINITY] {
        assert_eq!(refuse(initial, (0.0, 1.0), every).key(), "initial");
    }
    for range in [(f64::NAN, 1.0), (0.0, f64::NAN), (f64::NEG_INFINITY, 1.0), (0.0, f64::INFINITY)] {
        assert_eq!(refuse(0.5, range, every).key(), "range");
    }
    // Both bounds are finite, but their difference is not.
    assert!(refuse(0.0, (-1e308, 1e308), every).to_string().contains("changes at a finite rate"));
    let timings = [
        ("delay", Timing { delay: 1e-3, ..every }),
        ("delay", Timing { delay: f64::NAN, ..every }),
        ("phase", Timing { phase: 0.1, ..every }),
        ("cycles", Timing { cycles: Some(2.0), ..every }),
    ];
    for (key, timing) in timings {
        assert_eq!(refuse(0.5, (0.0, 1.0), timing).key(), key);
    }
}
