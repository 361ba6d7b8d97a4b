//! Axis of a map: a parameter with its range.

use super::MapError;
use crate::curve::Range;
use crate::number::text;
use stickslip_run::Job;

/// A parameter with its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Key path.
    pub path: String,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Start and end, SI.
    pub range: [f64; 2],
    /// Whether the axis is logarithmic.
    pub is_logarithmic: bool,
}

impl Axis {
    /// Creates the axis from a key path and a range such as `0.1N..10N`. `option` is the command-line option, for messages.
    ///
    /// # Errors
    /// Fails if the parameter does not exist or the range is invalid.
    pub(super) fn new(
        job: &Job,
        option: &'static str,
        (path, range): &(String, String),
        is_logarithmic: bool,
    ) -> Result<Self, MapError> {
        let refused = |message: String| MapError::Range { option, message };
        let found = job.scenario.number(path)?;
        let range = Range::ends(range, found.unit).map_err(refused)?;
        let shown = |value: f64| format!("{value} {}", found.unit).trim_end().to_owned();
        let [from, to] = range.map(shown);
        if !(range[0] < range[1] && (range[1] - range[0]).is_finite()) {
            return Err(refused(format!(
                "expected a range that rises from one finite value to another, got {from} to {to}"
            )));
        }
        if is_logarithmic && range[0] <= 0.0 {
            let message = format!("a logarithmic axis needs a range above 0, got {from} to {to}");
            return Err(refused(message));
        }
        Ok(Self { path: path.clone(), unit: found.unit, range, is_logarithmic })
    }

    /// Returns the value at a fraction of the axis, 0 to 1.
    #[must_use]
    pub fn at(&self, share: f64) -> f64 {
        let [from, to] = self.range;
        match share {
            share if share <= 0.0 => from,
            share if share >= 1.0 => to,
            share if self.is_logarithmic => from * math::powf(to / from, share),
            share => from + share * (to - from),
        }
    }

    /// Returns the fraction of the axis at a value.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        let [from, to] = self.range;
        match self.is_logarithmic {
            true => math::ln(value / from) / math::ln(to / from),
            false => (value - from) / (to - from),
        }
    }

    /// Returns `points` values from start to end.
    #[must_use]
    pub fn values(&self, points: usize) -> Vec<f64> {
        (0..points).map(|k| self.at(k as f64 / points.saturating_sub(1).max(1) as f64)).collect()
    }

    /// Returns an override of the scenario for a value.
    pub(super) fn set(&self, value: f64) -> (String, String) {
        (self.path.clone(), text(value))
    }
}
