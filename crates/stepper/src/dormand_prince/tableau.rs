//! What coefficients of an explicit Runge–Kutta method are made of.
//!
//! A row is a sparse linear form of the slopes k₁ … k₁₆ (indices 0 … 15). Each becomes one straight sum without loop,
//! zero or bounds check. The newest slope stands apart: everything else can be summed while its evaluation is under way.

/// The sixteen slopes of one component: twelve stages, the end point, three more for the dense output.
pub(super) type Slopes = [f64; 16];

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
    fn rest(k: &Slopes) -> f64;

    /// Value of the form.
    #[inline(always)]
    fn dot(k: &Slopes) -> f64 {
        Self::rest(k) + Self::LAST * k[Self::NEWEST]
    }
}

macro_rules! sum {
    ($k:ident) => {{
        let _ = $k;
        0.0
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
            fn rest(k: &crate::dormand_prince::tableau::Slopes) -> f64 {
                $crate::dormand_prince::tableau::sum!(k $($j $a)*)
            }
        }
    )+};
}

pub(super) use {rows, sum};
