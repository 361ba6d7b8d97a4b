//! Benchmarks of a row of springs: force, trial and commit; for comparison the reduced force of profiles.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_contact::{Apex, Interface, Move, Pair, Profile, Row, Segment, Springs};

const D: f64 = 1.8e-7;

fn row(count: usize) -> (Interface, Springs, Row) {
    let profile = Profile::paraboloid(1e-3).unwrap();
    let law = Interface::new(Pair::from_moduli(1.15e11, 0.95e11).unwrap(), profile, 0.15).unwrap();
    let springs = Springs::new(law.profile(), count, 2.0 * law.profile().radius(D)).unwrap();
    let mut row = Row::new(&springs);
    for u in [0.0, 0.7, -0.4, 0.2].map(|part| part * law.gross_slip_displacement(D)) {
        row.commit(&springs, &law, Segment::Straight(Apex { d: D, u })).unwrap();
    }
    (law, springs, row)
}

fn rows(bench: &mut Criterion) {
    for count in [64, 256, 1024] {
        let (law, springs, row) = row(count);
        let u_c = law.gross_slip_displacement(D);
        let to = Apex { d: D, u: -0.1 * u_c };
        bench.bench_function(&format!("force, {count} springs"), |b| {
            b.iter(|| black_box(&row).force(&springs, &law, black_box(to)));
        });
        let lower = Apex { d: 0.97 * D, u: -0.1 * u_c };
        bench.bench_function(&format!("force, d falling, {count} springs"), |b| {
            b.iter(|| black_box(&row).force(&springs, &law, black_box(lower)));
        });
        bench.bench_function(&format!("trial, {count} springs"), |b| {
            b.iter(|| black_box(&row).trial(&springs, &law, Move::Chord(black_box(to))));
        });
        let mut moving = row.clone();
        let mut sign = 1.0;
        bench.bench_function(&format!("commit, {count} springs"), |b| {
            b.iter(|| {
                sign = -sign;
                moving.commit(&springs, &law, Segment::Straight(Apex { d: D, u: 0.6 * sign * u_c }))
            });
        });
    }
}

fn reduced_forces(bench: &mut Criterion) {
    let profiles = [
        ("paraboloid", Profile::paraboloid(1e-3)),
        ("sphere", Profile::sphere(1e-3)),
        ("power 1.7", Profile::power(0.3, 1.7)),
    ];
    for (name, profile) in profiles {
        let profile = profile.unwrap();
        bench.bench_function(&format!("area, {name}"), |b| b.iter(|| profile.reduced_force(black_box(D))));
    }
    let sphere = Profile::sphere(1.0).unwrap();
    bench.bench_function("area, sphere pressed deep", |b| b.iter(|| sphere.reduced_force(black_box(0.9))));
}

criterion_group!(benches, rows, reduced_forces);
criterion_main!(benches);
