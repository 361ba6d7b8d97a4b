//! What a drive would settle on, as far as a glance tells.

use super::{Kind, Options, Steady, SteadyError, find};
use stickslip_drive::Counts;
use stickslip_drive::scene::{Coordinate, EngineChoice, Freedom, Scene};
use stickslip_run::outlook::{Outlook, Repetition};
use stickslip_run::{Job, Real};

/// Local error per step: six digits of a step are enough to compare a run with.
const TOLERANCE: f64 = 1e-9;
/// Steps that a glance may take where a step is cheap: more than all examples need that have a motion to be found but one.
const STEPS: u64 = 75_000;
/// The part of a run's own steps that it may cost.
const SHARE: u64 = 5;
/// Periods that it takes at least: four to settle, one for Newton's method, two finer ones for the error, two to see it come back.
const LEAST: u64 = 9;
/// Coordinates and contacts up to which a step is: more than those of any example.
const FEW: usize = 16;
/// Springs of a row that cost what a contact without a row does.
const SPRINGS: usize = 64;

impl Steady {
    /// What is told of it beside a run; none where no body steps.
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
                format!("; that of what {} remembers is not known and may stay longer", carried.join(", "))
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
                Some(doubt) => format!("decays or is neutral, which is not known: {doubt}"),
            },
            carried,
            shaken_down: self.named(&self.shaken_down),
        })
    }

    /// That it is not known what becomes of a disturbance of some numbers.
    fn not_told(&self) -> Option<String> {
        Some(format!("; of {} that is not known", self.names_untold()?))
    }

    /// What becomes of a disturbance, in words: of what stays, and of what fades slowest beside it; and whether others like it do as well.
    fn becomes(&self) -> String {
        let Some(largest) = self.multipliers.first() else { return "is gone after a period".to_owned() };
        let stays = largest.kind() == Kind::Stays;
        let slowest = self.multipliers.iter().find(|multiplier| stays && multiplier.kind() == Kind::Fades);
        let rest = slowest
            .map_or_else(String::new, |slowest| format!("; of the others the slowest {}", slowest.words()));
        let is_of_family = stays && self.is_one_of_many() || !self.shaken_down.is_empty();
        let family = if is_of_family { "; this is one motion of a family" } else { "" };
        largest.words() + &rest + family
    }
}

/// Steps that a glance at a scene may take: the fewer, the more there is to every one. Counted, not timed, so that a scenario has one
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

/// What is said where a share of a run's steps does not lead to it.
fn too_few(steps: u64) -> Outlook {
    let asked = "`stickslip steady` and figures.steady_motion=true search without this limit";
    Outlook::NotFound {
        fault: format!(
            "no steady motion found: the search stopped at its limit of {steps} integration steps, a fifth of those of the run; {asked}"
        ),
    }
}

/// What a job's drive would settle on, if that can be told at little cost, or is asked for at any; none of scenes that do not ask the
/// question: without a period, without a free body that figures are of, and of those that say no to it. Beside a run, whose counts are
/// given, it costs at most a share of its steps. `goes_on` is asked before every period; `false` gives up.
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
        // Its first line says what, the others what to try.
        Err(error) => {
            let fault = error.to_string().lines().next().unwrap_or_default().to_owned();
            Some(Outlook::NotFound { fault })
        }
    }
}
