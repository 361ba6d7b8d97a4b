//! Constants and curves of a contact.

use super::{Loading, Subject, TheoryError};
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_contact::{FirstLoading, Interface, NormalGiven, TangentialGiven};
use stickslip_quantity::Real;

/// Constants and curves of a contact, and its state under the given load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Sheet {
    /// name of the scenario
    pub scenario: String,
    /// SHA-256 of the complete scenario, with all defaults and --set values
    pub scenario_sha256: String,
    /// name of the contact. All values are those of one of the identical contacts.
    pub contact: String,
    /// Constants.
    pub constants: Constants,
    /// State under the given load, without tangential displacement.
    pub pressed: Pressed,
    /// Points of F_N(d) and a(d) up to the given load (4.26). Empty if the contact is open.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub normal: Vec<NormalRow>,
    /// Points of the universal curve (4.37). Empty if the contact is open.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub universal: Vec<UniversalRow>,
    /// First loading to given tangential and normal values. `None` if none are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loading: Option<Loading>,
}

/// Constants of a contact.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Constants {
    /// names of the materials of the first and second body
    pub materials: [String; 2],
    /// type of the profile, such as `sphere`
    pub profile: String,
    /// f(r), formula of the profile. Absent for a profile given by numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub f: Option<&'static str>,
    /// g(x), formula of the substitute profile: `g(x) = |x|∫₀^|x| f′(r)/√(x² - r²) dr` (4.20). Absent for a profile
    /// given by numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub g: Option<&'static str>,
    /// whether the profile has an axisymmetric shape, so that stresses and displacements can be computed
    pub axisymmetric: bool,
    /// E*, effective modulus: `1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂` (4.13)
    #[serde(rename = "normal_modulus_Pa")]
    pub normal_modulus: Real,
    /// G*, effective shear modulus: `1/G* = (2-ν₁)/(4G₁) + (2-ν₂)/(4G₂)`, with G = E/(2(1+ν)) (4.13)
    #[serde(rename = "tangential_modulus_Pa")]
    pub tangential_modulus: Real,
    /// μ, coefficient of friction
    pub friction: Real,
    /// κ, tangential displacement at the onset of slip divided by the indentation of a spring: `κ = μE*/G*`
    pub stick_slope: Real,
    /// β, Dundurs' constant, a measure of the [neglected coupling](theory/contact_mechanics.md#elastic-similarity). 0
    /// for elastically similar bodies.
    pub dundurs_beta: Real,
    /// whether the bodies are elastically similar, β = 0. Then the theory is exact.
    pub elastically_similar: bool,
    /// largest relative amount by which the normal stiffness at a given contact radius is too low, because of the
    /// [neglected coupling](theory/contact_mechanics.md#elastic-similarity): artanh(β)/β - 1
    pub neglected_stiffness: Real,
    /// sentence about dundurs_beta and neglected_stiffness
    pub similarity: String,
}

/// State of one contact at an indentation, without tangential displacement.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Pressed {
    /// d, indentation. The contact is open if it is 0 or negative.
    #[serde(rename = "indentation_m")]
    pub d: Real,
    /// a, contact radius, where g(a) = d (4.26)
    #[serde(rename = "contact_radius_m")]
    pub a: Real,
    /// F_N, normal force: 2E*∫₀^a (d - g(x)) dx (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// u_c, gross slip displacement: u_c = κd (4.28)
    #[serde(rename = "gross_slip_displacement_m")]
    pub gross_slip: Real,
    /// μF_N, friction limit
    #[serde(rename = "limit_force_N")]
    pub limit_force: Real,
    /// p_max, largest pressure. Infinite at tips and sharp edges. Absent for lists of springs.
    #[serde(rename = "peak_pressure_Pa", skip_serializing_if = "Option::is_none")]
    pub peak_pressure: Option<Real>,
    /// tangential stiffness ∂F_x/∂u in full stick: 2G*a
    #[serde(rename = "tangential_stiffness_N_m")]
    pub tangential_stiffness: Real,
    /// normal stiffness ∂F_N/∂d: 2E*a
    #[serde(rename = "normal_stiffness_N_m")]
    pub normal_stiffness: Real,
    /// elastic energy of the normal deformation: ∫₀^d F_N dd
    #[serde(rename = "normal_energy_J")]
    pub normal_energy: Real,
}

/// Point of the normal contact (4.26).
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
pub struct NormalRow {
    /// d, indentation at a point of F_N(d), one of eleven up to the given load
    #[serde(rename = "indentation_m")]
    pub d: Real,
    /// a, contact radius at the point of F_N(d)
    #[serde(rename = "contact_radius_m")]
    pub a: Real,
    /// F_N, normal force at the point of F_N(d) (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// normal stiffness ∂F_N/∂d at the point of F_N(d): 2E*a
    #[serde(rename = "normal_stiffness_N_m")]
    pub normal_stiffness: Real,
    /// u_c, gross slip displacement at the point of F_N(d)
    #[serde(rename = "gross_slip_displacement_m")]
    pub gross_slip: Real,
}

