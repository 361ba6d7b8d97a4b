//! Contacts: pair, scales, stiffness.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_contact::Interface;
use stickslip_drive::facts;
use stickslip_drive::scene::Side;
use stickslip_quantity::Real;

/// A contact.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactInfo {
    /// first and second body
    pub between: [String; 2],
    /// names of their materials
    pub materials: [String; 2],
    /// word for the profile
    pub profile: String,
    /// number of identical contacts
    pub count: u32,
    /// E*, effective modulus: 1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂ (4.13)
    #[serde(rename = "normal_modulus_Pa")]
    pub normal_modulus: Real,
    /// G*, effective shear modulus: 1/G* = (2-ν₁)/(4G₁) + (2-ν₂)/(4G₂), G = E/(2(1+ν)) (4.13)
    #[serde(rename = "tangential_modulus_Pa")]
    pub tangential_modulus: Real,
    /// β = [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂]; 0 of similar bodies (Dundurs 1969)
    pub dundurs_beta: Real,
    /// whether β is 0, which makes the theory exact
    pub elastically_similar: bool,
    /// artanh(β)/β - 1, by how much of itself the normal stiffness at a given radius is too low at most, [derived
    /// here](figures.md#similarity)
    pub neglected_stiffness: Real,
    /// both in words
    pub similarity: String,
    /// μ, coefficient of friction
    pub friction: Real,
    /// κ = μE*/G*, displacement per height of the memory curve: u_c = κd
    pub stick_slope: Real,
    /// At t = 0.
    #[schemars(extend("x-name" = "LOAD"))]
    pub start: Pressed,
    /// At the smallest indentation of a load that varies.
    #[serde(rename = "smallest", skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-name" = "LOAD"))]
    pub least: Option<Pressed>,
    /// At the largest.
    #[serde(rename = "largest", skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-name" = "LOAD"))]
    pub most: Option<Pressed>,
}

/// What depends on the indentation. Forces, radius and pressure are those of one contact, stiffnesses of all `count`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Pressed {
    /// F_N, normal force of one contact: 2E*∫₀^a (d - g(x)) dx (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// d, indentation; below 0 the contact is open
    #[serde(rename = "indentation_m")]
    pub indentation: Real,
    /// a, contact radius, where g(a) = d (4.26)
    #[serde(rename = "contact_radius_m")]
    pub radius: Real,
    /// p_max, largest pressure; infinite at tips and edges, left out for a list of springs
    #[serde(rename = "peak_pressure_Pa", skip_serializing_if = "Option::is_none")]
    pub peak_pressure: Option<Real>,
    /// u_c = κd, where gross slip of a first loading begins (4.28)
    #[serde(rename = "gross_slip_displacement_m")]
    pub gross_slip: Real,
    /// S₀, stroke up to which an ideal drive makes no step: flyback in no time, slow return, all ringing damped, no load on
    /// the slider
    #[serde(rename = "zero_step_stroke_m")]
    pub zero_step_stroke: Real,
    /// What the constant load on the slider makes of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loaded: Option<Loaded>,
    /// μF_N, maximum force of all count contacts without damping; the stuck springs of a damped one bear βG*ṡ beside G*s
    #[serde(rename = "limit_force_N")]
    pub limit_force: Real,
    /// ∂F_x/∂u of all count contacts where all of them sticks: count · 2G*a
    #[serde(rename = "tangential_stiffness_N_m")]
    pub tangential_stiffness: Real,
    /// ∂F_N/∂d of all count contacts: count · 2E*a
    #[serde(rename = "normal_stiffness_N_m")]
    pub normal_stiffness: Real,
    /// √(k/m)/2π, with k the tangential stiffness and m the reduced mass of its two bodies; left out where neither is free
    #[serde(rename = "contact_resonance_Hz", skip_serializing_if = "Option::is_none")]
    pub resonance: Option<Real>,
}

/// A constant load on a body that depends on one contact only.
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
pub struct Loaded {
    /// constant loads and gravity along x on the slider, where it has no other contact
    #[serde(rename = "force_N")]
    pub force: Real,
    /// its magnitude over μF_N of all count contacts
    pub share: Real,
    /// S₀ where this load opposes the steps; left out where the contact does not hold it
    #[serde(rename = "zero_step_stroke_m", skip_serializing_if = "Option::is_none")]
    pub zero_step_stroke: Option<Real>,
}

/// All contacts.
pub fn contacts(job: &Job) -> Parts<ContactInfo> {
    let contacts = job.model.contacts().enumerate();
    Parts(contacts.filter_map(|(c, (name, law))| Some((name.to_owned(), contact(job, c, law)?))).collect())
}

fn contact(job: &Job, c: usize, law: &Interface) -> Option<ContactInfo> {
    let contact = &job.scenario.scene.contacts.get(c)?.part;
    let depths = job.model.indentations(&job.start, c)?;
    let similarity = law.pair().similarity();
    let varies = !job.has_constant_load(c);
    let pressed = |d: f64| facts::Pressed::of(job.setup(), c, d).map(Pressed::of);
    Some(ContactInfo {
        between: contact.between.map(|side| name(job, side)),
        materials: job.scenario.materials_of(c).unwrap_or_default().map(str::to_owned),
        profile: job.scenario.profile_of(c).unwrap_or_default().to_owned(),
        count: contact.count,
        normal_modulus: Real(law.normal_modulus()),
        tangential_modulus: Real(law.tangential_modulus()),
        dundurs_beta: Real(similarity.dundurs_beta()),
        elastically_similar: similarity.is_exact(),
        neglected_stiffness: Real(similarity.neglected_stiffness()),
        similarity: similarity.to_string(),
        friction: Real(law.friction()),
        stick_slope: Real(law.stick_slope()),
        start: pressed(depths.start)?,
        least: if varies { pressed(depths.least) } else { None },
        most: if varies { pressed(depths.most) } else { None },
    })
}

impl Pressed {
    fn of(pressed: facts::Pressed) -> Self {
        Self {
            normal_force: Real(pressed.normal_force),
            indentation: Real(pressed.indentation),
            radius: Real(pressed.radius),
            peak_pressure: pressed.peak_pressure.map(Real),
            gross_slip: Real(pressed.gross_slip),
            zero_step_stroke: Real(pressed.zero_step_stroke),
            loaded: pressed.loaded.map(|loaded| Loaded {
                force: Real(loaded.force),
                share: Real(loaded.share),
                zero_step_stroke: loaded.zero_step_stroke.map(Real),
            }),
            limit_force: Real(pressed.limit_force),
            tangential_stiffness: Real(pressed.tangential_stiffness),
            normal_stiffness: Real(pressed.normal_stiffness),
            resonance: pressed.resonance.map(Real),
        }
    }
}

/// Name of a side.
pub fn name(job: &Job, side: Side) -> String {
    match side {
        Side::Ground => "ground".to_owned(),
        Side::Body(body) => job.scenario.scene.bodies.get(body).map(|b| b.name.clone()).unwrap_or_default(),
    }
}
