//! Constants and curves of a contact.

use super::{Loading, Subject, TheoryError};
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_contact::{FirstLoading, Interface, NormalGiven, TangentialGiven};
use stickslip_quantity::Real;

/// What holds of a contact whatever happens to it, and how it is pressed.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Sheet {
    /// name of the scenario
    pub scenario: String,
    /// SHA-256 of the resolved scenario
    pub scenario_sha256: String,
    /// name of the contact; everything is of one of its count
    pub contact: String,
    /// What never changes.
    pub constants: Constants,
    /// As it is pressed.
    pub pressed: Pressed,
    /// `F_N`(d) and a(d) up to that (4.26); nothing of an open contact.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub normal: Vec<NormalRow>,
    /// The universal curve (4.37) and what goes with it; nothing of an open contact.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub universal: Vec<UniversalRow>,
    /// The first loading that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loading: Option<Loading>,
}

/// Constants of a contact.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Constants {
    /// names of the materials
    pub materials: [String; 2],
    /// word for the profile
    pub profile: String,
    /// f(r), height of the profile, where it has a formula
    #[serde(skip_serializing_if = "Option::is_none")]
    pub f: Option<&'static str>,
    /// g(x) = |x|∫₀^|x| f′(r)/√(x² - r²) dr (4.20), where it has a formula
    #[serde(skip_serializing_if = "Option::is_none")]
    pub g: Option<&'static str>,
    /// whether it has a shape in three dimensions, and so fields
    pub axisymmetric: bool,
    /// E*, effective modulus: 1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂ (4.13)
    #[serde(rename = "normal_modulus_Pa")]
    pub normal_modulus: Real,
    /// G*, effective shear modulus: 1/G* = (2-ν₁)/(4G₁) + (2-ν₂)/(4G₂), G = E/(2(1+ν)) (4.13)
    #[serde(rename = "tangential_modulus_Pa")]
    pub tangential_modulus: Real,
    /// μ, coefficient of friction
    pub friction: Real,
    /// κ = μE*/G*
    pub stick_slope: Real,
    /// β, [Dundurs' second constant](figures.md#similarity)
    pub dundurs_beta: Real,
    /// whether β is 0, which makes the theory exact
    pub elastically_similar: bool,
    /// artanh(β)/β - 1, [what the theory leaves out](figures.md#similarity) at most
    pub neglected_stiffness: Real,
    /// both in words
    pub similarity: String,
}

/// A contact at an indentation. Of one contact, however many identical ones the scenario has.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Pressed {
    /// d, indentation; at most 0: nothing touches
    #[serde(rename = "indentation_m")]
    pub d: Real,
    /// a, contact radius, where g(a) = d (4.26)
    #[serde(rename = "contact_radius_m")]
    pub a: Real,
    /// F_N, normal force: 2E*∫₀^a (d - g(x)) dx (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// u_c = κd (4.28)
    #[serde(rename = "gross_slip_displacement_m")]
    pub gross_slip: Real,
    /// μF_N, its maximum tangential force; with damping F_x may be larger while it moves, by up to βG*m(c)|u̇|
    #[serde(rename = "limit_force_N")]
    pub limit_force: Real,
    /// p_max, largest pressure; infinite at tips and edges, left out for a list of springs
    #[serde(rename = "peak_pressure_Pa", skip_serializing_if = "Option::is_none")]
    pub peak_pressure: Option<Real>,
    /// 2G*a, ∂F_x/∂u where all of it sticks
    #[serde(rename = "tangential_stiffness_N_m")]
    pub tangential_stiffness: Real,
    /// 2E*a, ∂F_N/∂d
    #[serde(rename = "normal_stiffness_N_m")]
    pub normal_stiffness: Real,
    /// elastic energy of the normal deformation: ∫₀^d F_N dd
    #[serde(rename = "normal_energy_J")]
    pub normal_energy: Real,
}

/// A point of the normal contact (4.26).
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
pub struct NormalRow {
    /// d, of a point of F_N(d); eleven up to the load asked for
    #[serde(rename = "indentation_m")]
    pub d: Real,
    /// a there
    #[serde(rename = "contact_radius_m")]
    pub a: Real,
    /// F_N there (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// ∂F_N/∂d there: 2E*a
    #[serde(rename = "normal_stiffness_N_m")]
    pub normal_stiffness: Real,
    /// u_c there
    #[serde(rename = "gross_slip_displacement_m")]
    pub gross_slip: Real,
}

/// A point of the first loading at this indentation, over its share of stick.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct UniversalRow {
    /// c/a, of a point of the first loading under this load
    pub stick_share: Real,
    /// u/u_c there
    pub displacement_share: Real,
    /// F_x/(μF_N) there (4.37)
    pub force_share: Real,
    /// The loading itself.
    #[serde(flatten)]
    pub loading: Loading,
}

impl Sheet {
    /// Constants of a contact, and its curves where something presses it, at so many points.
    ///
    /// # Errors
    /// An indentation that the profile does not reach, or a loading that does not fit.
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

    /// The same without its curves.
    #[must_use]
    pub fn without_curves(&self) -> Self {
        Self { normal: Vec::new(), universal: Vec::new(), ..self.clone() }
    }

    /// Whether anything touches.
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
    /// From full stick (`share` 0) to the onset of gross slip (1): by the radius that has slipped, or by the displacement where a
    /// radius does not determine one.
    fn at(law: &Interface, d: f64, share: f64) -> Result<Self, TheoryError> {
        let a = law.profile().radius(d);
        // Full stick is nothing but pressed: by its radius it would come out but for rounding.
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
