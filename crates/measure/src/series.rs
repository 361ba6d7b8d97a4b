//! Checks on series of samples.

use thiserror::Error;

/// Error for a series that cannot be evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SeriesError {
    /// The series has too few samples.
    #[error("{series}: expected at least {least} samples, got {got}")]
    TooShort {
        /// Name of the series.
        series: &'static str,
        /// Required number of samples.
        least: usize,
        /// Actual number of samples.
        got: usize,
    },
    /// Two series have different lengths.
    #[error("{series} has {got} samples where {other} has {expected}")]
    Lengths {
        /// Name of the series.
        series: &'static str,
        /// Number of samples of this series.
        got: usize,
        /// Name of the other series.
        other: &'static str,
        /// Number of samples of the other series.
        expected: usize,
    },
    /// A sample is not finite.
    #[error("{series}[{index}] is {value}, expected a finite number")]
    NotFinite {
        /// Name of the series.
        series: &'static str,
        /// Index of the sample.
        index: usize,
        /// Value of the sample.
        value: f64,
    },
    /// Times decrease. Equal times are no error, because a jump has two rows with the same time.
    #[error("t[{index}] = {after} s follows {before} s, expected times in ascending order")]
    TimeDecreases {
        /// Index of the later sample.
        index: usize,
        /// Time of the previous sample, s.
        before: f64,
        /// Time of the later sample, s.
        after: f64,
    },
    /// The record is shorter than one period.
    #[error("the record lasts {duration} s, expected at least one period of {period} s")]
    ShorterThanPeriod {
        /// Duration of the record, s.
        duration: f64,
        /// Period, s.
        period: f64,
    },
    /// A parameter is outside its range.
    #[error("{name}: expected a number {range}, got {value}")]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Description of the allowed range.
        range: &'static str,
        /// Value of the parameter.
        value: f64,
    },
}

/// Checks that a series has at least `least` samples, all finite.
pub(crate) fn check(series: &'static str, values: &[f64], least: usize) -> Result<(), SeriesError> {
    if values.len() < least {
        return Err(SeriesError::TooShort { series, least, got: values.len() });
    }
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(SeriesError::NotFinite { series, index, value: values[index] }),
        None => Ok(()),
    }
}

/// Checks that two series have equal lengths.
pub(crate) fn check_lengths(
    (series, values): (&'static str, &[f64]),
    (other, others): (&'static str, &[f64]),
) -> Result<(), SeriesError> {
    if values.len() == others.len() {
        return Ok(());
    }
    Err(SeriesError::Lengths { series, got: values.len(), other, expected: others.len() })
}

/// Checks that times are finite and do not decrease.
pub(crate) fn check_time(t: &[f64], least: usize) -> Result<(), SeriesError> {
    check("t", t, least)?;
    match t.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(i) => Err(SeriesError::TimeDecreases { index: i + 1, before: t[i], after: t[i + 1] }),
        None => Ok(()),
    }
}

/// Checks that a parameter is positive and finite.
pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<(), SeriesError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SeriesError::Parameter { name, range: "above 0", value })
}

/// Returns the minimum and the maximum of values, or (∞, -∞) for an empty slice.
#[must_use]
pub fn extent(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &v| (lo.min(v), hi.max(v)))
}

/// Returns the sum by Neumaier's compensated summation. The rounding error does not grow with the number of terms.
pub(crate) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut total, mut lost) = (0.0_f64, 0.0_f64);
    for term in terms {
        let next = total + term;
        lost += if total.abs() >= term.abs() { (total - next) + term } else { (term - next) + total };
        total = next;
    }
    total + lost
}

/// Returns the arithmetic mean of values, or NaN for an empty slice.
pub(crate) fn mean(values: &[f64]) -> f64 {
    sum(values.iter().copied()) / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_place() {
        assert_eq!(check("u", &[], 3), Err(SeriesError::TooShort { series: "u", least: 3, got: 0 }));
        let text = check("u", &[0.0, f64::INFINITY], 1).unwrap_err().to_string();
        assert_eq!(text, "u[1] is inf, expected a finite number");
        let text = check_time(&[0.0, 1.0, 0.5], 1).unwrap_err().to_string();
        assert_eq!(text, "t[2] = 0.5 s follows 1 s, expected times in ascending order");
        assert!(check_time(&[0.0, 1.0, 1.0], 1).is_ok());
        assert!(check_positive("period", f64::NAN).is_err());
    }

    #[test]
    fn the_sum_keeps_what_large_terms_would_swallow() {
        // Neumaier (1974): a plain sum, and Kahan's, give 0.
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100].into_iter()), 2.0);
    }
}