/// Point of the universal curve: first loading at constant indentation.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct UniversalRow {
    /// c/a, stick radius divided by contact radius, at one of the points of the first loading under the given load
    pub stick_share: Real,
    /// u/u_c, tangential displacement divided by the gross slip displacement
    pub displacement_share: Real,
    /// F_x/(μF_N), tangential force divided by the friction limit (4.37)
    pub force_share: Real,
    /// The first loading.
    #[serde(flatten)]
    pub loading: Loading,
}

impl Sheet {
    /// Computes the constants of a contact and, unless the contact is open, its curves at a number of points.
    ///
    /// # Errors
    /// The profile does not reach the indentation, or the first loading is impossible.
    pub fn of(
        subject: &Subject<'_>,
        normal: NormalGiven,
        tangential: Option<TangentialGiven>,
        points: usize,
    ) -> Result<Self, TheoryError> {
        let law = subject.law;
        let d = normal.indentation(law)?;
        let steps = points.max(2) - 1;
        let shares = (0..=steps).map(|k| k as f64 / steps as f64);
        let touches = law.profile().radius(d) > 0.0;
        let shares: Vec<f64> = if touches { shares.collect() } else { Vec::new() };
        let universal = shares.iter().map(|share| UniversalRow::at(law, d, *share));
        let universal = if law.friction() > 0.0 { universal.collect() } else { Ok(Vec::new()) };
        let loading = tangential.map(|asked| Loading::solve(subject, NormalGiven::Indentation(d), asked));
        Ok(Self {
            scenario: subject.job.name.clone(),
            scenario_sha256: subject.job.hash.clone(),
            contact: subject.name.to_owned(),
            constants: Constants::of(subject),
            pressed: Pressed::at(law, d),
            normal: shares.iter().map(|share| NormalRow::at(law, share * d)).collect(),
            universal: universal?,
            loading: loading.transpose()?,
        })
    }

    /// Returns a copy of the constants without the curves.
    #[must_use]
    pub fn without_curves(&self) -> Self {
        Self { normal: Vec::new(), universal: Vec::new(), ..self.clone() }
    }

    /// Returns whether the bodies touch.
    pub fn touches(&self) -> bool {
        self.pressed.a.0 > 0.0
    }
}

impl Constants {
    fn of(subject: &Subject<'_>) -> Self {
        let (law, formulas) = (subject.law, subject.formulas());
        let similarity = law.pair().similarity();
        Self {
            materials: subject.materials.clone(),
            profile: subject.profile.clone(),
            f: formulas.map(|[f, _]| f),
            g: formulas.map(|[_, g]| g),
            axisymmetric: law.profile().has_shape(),
            normal_modulus: Real(law.normal_modulus()),
            tangential_modulus: Real(law.tangential_modulus()),
            friction: Real(law.friction()),
            stick_slope: Real(law.stick_slope()),
            dundurs_beta: Real(similarity.dundurs_beta()),
            elastically_similar: similarity.is_exact(),
            neglected_stiffness: Real(similarity.neglected_stiffness()),
            similarity: similarity.to_string(),
        }
    }
}

impl Pressed {
    fn at(law: &Interface, d: f64) -> Self {
        let normal_force = law.normal_force(d);
        Self {
            d: Real(d),
            a: Real(law.profile().radius(d)),
            normal_force: Real(normal_force),
            gross_slip: Real(law.gross_slip_displacement(d)),
            limit_force: Real(law.friction() * normal_force),
            peak_pressure: law.peak_pressure(d).map(Real),
            tangential_stiffness: Real(law.stick_stiffness(d)),
            normal_stiffness: Real(law.normal_stiffness(d)),
            normal_energy: Real(law.normal_energy(d)),
        }
    }
}

impl NormalRow {
    fn at(law: &Interface, d: f64) -> Self {
        Self {
            d: Real(d),
            a: Real(law.profile().radius(d)),
            normal_force: Real(law.normal_force(d)),
            normal_stiffness: Real(law.normal_stiffness(d)),
            gross_slip: Real(law.gross_slip_displacement(d)),
        }
    }
}

impl UniversalRow {
    /// Computes the point at a fraction between full stick (0) and the onset of gross slip (1). The fraction refers to the slipped part of
    /// the radius, or to the displacement for profiles that are not strictly convex.
    fn at(law: &Interface, d: f64, share: f64) -> Result<Self, TheoryError> {
        let a = law.profile().radius(d);
        // Full stick is computed from the displacement 0, which is exact.
        let asked = if share > 0.0 && law.profile().is_strictly_convex() {
            TangentialGiven::StickRadius((1.0 - share) * a)
        } else {
            TangentialGiven::Displacement(share * law.gross_slip_displacement(d))
        };
        let loading = FirstLoading::solve(law, NormalGiven::Indentation(d), asked)?;
        let limit = law.friction() * loading.normal_force;
        Ok(Self {
            stick_share: Real(loading.c / a),
            displacement_share: Real(loading.u / law.gross_slip_displacement(d)),
            force_share: Real(loading.tangential_force / limit),
            loading: Loading::of(law, &loading),
        })
    }
}
