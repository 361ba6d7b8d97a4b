//! Why a profile is refused.

use thiserror::Error;

/// Why a profile cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ProfileError {
    /// A radius must be positive and finite, m.
    #[error("expected a radius above 0 m, got {0}")]
    Radius(f64),
    /// The slope of a cone must be positive and finite.
    #[error("expected a slope above 0, got {0}")]
    Slope(f64),
    /// The coefficient of a power law must be positive and finite, and so must its reciprocal.
    #[error("expected a coefficient above 0, got {0}")]
    Coefficient(f64),
    /// The exponent of a power law must be positive and finite.
    #[error("expected an exponent above 0, got {0}")]
    Exponent(f64),
    /// A foundation needs at least one spring.
    #[error("expected at least one height")]
    Empty,
    /// Each height has its length.
    #[error("expected a length for each of the {heights} heights, got {lengths}")]
    Unpaired {
        /// Number of heights.
        heights: usize,
        /// Number of lengths.
        lengths: usize,
    },
    /// A height must be finite and at least 0, m.
    #[error("expected height {index} to be at least 0 m, got {value}")]
    Height {
        /// Index in the list, from 0.
        index: usize,
        /// What stands there.
        value: f64,
    },
    /// A length must be positive and finite, m.
    #[error("expected length {index} to be above 0 m, got {value}")]
    Length {
        /// Index in the list, from 0.
        index: usize,
        /// What stands there.
        value: f64,
    },
}

/// The value if it is positive and finite, otherwise the error made from it.
pub(super) fn positive(value: f64, error: fn(f64) -> ProfileError) -> Result<f64, ProfileError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(error(value)) }
}
