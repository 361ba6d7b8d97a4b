//! Tests of rough lines: a curve over 10⁵ heights against a row of springs, and generated lines.

use crate::lottery::Lottery;
use std::f64::consts::TAU;
use stickslip_contact::{
    Apex, Curve, Interface, Pair, Profile, ProfileError, RoughnessError, Row, Segment, SelfAffine, Springs,
};

fn line(count: usize) -> Vec<f64> {
    let mut lottery = Lottery(3);
    (0..count).map(|_| 50e-9 * lottery.normal()).collect()
}

#[test]
fn a_line_of_1e5_heights_equals_as_many_springs() {
    let (heights, spacing) = (line(100_000), 1e-8);
    let profile = Profile::rough(&heights, spacing).unwrap();
    let law = Interface::new(Pair::from_moduli(1e11, 0.8e11).unwrap(), profile, 0.3).unwrap();
    let springs = Springs::new(law.profile(), 1, 1.0).unwrap();
    assert_eq!(springs.count(), 100_000);
    let deepest = 200e-9;
    let (u, limit) = (law.gross_slip_displacement(deepest), law.friction() * law.normal_force(deepest));
    let (mut curve, mut row) = (Curve::new(&law, Apex::default()), Row::new(&springs));
    let (mut lottery, mut worst, mut works) = (Lottery(1), 0.0_f64, [0.0; 2]);
    for _ in 0..80 {
        let to = Apex { d: deepest * (1.1 * lottery.draw() - 0.1), u: 2.0 * u * (lottery.draw() - 0.5) };
        works[0] += curve.commit(&law, Segment::Straight(to)).unwrap();
        works[1] += row.commit(&springs, &law, Segment::Straight(to)).unwrap();
        worst = worst.max((curve.force(&law) - row.force(&springs, &law, to)).abs() / limit);
    }
    assert!(worst < 1e-12, "{worst:e}");
    assert!((works[0] / works[1] - 1.0).abs() < 1e-10, "{works:?}");
}

#[test]
fn a_line_is_the_foundation_of_what_each_height_lacks_of_the_highest() {
    for count in [1, 2, 3, 1000, 30_000] {
        let (heights, spacing) = (line(count), 2e-7);
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lacks: Vec<f64> = heights.iter().map(|height| highest - height).collect();
        let rough = Profile::rough(&heights, spacing).unwrap();
        let list = Profile::foundation(&lacks, &vec![spacing; count]).unwrap();
        let mut lottery = Lottery(9);
        // Heights of springs, one unit in the last place above and below them, and beyond all.
        let near = lacks.iter().take(300).flat_map(|h| [h.next_down(), *h, h.next_up()]);
        let anywhere = (0..1000).map(|_| 600e-9 * lottery.draw());
        for h in near.chain(anywhere).chain([1e-300, 1.0, 1e300]).collect::<Vec<_>>() {
            assert_eq!(rough.reduced_stiffness(h), list.reduced_stiffness(h), "{count} {h:e}");
            assert_eq!(rough.reduced_force(h), list.reduced_force(h), "{count} {h:e}");
            assert_eq!(rough.reduced_energy(h), list.reduced_energy(h), "{count} {h:e}");
        }
        let force = list.reduced_force(300e-9);
        assert_eq!(rough.height_of_reduced_force(force), list.height_of_reduced_force(force));
        assert_eq!((rough.gap(0.0), rough.exponent(), rough.has_kinks()), (None, None, true));
    }
    // All heights equal: a flat punch.
    let flat = Profile::rough(&[3e-6; 7], 1e-6).unwrap();
    assert!((flat.reduced_force(1e-9) / 7e-15 - 1.0).abs() < 1e-14);
}

#[test]
fn a_line_of_as_many_points_as_are_made_is_a_profile() {
    let points = SelfAffine::MAX_POINTS;
    let heights = SelfAffine { points, ..LINE }.heights().unwrap();
    let rough = Profile::rough(&heights, LINE.length / points as f64).unwrap();
    // Fully pressed, the contact has the length of the line.
    assert!((rough.reduced_stiffness(1.0) / LINE.length - 1.0).abs() < 1e-13);
}

