//! Tests of limits of step lengths and of the decision whether steps are steady.

use super::*;

const FREE: Bounds = Bounds { least: 0.0, most: f64::INFINITY, error: 0.0 };

/// The limit s of s + a rᵏ is known after a few values, long before the values reach it.
#[test]
fn a_slow_approach_is_not_waited_for() {
    let steps =
        |count: i32, share: f64| -> Vec<f64> { (0..count).map(|k| 3e-8 + 1e-8 * share.powi(k)).collect() };
    let found = limit(&steps(8, 0.99), 4e-8, 1e-6).unwrap();
    assert!((found.value - 3e-8).abs() < 1e-14 && found.error < 1e-13, "{found:?}");
    let found = limit(&steps(60, 0.7), 4e-8, 1e-6).unwrap();
    assert!((found.value - 3e-8).abs() <= found.error.max(1e-22), "{found:?}");
    // A sum of two decays has no constant ratio.
    let mixed: Vec<f64> = (0..8).map(|k| 1e-8 * (0.9_f64.powi(k) + 0.5_f64.powi(k))).collect();
    assert_eq!(limit(&mixed, 4e-8, 1e-6), None);
}

#[test]
fn what_grows_or_swings_is_no_limit() {
    let grows: Vec<f64> = (0..50).map(|k| 1e-9 * 1.01_f64.powi(k)).collect();
    assert_eq!(limit(&grows, 4e-8, 1e-6), None);
    let swings: Vec<f64> = (0..200).map(|k| 1e-8 * (1.0 + 0.1 * f64::from(k).sin())).collect();
    assert_eq!(limit(&swings, 4e-8, 1e-6), None);
    let judged_so = judged(&grows, Hold::default(), FREE, None);
    assert!(matches!(judged_so, Err(Motionless::SlidesAway { periods: 50, .. })), "{judged_so:?}");
    let (course, mean, spread) = judged(&swings, Hold::default(), FREE, None).unwrap();
    assert_eq!(course, Course::Beats);
    // 100 values contain 15 oscillations: their mean is known to less than a tenth of the amplitude.
    assert!((mean.value - 1e-8).abs() <= mean.error && mean.error < 1e-10, "{mean:?}");
    // Samples are one radian apart: one of them is within half a radian of the maximum.
    assert!((0.5_f64.cos() * 1e-9..=1e-9).contains(&spread), "{spread}");
    // A growing oscillation changes the mean by an unknown amount.
    let of = |k: i32| 1e-10 * 1.004_f64.powi(k);
    let grows: Vec<f64> = (0..400).map(|k| 1e-8 + of(k) * f64::from(k).sin()).collect();
    let (course, mean, spread) = judged(&grows, Hold::default(), FREE, None).unwrap();
    assert_eq!(course, Course::Beats);
    assert!(mean.error >= spread && spread > 0.5_f64.cos() * of(399), "{mean:?} {spread}");
}

/// An oscillation with constant amplitude whose mean still drifts: the scatter of batch means is small and does not
/// show the remaining drift.
#[test]
fn a_mean_on_its_way_is_known_to_what_it_has_to_go() {
    let fades = |k: i32| 4e-11 * 0.995_f64.powi(k);
    let beat = |k: i32| 1e-8 + [0.0, 3e-9, -1e-9][k as usize % 3] + fades(k);
    let steps: Vec<f64> = (0..400).map(beat).collect();
    let (course, mean, _) = judged(&steps, Hold::default(), FREE, None).unwrap();
    assert_eq!(course, Course::Beats);
    let exact = 1e-8 + 2e-9 / 3.0;
    let off = (mean.value - exact).abs();
    assert!(off <= mean.error && mean.error < 3.0 * off, "{mean:?} {off:e}");
    let steps: Vec<f64> = (0..400).map(|k| beat(k) - fades(k)).collect();
    let (_, mean, _) = judged(&steps, Hold::default(), FREE, None).unwrap();
    assert!((mean.value - exact).abs() < 1e-20 && mean.error < 1e-18, "{mean:?}");
}

