//! Search for the periodic orbit at limited cost, for the summary of a run.

use super::{Kind, Options, Steady, SteadyError, find};
use stickslip_drive::Counts;
use stickslip_drive::scene::{Coordinate, EngineChoice, Freedom, Scene};
use stickslip_run::outlook::{Outlook, Repetition};
use stickslip_run::{Job, Real};

/// Tolerance of the local error per time step, which gives about six digits of the step length.
const TOLERANCE: f64 = 1e-9;
/// Maximum number of time steps for a small model.
const STEPS: u64 = 75_000;
/// Ratio of the time steps of a run to the maximum time steps of the search: a fifth of the steps is allowed.
const SHARE: u64 = 5;
/// Minimum number of periods of a search: four simulated, one for Newton's method, two for the error estimate, two for verification.
const LEAST: u64 = 9;
/// Number of free coordinates and contacts up to which a model is small.
const FEW: usize = 16;
/// Number of discrete springs that cost as much as a contact with a piecewise linear slip memory.
const SPRINGS: usize = 64;

impl Steady {
    /// Returns the entry about the periodic orbit for the summary of a run. Returns `None` if no body makes steps.
    #[must_use]
    pub fn repetition(&self, job: &Job) -> Option<Repetition> {
        let waveform = job.scenario.figures.waveform.and_then(|w| job.scenario.scene.waveforms.get(w));
        let own = waveform.and_then(|waveform| waveform.part.period());
        let periods = own.map_or(1, |own| self.periods_of(own) as u64);
        let largest = self.multipliers.first();
        let carried = self.named(&self.carried);
        let led = match carried.is_empty() {
            true => String::new(),
            false => {
                format!("; a disturbance of the memory of {} may last longer", carried.join(", "))
            }
        };
        Some(Repetition {
            step: Real(self.step?),
            error: Real(self.bound),
            speed: Real(self.speed()?),
            stable: self.comes_back(),
            periods,
            radius: Real(self.radius()),
            beat: largest.and_then(super::Multiplier::beat).map(Real),
            fold: largest.and_then(super::Multiplier::periods).map(Real),
            words: match self.doubt() {
                None => self.becomes() + &self.not_told().unwrap_or_default() + &led,
                Some(doubt) => format!("decays or is neutral: {doubt}"),
            },
            carried,
            shaken_down: self.named(&self.shaken_down),
        })
    }

    /// Returns a phrase which states that the effect of some disturbances is unknown.
    fn not_told(&self) -> Option<String> {
        Some(format!("; the effect of {} is not known", self.names_untold()?))
    }

    /// Describes a disturbance by the largest multiplier. If it is neutral, also describes the slowest decaying multiplier, and states
    /// whether the orbit is one of a family.
    fn becomes(&self) -> String {
        let Some(largest) = self.multipliers.first() else { return "vanishes within a period".to_owned() };
        let stays = largest.kind() == Kind::Stays;
        let slowest = self.multipliers.iter().find(|multiplier| stays && multiplier.kind() == Kind::Fades);
        let rest = slowest
            .map_or_else(String::new, |slowest| format!("; the slowest of the others {}", slowest.words()));
        let is_of_family = stays && self.is_one_of_many() || !self.shaken_down.is_empty();
        let family = if is_of_family { "; the orbit is one of a family" } else { "" };
        largest.words() + &rest + family
    }
}

/// Returns the maximum number of time steps of the search; larger models get fewer steps. A limit of steps instead of time gives the same
/// answer on all machines.
fn steps(scene: &Scene) -> u64 {
    let is_free = |coordinate: &Coordinate| coordinate.freedom == Freedom::Free;
    let coordinates = scene.bodies.iter().flat_map(|body| body.part.coordinates());
    let free = coordinates.filter(|(_, coordinate)| is_free(coordinate)).count();
    let contacts = scene.contacts.iter().map(|contact| match contact.part.engine {
        EngineChoice::Curve => 1,
        EngineChoice::Springs { count, .. } => 1 + count / SPRINGS,
    });
    let parts = (free + contacts.sum::<usize>()).max(FEW);
    STEPS * FEW as u64 / parts as u64
}

/// Returns the entry for a search that reached its limit of time steps.
fn too_few(steps: u64) -> Outlook {
    let asked = "`stickslip steady` and figures.steady_motion=true search without this limit";
    Outlook::NotFound {
        fault: format!(
            "no periodic orbit found: the search stopped at its limit of {steps} time steps, a fifth of those of the run; {asked}"
        ),
    }
}

/// Searches for the periodic orbit of a drive at limited cost, or without limit if the scenario requests this.
///
/// Returns `None` if the scenario excludes the search, has no period, or has no free body named in `figures`. With the counts of a run, the
/// search takes at most a fifth of the run's time steps. `goes_on` is called before every period; `false` interrupts the search.
pub fn outlook(job: &Job, run: Option<Counts>, goes_on: &dyn Fn() -> bool) -> Option<Outlook> {
    let (_, waveform) = job.scenario.figures.body.zip(job.scenario.figures.waveform)?;
    let share = run.map(|run| (run.steps + run.rejected) / SHARE);
    let steps = match job.scenario.steady_motion {
        Some(true) => u64::MAX,
        Some(false) => return None,
        None => steps(&job.scenario.scene).min(share.unwrap_or(u64::MAX)),
    };
    let period = job.scenario.scene.waveforms.get(waveform)?.part.period()?;
    if Some(steps) == share && job.scenario.plan.duration < (SHARE * LEAST) as f64 * period {
        return Some(too_few(steps));
    }
    let options = Options { tolerance: TOLERANCE, steps, goes_on, ..Options::default() };
    match find(job, &options) {
        Ok(found) => found.repetition(job).map(Outlook::Found),
        Err(
            SteadyError::NoPeriod
            | SteadyError::NothingFree
            | SteadyError::Endless(_)
            | SteadyError::Commanded(_)
            | SteadyError::Interrupted(_),
        ) => None,
        Err(SteadyError::Costly { steps }) if Some(steps) == share => Some(too_few(steps)),
        // The first line of the message is the error, further lines are advice.
        Err(error) => {
            let fault = error.to_string().lines().next().unwrap_or_default().to_owned();
            Some(Outlook::NotFound { fault })
        }
    }
}
