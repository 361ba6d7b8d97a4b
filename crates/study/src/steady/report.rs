//! What is told of a steady motion, as JSON.

use super::{Aftermath, Ending, Kind, Multiplier, Steady, Way};
use serde::Serialize;
use stickslip_run::{Job, Real};

/// What is told of a steady motion, as `steady.json` has it.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    scenario: String,
    scenario_sha256: String,
    program: String,
    tolerance: Real,
    period_s: Real,
    #[serde(skip_serializing_if = "Option::is_none")]
    step_m: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step_error_m: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed_m_s: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stable: Option<bool>,
    radius: Real,
    multipliers: Vec<MultiplierReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    aftermath: Option<AftermathReport>,
    unknowns: Vec<String>,
    untold: Vec<String>,
    drifts: usize,
    carried: Vec<String>,
    shaken_down: Vec<String>,
    work_periods: u32,
    defects: Vec<DefectReport>,
    /// Names of the files beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// What is to be known of the rest.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

#[derive(Debug, Clone, Serialize)]
struct MultiplierReport {
    re: Real,
    im: Real,
    modulus: Real,
    error: Real,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    beat_periods: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fold_periods: Option<Real>,
    words: String,
}

#[derive(Debug, Clone, Serialize)]
struct AftermathReport {
    ending: &'static str,
    periods: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    repeats_periods: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beat_periods: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step_m: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    least_m: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    most_m: Option<Real>,
    words: String,
}

#[derive(Debug, Clone, Serialize)]
struct DefectReport {
    size: Real,
    way: &'static str,
}

impl Report {
    /// What is told of a job's steady motion, and of what a run ends on that leaves it.
    #[must_use]
    pub fn of(job: &Job, found: &Steady, aftermath: Option<&Aftermath>) -> Self {
        let defect = |defect: &super::Defect| DefectReport {
            size: Real(defect.size),
            way: match defect.way {
                Way::Plain => "plain",
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
            beat_periods: multiplier.beat().map(Real),
            fold_periods: multiplier.periods().map(Real),
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
            beat_periods: beat,
            step_m: step,
            least_m: least,
            most_m: most,
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
            Self::Fades => "fades",
            Self::Stays => "stays",
            Self::Grows => "grows",
        }
    }
}