/// An oscillation that grows like a disturbance of the unstable orbit at its mean has not left the orbit. One with
/// constant amplitude, or with another mean, has left it.
#[test]
fn what_still_swings_about_a_motion_that_it_leaves_is_none() {
    let unstable = Unstable { step: 1e-8, error: 1e-17, growth: 1.0004 };
    let swings = |count: i32, growth: f64, middle: f64| -> Vec<f64> {
        (0..count).map(|k| middle + 1e-9 * growth.powi(k) * (0.7 * f64::from(k)).sin()).collect()
    };
    let of = |steps: &[f64]| judged(steps, Hold::default(), FREE, Some(unstable));
    let slowly = of(&swings(400, 1.0004, 1e-8));
    assert!(matches!(slowly, Err(Motionless::Grows { periods: 400, .. })), "{slowly:?}");
    let still = of(&[1e-8; 400]);
    assert!(matches!(still, Err(Motionless::Grows { .. })), "{still:?}");
    for middle in [1e-8, -3e-8] {
        let (course, mean, _) = of(&swings(1600, 1.0, middle)).unwrap();
        assert_eq!(course, Course::Beats);
        assert!((mean.value - middle).abs() <= mean.error && mean.error < 1e-10, "{mean:?}");
    }
    // During the transition to another motion the mean drifts.
    let left = |k: f64| -4e-8 / (1.0 + (-(k - 1400.0) / 40.0).exp());
    let underway: Vec<f64> =
        swings(1600, 1.0, 1e-8).iter().zip(0..).map(|(s, k)| s + left(f64::from(k))).collect();
    let underway = of(&underway);
    assert!(matches!(underway, Err(Motionless::Grows { .. })), "{underway:?}");
}

/// A slow decay below a fast one: the limit that the fast decay suggests does not remain constant.
#[test]
fn a_limit_that_does_not_last_begins_anew() {
    let mean = |value: f64| Mean { value, error: 1e-16 };
    let from = lasts(None, (7, mean(1.6e-12)), 4e-8);
    assert_eq!(lasts(Some(from), (8, mean(1.6e-12 + 1.5e-16)), 4e-8).0, 7);
    assert_eq!(lasts(Some(from), (9, mean(1.5e-12)), 4e-8).0, 9);
}

/// Six steps, the first of which contain the start transient; and steps that rounding could not excite.
#[test]
fn what_rings_below_the_least_step_makes_none() {
    let bounds = Bounds { least: 4e-13, most: 1e-6, ..FREE };
    let steps = [6.9e-9, 1.6e-9, -3e-10, -5e-11, -5.8e-13, 2.2e-13];
    let (course, mean, _) = judged(&steps, Hold::default(), bounds, None).unwrap();
    assert!(course == Course::Steady && mean.value.abs() < 4e-13, "{mean:?}");
    let steps: Vec<f64> = steps.iter().map(|step| 20.0 * step).collect();
    assert!(matches!(judged(&steps, Hold::default(), bounds, None), Err(Motionless::Unsettled { .. })));
    let unstable = Unstable { step: 0.0, error: 1e-18, growth: 1.36 };
    assert!(judged(&[0.0; 400], Hold::default(), bounds, Some(unstable)).is_ok());
    let slow = Unstable { growth: 1.001, ..unstable };
    assert!(matches!(
        judged(&[0.0; 400], Hold::default(), bounds, Some(slow)),
        Err(Motionless::Grows { .. })
    ));
}

/// Constant force: the step length increases by F T²/m per period. Differences of rounded positions can decrease three times in a row by
/// chance; no limit may be derived from them.
#[test]
fn even_growth_is_no_limit_however_it_is_rounded() {
    for stretch in 0..400 {
        let place = |k: u32| -0.5 * 7.25e-4 * (1.0 + f64::from(stretch) / 997.0) * f64::from(k).powi(2);
        let steps: Vec<f64> = (0..400).map(|k| place(k + 1) - place(k)).collect();
        for count in FEWEST..steps.len() {
            assert_eq!(limit(&steps[..count], 4e-8, 1e-6), None, "{stretch} {count}");
        }
        let judged = judged(&steps, Hold::default(), FREE, None);
        assert!(matches!(judged, Err(Motionless::SlidesAway { .. })), "{judged:?}");
    }
}

/// Constant steps are no steady motion if nothing holds the body. A body at rest is not affected.
#[test]
fn what_is_dragged_or_flies_is_not_steady() {
    let loose = |loose| Hold { loose_until: 20, held_until: 17, loose: Some(loose) };
    let of = |step: f64, hold| judged(&[step; 20], hold, Bounds { least: 1e-12, ..FREE }, None);
    assert_eq!(of(5e-8, loose(Loose::Flies)), Err(Motionless::Flies { periods: 20 }));
    assert!(matches!(of(-2e-7, loose(Loose::Slides)), Err(Motionless::SlidesAway { .. })));
    assert!(of(0.0, loose(Loose::Slides)).is_ok() && of(-2e-7, Hold::default()).is_ok());
    // A body that touches in every third period is held, though it flies in the last. The same holds for a body that
    // hops and touches again.
    let hold = Hold { loose_until: 100, held_until: 98, loose: Some(Loose::Flies) };
    assert!(judged(&[5e-8; 100], hold, FREE, None).is_ok());
    let hops: Vec<f64> = (0..100).map(|k| if k % 7 == 3 { 1e-8 } else { 5e-8 }).collect();
    let hold = Hold { loose_until: 100, held_until: 96, loose: Some(Loose::Flies) };
    assert!(judged(&hops, hold, FREE, None).is_ok());
}
