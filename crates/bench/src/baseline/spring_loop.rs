//! The loop a researcher writes: velocity Verlet over rows of springs, and nothing else in the loop.
//!
//! Bodies free in x, z and pitch, contacts under constant load or pressed by the bodies. Tuned: half of each symmetric row,
//! eight lanes, two comparisons per clamp, coordinates in arrays of fixed size, driven places from a table.

mod driven;
mod watch;

use super::Mechanism;
use super::form::Form;
use super::half::Half;
use crate::clock::{Stopwatch, Times};
use crate::contestant::{Contestant, Stop};
use crate::samples::Samples;
use driven::{Driven, Table};
use std::time::Instant;
use stickslip_drive::Counts;
use stickslip_results::Watcher;
use watch::{Blind, Keen, Watch};

/// Most free coordinates; each number of them has its own loop.
const MOST: usize = 6;

/// The loop over rows of so many springs.
pub(crate) struct SpringLoop {
    mechanism: Mechanism,
    duration: f64,
    /// A row for each contact as it stands at the start.
    rows: Vec<Half>,
}

impl SpringLoop {
    /// Rows of `springs` over `spans` (m; none: the contact's width at the start).
    pub(crate) fn new(
        mechanism: Mechanism,
        duration: f64,
        springs: usize,
        spans: &[Option<f64>],
    ) -> Result<Self, String> {
        if !(1..=MOST).contains(&mechanism.free.len()) {
            return Err(format!("more than {MOST} free coordinates"));
        }
        let width = |tie: &super::Tie| 2.0 * tie.law.profile().radius(tie.start.apex().d);
        let rows = mechanism.ties.iter().zip(spans);
        let rows =
            rows.map(|(tie, span)| Half::new(tie, springs, span.unwrap_or_else(|| width(tie)))).collect();
        Ok(Self { mechanism, duration, rows })
    }

    fn tables(&self, step: f64) -> Result<Vec<Table>, Stop> {
        let tables = self.mechanism.tracks.iter().map(|track| Table::new(track, step, self.duration));
        tables.collect()
    }

    fn go(&self, step: f64, tables: &[Table], watch: &mut impl Watch) {
        match self.mechanism.free.len() {
            1 => self.run::<1>(step, tables, watch),
            2 => self.run::<2>(step, tables, watch),
            3 => self.run::<3>(step, tables, watch),
            4 => self.run::<4>(step, tables, watch),
            5 => self.run::<5>(step, tables, watch),
            _ => self.run::<MOST>(step, tables, watch),
        }
    }

    fn run<const F: usize>(&self, step: f64, tables: &[Table], watch: &mut impl Watch) {
        let free: [super::Free; F] = std::array::from_fn(|i| self.mechanism.free[i]);
        let mut ties: Vec<Link<F>> = self
            .mechanism
            .ties
            .iter()
            .zip(&self.rows)
            .map(|(tie, row)| Link::new(tie, row.clone()))
            .collect();
        let mut driven = Driven::new(tables);
        let (mut x, mut v) = (free.map(|free| free.start.0), free.map(|free| free.start.1));
        let (forces, mobility) = (free.map(|free| free.force), free.map(|free| 1.0 / free.mass));
        for tie in &mut ties {
            tie.at = tie.slide.value(&driven.values, &x);
        }
        let mut a = accelerations(&mobility, forces, &mut ties, &driven.values, &x);
        let steps = (self.duration / step).round() as usize;
        for n in 1..=steps {
            for i in 0..F {
                v[i] += 0.5 * step * a[i];
                x[i] += step * v[i];
            }
            driven.advance();
            a = accelerations(&mobility, forces, &mut ties, &driven.values, &x);
            for i in 0..F {
                v[i] += 0.5 * step * a[i];
            }
            if !watch.step(n, &x, &v) {
                return;
            }
        }
    }
}

#[inline]
fn accelerations<const F: usize>(
    mobility: &[f64; F],
    mut forces: [f64; F],
    ties: &mut [Link<F>],
    driven: &[f64],
    x: &[f64; F],
) -> [f64; F] {
    for tie in ties {
        tie.act(driven, x, &mut forces);
    }
    std::array::from_fn(|i| forces[i] * mobility[i])
}

/// A contact in the loop.
struct Link<const F: usize> {
    row: Half,
    count: f64,
    slide: Row<F>,
    press: Option<Row<F>>,
    /// u after the last step, m.
    at: f64,
}

/// A linear form with coefficients in an array.
struct Row<const F: usize> {
    constant: f64,
    free: [f64; F],
    driven: Vec<(usize, f64)>,
}

impl<const F: usize> Link<F> {
    fn new(tie: &super::Tie, row: Half) -> Self {
        let press = tie.press.as_ref().map(Row::new);
        Self { row, count: tie.count, slide: Row::new(&tie.slide), press, at: 0.0 }
    }

    #[inline]
    fn act(&mut self, driven: &[f64], x: &[f64; F], forces: &mut [f64; F]) {
        let u = self.slide.value(driven, x);
        let du = u - self.at;
        self.at = u;
        let shear = match &self.press {
            None => self.row.slide(du),
            Some(press) => {
                let (shear, normal) = self.row.press(du, press.value(driven, x));
                press.push(forces, -self.count * normal);
                shear
            }
        };
        self.slide.push(forces, -self.count * shear);
    }
}

impl<const F: usize> Row<F> {
    fn new(form: &Form) -> Self {
        let free = std::array::from_fn(|i| form.free[i]);
        Self { constant: form.constant, free, driven: form.driven.clone() }
    }

    #[inline]
    fn value(&self, driven: &[f64], x: &[f64; F]) -> f64 {
        let mut value = self.constant;
        for (factor, x) in self.free.iter().zip(x) {
            value += factor * x;
        }
        for (w, factor) in &self.driven {
            value += factor * driven[*w];
        }
        value
    }

    /// Adds a force along the form to those on the coordinates.
    #[inline]
    fn push(&self, forces: &mut [f64; F], force: f64) {
        for (sum, factor) in forces.iter_mut().zip(&self.free) {
            *sum += factor * force;
        }
    }
}

impl Contestant for SpringLoop {
    fn sample(&self, step: f64, wall: f64, watcher: &dyn Watcher) -> Result<(Samples, Counts), Stop> {
        let tables = self.tables(step)?;
        let starts = self.mechanism.free.iter().map(|free| free.start);
        let mut keen = Keen {
            samples: Samples::new(self.mechanism.free.len()),
            step,
            duration: self.duration,
            last: starts.unzip(),
            begun: Instant::now(),
            wall,
            watcher,
            stop: None,
        };
        self.go(step, &tables, &mut keen);
        if let Some(stop) = keen.stop {
            return Err(stop);
        }
        keen.last.0.iter().for_each(|x| keen.samples.push(*x));
        let steps = (self.duration / step).round() as u64;
        Ok((keen.samples, Counts { steps, evaluations: steps + 1, ..Counts::default() }))
    }

    fn time(&self, step: f64, times: u32, watcher: &dyn Watcher) -> Result<Times, Stop> {
        let tables = self.tables(step)?;
        let watch = Stopwatch::start();
        for _ in 0..times {
            self.go(step, &tables, &mut Blind(watcher));
        }
        if !watcher.goes_on() {
            return Err(Stop::Interrupted);
        }
        Ok(watch.each(times))
    }
}
