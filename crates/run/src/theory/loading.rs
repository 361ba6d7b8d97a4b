//! One first loading with everything that follows from it.

use super::state::contact_word;
use super::{Subject, TheoryError};
use serde::Serialize;
use stickslip_contact::{ContactState, FirstLoading, Interface, NormalGiven, Outcome, TangentialGiven};
use stickslip_quantity::Real;

/// A first loading: two quantities given, the rest follows.
#[derive(Debug, Clone, Serialize)]
pub struct Loading {
    /// d.
    #[serde(rename = "indentation_m")]
    pub d: Real,
    /// a.
    #[serde(rename = "contact_radius_m")]
    pub a: Real,
    /// `F_N`.
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// u.
    #[serde(rename = "displacement_m")]
    pub u: Real,
    /// c.
    #[serde(rename = "stick_radius_m")]
    pub c: Real,
    /// `F_x` = μ[`F_N`(a) - `F_N`(c)], approach I, superposition (4.38).
    #[serde(rename = "tangential_force_N")]
    pub tangential_force: Real,
    /// `F_x` by the integral of the line load, approach II (4.39).
    #[serde(rename = "tangential_force_by_integral_N")]
    pub by_integral: Real,
    /// Estimated error of the integral.
    #[serde(rename = "tangential_force_by_integral_error_N")]
    pub integral_error: Real,
    /// Friction work (4.42).
    #[serde(rename = "friction_work_J")]
    pub friction_work: Real,
    /// Elastic energy of the tangential deformation.
    #[serde(rename = "tangential_energy_J")]
    pub tangential_energy: Real,
    /// Elastic energy of the normal deformation.
    #[serde(rename = "normal_energy_J")]
    pub normal_energy: Real,
    /// State of the whole contact: open, stick, partial, slip.
    pub state: &'static str,
}

impl Loading {
    /// The first loading of a contact with these two quantities.
    ///
    /// # Errors
    /// If a quantity is out of its range, or a radius is given that does not determine a depth.
    pub fn solve(
        subject: &Subject<'_>,
        normal: NormalGiven,
        tangential: TangentialGiven,
    ) -> Result<Self, TheoryError> {
        Ok(Self::of(subject.law, &FirstLoading::solve(subject.law, normal, tangential)?))
    }

    pub(super) fn of(law: &Interface, loading: &FirstLoading) -> Self {
        let (by_integral, integral_error) = loading.force_by_integral(law);
        let outcome = loading.outcome(law);
        Self {
            d: Real(loading.d),
            a: Real(loading.a),
            normal_force: Real(loading.normal_force),
            u: Real(loading.u),
            c: Real(loading.c),
            tangential_force: Real(loading.tangential_force),
            by_integral: Real(by_integral),
            integral_error: Real(integral_error),
            friction_work: Real(worked(&outcome)),
            tangential_energy: Real(outcome.elastic),
            normal_energy: Real(law.normal_energy(loading.d)),
            state: contact_word(outcome.state),
        }
    }
}

/// Friction work, J: what sticks as a whole has none, where its sums leave rounding.
pub(super) fn worked(outcome: &Outcome) -> f64 {
    if outcome.state == ContactState::Stick { 0.0 } else { outcome.friction }
}
