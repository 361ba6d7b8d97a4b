//! Benchmark of the cost of a step beyond its evaluations.
#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_stepper::{Attempt, Completion, DormandPrince, Rk4, Step, Stepping, System, Target, Verlet};

/// `pairs` uncoupled oscillators ẍ = -x and two quadratures.
struct Oscillators {
    pairs: usize,
}

impl System for Oscillators {
    fn dimension(&self) -> usize {
        2 * self.pairs
    }
    fn positions(&self) -> usize {
        self.pairs
    }
    fn total(&self) -> usize {
        2 * self.pairs + 2
    }
    fn slopes(&self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let (x, v) = y.split_at(self.pairs);
        let (dx, rest) = dy.split_at_mut(self.pairs);
        let (dv, work) = rest.split_at_mut(self.pairs);
        for (((dx, dv), x), v) in dx.iter_mut().zip(dv).zip(x).zip(v) {
            *dx = *v;
            *dv = -x;
        }
        if let ([a, b], Some(v)) = (work, v.first()) {
            *a = v * v;
            *b = -v * v;
        }
    }
}

/// A hundred steps each; divide by 1200 (evaluations of 100 attempts and end slopes), 400 or 100.
fn overhead(c: &mut Criterion) {
    for pairs in [1, 2, 5] {
        let system = Oscillators { pairs };
        evaluation(c, &system);
        dop853(c, &system);
        fixed::<Rk4>(c, &system, "rk4");
        fixed::<Verlet>(c, &system, "verlet");
    }
}

fn evaluation(c: &mut Criterion, system: &Oscillators) {
    let (dimension, total) = (system.dimension(), system.total());
    c.bench_function(&format!("evaluation alone x1200, {dimension} components"), |b| {
        let (mut y, mut dy) = (vec![1.0; total], vec![0.0; total]);
        b.iter(|| {
            for _ in 0..1200 {
                system.slopes(0.0, black_box(&y[..dimension]), black_box(&mut dy));
                y[0] = dy[1];
            }
            y[0]
        });
    });
}

fn dop853(c: &mut Criterion, system: &Oscillators) {
    let (dimension, total) = (system.dimension(), system.total());
    let (start, scale) = (vec![1.0; total], vec![1e-8; dimension]);
    let next = |stepper: &DormandPrince| Target::even(stepper.span().time + black_box(0.1));
    c.bench_function(&format!("dop853 x100 steps, {dimension} components"), |b| {
        let mut stepper = DormandPrince::new(dimension, total);
        b.iter(|| {
            stepper.start(system, 0.0, &start);
            let mut worst = 0.0_f64;
            for _ in 0..100 {
                worst = worst.max(stepper.attempt(system, next(&stepper), &scale));
                stepper.complete(system, Completion::EndSlopes);
                stepper.accept();
            }
            worst
        });
    });
    c.bench_function(&format!("dop853 dense x100 steps, {dimension} components"), |b| {
        let mut stepper = DormandPrince::new(dimension, total);
        b.iter(|| {
            stepper.start(system, 0.0, &start);
            for _ in 0..100 {
                stepper.attempt(system, next(&stepper), &scale);
                stepper.complete(system, Completion::Dense);
                stepper.accept();
            }
            stepper.span().begin[0]
        });
    });
}

fn fixed<F: Stepping<Oscillators>>(c: &mut Criterion, system: &Oscillators, name: &str) {
    c.bench_function(&format!("{name} x100 steps, {} components", system.dimension()), |b| {
        let (mut stepper, mut y) =
            (F::sized(system.positions(), system.dimension(), system.total()), vec![1.0; system.total()]);
        b.iter(|| {
            for _ in 0..100 {
                stepper.step(system, 0.0, &mut y, black_box(0.01));
            }
            y[0]
        });
    });
}

criterion_group!(benches, overhead);
criterion_main!(benches);
