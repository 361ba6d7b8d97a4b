//! Fixed-step loops over half rows of springs, or with the exact contact law under constant load.
//!
//! Bodies move in x, z and pitch. The loops are optimised by arrays of fixed size and tabulated waveforms. Only half of each symmetric
//! row is computed, with the widest vector instructions of the machine.
//!
//! Reading order: `walk` (the loop), `driven` (prescribed quantities), `row` and `exact` (contacts).

mod driven;
mod exact;
mod row;
mod walk;

pub(crate) use exact::Exact;
pub(crate) use row::Half;

use super::Mechanism;
use crate::clock::{Stopwatch, Times};
use crate::contestant::{Contestant, Stop};
use crate::samples::Samples;
use driven::{Driven, Table};
use std::hint::black_box;
use std::time::Instant;
use stickslip_drive::Counts;
use stickslip_run::Watcher;
use walk::{Contact, Walk, Walker};

/// Maximum number of free coordinates. Each number has its own compiled loop.
const MOST: usize = 6;
/// Number of steps between two checks of the clock.
const STRIDE: usize = 4096;
/// Number of evaluations per step of the Runge–Kutta method.
const STAGES: u64 = 4;

/// Fixed-step loop with contacts of one type.
pub(crate) struct Fixed<C> {
    mechanism: Mechanism,
    duration: f64,
    /// Contacts in their initial state.
    contacts: Vec<C>,
    /// Whether the method is Runge–Kutta of order 4; otherwise velocity Verlet.
    staged: bool,
}

impl<C: Contact> Fixed<C> {
    pub(crate) fn new(
        mechanism: Mechanism,
        contacts: Vec<C>,
        (duration, staged): (f64, bool),
    ) -> Result<Self, String> {
        if !(1..=MOST).contains(&mechanism.free.len()) {
            return Err(format!("more than {MOST} free coordinates"));
        }
        Ok(Self { mechanism, duration, contacts, staged })
    }

    fn steps(&self, step: f64) -> usize {
        (self.duration / step).round() as usize
    }

    fn tables(&self, step: f64) -> Result<Vec<Table>, Stop> {
        self.mechanism.tracks.iter().map(|track| Table::new(track, step, self.duration)).collect()
    }

    fn walker<'t>(&self, step: f64, tables: &'t [Table]) -> Box<dyn Walker + 't>
    where
        C: 't,
    {
        match self.mechanism.free.len() {
            1 => Box::new(self.walk::<1>(step, tables)),
            2 => Box::new(self.walk::<2>(step, tables)),
            3 => Box::new(self.walk::<3>(step, tables)),
            4 => Box::new(self.walk::<4>(step, tables)),
            5 => Box::new(self.walk::<5>(step, tables)),
            _ => Box::new(self.walk::<MOST>(step, tables)),
        }
    }

    fn walk<'t, const F: usize>(&self, step: f64, tables: &'t [Table]) -> Walk<'t, C, F> {
        Walk::new((&self.mechanism, &self.contacts), (step, self.staged), Driven::new(tables))
    }
}

impl<C: Contact> Contestant for Fixed<C> {
    fn sample(&self, step: f64, wall: f64, watcher: &dyn Watcher) -> Result<(Samples, Counts), Stop> {
        let begun = Instant::now();
        let tables = self.tables(step)?;
        let mut walker = self.walker(step, &tables);
        let (steps, mut samples) = (self.steps(step), Samples::new(self.mechanism.free.len()));
        let before = |walker: &dyn Walker| {
            let (x, v) = walker.places();
            (x.to_vec(), v.to_vec())
        };
        for n in 0..steps {
            let start = (samples.next(self.duration) <= (n + 1) as f64 * step).then(|| before(&*walker));
            walker.advance(1);
            if let Some(start) = start {
                between(&mut samples, (n, step, self.duration), &start, walker.places());
            }
            if n.is_multiple_of(STRIDE) {
                if !watcher.goes_on() {
                    return Err(Stop::Interrupted);
                } else if begun.elapsed().as_secs_f64() > wall {
                    return Err(Stop::Slow);
                }
            }
        }
        walker.places().0.iter().for_each(|x| samples.push(*x));
        let evaluations = if self.staged { STAGES } else { 1 } * steps as u64 + 1;
        Ok((samples, Counts { steps: steps as u64, evaluations, ..Counts::default() }))
    }

