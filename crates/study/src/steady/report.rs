//! Report of a periodic orbit in JSON.

use super::{Aftermath, Ending, Kind, Multiplier, Steady, Way};
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_run::{Job, Real};

/// Report of a periodic orbit: the content of `steady.json`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Report {
    /// name of the scenario
    scenario: String,
    /// SHA-256 of the complete scenario, with all defaults and --set values
    scenario_sha256: String,
    /// name and version of the program
    program: String,
    /// tolerance of the search: local error per time step relative to the natural scales
    tolerance: Real,
    /// period of the orbit: common period of all waveforms
    period_s: Real,
    /// step length: displacement along x of the body named in `figures` in one period of the orbit. Absent if no body is
    /// free along x.
    #[serde(skip_serializing_if = "Option::is_none")]
    step_m: Option<Real>,
    /// uncertainty of the step length: a [first-order estimate,
    /// doubled](theory/periodic_orbits.md#error-of-the-step-length). Absent without a step length.
    #[serde(skip_serializing_if = "Option::is_none")]
    step_error_m: Option<Real>,
    /// mean velocity: step length divided by period. Absent without a step length.
    #[serde(skip_serializing_if = "Option::is_none")]
    speed_m_s: Option<Real>,
    /// whether small disturbances of the orbit decay. Absent if unknown, if a multiplier has modulus 1 within its
    /// error, or in a shakedown without growing disturbances.
    #[serde(skip_serializing_if = "Option::is_none")]
    stable: Option<bool>,
    /// ρ, largest modulus of the Floquet multipliers. 0 if there are none, null if they are unknown.
    #[serde(rename = "largest_multiplier")]
    radius: Real,
    multipliers: Vec<MultiplierReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    aftermath: Option<AftermathReport>,
    /// names of the unknowns of the Poincaré map
    unknowns: Vec<String>,
    /// unknowns whose influence on the Poincaré map is not known, because disturbing them changes the corners of a slip
    /// memory
    #[serde(rename = "without_multiplier")]
    untold: Vec<String>,
    /// number of drifts: directions in which only positions change
    drifts: usize,
    /// contacts whose slip memory is not part of the Poincaré map. These memories are correct on the orbit, but have no
    /// multipliers.
    #[serde(rename = "memories_not_in_map")]
    carried: Vec<String>,
    /// contacts that never slip grossly. Their slip memory near the centre never changes, so the orbit is one of a
    /// family.
    shaken_down: Vec<String>,
    /// number of simulated periods
    work_periods: u32,
    defects: Vec<DefectReport>,
    /// names of the files in the same folder. Absent if none were written.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// notes on the results. Absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

#[derive(Debug, Clone, Serialize, JsonSchema)]
struct MultiplierReport {
    /// real part of a Floquet multiplier λ. The multipliers are sorted by modulus, the largest first. A complex pair
    /// has one entry.
    re: Real,
    /// imaginary part of the multiplier, at least 0
    im: Real,
    /// |λ|, modulus of the multiplier: factor by which its disturbance changes per period
    modulus: Real,
    /// error of re, im and modulus. If the modulus is 1 within this error, the multiplier is `neutral`.
    error: Real,
    /// behaviour of the disturbance: `forgotten` (gone after one period), `decays`, `neutral` (neither decays nor
    /// grows) or `grows`
    kind: &'static str,
    /// period of the oscillation of the disturbance, in drive periods: 2π/|arg λ|. Absent if it does not oscillate.
    #[serde(skip_serializing_if = "Option::is_none")]
    oscillation_periods: Option<Real>,
    /// time constant of the disturbance, in drive periods: 1/|ln |λ||. Absent for `forgotten` and `neutral`.
    #[serde(skip_serializing_if = "Option::is_none")]
    time_constant_periods: Option<Real>,
    /// sentence about the disturbance
    #[serde(rename = "text")]
    words: String,
}

#[derive(Debug, Clone, Serialize, JsonSchema)]
struct AftermathReport {
    /// behaviour after an unstable orbit is disturbed by 1 % of the natural scales: the motion `repeats`, `oscillates`,
    /// is `irregular`, is `not_settled`, or the run `stops`. `aftermath` is absent for other orbits.
    ending: &'static str,
    /// number of simulated periods until the behaviour `ending` was found
    periods: usize,
    /// number of drive periods after which the motion repeats. 1 means another periodic orbit. Absent unless it
    /// `repeats`.
    #[serde(skip_serializing_if = "Option::is_none")]
    repeats_periods: Option<usize>,
    /// period of the oscillation in drive periods. Absent unless it `oscillates`.
    #[serde(skip_serializing_if = "Option::is_none")]
    oscillation_periods: Option<Real>,
    /// mean step length, of the repeated periods or of the last half of the periods
    #[serde(skip_serializing_if = "Option::is_none")]
    step_m: Option<Real>,
    /// smallest step length, of the repeated periods or of the last half of the periods
    #[serde(skip_serializing_if = "Option::is_none")]
    smallest_m: Option<Real>,
    /// largest step length, of the repeated periods or of the last half of the periods
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_m: Option<Real>,
    /// sentence about the behaviour after the disturbance
    #[serde(rename = "text")]
    words: String,
}

#[derive(Debug, Clone, Serialize, JsonSchema)]
struct DefectReport {
    /// defect of a period of the search: largest change of an unknown, relative to its natural scale
    size: Real,
    /// origin of the state at the start of a period of the search: `iteration` (end of the previous period) or `newton`
    /// (Newton step)
    #[serde(rename = "method")]
    way: &'static str,
}

impl Report {
    /// Creates the report of a periodic orbit and of the behaviour after a disturbance.
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

    /// Returns the report as JSON in one line.
    #[must_use]
    pub fn line(&self) -> String {
        // Numbers and strings only: serialisation cannot fail.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Returns the report as indented JSON.
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
    /// Returns the name of the behaviour in output files.
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
