//! Errors of profiles.

use thiserror::Error;

/// Reason why a profile is invalid.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ProfileError {
    /// The radius is not above 0 or not finite, m.
    #[error("expected a radius above 0 m, got {0}")]
    Radius(f64),
    /// The mean height or the standard deviation of asperities is not above 0 or not finite, m.
    #[error("expected a height above 0 m, got {0}")]
    Scale(f64),
    /// The depth at which a graded body has the modulus of its material is not above 0 or not finite, m.
    #[error("expected a depth above 0 m, got {0}")]
    Depth(f64),
    /// The exponent of the modulus of a graded body is not in [0, 1).
    #[error("expected an exponent of at least 0 and below 1, got {0}")]
    Grading(f64),
    /// The number of asperities is out of range.
    #[error("expected a number of tips between 10 and 1e15, got {0}")]
    Tips(f64),
    /// The radius of the flat is not above 0 or not finite, m.
    #[error("expected a flat of a radius above 0 m, got {0}")]
    Flat(f64),
    /// The radius of the tip is not above 0 or not finite, m.
    #[error("expected a tip of a radius above 0 m, got {0}")]
    Tip(f64),
    /// The slope of the cone is not above 0 or not finite.
    #[error("expected a slope above 0, got {0}")]
    Slope(f64),
    /// The coefficient of the power law is not above 0, or it or its reciprocal is not finite.
    #[error("expected a coefficient above 0, got {0}")]
    Coefficient(f64),
    /// The exponent of the power law is not above 0 or not finite.
    #[error("expected an exponent above 0, got {0}")]
    Exponent(f64),
    /// A coefficient of a sum of powers is below 0 or not finite.
    #[error("expected the coefficient of term {index} to be at least 0, got {value}")]
    TermCoefficient {
        /// Index of the term, from 0.
        index: usize,
        /// Value given.
        value: f64,
    },
    /// An exponent of a sum of powers is not above 0 or not finite.
    #[error("expected the exponent of term {index} to be above 0, got {value}")]
    TermExponent {
        /// Index of the term, from 0.
        index: usize,
        /// Value given.
        value: f64,
    },
    /// The sum of powers has no coefficient above 0.
    #[error("expected at least one term with a coefficient above 0")]
    NoTerm,
    /// The table has fewer than two points.
    #[error("expected at least two points, got {0}")]
    Points(usize),
    /// The table has more than [`Profile::MAX_POINTS`](super::Profile::MAX_POINTS) points.
    #[error("expected at most {max} points, got {0}", max = super::Profile::MAX_POINTS)]
    TooMany(usize),
    /// The first point of the table is not (0, 0).
    #[error("expected the first point at (0, 0), got ({radius}, {value})")]
    Origin {
        /// Radius or indentation given, m.
        radius: f64,
        /// Value given.
        value: f64,
    },
    /// Radii or indentations of the table do not increase or are not finite.
    #[error("expected point {index} to lie beyond the point before it")]
    Order {
        /// Index of the point, from 0.
        index: usize,
    },
    /// The gap f of a table decreases, or a normal force does not increase with the indentation.
    #[error("expected a value of point {index} of at least that of the point before it")]
    Fall {
        /// Index of the point, from 0.
        index: usize,
    },
    /// The gap f is 0 at the last point.
    #[error("expected a gap above 0 at the last point")]
    NoRise,
    /// A kink is not at a point between the first and the last.
    #[error("expected kink {index} at one of the points between the first and the last, got {value} m")]
    Kink {
        /// Index of the kink, from 0.
        index: usize,
        /// Radius given, m.
        value: f64,
    },
    /// The profile is so far from convex that its one-dimensional profile g(x) does not increase.
    #[error(
        "the profile bends down too far before point {index}: its one-dimensional equivalent g(x) does not increase up to {radius} m"
    )]
    NotRising {
        /// Index of the point, from 0.
        index: usize,
        /// Radius of the point, m.
        radius: f64,
    },
    /// The contact stiffness of a normal law decreases with the indentation.
    #[error("the force increases less steeply up to point {index} than before it")]
    Softening {
        /// Index of the point, from 0.
        index: usize,
    },
    /// A height of the rough line is not finite, m.
    #[error("expected a finite height {index}, got {value}")]
    LineHeight {
        /// Index of the height, from 0.
        index: usize,
        /// Value given.
        value: f64,
    },
    /// The rough line has more than [`Profile::MAX_HEIGHTS`](super::Profile::MAX_HEIGHTS) heights.
    #[error("expected at most {max} heights, got {0}", max = super::Profile::MAX_HEIGHTS)]
    TooManyHeights(usize),
    /// The spacing of the rough line is not above 0 or not finite, m.
    #[error("expected a distance of heights above 0 m, got {0}")]
    Spacing(f64),
    /// The list of springs is empty.
    #[error("expected at least one height")]
    Empty,
    /// The numbers of heights and lengths differ.
    #[error("expected a length for each of the {heights} heights, got {lengths}")]
    Unpaired {
        /// Number of heights.
        heights: usize,
        /// Number of lengths.
        lengths: usize,
    },
    /// A height is below 0 or not finite, m.
    #[error("expected height {index} to be at least 0 m, got {value}")]
    Height {
        /// Index of the height, from 0.
        index: usize,
        /// Value given.
        value: f64,
    },
    /// A length is not above 0 or not finite, m.
    #[error("expected length {index} to be above 0 m, got {value}")]
    Length {
        /// Index of the length, from 0.
        index: usize,
        /// Value given.
        value: f64,
    },
}

/// Returns the value if it is above 0 and finite, and otherwise the error made from it.
pub(super) fn positive(value: f64, error: fn(f64) -> ProfileError) -> Result<f64, ProfileError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(error(value)) }
}
