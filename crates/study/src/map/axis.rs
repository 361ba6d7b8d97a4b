//! A number of the scenario along an axis of a map.

use super::MapError;
use crate::curve::Range;
use crate::number::text;
use stickslip_run::Job;

/// A number and its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its key path.
    pub path: String,
    /// Its SI unit; empty of a plain number.
    pub unit: &'static str,
    /// From where to where it goes, SI.
    pub range: [f64; 2],
    /// Whether equal distances are equal ratios.
    pub is_logarithmic: bool,
}

impl Axis {
    /// The number at a path over a range such as `0.1N..10N`; `option` is where both stand on the command line.
    ///
    /// # Errors
    /// No such number, or no such range.
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

    /// The value at a share of the axis, 0 to 1.
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

    /// The share of the axis at a value.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        let [from, to] = self.range;
        match self.is_logarithmic {
            true => math::ln(value / from) / math::ln(to / from),
            false => (value - from) / (to - from),
        }
    }

    /// So many values from end to end.
    #[must_use]
    pub fn values(&self, points: usize) -> Vec<f64> {
        (0..points).map(|k| self.at(k as f64 / points.saturating_sub(1).max(1) as f64)).collect()
    }

    /// A value as an override of the scenario.
    pub(super) fn set(&self, value: f64) -> (String, String) {
        (self.path.clone(), text(value))
    }
}
