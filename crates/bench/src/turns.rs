//! Measurement: errors once, then times in alternating rounds, so that all methods share the noise of the machine.

use crate::clock::Stopwatch;
use crate::contestant::Stop;
use crate::family::{Family, Measured};
use crate::problem::Problem;
use crate::samples::Samples;
use std::time::Instant;
use stickslip_run::Watcher;

/// Maximum number of rounds.
const TURNS: u32 = 12;
/// Target time of a run in a round, s. Runs are repeated accordingly, so that clock and cold caches have little influence.
const TURN: f64 = 4e-3;
/// Maximum number of repetitions in a round.
const REPEATS: f64 = 500.0;
/// Expected ratio of run times between a tolerance or step and the previous one.
const GROWTH: f64 = 2.0;

/// Measures all methods in about `budget` s of wall time. Half of this time is for errors, in equal shares per method. Runs that exceed the
/// share are omitted with a note. The other half is for times: every run has one round, and further rounds while its share lasts.
pub(crate) fn measure(
    problem: &Problem,
    families: &mut [Family<'_>],
    budget: f64,
    watcher: &dyn Watcher,
) -> Result<(), Stop> {
    let share = 0.5 * budget / families.len() as f64;
    for (done, family) in families.iter_mut().enumerate() {
        sample(problem, family, share, watcher)?;
        watcher.reached(share * (done + 1) as f64);
    }
    time(families, budget, watcher)
}

/// Runs a method from coarse to fine while its share of time lasts.
fn sample(problem: &Problem, family: &mut Family<'_>, share: f64, watcher: &dyn Watcher) -> Result<(), Stop> {
    let begun = Instant::now();
    let (mut last, mut slow) = (0.0, false);
    for run in &mut family.runs {
        let left = share - begun.elapsed().as_secs_f64();
        if slow || GROWTH * last > left {
            slow = true;
            "omitted: longer than its share of the time".clone_into(&mut run.note);
            continue;
        }
        let watch = Stopwatch::start();
        match family.contestant.sample(run.value, left, watcher) {
            Ok((samples, counts)) if samples.len() == Samples::complete() => {
                let cost = watch.each(1);
                last = cost.wall;
                let (errors, known) = problem.errors(&samples);
                run.result = Some(Measured { errors, known, counts, cost, turns: 0, times: 1 });
            }
            Ok(_) => "some sample times are missing".clone_into(&mut run.note),
            Err(Stop::Interrupted) => return Err(Stop::Interrupted),
            Err(Stop::Failed(why)) => run.note = why,
            Err(Stop::Slow) => {
                slow = true;
                "omitted: longer than its share of the time".clone_into(&mut run.note);
            }
        }
    }
    Ok(())
}

/// Measures the times of all runs in alternating rounds.
fn time(families: &mut [Family<'_>], budget: f64, watcher: &dyn Watcher) -> Result<(), Stop> {
    let runs: usize = families.iter().map(|family| family.measured().count()).sum();
    let share = 0.5 * budget / runs.max(1) as f64;
    let begun = Instant::now();
    for turn in 0..TURNS {
        for family in families.iter_mut() {
            for run in &mut family.runs {
                let Some(result) = &mut run.result else { continue };
                let cost = result.cost.wall * f64::from(result.times);
                if turn > 0 && f64::from(turn + 1) * cost > share.max(f64::from(TURNS) * TURN) {
                    continue;
                }
                if turn == 0 {
                    result.times = (TURN / result.cost.wall).clamp(1.0, REPEATS) as u32;
                }
                let cost = family.contestant.time(run.value, result.times, watcher)?;
                result.cost = if turn == 0 { cost } else { result.cost.shorter(cost) };
                result.turns += 1;
            }
            if !watcher.goes_on() {
                return Err(Stop::Interrupted);
            }
            watcher.reached(0.5 * budget + begun.elapsed().as_secs_f64().min(0.5 * budget));
        }
        if turn > 0 && begun.elapsed().as_secs_f64() > 0.5 * budget {
            break;
        }
    }
    Ok(())
}
