use super::Plays;

/// Model with uneven thresholds and weights.
fn uneven() -> Plays {
    Plays::new(0.7, vec![0.05, 0.2, 0.21, 0.6, 1.1], vec![0.1, 0.05, 0.3, 0.02, 0.4]).unwrap()
}

/// Outputs at the reversals of an input that starts from 0.
fn walk(plays: &Plays, turns: &[f64]) -> Vec<f64> {
    let mut places = plays.start(0.0);
    turns.iter().map(|&v| (plays.drag(&mut places, v), value(plays, &places, v)).1).collect()
}

/// Output by definition: w₀ v + Σ wᵢ pᵢ.
fn value(plays: &Plays, places: &[f64], v: f64) -> f64 {
    plays.direct() * v + plays.weights().iter().zip(places).map(|(w, p)| w * p).sum::<f64>()
}

/// After a reversal at v₁ the output changes by 2φ(|v - v₁|/2), with φ computed from its definition.
#[test]
fn branches_are_the_initial_curve_twice_as_large() {
    let plays = uneven();
    let phi = |v: f64| {
        let terms = plays.thresholds().iter().zip(plays.weights()).map(|(r, w)| w * (v - r).max(0.0));
        plays.direct() * v + terms.sum::<f64>()
    };
    let top = 2.0;
    for k in 0..=200 {
        let v = 0.02 * f64::from(k) - top;
        let y = walk(&plays, &[top, v]);
        assert!((y[0] - phi(top)).abs() < 1e-15 * 4.0);
        assert!((y[0] - y[1] - 2.0 * phi(0.5 * (top - v))).abs() < 1e-14, "{v}");
    }
}

#[test]
fn loops_close_and_are_forgotten() {
    let plays = uneven();
    let y = walk(&plays, &[1.7, -0.4, 0.9, -0.4, 1.7, -1.2, 1.7]);
    assert_eq!(y[1].to_bits(), y[3].to_bits(), "a minor loop closes");
    assert_eq!(y[0].to_bits(), y[4].to_bits(), "and so does the large one, as if the minor one had not been");
    assert_eq!(y[0].to_bits(), y[6].to_bits());
    // Wiping-out: an input beyond the largest reversal erases all others.
    let plain = walk(&plays, &[2.3]);
    let worn = walk(&plays, &[1.7, -0.4, 0.9, -0.2, 0.5, 2.3]);
    assert!((plain[0] - worn[5]).abs() < 1e-15 * 4.0);
}

/// Congruency: the minor loop has the same shape at three positions in the large loop.
#[test]
fn equal_minor_loops_are_equal_wherever_they_lie() {
    let plays = uneven();
    let inside = |way_there: &[f64]| {
        let mut places = plays.start(0.0);
        way_there.iter().for_each(|&v| plays.drag(&mut places, v));
        // One cycle closes the loop; then the path from the lower end to the upper one and back is recorded.
        [0.3, -0.5].iter().for_each(|&v| plays.drag(&mut places, v));
        let from = value(&plays, &places, -0.5);
        let path: Vec<f64> = (1..=32)
            .map(|k| if k <= 16 { -0.5 + 0.05 * f64::from(k) } else { 0.3 - 0.05 * f64::from(k - 16) })
            .map(|v| (plays.drag(&mut places, v), value(&plays, &places, v) - from).1)
            .collect();
        (from, path)
    };
    let loops = [inside(&[1.5, -1.5]), inside(&[1.5]), inside(&[-1.5])];
    assert!((loops[0].0 - loops[1].0).abs() > 0.1, "they lie at different heights");
    for other in &loops[1..] {
        for (a, b) in loops[0].1.iter().zip(&other.1) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }
}

/// Compares the area of a polygon through the corners of the loop with the closed form. The rising corners are at -X/2 + 2rᵢ.
#[test]
fn the_area_of_a_loop_is_that_of_its_closed_form() {
    let plays = uneven();
    for stroke in [0.08, 0.9, 2.7] {
        let (low, high) = (-0.5 * stroke, 0.5 * stroke);
        let corners = plays.thresholds().iter().map(|r| 2.0 * r).filter(|way| *way < stroke);
        let ways: Vec<f64> = corners.chain([stroke]).collect();
        let mut places = plays.start(0.0);
        [high, low].iter().for_each(|&v| plays.drag(&mut places, v));
        let up = ways.iter().map(|way| low + way);
        let down = ways.iter().map(|way| high - way);
        let (mut last, mut area) = ((low, value(&plays, &places, low)), 0.0);
        for v in up.chain(down) {
            plays.drag(&mut places, v);
            let y = value(&plays, &places, v);
            area -= 0.5 * (y + last.1) * (v - last.0);
            last = (v, y);
        }
        assert!((area - plays.area(stroke)).abs() < 1e-10 * plays.area(stroke).max(1e-12), "{area}");
        assert!((stroke < 0.1) == (plays.area(stroke) == 0.0));
    }
}

