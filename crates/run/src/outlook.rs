//! Properties of the periodic orbit of a drive, as part of `info` and of the summary of a run.

use schemars::JsonSchema;
use serde::Serialize;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// Result of the search for the periodic orbit. The crate `study` performs the search.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Outlook {
    /// The orbit was found.
    Found(Repetition),
    /// The orbit was not found.
    NotFound {
        /// reason why the periodic orbit was not found. The search is limited, in a run to a fifth of its time steps.
        /// All other keys of steady_motion are then absent.
        fault: String,
    },
}

/// Periodic orbit of a drive.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Repetition {
    /// step length of the [periodic orbit](theory/periodic_orbits.md) with endless waveforms: displacement along x of
    /// the body named in `figures` in one period of the orbit
    #[serde(rename = "step_m")]
    pub step: Real,
    /// uncertainty of the step length of the periodic orbit: a [first-order estimate,
    /// doubled](theory/periodic_orbits.md#error-of-the-step-length)
    #[serde(rename = "step_error_m")]
    pub error: Real,
    /// mean velocity of the periodic orbit: step length divided by period
    #[serde(rename = "speed_m_s")]
    pub speed: Real,
    /// whether small disturbances of the periodic orbit decay. Absent if unknown, if a multiplier has modulus 1 within
    /// its error, or in a shakedown without growing disturbances.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<bool>,
    /// period of the orbit divided by the period of the waveform named in `figures`. All waveforms have this common
    /// period. Absent if 1.
    #[serde(skip_serializing_if = "is_one")]
    pub periods: u64,
    /// largest modulus of the Floquet multipliers: factor by which the slowest disturbance changes per period of the
    /// orbit
    #[serde(rename = "largest_multiplier")]
    pub radius: Real,
    /// period of the oscillation of the slowest disturbance, in drive periods. Absent if it does not oscillate.
    #[serde(rename = "oscillation_periods", skip_serializing_if = "Option::is_none")]
    pub beat: Option<Real>,
    /// time constant of the slowest disturbance, in drive periods: it decays or grows by a factor of e in this time.
    /// Absent if the multiplier is 0 or has modulus 1.
    #[serde(rename = "time_constant_periods", skip_serializing_if = "Option::is_none")]
    pub fold: Option<Real>,
    /// sentence about the slowest disturbance
    #[serde(rename = "text")]
    pub words: String,
    /// contacts whose slip memory is not part of the Poincaré map. Disturbances of these memories may decay more slowly
    /// than the multipliers show. Absent if there are none.
    #[serde(rename = "memories_not_in_map", skip_serializing_if = "Vec::is_empty")]
    pub carried: Vec<String>,
    /// contacts that never slip grossly, so that the orbit is one of a family. Their sliding per period is part of the
    /// error. Absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub shaken_down: Vec<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_one(periods: &u64) -> bool {
    *periods == 1
}

impl Repetition {
    /// Returns whether the step length exceeds its error.
    #[must_use]
    pub fn steps(&self) -> bool {
        self.step.0.abs() > self.error.0
    }

    /// Returns the step length as text, such as `1.2 µm a period`, or `no step` if the length does not exceed its error.
    #[must_use]
    pub fn step_words(&self) -> String {
        step_words(self.step, self.error, self.periods)
    }
}

/// Returns a displacement with its error, m, in `periods` drive periods as text.
#[must_use]
pub fn step_words(step: Real, error: Real, periods: u64) -> String {
    let each = if periods == 1 { "a period".to_owned() } else { format!("in {periods} periods") };
    if step.0 == 0.0 && error.0 == 0.0 {
        return "no step".to_owned();
    }
    if step.0.abs() <= error.0 {
        return format!("no step, below {} {each}", quantity(Real(step.0.abs() + error.0), "m"));
    }
    format!("{} ± {} {each}", quantity(step, "m"), quantity(error, "m"))
}
