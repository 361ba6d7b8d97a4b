//! The second method: a row of springs by velocity Verlet, which shares neither forces, memory nor steps with the event stepper
//! on the curve.

use super::finding::{Finding, Verdict};
use super::judge;
use super::trial::{Ran, Trial};
use stickslip_drive::scene::EngineChoice;
use stickslip_drive::{SceneError, Stepper};

/// Springs of a row.
const SPRINGS: usize = 2048;
/// Most error against it, in natural units.
const MOST: f64 = 1e-5;
/// Steps of the first run of the reference; each later one halves them, at most to …
const STEPS: f64 = 20_000.0;
/// … this many.
const FINEST: f64 = 700_000.0;
/// Change of the start whose growth is S.
const NUDGE: f64 = 1e-9;

/// Compares the scene on the curve with the same on rows by steps halved until their difference is small.
pub(super) fn against_row(finding: &mut Finding, trial: &Trial, finest: &Ran) {
    // The curve of a scene that was on rows is its second method, too.
    let was_row = trial.scene.contacts.iter().any(|contact| contact.part.engine != EngineChoice::Curve);
    let (Ok(rows), Ok(curve)) = (on(trial, row(SPRINGS)), on(trial, EngineChoice::Curve)) else { return };
    let on_curve = was_row.then(|| curve.run(Stepper::Event { tolerance: 1e-10 }).ok()).flatten();
    let finest = on_curve.as_ref().unwrap_or(finest);
    let Some(Reference { ran, own, step }) = reference(finding, &rows) else { return };
    let apart = trial.apart(finest, &ran);
    finding.row = [apart.by, own];
    // Twice its own error: the last halving leaves a third of it, and rows follow chords.
    let allowed = MOST.max(2.0 * own);
    if apart.by <= allowed {
        return;
    }
    // A row is a sum over cells, and its error halves at the least with twice as many.
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
            format!("{name} {by:.1e} from a row of {SPRINGS} springs by verlet, itself good to {own:.1e}, S {growth:.1e}")
        });
    }
}

fn row(count: usize) -> EngineChoice {
    EngineChoice::Springs { count, span: None }
}

/// The scene with all contacts on an engine.
fn on(trial: &Trial, engine: EngineChoice) -> Result<Trial, SceneError> {
    let mut scene = trial.scene.clone();
    scene.contacts.iter_mut().for_each(|contact| contact.part.engine = engine);
    Trial::new(scene, trial.plan)
}

/// How far a row of half the springs is away at the same step; nothing known where it cannot be run.
fn halved(finding: &mut Finding, trial: &Trial, reference: &Ran, step: f64) -> f64 {
    let Ok(rows) = on(trial, row(SPRINGS / 2)) else { return 0.0 };
    let Ok(ran) = rows.run(Stepper::Verlet { step }) else { return 0.0 };
    finding.took(ran.wall, 0);
    if ran.error.is_some() { 0.0 } else { trial.apart(reference, &ran).by }
}

/// A run by fixed steps.
struct Reference {
    ran: Ran,
    /// Its difference from the run at twice its step, or half that of those before, in natural units: where a touch falls on
    /// the grid, differences get small by chance.
    own: f64,
    /// s.
    step: f64,
}

/// The reference; none where fixed steps do not follow the scene.
fn reference(finding: &mut Finding, rows: &Trial) -> Option<Reference> {
    let (mut steps, mut last): (f64, Option<Reference>) = (STEPS, None);
    while steps <= FINEST {
        let step = rows.plan.duration / steps;
        steps *= 2.0;
        // Refused where the stiffest motion grows at this step: a shorter one may do.
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
