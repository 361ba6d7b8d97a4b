//! Second method: a row of springs by velocity Verlet. The method shares neither force law, memory nor time steps with the event stepper
//! on the memory curve.

use super::finding::{Finding, Verdict};
use super::judge;
use super::trial::{Ran, Trial};
use stickslip_drive::scene::EngineChoice;
use stickslip_drive::{SceneError, Stepper};

/// Number of springs of a row.
const SPRINGS: usize = 2048;
/// Largest allowed difference, in natural units.
const MOST: f64 = 1e-5;
/// Number of steps of the first run; each further run doubles the number.
const STEPS: f64 = 20_000.0;
/// Largest number of steps.
const FINEST: f64 = 700_000.0;
/// Perturbation of the start whose growth factor is S.
const NUDGE: f64 = 1e-9;

/// Compares the memory-curve engine with rows of springs, whose time step is halved until the result changes little.
pub(super) fn against_row(finding: &mut Finding, trial: &Trial, finest: &Ran) {
    // If the scenario has rows of springs, the memory curve is used for the comparison.
    let was_row = trial.scene.contacts.iter().any(|contact| contact.part.engine != EngineChoice::Curve);
    let (Ok(rows), Ok(curve)) = (on(trial, row(SPRINGS)), on(trial, EngineChoice::Curve)) else { return };
    let on_curve = was_row.then(|| curve.run(Stepper::Event { tolerance: 1e-10 }).ok()).flatten();
    let finest = on_curve.as_ref().unwrap_or(finest);
    let Some(Reference { ran, own, step }) = reference(finding, &rows) else { return };
    let apart = trial.apart(finest, &ran);
    finding.row = [apart.by, own];
    // Twice the own error: the last halving leaves a third of it, and rows follow chords.
    let allowed = MOST.max(2.0 * own);
    if apart.by <= allowed {
        return;
    }
    // The error of a row at least halves with twice as many springs.
    let cells = halved(finding, trial, &ran, step);
    finding.row[1] = own + cells;
    let allowed = allowed.max(2.0 * (own + cells));
    if apart.by <= allowed {
        return;
    }
    let growth = judge::growth(finding, &curve, NUDGE, finest);
    finding.growth = finding.growth.max(growth);
    if apart.by > allowed * finding.growth {
        let (by, name, own) = (apart.by, apart.name, finding.row[1]);
        finding.turns(Verdict::Wrong, || {
            format!("{name} differs by {by:.1e} from {SPRINGS} springs by verlet, whose own error is {own:.1e}, S {growth:.1e}")
        });
    }
}

fn row(count: usize) -> EngineChoice {
    EngineChoice::Springs { count, span: None }
}

/// Returns the scenario with one contact engine for all contacts.
fn on(trial: &Trial, engine: EngineChoice) -> Result<Trial, SceneError> {
    let mut scene = trial.scene.clone();
    scene.contacts.iter_mut().for_each(|contact| contact.part.engine = engine);
    Trial::new(scene, trial.plan)
}

/// Returns the difference to a row of half as many springs at the same step, or 0 if that row cannot be run.
fn halved(finding: &mut Finding, trial: &Trial, reference: &Ran, step: f64) -> f64 {
    let Ok(rows) = on(trial, row(SPRINGS / 2)) else { return 0.0 };
    let Ok(ran) = rows.run(Stepper::Verlet { step }) else { return 0.0 };
    finding.took(ran.wall, 0);
    if ran.error.is_some() { 0.0 } else { trial.apart(reference, &ran).by }
}

/// Run with fixed steps.
struct Reference {
    ran: Ran,
    /// Own error in natural units: the difference from the run at twice the step, but at least half of the previous error. Single
    /// differences may be small by chance.
    own: f64,
    /// Step, s.
    step: f64,
}

/// Returns the reference, or `None` if fixed steps do not converge.
fn reference(finding: &mut Finding, rows: &Trial) -> Option<Reference> {
    let (mut steps, mut last): (f64, Option<Reference>) = (STEPS, None);
    while steps <= FINEST {
        let step = rows.plan.duration / steps;
        steps *= 2.0;
        // The run is refused if the stiffest mode is unstable at this step; a shorter step may be stable.
        let Ok(ran) = rows.run(Stepper::Verlet { step }) else { continue };
        finding.took(ran.wall, 0);
        if ran.error.is_some() {
            break;
        }
        let own = last.as_ref().map_or(f64::INFINITY, |before| {
            let apart = rows.apart(&before.ran, &ran).by;
            if before.own.is_finite() { apart.max(0.5 * before.own) } else { 2.0 * apart }
        });
        last = Some(Reference { ran, own, step });
        if own <= 0.3 * MOST {
            break;
        }
    }
    last.filter(|reference| reference.own.is_finite())
}
