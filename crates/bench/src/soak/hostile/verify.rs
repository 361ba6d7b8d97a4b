//! Judges a cell: by its energy balance and a comparison with the event stepper at another tolerance, or for other methods by their own
//! error.

use super::cell::{Cell, Cells, Column};
use crate::soak::finding::{Finding, Verdict};
use crate::soak::judge;
use crate::soak::trial::{Ran, Trial};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use stickslip_drive::{RunError, Stepper};
use stickslip_scenario::Scenario;

/// Tolerance of the reference, and the smallest tolerance to which errors are relative.
const REFERENCE: f64 = 1e-10;
/// Smallest tolerance to which errors of the energy balance are relative; smaller errors are rounding.
const ROUNDING: f64 = 1e-12;
/// Largest allowed error, in tolerances.
const MOST: f64 = 100.0;
/// Perturbation of the start whose growth factor is S, in natural lengths.
const NUDGE: f64 = 1e-9;
/// Own error above which a fixed-step method cannot judge the event stepper, in natural lengths.
const BLURRED: f64 = 0.1;
/// Error that is always allowed to fixed-step methods, in natural lengths.
const FREE: f64 = 1e-6;

/// Judge of cells, with stored reference runs that the cells of a scenario share.
pub(super) struct Judge {
    cells: Cells,
    references: Mutex<HashMap<usize, Arc<Option<Ran>>>>,
}

impl Judge {
    pub(super) fn new(cells: Cells) -> Self {
        Self { cells, references: Mutex::default() }
    }

    pub(super) fn judge(&self, number: u64) -> Finding {
        let Some(cell) = self.cells.get(number) else { return Finding::new(number, "beyond") };
        let mut finding = Finding::new(number, cell.family.name);
        let name = format!("{} {:e}, {}", cell.family.axis, cell.value, cell.column.name());
        self.look(&mut finding, &cell);
        let note = std::mem::take(&mut finding.note);
        finding.note = if note.is_empty() { name } else { format!("{name}: {note}") };
        finding
    }

    fn look(&self, finding: &mut Finding, cell: &Cell<'_>) {
        let scenario = match Scenario::from_str_alone(&cell.text(), "hostile") {
            Ok(scenario) => scenario,
            Err(error) => return refused(finding, error.help.as_deref(), &error.message),
        };
        let trial = match Trial::new(scenario.scene.clone(), scenario.plan) {
            Ok(trial) => trial,
            Err(error) => {
                let told = scenario.refusal(&error);
                return refused(finding, told.help.as_deref(), &told.message);
            }
        };
        if let Some(warning) = scenario.warnings.first() {
            finding.turns(Verdict::Warned, || warning.message.clone());
        }
        let stepper = scenario.plan.stepper;
        let Some(ran) = self.run(finding, cell, &trial, stepper) else { return };
        let reference = self.reference(finding, cell, &trial);
        let reference = reference.as_ref().as_ref();
        match cell.column {
            Column::Event(tolerance) => {
                judge::balanced(finding, tolerance.max(ROUNDING), &ran);
                compared(finding, &trial, (&ran, tolerance), reference);
            }
            Column::Plain(_) => self.halved(finding, cell, &trial, (&ran, stepper, reference)),
        }
    }

    /// Runs a scenario. Returns `None` if the run did not finish.
    fn run(&self, finding: &mut Finding, cell: &Cell<'_>, trial: &Trial, stepper: Stepper) -> Option<Ran> {
        match trial.run(stepper) {
            Ok(ran) => {
                finding.took(ran.wall, ran.counts.detours);
                let Some(error) = &ran.error else { return Some(ran) };
                finding.turns(ending(cell, error), || format!("{error}; {}", error.advice()));
                None
            }
            Err(error) => {
                refused(finding, Some(""), &error.to_string());
                None
            }
        }
    }

    /// Returns the reference run of a scenario, computed once for all its cells.
    fn reference(&self, finding: &mut Finding, cell: &Cell<'_>, trial: &Trial) -> Arc<Option<Ran>> {
        let known = self.references.lock().unwrap_or_else(PoisonError::into_inner).get(&cell.row).cloned();
        if let Some(known) = known {
            return known;
        }
        let ran = trial.run(Stepper::Event { tolerance: REFERENCE }).ok();
        let ran = ran.filter(|ran| ran.error.is_none());
        if let Some(ran) = &ran {
            finding.took(ran.wall, ran.counts.detours);
        }
        let ran = Arc::new(ran);
        self.references.lock().unwrap_or_else(PoisonError::into_inner).insert(cell.row, Arc::clone(&ran));
        ran
    }

