//! What a drive would settle on, told before a run and beside it.

use serde::Serialize;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// The motion of a drive that repeats itself every period, as whoever has looked for it tells it: `study` does.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Outlook {
    /// It is there.
    Found(Repetition),
    /// It was not found.
    NotFound {
        /// Why.
        fault: String,
    },
}

/// A motion that repeats itself every period.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Repetition {
    /// Way of the figures' body along x in a period, m.
    #[serde(rename = "step_m")]
    pub step: Real,
    /// How far the step may be off, m.
    #[serde(rename = "step_error_m")]
    pub error: Real,
    /// Step over period, m/s.
    #[serde(rename = "speed_m_s")]
    pub speed: Real,
    /// Whether a run that is disturbed a little comes back; none where a disturbance stays as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<bool>,
    /// Periods of the figures' waveform in a period of the motion: the common one of all waveforms may be longer.
    #[serde(skip_serializing_if = "is_one")]
    pub periods: u64,
    /// Largest magnitude of a Floquet multiplier: what is left of a disturbance after a period; 0 without any.
    pub radius: Real,
    /// Periods of the drive to a beat of the disturbance that stays longest.
    #[serde(rename = "beat_periods", skip_serializing_if = "Option::is_none")]
    pub beat: Option<Real>,
    /// Periods in which that disturbance falls, or grows, by e.
    #[serde(rename = "fold_periods", skip_serializing_if = "Option::is_none")]
    pub fold: Option<Real>,
    /// What becomes of that disturbance, in words.
    pub words: String,
    /// Contacts whose memories were led along: nothing is known of their disturbances.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub carried: Vec<String>,
    /// Contacts that never slip grossly.
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
