//! What coefficients of an explicit Runge–Kutta method are made of.
//!
//! A row is a sparse linear form of the slopes k₁ … k₁₆ (indices 0 … 15). Each becomes one straight sum without loop,
//! zero or bounds check. The newest slope stands apart: everything else can be summed while its evaluation is under way.

use std::ops::{Add, Mul, Sub};

/// Two components side by side: a processor sums both in one go, each to the bits that it has alone.
// The stages of six components take 0.87 of the instructions that they take one by one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Pair(pub(super) [f64; 2]);

/// The sixteen slopes of two components: twelve stages, the end point, three more for the dense output.
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

/// Components by pairs; there is an even number of them.
#[inline(always)]
pub(super) fn pairs_of(components: &[f64]) -> &[[f64; 2]] {
    components.as_chunks().0
}

/// A linear form of the slopes, split at the newest of them.
pub(super) trait Row {
    /// Index of the newest slope.
    const NEWEST: usize;
    /// Coefficient of the newest slope.
    const LAST: f64;
    /// Coefficients by the index of their slope.
    #[cfg(test)]
    const TERMS: &'static [(usize, f64)];

    /// Value of the form without its newest term.
    fn rest(k: &Slopes) -> Pair;

    /// Value of the form.
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
