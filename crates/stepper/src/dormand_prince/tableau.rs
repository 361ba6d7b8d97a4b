//! Rows of coefficients of an explicit Runge–Kutta method.
//!
//! A row is a sparse linear form of the slopes k₁ … k₁₆ (indices 0 … 15). A row compiles to one sum without a loop or a bounds check. The
//! newest slope is a separate term: the other terms can be summed while the slope is evaluated.

use std::ops::{Add, Mul, Sub};

/// Two components that SIMD instructions process together, with the same bits as separate processing.
// The stages of six components need 13 % fewer instructions in pairs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Pair(pub(super) [f64; 2]);

/// Sixteen slopes of two components: twelve stages, the end of the step, and three stages of the dense output.
pub(super) type Slopes = [Pair; 16];

impl Add for Pair {
    type Output = Self;

    #[inline(always)]
    fn add(self, Self(b): Self) -> Self {
        let Self(a) = self;
        Self([a[0] + b[0], a[1] + b[1]])
    }
}

impl Sub for Pair {
    type Output = Self;

    #[inline(always)]
    fn sub(self, Self(b): Self) -> Self {
        let Self(a) = self;
        Self([a[0] - b[0], a[1] - b[1]])
    }
}

impl Mul<Pair> for f64 {
    type Output = Pair;

    #[inline(always)]
    fn mul(self, Pair(b): Pair) -> Pair {
        Pair([self * b[0], self * b[1]])
    }
}

/// Splits components into pairs; the number of components must be even.
#[inline(always)]
pub(super) fn pairs_of(components: &[f64]) -> &[[f64; 2]] {
    components.as_chunks().0
}

/// Linear form of the slopes, with a separate term for the newest slope.
pub(super) trait Row {
    /// Index of the newest slope.
    const NEWEST: usize;
    /// Coefficient of the newest slope.
    const LAST: f64;
    /// Pairs of a slope's index and its coefficient.
    #[cfg(test)]
    const TERMS: &'static [(usize, f64)];

    /// Returns the value of the linear form without the newest slope.
    fn rest(k: &Slopes) -> Pair;

    /// Returns the value of the linear form.
    #[inline(always)]
    fn dot(k: &Slopes) -> Pair {
        Self::rest(k) + Self::LAST * k[Self::NEWEST]
    }
}

macro_rules! sum {
    ($k:ident) => {{
        let _ = $k;
        $crate::dormand_prince::tableau::Pair([0.0; 2])
    }};
    ($k:ident $j0:literal $a0:literal $($j:literal $a:literal)*) => { $a0 * $k[$j0] $(+ $a * $k[$j])* };
}

macro_rules! rows {
    ($($(#[$doc:meta])* $name:ident { $($j:literal => $a:literal,)* newest $n:literal => $last:literal })+) => {$(
        $(#[$doc])*
        pub(in crate::dormand_prince) struct $name;

        impl crate::dormand_prince::tableau::Row for $name {
            const NEWEST: usize = $n;
            const LAST: f64 = $last;
            #[cfg(test)]
            const TERMS: &'static [(usize, f64)] = &[$(($j, $a),)* ($n, $last)];

            #[inline(always)]
            fn rest(
                k: &crate::dormand_prince::tableau::Slopes,
            ) -> crate::dormand_prince::tableau::Pair {
                $crate::dormand_prince::tableau::sum!(k $($j $a)*)
            }
        }
    )+};
}

pub(super) use {rows, sum};