    fn time(&self, step: f64, times: u32, watcher: &dyn Watcher) -> Result<Times, Stop> {
        let tables = self.tables(step)?;
        let watch = Stopwatch::start();
        for _ in 0..times {
            let mut walker = self.walker(step, &tables);
            let mut left = self.steps(step);
            while left > 0 {
                walker.advance(left.min(STRIDE));
                left -= left.min(STRIDE);
                if !watcher.goes_on() {
                    return Err(Stop::Interrupted);
                }
            }
            black_box(walker.places());
        }
        Ok(watch.each(times))
    }
}

/// Records the sample times within a step, by cubic Hermite interpolation.
fn between(
    samples: &mut Samples,
    (n, step, duration): (usize, f64, f64),
    start: &(Vec<f64>, Vec<f64>),
    (x, v): (&[f64], &[f64]),
) {
    let from = n as f64 * step;
    while samples.next(duration) <= from + step {
        let s = (samples.next(duration) - from) / step;
        for (((x0, v0), x), v) in start.0.iter().zip(&start.1).zip(x).zip(v) {
            let mean = (x - x0) / step;
            let bend = s * (1.0 - s) * ((1.0 - s) * (v0 - mean) - s * (v - mean));
            samples.push(x0 + step * (s * mean + bend));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::contestant::Stepping;
    use crate::family::{Method, families};
    use crate::problem::Problem;
    use std::path::Path;
    use stickslip_run::Job;

    fn problem(name: &str) -> Problem {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
        Problem::new(&Job::prepare(&file, &[], Path::new("")).unwrap(), &[], &()).unwrap()
    }

    /// Returns trajectory errors relative to the stroke, at three steps, s.
    fn errors(problem: &Problem, method: Method, steps: [f64; 3]) -> [f64; 3] {
        let families = families(problem);
        let family = families.iter().find(|family| family.method == method).unwrap();
        steps.map(|step| {
            let (samples, _) = family.contestant.sample(step, f64::INFINITY, &()).unwrap();
            problem.errors(&samples).0.trajectory
        })
    }

    /// Returns the difference of two methods at the end, for the same step, relative to the stroke.
    fn apart(problem: &Problem, one: Method, other: Method) -> f64 {
        let families = families(problem);
        let [one, other] = [one, other].map(|method| {
            let family = families.iter().find(|family| family.method == method).unwrap();
            family.contestant.sample(problem.duration / 4000.0, f64::INFINITY, &()).unwrap().0
        });
        problem.norm.errors(&one, &other).end
    }

    /// Reversals and ends of branches lie within steps, so both methods have order 2. The reference is the event stepper at 1e-14, which
    /// agrees with the 50-digit solution of P1.
    #[test]
    fn plain_loops_on_the_exact_contact_come_to_p1_at_their_order() {
        for name in
            ["scenarios/p1.json", "crates/bench/scenes/p1_cone.json", "crates/bench/scenes/p1_power4.json"]
        {
            let problem = problem(name);
            for (staged, most) in [(false, 0.1), (true, 0.01)] {
                let steps = [5e-6, 1.25e-6, 0.3125e-6];
                let errors = errors(&problem, Method::Loop { springs: None, staged }, steps);
                let limits = steps.map(|step| most * (step / 10e-6).powi(2));
                assert!(
                    errors.iter().zip(limits).all(|(e, l)| *e < l),
                    "{name} {staged}: {errors:?} {limits:?}"
                );
            }
        }
    }

    /// Compares the loop with the program for the same steps and the same contact law, which are implemented differently.
    #[test]
    fn plain_loops_on_the_exact_contact_move_as_the_program_does() {
        let problem = problem("scenarios/p1.json");
        for (staged, stepping) in [(false, Stepping::Verlet), (true, Stepping::Rk4)] {
            let apart = apart(
                &problem,
                Method::Own { stepping, springs: None },
                Method::Loop { springs: None, staged },
            );
            assert!(apart < 1e-9, "{staged}: {apart:e}");
        }
    }

    /// Compares the loop with the program for the same steps and springs. Differences are of the order of rounding errors. Under varying
    /// load, the program moves springs along a straight line from their first contact, and the loop clips stretches. Both converge to the
    /// same limit.
    #[test]
    fn half_a_row_moves_as_the_program_s_whole_one() {
        for name in ["scenarios/p1.json", "crates/bench/scenes/p1_power4.json"] {
            let (problem, springs) = (problem(name), Some(64));
            for (staged, stepping) in [(false, Stepping::Verlet), (true, Stepping::Rk4)] {
                let apart =
                    apart(&problem, Method::Own { stepping, springs }, Method::Loop { springs, staged });
                assert!(apart < 1e-11, "{name} {staged}: {apart:e}");
            }
        }
    }
}
