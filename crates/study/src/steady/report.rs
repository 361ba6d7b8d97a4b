//! What is told of a steady motion, as JSON.

use super::{Aftermath, Ending, Kind, Multiplier, Steady, Way};
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_run::{Job, Real};

/// What is told of a steady motion, as `steady.json` has it.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Report {
    /// name of the scenario
    scenario: String,
    /// SHA-256 of the resolved scenario
    scenario_sha256: String,
    /// name and version of the program
    program: String,
    /// local error per step, in natural scales
    tolerance: Real,
    /// period, common to all waveforms
    period_s: Real,
    /// way of the body of the figures along x in a period
    #[serde(skip_serializing_if = "Option::is_none")]
    step_m: Option<Real>,
    /// how far the step may be off: an estimate, [doubled](steady.md#bound)
    #[serde(skip_serializing_if = "Option::is_none")]
    step_error_m: Option<Real>,
    /// step over period
    #[serde(skip_serializing_if = "Option::is_none")]
    speed_m_s: Option<Real>,
    /// whether a run that is disturbed a little comes back; left out where a disturbance neither decays nor grows, of a
    /// shakedown unless it grows, as a run may end in another of its family, and where the memory of a contact that never slips
    /// grossly is `carried`: its multipliers are not known
    #[serde(skip_serializing_if = "Option::is_none")]
    stable: Option<bool>,
    /// ρ, largest magnitude of a multiplier; 0 where there is none, null where they are not known
    #[serde(rename = "largest_multiplier")]
    radius: Real,
    multipliers: Vec<MultiplierReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    aftermath: Option<AftermathReport>,
    /// the numbers that the map of a period is of
    unknowns: Vec<String>,
    /// those without a multiplier: memories come back with other knots when one of them is disturbed
    #[serde(rename = "without_multiplier")]
    untold: Vec<String>,
    /// number of ways along which nothing changes but the place
    drifts: usize,
    /// contacts whose memories are no numbers of the map: they are propagated beside it, and multipliers do not include them
    #[serde(rename = "memories_not_in_map")]
    carried: Vec<String>,
    /// contacts that never slip grossly: what they hold near the centre they hold for ever, and this motion is the nearest of a
    /// whole family
    shaken_down: Vec<String>,
    /// periods that were computed
    work_periods: u32,
    defects: Vec<DefectReport>,
    /// names of the files beside it
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// what is to be known of the rest
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

#[derive(Debug, Clone, Serialize, JsonSchema)]
struct MultiplierReport {
    /// real part of a Floquet multiplier, the largest first; of a pair one stands for both
    re: Real,
    /// its imaginary part, at least 0
    im: Real,
    /// |λ|, by which a disturbance has become larger after a period
    modulus: Real,
    /// how far both parts, and |λ|, may be off: one as near to 1 as that is `neutral`
    error: Real,
    /// what a disturbance does: it is `forgotten` after a period, `decays`, is `neutral` (stays as it is) or `grows`
    kind: &'static str,
    /// 2π/|arg λ|, drive periods of one oscillation; none where it does not oscillate
    #[serde(skip_serializing_if = "Option::is_none")]
    oscillation_periods: Option<Real>,
    /// 1/|ln |λ||, periods in which it becomes e times smaller, or larger
    #[serde(skip_serializing_if = "Option::is_none")]
    time_constant_periods: Option<Real>,
    /// the same in words
    #[serde(rename = "text")]
    words: String,
}

#[derive(Debug, Clone, Serialize, JsonSchema)]
struct AftermathReport {
    /// what a run ends on that leaves an unstable motion, every number of it disturbed by a hundredth of a natural scale: it
    /// `repeats` itself, `oscillates`, is `irregular`, is `not_settled`, or `stops`
    ending: &'static str,
    /// periods until then
    periods: usize,
    /// after how many periods it repeats itself; 1: another steady motion
    #[serde(skip_serializing_if = "Option::is_none")]
    repeats_periods: Option<usize>,
    /// drive periods of one oscillation
    #[serde(skip_serializing_if = "Option::is_none")]
    oscillation_periods: Option<Real>,
    /// mean step of what repeats itself, else of the last half
    #[serde(skip_serializing_if = "Option::is_none")]
    step_m: Option<Real>,
    /// the shortest of these steps
    #[serde(skip_serializing_if = "Option::is_none")]
    smallest_m: Option<Real>,
    /// the longest of these steps
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_m: Option<Real>,
    /// the same in words
    #[serde(rename = "text")]
    words: String,
}

#[derive(Debug, Clone, Serialize, JsonSchema)]
struct DefectReport {
    /// largest change of a number in a period of the search, in natural scales
    size: Real,
    /// how the state of that period was found: `iteration`, from the end of the period before, or `newton`
    #[serde(rename = "method")]
    way: &'static str,
}

impl Report {
    /// What is told of a job's steady motion, and of what a run ends on that leaves it.
    #[must_use]
    pub fn of(job: &Job, found: &Steady, aftermath: Option<&Aftermath>) -> Self {
        let defect = |defect: &super::Defect| DefectReport {
            size: Real(defect.size),
            way: match defect.way {
                Way::Plain => "iteration",
                Way::Newton => "newton",
            },
        };
        Self {
            scenario: job.name.clone(),
            scenario_sha256: job.hash.clone(),
            program: job.program.clone(),
            tolerance: Real(found.tolerance),
            period_s: Real(found.period),
            step_m: found.step.map(Real),
            step_error_m: found.step.map(|_| Real(found.bound)),
            speed_m_s: found.speed().map(Real),
            stable: found.comes_back(),
            radius: Real(found.radius()),
            multipliers: found.multipliers.iter().map(MultiplierReport::of).collect(),
            aftermath: aftermath.map(AftermathReport::of),
            unknowns: found.unknowns.clone(),
            untold: found.untold.clone(),
            drifts: found.drifts,
            carried: found.named(&found.carried),
            shaken_down: found.named(&found.shaken_down),
            work_periods: found.work,
            defects: found.defects.iter().map(defect).collect(),
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// On one line.
    #[must_use]
    pub fn line(&self) -> String {
        // Numbers and strings only: there is nothing that JSON could refuse.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// As a file.
    #[must_use]
    pub fn file(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

impl MultiplierReport {
    fn of(multiplier: &Multiplier) -> Self {
        Self {
            re: Real(multiplier.re),
            im: Real(multiplier.im),
            modulus: Real(multiplier.modulus()),
            error: Real(multiplier.error),
            kind: multiplier.kind().name(),
            oscillation_periods: multiplier.beat().map(Real),
            time_constant_periods: multiplier.periods().map(Real),
            words: multiplier.words(),
        }
    }
}

impl AftermathReport {
    fn of(aftermath: &Aftermath) -> Self {
        let [step, least, most] = aftermath.range().map_or([None; 3], |range| range.map(|x| Some(Real(x))));
        let (repeats, beat) = match aftermath.ending {
            Ending::Repeats(periods) => (Some(periods), None),
            Ending::Beats(period) => (None, Some(Real(period))),
            Ending::Irregular | Ending::Underway | Ending::Stops(_) => (None, None),
        };
        Self {
            ending: aftermath.ending.name(),
            periods: aftermath.periods,
            repeats_periods: repeats,
            oscillation_periods: beat,
            step_m: step,
            smallest_m: least,
            largest_m: most,
            words: aftermath.words(),
        }
    }
}

impl Kind {
    /// Its word in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Forgotten => "forgotten",
            Self::Fades => "decays",
            Self::Stays => "neutral",
            Self::Grows => "grows",
        }
    }
}
