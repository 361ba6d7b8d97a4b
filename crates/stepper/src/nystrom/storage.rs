//! Storage of a step: for any number of components, or for one, with all loops unrolled.

use super::Track;

/// How many positions and quadratures there are: the storage of a [`Nystrom`](super::Nystrom).
///
/// A single slider is what most drives are. With arrays of its size all loops over components are unrolled.
// 34 ns for a step of one oscillator instead of 81 with vectors.
pub trait Storage {
    /// A number for each position.
    type Positions: Values<f64>;
    /// A number for each position and quadrature.
    type Rates: Values<f64>;
    /// A number for each position, velocity and quadrature.
    type State: Values<f64>;
    /// A track for each position and quadrature.
    type Tracks: Values<Track>;
}

/// Values of one kind, as many as there are components of theirs.
pub trait Values<T>: AsRef<[T]> + AsMut<[T]> + std::fmt::Debug + Clone {
    /// `count` values to begin with.
    fn of(count: usize) -> Self;
}

impl<T: Default + Clone + std::fmt::Debug> Values<T> for Vec<T> {
    fn of(count: usize) -> Self {
        vec![T::default(); count]
    }
}

impl<T: Default + Copy + std::fmt::Debug, const N: usize> Values<T> for [T; N] {
    /// Those of any other `count` than `N` are left out or too many.
    fn of(_: usize) -> Self {
        [T::default(); N]
    }
}

/// Any number of positions and quadratures.
#[derive(Debug, Clone, Copy)]
pub struct Many;

impl Storage for Many {
    type Positions = Vec<f64>;
    type Rates = Vec<f64>;
    type State = Vec<f64>;
    type Tracks = Vec<Track>;
}

/// One position and one quadrature: all loops fall out at compile time.
#[derive(Debug, Clone, Copy)]
pub struct One;

impl Storage for One {
    type Positions = [f64; 1];
    type Rates = [f64; 2];
    type State = [f64; 3];
    type Tracks = [Track; 2];
}
