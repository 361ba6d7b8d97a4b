//! Dense output of order 7 (Hairer, Nørsett, Wanner, *Solving ODEs I*, 2nd ed., section II.6, equation (6.12) ff.).

use super::order5;
use super::order8::{Dense5, Dense6, Dense7, Dense8, END, NODES, Stage14, Stage15, Stage16, Weights};
use super::tableau::{Pair, Row, Slopes, pairs_of};
use super::{DormandPrince, Grade};
use crate::System;

/// Dense output of one component in nested form: c₀ + s(c₁ + (1-s)(c₂ + s(c₃ + (1-s)(c₄ + s(c₅ + (1-s)(c₆ + s c₇)))))), with s
/// the fraction of the step.
pub(super) type Polynomial = [f64; 8];

impl DormandPrince {
    /// Computes the dense output of the attempted step, unless already known. Costs three evaluations, and one more if the slopes at the
    /// end are unknown.
    ///
    /// The first four coefficients are the cubic Hermite interpolant of both ends. Three more stages raise the order to 7.
    pub(super) fn interpolate<S: System + ?Sized>(&mut self, system: &S) {
        if self.dense_known {
            return;
        }
        if self.coasts {
            self.dense_coast();
            return;
        }
        if self.extent.grade == Grade::Few {
            // The end slopes are a stage of this method: no further evaluation is needed.
            self.polynomials_of::<order5::Weights>(order5::END, |k| {
                [order5::Dense5::dot(k), Pair::default(), Pair::default(), Pair::default()]
            });
        } else {
            self.refine(system);
        }
        self.dense_known = true;
    }

    /// Evaluates three more stages and computes the polynomials of order 7.
    fn refine<S: System + ?Sized>(&mut self, system: &S) {
        self.end_slopes(system);
        self.newest.copy_from_slice(&self.ends.last);
        self.pace(self.extent.grade.pace(1.0));
        self.keep::<END>();
        // The cubic through both ends would cost nothing, but is too inaccurate to locate events.
        self.stage::<Stage14, S, 0, 0, true>(system, NODES[13]);
        self.stage::<Stage15, S, 0, 0, true>(system, NODES[14]);
        self.stage::<Stage16, S, 0, 0, true>(system, NODES[15]);
        self.keep::<15>();
        self.polynomials_of::<Weights>(END, |k| {
            [Dense5::dot(k), Dense6::dot(k), Dense7::dot(k), Dense8::dot(k)]
        });
    }

    /// Computes the polynomials of all components from the slopes at both ends and four linear forms of the stages.
    #[inline(always)]
    fn polynomials_of<R: Row>(&mut self, last: usize, lift: impl Fn(&Slopes) -> [Pair; 4]) {
        let (h, grade) = (self.extent.step, self.extent.grade);
        let ends = pairs_of(&self.begin).iter().zip(pairs_of(&self.end));
        for ((c, k), (begin, end)) in self.polynomials.chunks_mut(2).zip(&self.k).zip(ends) {
            let (begin, end) = (Pair(*begin), Pair(*end));
            let rise = if grade.is_even() { end - begin } else { h * R::dot(k) };
            let (bend, lifted) = (h * k[0] - rise, lift(k));
            let cubic = [begin, rise, bend, rise - h * k[last] - bend];
            for (lane, c) in c.iter_mut().enumerate() {
                let [first, second, third, fourth] = &cubic;
                let [fifth, sixth, seventh, eighth] = &lifted;
                let low = [first.0[lane], second.0[lane], third.0[lane], fourth.0[lane]];
                let high = [fifth.0[lane], sixth.0[lane], seventh.0[lane], eighth.0[lane]];
                *c = [low[0], low[1], low[2], low[3], h * high[0], h * high[1], h * high[2], h * high[3]];
            }
        }
        // The linear part that graded stages leave out: φ = σ ∓ σ(1-σ).
        let bend = match grade {
            Grade::Even | Grade::Few => 0.0,
            Grade::Start => -h,
            Grade::End => h,
        };
        if !grade.is_even() {
            for (c, first) in self.polynomials.iter_mut().zip(&self.ends.first) {
                c[1] += h * first;
                c[2] += bend * first;
            }
        }
    }

    /// Writes all components at time `t` (s) of the step into `out`, by the dense output. Without dense output all values are NaN.
    pub fn values(&self, t: f64, out: &mut [f64]) {
        if !self.dense_known {
            out.fill(f64::NAN);
            return;
        }
        let s = self.fraction(t);
        for (to, c) in out.iter_mut().zip(&self.polynomials) {
            *to = value(c, s);
        }
    }

    /// Returns the time derivative of component `i` at time `t` (s) by the dense output (order 6). Without dense output it is NaN.
    #[must_use]
    #[inline]
    pub fn rate(&self, i: usize, t: f64) -> f64 {
        let s = self.fraction(t);
        self.polynomial(i).map_or(f64::NAN, |c| rate(c, s) / (self.extent.step * self.extent.grade.pace(s)))
    }

    /// Returns the polynomial of component `i` if the dense output is known.
    #[inline]
    pub(super) fn polynomial(&self, i: usize) -> Option<&Polynomial> {
        self.polynomials.get(i).filter(|_| self.dense_known)
    }

    /// Returns the stage variable σ at time `t` (s) of the attempted step, exactly 0 and 1 at its ends.
    #[inline]
    pub(super) fn fraction(&self, t: f64) -> f64 {
        // A division may miss 1 by rounding; the value there would differ from the accepted state.
        if t == self.extent.target {
            1.0
        } else {
            self.extent.grade.fraction(
                (t - self.extent.time) / self.extent.step,
                (self.extent.target - t) / self.extent.step,
            )
        }
    }
}

/// Returns the value of the dense-output polynomial at s.
#[inline]
pub(super) fn value(c: &Polynomial, s: f64) -> f64 {
    let r = 1.0 - s;
    c[0] + s * (c[1] + r * (c[2] + s * (c[3] + r * (c[4] + s * (c[5] + r * (c[6] + s * c[7]))))))
}

/// Returns the derivative of the dense-output polynomial with respect to s, from the innermost bracket outwards.
#[inline]
fn rate(c: &Polynomial, s: f64) -> f64 {
    let r = 1.0 - s;
    let (p, d) = (c[6] + s * c[7], c[7]);
    let (p, d) = (c[5] + r * p, r * d - p);
    let (p, d) = (c[4] + s * p, s * d + p);
    let (p, d) = (c[3] + r * p, r * d - p);
    let (p, d) = (c[2] + s * p, s * d + p);
    let (p, d) = (c[1] + r * p, r * d - p);
    s * d + p
}
