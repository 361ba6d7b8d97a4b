//! Judges a seed: its scenario at three tolerances, with a perturbed start, and with a row of springs.

use super::finding::{Finding, Verdict};
use super::kinds::{self, Kind};
use super::rows;
use super::trial::{Ran, Trial};
use stickslip_drive::{RunError, SceneError, Stepper};
use stickslip_scenario::Scenario;

/// Tolerances of the runs; the last is the reference for the others.
pub(super) const TOLERANCES: [f64; 3] = [1e-6, 1e-8, 1e-10];
/// Largest allowed error of a run and of its energy balance, in tolerances.
const MOST: f64 = 100.0;
/// Perturbation of the start whose growth factor is S, in natural lengths.
const NUDGE: f64 = 1e-9;

/// Judges the scenario of a seed. `with_row`: also compares with a row of springs and fixed steps.
pub(super) fn judge(seed: u64, with_row: bool) -> Finding {
    let (kind, text) = kinds::scenario(seed);
    let mut finding = Finding::new(seed, kind.name());
    match Scenario::from_str_alone(&text, "soak") {
        Ok(scenario) => judge_scenario(&mut finding, &scenario, with_row),
        // An unreadable file is a fault of the generator.
        Err(error) => {
            finding.turns(Verdict::Wrong, || format!("unreadable: {}", one_line(&error.to_string())));
        }
    }
    finding
}

fn judge_scenario(finding: &mut Finding, scenario: &Scenario, with_row: bool) {
    let warning = scenario.warnings.first().map(|warning| warning.message.clone());
    let trial = match Trial::new(scenario.scene.clone(), scenario.plan) {
        Ok(trial) => trial,
        Err(error) => return refused(finding, scenario, &error),
    };
    let mut runs = Vec::new();
    for tolerance in TOLERANCES {
        match trial.run(Stepper::Event { tolerance }) {
            Ok(ran) => runs.push(ran),
            Err(error) => return refused(finding, scenario, &error),
        }
    }
    if let Some(warning) = warning {
        finding.turns(Verdict::Warned, || warning);
    }
    for (tolerance, ran) in TOLERANCES.into_iter().zip(&runs) {
        finding.took(ran.wall, ran.counts.detours);
        ended(finding, tolerance, ran);
        balanced(finding, tolerance, ran);
    }
    let [coarse, fine, finest] = &runs[..] else { return };
    if runs.iter().all(|ran| ran.error.is_none()) {
        compared(finding, &trial, [coarse, fine], finest);
        if with_row && finding.kind != Kind::Walk.name() {
            rows::against_row(finding, &trial, finest);
        }
    } else if finding.verdict <= Verdict::Left {
        left_together(finding, &runs);
    }
}

pub(super) fn refused(finding: &mut Finding, scenario: &Scenario, error: &SceneError) {
    let told = scenario.refusal(error).to_string();
    finding.turns(Verdict::Refused, || one_line(&told));
}

/// Records how a run ended.
pub(super) fn ended(finding: &mut Finding, tolerance: f64, ran: &Ran) {
    let Some(error) = &ran.error else { return };
    let verdict = match error {
        RunError::Contact { .. } => Verdict::Left,
        RunError::OutOfTime { .. } => Verdict::Hung,
        _ => Verdict::Stopped,
    };
    finding.turns(verdict, || format!("at {tolerance:e}: {error}"));
}

/// Checks the energy balance.
pub(super) fn balanced(finding: &mut Finding, tolerance: f64, ran: &Ran) {
    let (error, throughput) = ran.books;
    let off = if error == 0.0 { 0.0 } else { error / throughput / tolerance };
    // A NaN must not count as a small error.
    let off = if off.is_nan() { f64::INFINITY } else { off };
    finding.books = finding.books.max(off);
    if off > MOST {
        let relative = error / throughput;
        finding.turns(Verdict::Unbalanced, || {
            format!(
                "at {tolerance:e}: the energy balance is off by {relative:.1e} of {throughput:.1e} J, {off:.0} tolerances"
            )
        });
    }
}

/// Records the errors relative to the finest run.
fn compared(finding: &mut Finding, trial: &Trial, runs: [&Ran; 2], finest: &Ran) {
    for (place, ran) in runs.into_iter().enumerate() {
        let tolerance = TOLERANCES[place];
        let apart = trial.apart(ran, finest);
        finding.errors[place] = apart.by;
        if apart.by <= MOST * tolerance {
            continue;
        }
        let growth = growth(finding, trial, NUDGE, finest);
        finding.growth = finding.growth.max(growth);
        if apart.by <= MOST * tolerance * finding.growth {
            continue;
        }
        // A grazing contact is sensitive to a perturbation of the tolerance's size, but not to one of a thousandth of it.
        let coarse = self::growth(finding, trial, tolerance, finest);
        let verdict =
            if apart.by <= MOST * tolerance * coarse.max(1.0) { Verdict::Grazing } else { Verdict::Wrong };
        let (by, name, share) = (apart.by, apart.name, 100.0 * apart.share);
        finding.turns(verdict, || {
            format!("at {tolerance:e}: {name} off by {by:.1e} at {share:.0} % of the run, S {growth:.1e}")
        });
    }
}

/// Returns the growth factor of a perturbation of the start in both directions, at least 1.
pub(super) fn growth(finding: &mut Finding, trial: &Trial, part: f64, finest: &Ran) -> f64 {
    let [.., tolerance] = TOLERANCES;
    [part, -part].into_iter().fold(1.0, |most: f64, part| {
        let Ok(nudged) = trial.nudged(part) else { return most };
        let Ok(ran) = nudged.run(Stepper::Event { tolerance }) else { return most };
        finding.took(ran.wall, ran.counts.detours);
        if ran.error.is_some() {
            return most;
        }
        most.max(trial.apart(&ran, finest).by / part.abs())
    })
}

/// Checks that either all runs left the range of the model, or none.
fn left_together(finding: &mut Finding, runs: &[Ran]) {
    let left = runs.iter().filter(|ran| ran.error.is_some()).count();
    if left < runs.len() {
        finding.turns(Verdict::Grazing, || format!("{left} of {} runs left the model", runs.len()));
    }
}

/// Returns the first line of a message.
pub(super) fn one_line(message: &str) -> String {
    message.lines().next().unwrap_or_default().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_drive::Counts;

    fn ran(error: Option<RunError>, books: (f64, f64)) -> Ran {
        Ran { error, books, rows: vec![], counts: Counts::default(), wall: 0.1 }
    }

    #[test]
    fn endings_and_books_are_told_apart() {
        let verdict = |ran: &Ran| {
            let mut finding = Finding::new(0, "slider");
            ended(&mut finding, 1e-6, ran);
            balanced(&mut finding, 1e-6, ran);
            finding.verdict
        };
        assert_eq!(verdict(&ran(None, (0.99e-4, 1.0))), Verdict::Right);
        assert_eq!(verdict(&ran(None, (1.01e-4, 1.0))), Verdict::Unbalanced);
        assert_eq!(verdict(&ran(None, (f64::NAN, 1.0))), Verdict::Unbalanced);
        assert_eq!(verdict(&ran(None, (0.0, 0.0))), Verdict::Right);
        let late = RunError::OutOfTime { t: 0.0, limit: 20.0 };
        assert_eq!(verdict(&ran(Some(late), (0.0, 1.0))), Verdict::Hung);
        let small = RunError::StepTooSmall { t: 0.0, step: 1e-20 };
        assert_eq!(verdict(&ran(Some(small), (0.0, 1.0))), Verdict::Stopped);
    }
}