    /// Runs again at half and a quarter of the step, or a tenth and a hundredth of the tolerance. The differences give the own error of
    /// the method. The event stepper must lie within twice this error.
    fn halved(
        &self,
        finding: &mut Finding,
        cell: &Cell<'_>,
        trial: &Trial,
        (ran, stepper, reference): (&Ran, Stepper, Option<&Ran>),
    ) {
        let Some(half) = self.run(finding, cell, trial, finer(stepper)) else { return };
        let Some(fine) = self.run(finding, cell, trial, finer(finer(stepper))) else { return };
        // The larger of both, because one of them may be small by chance.
        let own = trial.apart(&half, &fine).by.max(0.5 * trial.apart(ran, &half).by);
        let Some(reference) = reference else {
            return finding.turns(Verdict::Undecided, || "the event stepper does not finish".to_owned());
        };
        let apart = trial.apart(&fine, reference);
        finding.row = [apart.by, own];
        if own > BLURRED {
            let by = apart.by;
            return finding.turns(Verdict::Undecided, || {
                format!("its own error is {own:.1e}, {by:.1e} from the event stepper")
            });
        }
        let allowed = FREE.max(2.0 * own);
        if apart.by <= allowed {
            return;
        }
        let growth = judge::growth(finding, trial, NUDGE, reference);
        finding.growth = growth;
        if apart.by > allowed * growth {
            let (by, name) = (apart.by, apart.name);
            finding.turns(Verdict::Wrong, || {
                format!("{name} {by:.1e} from the event stepper, its own error {own:.1e}, S {growth:.1e}")
            });
        }
    }
}

/// Returns the stepper with half the step, or a tenth of the tolerance.
fn finer(stepper: Stepper) -> Stepper {
    match stepper {
        Stepper::Verlet { step } => Stepper::Verlet { step: 0.5 * step },
        Stepper::Rk4 { step } => Stepper::Rk4 { step: 0.5 * step },
        Stepper::Dopri5 { tolerance } => Stepper::Dopri5 { tolerance: 0.1 * tolerance },
        Stepper::Event { tolerance } => Stepper::Event { tolerance: 0.1 * tolerance },
        Stepper::Frames { length, accuracy } => Stepper::Frames { length, accuracy: 0.1 * accuracy },
    }
}

/// Judges a refusal, which must contain the allowed range or advice.
fn refused(finding: &mut Finding, help: Option<&str>, message: &str) {
    let says = help.is_some() || message.starts_with("expected");
    let verdict = if says { Verdict::Refused } else { Verdict::Wrong };
    finding.turns(verdict, || {
        if says { judge::one_line(message) } else { format!("refused without advice: {message}") }
    });
}

/// Returns the verdict of an error. Only large scenarios may reach the time limit.
fn ending(cell: &Cell<'_>, error: &RunError) -> Verdict {
    let large = matches!(cell.family.name, "springs" | "periods");
    match error {
        RunError::TooManySteps { .. } | RunError::TooManyEvents { .. } => Verdict::Limited,
        RunError::OutOfTime { .. } if large => Verdict::Limited,
        RunError::OutOfTime { .. } => Verdict::Hung,
        RunError::Contact { .. } => Verdict::Left,
        _ => Verdict::Stopped,
    }
}

/// Compares a run of the event stepper with the reference.
fn compared(finding: &mut Finding, trial: &Trial, (ran, tolerance): (&Ran, f64), reference: Option<&Ran>) {
    let Some(reference) = reference else { return };
    let apart = trial.apart(ran, reference);
    finding.errors[0] = apart.by;
    let allowed = MOST * tolerance.max(REFERENCE).max(trial.rounding());
    if apart.by <= allowed {
        return;
    }
    let growth = judge::growth(finding, trial, NUDGE, reference);
    finding.growth = growth;
    if apart.by <= allowed * growth {
        return;
    }
    let coarse = judge::growth(finding, trial, tolerance.max(REFERENCE), reference);
    let verdict = if apart.by <= allowed * coarse { Verdict::Grazing } else { Verdict::Wrong };
    let (by, name, share) = (apart.by, apart.name, 100.0 * apart.share);
    finding.turns(verdict, || format!("{name} off by {by:.1e} at {share:.0} % of the run, S {growth:.1e}"));
}
