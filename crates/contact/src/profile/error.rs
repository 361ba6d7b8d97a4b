//! Why a profile is refused.

use thiserror::Error;

/// Why a profile cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ProfileError {
    /// A radius must be positive and finite, m.
    #[error("expected a radius above 0 m, got {0}")]
    Radius(f64),
    /// The radius of a flat must be positive and finite, m.
    #[error("expected a flat of a radius above 0 m, got {0}")]
    Flat(f64),
    /// The radius of a tip must be positive and finite, m.
    #[error("expected a tip of a radius above 0 m, got {0}")]
    Tip(f64),
    /// The slope of a cone must be positive and finite.
    #[error("expected a slope above 0, got {0}")]
    Slope(f64),
    /// The coefficient of a power law must be positive and finite, and so must its reciprocal.
    #[error("expected a coefficient above 0, got {0}")]
    Coefficient(f64),
    /// The exponent of a power law must be positive and finite.
    #[error("expected an exponent above 0, got {0}")]
    Exponent(f64),
    /// A coefficient of a sum of powers must be at least 0 and finite.
    #[error("expected the coefficient of term {index} to be at least 0, got {value}")]
    TermCoefficient {
        /// Index in the list, from 0.
        index: usize,
        /// What stands there.
        value: f64,
    },
    /// An exponent of a sum of powers must be positive and finite.
    #[error("expected the exponent of term {index} to be above 0, got {value}")]
    TermExponent {
        /// Index in the list, from 0.
        index: usize,
        /// What stands there.
        value: f64,
    },
    /// A sum of powers needs a term above zero.
    #[error("expected at least one term with a coefficient above 0")]
    NoTerm,
    /// A table needs two points.
    #[error("expected at least two points, got {0}")]
    Points(usize),
    /// A table has at most [`Profile::MAX_POINTS`](super::Profile::MAX_POINTS).
    #[error("expected at most {max} points, got {0}", max = super::Profile::MAX_POINTS)]
    TooMany(usize),
    /// A table begins where nothing is pressed: at (0, 0).
    #[error("expected the first point at (0, 0), got ({radius}, {value})")]
    Origin {
        /// Radius or indentation, m.
        radius: f64,
        /// What is given there.
        value: f64,
    },
    /// Radii and indentations of a table rise and are finite.
    #[error("expected point {index} to lie beyond the point before it")]
    Order {
        /// Index in the list, from 0.
        index: usize,
    },
    /// f does not fall, and a normal force rises.
    #[error("expected the value of point {index} not to fall below that of the point before it")]
    Fall {
        /// Index in the list, from 0.
        index: usize,
    },
    /// f must be above 0 somewhere.
    #[error("expected a gap above 0 at the last point")]
    NoRise,
    /// A kink lies at a point between the first and the last.
    #[error("expected kink {index} at one of the points between the first and the last, got {value} m")]
    Kink {
        /// Index in the list, from 0.
        index: usize,
        /// What stands there, m.
        value: f64,
    },
    /// The foundation of a profile that is far from convex does not rise: no contact of one circle belongs to it.
    #[error(
        "the profile bends down so far before point {index} that its one-dimensional equivalent g(x) does not rise up to {radius} m"
    )]
    NotRising {
        /// Index in the list, from 0.
        index: usize,
        /// Radius of the point, m.
        radius: f64,
    },
    /// The stiffness of a contact does not fall as it is pressed.
    #[error("the force rises less steeply up to point {index} than before it")]
    Softening {
        /// Index in the list, from 0.
        index: usize,
    },
    /// A height of a rough line must be finite, m.
    #[error("expected a finite height {index}, got {value}")]
    LineHeight {
        /// Index in the list, from 0.
        index: usize,
        /// What stands there.
        value: f64,
    },
    /// A rough line has at most [`Profile::MAX_HEIGHTS`](super::Profile::MAX_HEIGHTS).
    #[error("expected at most {max} heights, got {0}", max = super::Profile::MAX_HEIGHTS)]
    TooManyHeights(usize),
    /// The distance of the heights of a rough line must be positive and finite, m.
    #[error("expected a distance of heights above 0 m, got {0}")]
    Spacing(f64),
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
