//! Published reference data with their sources.

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// Measured impacts.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Impacts {
    pub(crate) source: String,
    /// Angle of incidence to the normal, degrees; tangential restitution.
    pub(crate) restitution: Vec<(f64, f64)>,
    /// Angle of incidence, degrees; rebound angle, degrees.
    pub(crate) rebound_deg: Vec<(f64, f64)>,
    pub(crate) one_spring_source: String,
    /// Angle of incidence, degrees; tangential restitution.
    pub(crate) one_spring: Vec<(f64, f64)>,
    /// Angle of incidence, degrees; spin after the impact, rad/s.
    pub(crate) spin_rad_s: Vec<(f64, f64)>,
}

/// Impacts computed by finite elements.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FiniteElements {
    pub(crate) source: String,
    /// V_x/(μV_z) at the point of contact before and after the impact, called ψ by the authors.
    pub(crate) psi: Vec<(f64, f64)>,
    /// V_x/(μV_z) before the impact; spin ωR/(μv_n) after it.
    pub(crate) spin: Vec<(f64, f64)>,
}

/// Output of the boundary-element program CONTACT.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoundaryElements {
    pub(crate) source: String,
    pub(crate) cases: [Cattaneo; 4],
    pub(crate) printed: Printed,
    pub(crate) spence_source: String,
    pub(crate) spence: Spence,
}

/// Two equal bodies under normal and tangential load.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Cattaneo {
    pub(crate) shear_modulus_pa: f64,
    pub(crate) nu: f64,
    pub(crate) radius_mm: f64,
    pub(crate) force_n: f64,
    pub(crate) mu: f64,
    pub(crate) shift_um: f64,
    /// `F_x/(μF_N)`.
    pub(crate) share: f64,
    pub(crate) approach_um: f64,
    pub(crate) grid: String,
}

/// Further results of the first case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Printed {
    pub(crate) peak_mpa: f64,
    pub(crate) energy_j: f64,
    pub(crate) friction_work_j: f64,
}

/// Bodies that are not elastically similar, under normal load.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Spence {
    pub(crate) shear_modulus_mpa: [f64; 2],
    pub(crate) nu: [f64; 2],
    pub(crate) gap_per_mm: f64,
    pub(crate) mu: f64,
    /// Normal force, N; approach, mm.
    pub(crate) rows: Vec<(f64, f64)>,
}

/// Reads one of the data files of this crate.
///
/// # Errors
/// Fails if the file does not match its type.
pub(crate) fn read<T: DeserializeOwned>(text: &str) -> Result<T, serde_json::Error> {
    serde_json::from_str(text)
}

pub(crate) const IMPACTS: &str = include_str!("../data/kharaz_2001.json");
pub(crate) const FINITE_ELEMENTS: &str = include_str!("../data/wu_2003.json");
pub(crate) const BOUNDARY_ELEMENTS: &str = include_str!("../data/contact_bem.json");
pub(crate) const FRETTING_LOAD: &str = include_str!("../data/fouvry_2017.json");
