//! Benchmarks of the memory curve: trial, commit and branch, for several numbers of stored reversals.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use stickslip_contact::{Apex, Curve, Interface, Move, Pair, Profile, Segment};

const D: f64 = 1.8e-7;

fn laws() -> [(&'static str, Interface); 2] {
    [("paraboloid", Profile::paraboloid(1e-3)), ("sphere", Profile::sphere(1e-3))].map(|(name, profile)| {
        (name, Interface::new(Pair::from_moduli(1.15e11, 0.95e11).unwrap(), profile.unwrap(), 0.15).unwrap())
    })
}

/// Curve with a number of nested reversals, and the displacements of the last two.
fn nested(law: &Interface, turns: i32) -> (Curve, f64, f64) {
    let mut curve = Curve::new(law, Apex { d: D, u: 0.0 });
    let u_c = law.gross_slip_displacement(D);
    let turn = |k: i32| 0.95 * u_c * 0.8_f64.powi(k) * if k % 2 == 0 { 1.0 } else { -1.0 };
    for k in 0..turns {
        curve.commit(law, Segment::Straight(Apex { d: D, u: turn(k) })).unwrap();
    }
    (curve, turn(turns - 2), turn(turns - 1))
}

fn trials(bench: &mut Criterion) {
    for (name, law) in laws() {
        for depth in [1, 4, 16] {
            let (curve, before, last) = nested(&law, depth);
            let to = |share: f64, d: f64| Apex { d, u: last + share * (before - last) };
            let moves = [
                ("cuts one piece", to(0.3, D)),
                ("shrinking", to(0.3, 0.98 * D)),
                ("cuts all", Apex { d: D, u: 3.0 * law.gross_slip_displacement(D) }),
            ];
            for (kind, to) in moves {
                bench.bench_function(&format!("trial, {name}, {depth} turns, {kind}"), |b| {
                    b.iter(|| black_box(&curve).trial(&law, Move::Chord(black_box(to))));
                });
            }
        }
    }
}

/// Trials with a rough line of 10⁵ heights compared with a paraboloid. The ratio should be below 3.
fn long_lists(bench: &mut Criterion) {
    let mut random = 1_u64;
    let mut height = || {
        let even = (0..12).map(|_| {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (random >> 11) as f64 / (1_u64 << 53) as f64
        });
        50e-9 * (even.sum::<f64>() - 6.0)
    };
    let heights: Vec<f64> = (0..100_000).map(|_| height()).collect();
    let pair = Pair::from_moduli(1.15e11, 0.95e11).unwrap();
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lacks: Vec<f64> = heights.iter().map(|height| highest - height).collect();
    for (name, profile) in [
        ("paraboloid", Profile::paraboloid(1e-3)),
        ("1e5 heights", Profile::rough(&heights, 1e-8)),
        ("1e5 heights without an index", Profile::foundation(&lacks, &vec![1e-8; lacks.len()])),
    ] {
        let law = Interface::new(pair, profile.unwrap(), 0.15).unwrap();
        let (curve, before, last) = nested(&law, 4);
        // Successive trials are far apart in the list, so that the processor cache does not hide the search.
        let mut share = 0.0;
        bench.bench_function(&format!("trials all over, {name}"), |b| {
            b.iter(|| {
                share += 0.618_033_988_749_894_9;
                share -= f64::from(u8::from(share > 1.0));
                let to = Apex { d: D * (1.0 - 0.3 * share), u: last + share * (before - last) };
                black_box(&curve).trial(&law, Move::Chord(black_box(to)))
            });
        });
    }
}

fn branches(bench: &mut Criterion) {
    for (name, law) in laws() {
        let (curve, before, last) = nested(&law, 4);
        let branch = curve.branch(&law, (before - last).signum(), 0.0);
        let (u, reduced_force) = (0.7 * last + 0.3 * before, law.profile().reduced_force(D));
        bench.bench_function(&format!("force of a frozen branch, {name}"), |b| {
            b.iter(|| black_box(&branch).force(&law, black_box(D), black_box(u), reduced_force));
        });
    }
}

fn commits(bench: &mut Criterion) {
    for (name, law) in laws() {
        for depth in [1, 4, 16] {
            let (mut curve, before, last) = nested(&law, depth);
            let to = |u: f64| Segment::Straight(Apex { d: D, u });
            let (there, back) = (to(last + 0.3 * (before - last)), to(last));
            // Back and forth is a closed loop, so the size of the stack does not change.
            bench.bench_function(&format!("two commits, {name}, {depth} turns"), |b| {
                b.iter(|| {
                    let lost = curve.commit(&law, black_box(there)).unwrap();
                    lost + curve.commit(&law, black_box(back)).unwrap()
                });
            });
            assert!(curve.knot_count() < 30);
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .sample_size(20);
    targets = trials, long_lists, branches, commits
}
criterion_main!(benches);