/// The loop has the specified width, the stroke is kept, and smaller loops are narrower (Rayleigh's law).
#[test]
fn a_width_that_is_asked_for_is_measured() {
    for (width, count) in [(0.12, 10), (0.12, 7), (0.02, 1), (0.3, 64), (0.49, 2)] {
        let (stroke, steps) = (4.6e-6, 2000);
        let plays = Plays::of_loop(width, stroke, count).unwrap();
        let mut places = plays.start(0.0);
        let mut go = |v: f64| (plays.drag(&mut places, v), value(&plays, &places, v)).1;
        let top = (go(stroke), go(0.0), go(stroke)).2;
        let at = |k: i32| stroke * f64::from(k) / f64::from(steps);
        let down: Vec<f64> = (0..=steps).map(|k| go(at(steps - k))).collect();
        let up: Vec<f64> = (0..=steps).map(|k| go(at(k))).collect();
        let gaps = up.iter().zip(down.iter().rev()).map(|(up, down)| down - up);
        let widest = gaps.fold(0.0, f64::max);
        assert!((top - up[0] - stroke).abs() < 1e-13 * stroke, "the stroke is kept: {}", top - up[0]);
        assert!((widest - width * stroke).abs() < 1e-12 * stroke, "{widest} {width} {count}");
        assert!((plays.width(stroke) - widest).abs() < 1e-12 * stroke);
        if count >= 10 {
            let half = plays.width(0.5 * stroke) / plays.stroke(0.5 * stroke);
            // Constant density of thresholds: a quarter of the width at S, over the stroke (1 - width)S/2.
            let dense = 0.5 * width / (1.0 - width);
            assert!((half - dense).abs() < 0.05 * dense, "{half} {dense}");
        }
    }
}

/// Inverse and model in series return the input, in both orders.
#[test]
fn the_inverse_undoes_the_law() {
    for plays in [uneven(), Plays::of_loop(0.15, 2.0, 10).unwrap()] {
        let inverse = plays.inverse();
        let (mut places, mut inverted) = (plays.start(0.0), inverse.start(0.0));
        let mut v = 0.0_f64;
        for k in 0..4000 {
            // The input never repeats.
            v += 0.11 * (0.37 * f64::from(k)).sin() + 0.05 * (0.051 * f64::from(k)).cos();
            inverse.drag(&mut inverted, v);
            let asked = value(&inverse, &inverted, v);
            plays.drag(&mut places, asked);
            let y = value(&plays, &places, asked);
            assert!((y - v).abs() < 1e-13, "{k}: {v} {y}");
        }
        assert!(v.abs() > 0.01);
        let again = inverse.inverse();
        for (a, b) in again.thresholds().iter().zip(plays.thresholds()) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}

#[test]
fn laws_without_an_inverse_are_refused() {
    let said = |plays: Result<Plays, super::PlaysError>| plays.unwrap_err().to_string();
    assert!(
        said(Plays::new(1.0, vec![1.0, 0.5], vec![0.1, 0.1]))
            .contains("ascending thresholds above 0, got 0.5 at index 1")
    );
    assert!(said(Plays::new(1.0, vec![0.0], vec![0.1])).contains("got 0 at index 0"));
    assert!(said(Plays::new(1.0, vec![1.0], vec![])).contains("1 thresholds, got 0"));
    assert!(said(Plays::new(0.3, vec![1.0, 2.0], vec![0.1, -0.5])).contains("for the first 2 plays"));
    assert!(said(Plays::new(0.0, vec![1.0], vec![0.1])).contains("for the first 0 plays"));
    for width in [0.0, 0.5, 0.7, f64::NAN] {
        assert!(
            said(Plays::of_loop(width, 1.0, 10)).contains("relative width of the loop above 0 and below 0.5")
        );
    }
    assert!(said(Plays::of_loop(0.1, 1.0, 65)).contains("1 to 64 operators, got 65"));
    assert!(said(Plays::of_loop(0.1, -1.0, 5)).contains("stroke above 0"));
}

/// The output stays within the range, and an input range with an end at 0 reaches both ends of the output range.
#[test]
fn no_walk_leaves_the_range() {
    let inverse = Plays::of_loop(0.15, 2.0, 10).unwrap().inverse();
    let (low, high) = inverse.range((0.0, 2.0));
    let mut places = inverse.start(2.0);
    assert!((value(&inverse, &places, 2.0) - high).abs() < 1e-14);
    inverse.drag(&mut places, 0.0);
    assert!(low < -0.01 && (value(&inverse, &places, 0.0) - low).abs() < 1e-14, "{low}");
    for law in [inverse, Plays::of_loop(0.15, 2.0, 10).unwrap(), uneven(), uneven().inverse()] {
        for (low, high) in [(0.0, 2.0), (-0.5, 1.5), (-3.0, 0.2), (-1.0, 1.0)] {
            let (least, most) = law.range((low, high));
            let mut places = law.start(0.0);
            for k in 0..4000 {
                let to = 0.5 + 0.5 * (0.37 * f64::from(k) + (0.051 * f64::from(k)).cos()).sin();
                let v = low + (high - low) * if k % 7 == 0 { to.round() } else { to };
                law.drag(&mut places, v);
                let y = value(&law, &places, v);
                assert!((least - 1e-13..=most + 1e-13).contains(&y), "{y} of {least} to {most}");
            }
        }
    }
}
