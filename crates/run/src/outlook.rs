//! What a drive would settle on, told before a run and beside it.

use schemars::JsonSchema;
use serde::Serialize;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// The motion of a drive that repeats itself every period, as whoever has looked for it tells it: `study` does.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Outlook {
    /// It is there.
    Found(Repetition),
    /// It was not found.
    NotFound {
        /// why it was not found at little cost, beside a run a fifth of its steps; the others are left out then
        fault: String,
    },
}

/// A motion that repeats itself every period.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Repetition {
    /// displacement of the body of the figures along x in a period of the steady motion, [found directly](steady.md), as if waveforms
    /// never ended
    #[serde(rename = "step_m")]
    pub step: Real,
    /// how far that step may be off: an estimate, [doubled](steady.md#bound)
    #[serde(rename = "step_error_m")]
    pub error: Real,
    /// step over period
    #[serde(rename = "speed_m_s")]
    pub speed: Real,
    /// whether a run that is disturbed a little comes back to it; left out where a disturbance neither decays nor grows, of a
    /// shakedown unless it grows, and where that is not known
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<bool>,
    /// periods of the figures' waveform in a period of the motion, which is the common one of all waveforms; left out where it
    /// is 1
    #[serde(skip_serializing_if = "is_one")]
    pub periods: u64,
    /// largest magnitude of a Floquet multiplier: what is left of a disturbance after a period
    #[serde(rename = "largest_multiplier")]
    pub radius: Real,
    /// drive periods in which the slowest disturbance oscillates once; left out where it does not oscillate
    #[serde(rename = "oscillation_periods", skip_serializing_if = "Option::is_none")]
    pub beat: Option<Real>,
    /// drive periods in which that disturbance decays, or grows, by a factor of e: its time constant
    #[serde(rename = "time_constant_periods", skip_serializing_if = "Option::is_none")]
    pub fold: Option<Real>,
    /// what becomes of that disturbance, in words
    #[serde(rename = "text")]
    pub words: String,
    /// contacts whose slip memory is no unknown of the Poincaré map: disturbances of what they remember may decay more slowly
    #[serde(rename = "memories_not_in_map", skip_serializing_if = "Vec::is_empty")]
    pub carried: Vec<String>,
    /// contacts that never slip grossly: the motion is one of a whole family, and what they slide in a period counts as its
    /// error
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub shaken_down: Vec<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_one(periods: &u64) -> bool {
    *periods == 1
}

impl Repetition {
    /// Whether there is a step, longer than it may be off.
    #[must_use]
    pub fn steps(&self) -> bool {
        self.step.0.abs() > self.error.0
    }

    /// The step in words: `1.2 µm a period`, or that there is none, where it is no longer than it may be off.
    #[must_use]
    pub fn step_words(&self) -> String {
        step_words(self.step, self.error, self.periods)
    }
}

/// A step and how far it may be off, m, in so many periods of a drive, in words.
#[must_use]
pub fn step_words(step: Real, error: Real, periods: u64) -> String {
    let each = if periods == 1 { "a period".to_owned() } else { format!("in {periods} periods") };
    if step.0 == 0.0 && error.0 == 0.0 {
        return "no step".to_owned();
    }
    if step.0.abs() <= error.0 {
        return format!("no step, less than {} {each}", quantity(Real(step.0.abs() + error.0), "m"));
    }
    format!("{} ± {} {each}", quantity(step, "m"), quantity(error, "m"))
}
