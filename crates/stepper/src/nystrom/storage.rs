//! Storage of a step: vectors of any length, or arrays for one position and one quadrature.

use super::Track;

/// Types in which a [`Nystrom`](super::Nystrom) method stores its data.
///
/// Most models have one slider. For such models, arrays of fixed size let the compiler unroll all loops over components.
pub trait Storage {
    /// List with one number per position.
    type Positions: Values<f64>;
    /// List with one number per position and quadrature.
    type Rates: Values<f64>;
    /// List with one number per position, velocity and quadrature.
    type State: Values<f64>;
    /// List with one [`Track`] (data of a component) per position and quadrature.
    type Tracks: Values<Track>;
}

/// List of values, one per component.
pub trait Values<T>: AsRef<[T]> + AsMut<[T]> + std::fmt::Debug + Clone {
    /// Returns `count` default values.
    fn of(count: usize) -> Self;
}

impl<T: Default + Clone + std::fmt::Debug> Values<T> for Vec<T> {
    fn of(count: usize) -> Self {
        vec![T::default(); count]
    }
}

impl<T: Default + Copy + std::fmt::Debug, const N: usize> Values<T> for [T; N] {
    /// Returns `N` default values, whatever `count` is.
    fn of(_: usize) -> Self {
        [T::default(); N]
    }
}

/// Vectors for any number of positions and quadratures.
#[derive(Debug, Clone, Copy)]
pub struct Many;

impl Storage for Many {
    type Positions = Vec<f64>;
    type Rates = Vec<f64>;
    type State = Vec<f64>;
    type Tracks = Vec<Track>;
}

/// Arrays for one position and one quadrature.
#[derive(Debug, Clone, Copy)]
pub struct One;

impl Storage for One {
    type Positions = [f64; 1];
    type Rates = [f64; 2];
    type State = [f64; 3];
    type Tracks = [Track; 2];
}