const LINE: SelfAffine = SelfAffine {
    rms: 20e-9,
    hurst: 0.8,
    longest: 25e-6,
    shortest: 0.5e-6,
    length: 100e-6,
    points: 1024,
    seed: 42,
};

#[test]
fn a_self_affine_line_has_the_spectrum_asked_for() {
    let heights = LINE.heights().unwrap();
    let count = heights.len() as f64;
    assert_eq!(heights.len(), 1024);
    let square = heights.iter().map(|z| z * z).sum::<f64>() / count;
    assert!((square.sqrt() / LINE.rms - 1.0).abs() < 1e-13);
    let amplitude = |k: usize| {
        let part = |f: fn(f64) -> f64| -> f64 {
            heights.iter().enumerate().map(|(i, z)| z * f(TAU * (i * k % 1024) as f64 / count)).sum()
        };
        2.0 / count * part(f64::cos).hypot(part(f64::sin))
    };
    // Waves 4 to 200 along the length, with amplitudes that decrease with the exponent H + 1/2.
    let first = amplitude(4);
    for k in [5, 17, 60, 200] {
        let want = first * (k as f64 / 4.0).powf(-1.3);
        assert!((amplitude(k) / want - 1.0).abs() < 1e-10, "{k}");
    }
    for k in [0, 1, 3, 201, 400, 512] {
        assert!(amplitude(k) < 1e-13 * first, "{k}");
    }
    assert!(Profile::rough(&heights, LINE.length / count).is_ok());
}

#[test]
fn a_seed_makes_the_same_line_everywhere() {
    // The line uses only functions whose results are identical on every machine.
    let heights = LINE.heights().unwrap();
    let mixed = heights.iter().fold(0_u64, |sum, z| sum.rotate_left(5).wrapping_mul(31) ^ z.to_bits());
    assert_eq!(mixed, 0x9f9f_a889_35ab_1c76);
    assert_eq!(heights, LINE.heights().unwrap());
    assert_ne!(heights, SelfAffine { seed: 43, ..LINE }.heights().unwrap());
}

#[test]
fn what_is_no_line_is_refused() {
    let refused = |line: SelfAffine| line.heights().unwrap_err();
    assert_eq!(refused(SelfAffine { rms: 0.0, ..LINE }), RoughnessError::Rms(0.0));
    assert_eq!(refused(SelfAffine { hurst: 1.1, ..LINE }), RoughnessError::Hurst(1.1));
    assert_eq!(refused(SelfAffine { length: -1.0, ..LINE }), RoughnessError::Length(-1.0));
    assert_eq!(refused(SelfAffine { points: 1000, ..LINE }), RoughnessError::Points(1000));
    assert_eq!(refused(SelfAffine { points: 1 << 21, ..LINE }), RoughnessError::Points(1 << 21));
    let long = RoughnessError::Longest { longest: 2e-4, length: 1e-4 };
    assert_eq!(refused(SelfAffine { longest: 2e-4, ..LINE }), long);
    let swapped = RoughnessError::Swapped { shortest: 25e-6, longest: 0.5e-6 };
    assert_eq!(refused(SelfAffine { longest: 0.5e-6, shortest: 25e-6, ..LINE }), swapped);
    let short = refused(SelfAffine { shortest: 1e-7, ..LINE });
    assert!(matches!(short, RoughnessError::Shortest { shortest: 1e-7, .. }), "{short}");
    assert_eq!(refused(SelfAffine { longest: 7e-5, shortest: 6e-5, ..LINE }), RoughnessError::NoWave);
    assert_eq!(Profile::rough(&[], 1.0), Err(ProfileError::Empty));
    assert_eq!(Profile::rough(&[0.0], 0.0), Err(ProfileError::Spacing(0.0)));
    assert_eq!(Profile::rough(&[0.0], f64::INFINITY), Err(ProfileError::Spacing(f64::INFINITY)));
    assert!(matches!(Profile::rough(&[0.0, f64::NAN], 1.0), Err(ProfileError::LineHeight { .. })));
    let many = vec![0.0; Profile::MAX_HEIGHTS + 1];
    assert_eq!(Profile::rough(&many, 1.0), Err(ProfileError::TooManyHeights(1_048_577)));
}
