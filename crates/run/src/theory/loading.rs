//! First tangential loading of a contact from the unloaded state at constant indentation.

use super::state::contact_word;
use super::{Subject, TheoryError};
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_contact::{ContactState, FirstLoading, Interface, NormalGiven, Outcome, TangentialGiven};
use stickslip_quantity::Real;

/// A first loading. Two quantities determine all others.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Loading {
    /// d, indentation of the first loading
    #[serde(rename = "indentation_m")]
    pub d: Real,
    /// a, contact radius of the first loading
    #[serde(rename = "contact_radius_m")]
    pub a: Real,
    /// F_N, normal force of the first loading (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// u, tangential displacement of the first loading
    #[serde(rename = "displacement_m")]
    pub u: Real,
    /// c, stick radius of the first loading, where u = κ(d - g(c)) (4.27)
    #[serde(rename = "stick_radius_m")]
    pub c: Real,
    /// F_x, tangential force by superposition: μ[F_N(a) - F_N(c)] (4.38)
    #[serde(rename = "tangential_force_N")]
    pub tangential_force: Real,
    /// tangential force F_x by integration of the line load: 2∫₀^a q_x(x) dx (4.39)
    #[serde(rename = "tangential_force_by_integral_N")]
    pub by_integral: Real,
    /// estimated error of the force by integration
    #[serde(rename = "tangential_force_by_integral_error_N")]
    pub integral_error: Real,
    /// friction work of the first loading (4.42)
    #[serde(rename = "friction_work_J")]
    pub friction_work: Real,
    /// elastic energy of the tangential deformation
    #[serde(rename = "tangential_energy_J")]
    pub tangential_energy: Real,
    /// elastic energy of the normal deformation
    #[serde(rename = "normal_energy_J")]
    pub normal_energy: Real,
    /// state of the contact: `open`, `stick`, `partial` or `slip`
    pub state: &'static str,
}

impl Loading {
    /// Computes the first loading of a contact from two given quantities.
    ///
    /// # Errors
    /// A quantity is out of its range, or a given radius does not determine an indentation.
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

/// Returns the friction work, J. In full stick the result is exactly 0.
pub(super) fn worked(outcome: &Outcome) -> f64 {
    if outcome.state == ContactState::Stick { 0.0 } else { outcome.friction }
}
