//! Properties of contacts before a run: materials, characteristic forces and displacements, stiffnesses.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_contact::Interface;
use stickslip_drive::facts;
use stickslip_drive::scene::Side;
use stickslip_measure::plausibility::damping_shares;
use stickslip_quantity::Real;

/// Properties of a contact.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactInfo {
    /// names of the first and second body
    pub between: [String; 2],
    /// names of the materials of the first and second body
    pub materials: [String; 2],
    /// type of the profile, such as `sphere`
    pub profile: String,
    /// number of identical contacts
    pub count: u32,
    /// E*, effective modulus: `1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂` (4.13)
    #[serde(rename = "normal_modulus_Pa")]
    pub normal_modulus: Real,
    /// G*, effective shear modulus: `1/G* = (2-ν₁)/(4G₁) + (2-ν₂)/(4G₂)`, with G = E/(2(1+ν)) (4.13)
    #[serde(rename = "tangential_modulus_Pa")]
    pub tangential_modulus: Real,
    /// β, Dundurs' constant (1969): `β = [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂]`. 0 for elastically
    /// similar bodies.
    pub dundurs_beta: Real,
    /// whether the bodies are elastically similar, β = 0. Then the theory is exact.
    pub elastically_similar: bool,
    /// largest relative amount by which the normal stiffness at a given contact radius is too low, because of the
    /// [neglected coupling](theory/contact_mechanics.md#elastic-similarity): artanh(β)/β - 1
    pub neglected_stiffness: Real,
    /// sentence about dundurs_beta and neglected_stiffness
    pub similarity: String,
    /// μ, coefficient of friction
    pub friction: Real,
    /// μ_k, kinetic coefficient of friction, if there is one. μ is then the static coefficient μ_s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinetic_friction: Option<Real>,
    /// Damping of the contact, if it has any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<DampingInfo>,
    /// κ, tangential displacement at the onset of slip divided by the indentation of a spring: `κ = μE*/G*`, so that
    /// u_c = κd
    pub stick_slope: Real,
    /// At t = 0.
    #[schemars(extend("x-name" = "LOAD"))]
    pub start: Pressed,
    /// At the smallest indentation of a varying load.
    #[serde(rename = "smallest", skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-name" = "LOAD"))]
    pub least: Option<Pressed>,
    /// At the largest indentation of a varying load.
    #[serde(rename = "largest", skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-name" = "LOAD"))]
    pub most: Option<Pressed>,
}

/// Damping of a contact.
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
pub struct DampingInfo {
    /// β, damping time of the tangential springs. Absent if 0.
    #[serde(rename = "tangential_s", skip_serializing_if = "Option::is_none")]
    pub tangential: Option<Real>,
    /// β of the tangential springs divided by the shortest flank of the waveforms that move the contact. Above 0.15 another law of
    /// damping would give another motion. Absent without such a waveform.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flank_share: Option<Real>,
    /// βu̇/u_c, lead of the damped springs at the largest mean speed of these waveforms, in gross slip displacements
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lead: Option<Real>,
    /// β, damping time along the normal, given or from the coefficient of restitution. Absent if 0.
    #[serde(rename = "normal_s", skip_serializing_if = "Option::is_none")]
    pub normal: Option<Real>,
}

impl DampingInfo {
    fn of(job: &Job, c: usize) -> Option<Self> {
        let shares = damping_shares(job, c);
        let times = job.model.damping(c).map(|time| (time > 0.0).then_some(Real(time)));
        job.is_damped(c).then(|| Self {
            tangential: times[0],
            flank_share: shares.map(|[share, _]| Real(share)),
            lead: shares.map(|[_, lead]| Real(lead)),
            normal: times[1],
        })
    }
}

/// Properties that depend on the indentation. Forces, radius and pressure are those of one contact, stiffnesses and
/// friction limit totals of all identical contacts.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Pressed {
    /// F_N, normal force of one contact: 2E*∫₀^a (d - g(x)) dx (4.26)
    #[serde(rename = "normal_force_N")]
    pub normal_force: Real,
    /// d, indentation. Below 0 if the contact is open.
    #[serde(rename = "indentation_m")]
    pub indentation: Real,
    /// a, contact radius, where g(a) = d (4.26)
    #[serde(rename = "contact_radius_m")]
    pub radius: Real,
    /// p_max, largest pressure. Infinite at tips and sharp edges. Absent for lists of springs.
    #[serde(rename = "peak_pressure_Pa", skip_serializing_if = "Option::is_none")]
    pub peak_pressure: Option<Real>,
    /// u_c, gross slip displacement: u_c = κd, where gross slip begins in a first loading (4.28)
    #[serde(rename = "gross_slip_displacement_m")]
    pub gross_slip: Real,
    /// S₀, zero-step stroke: largest stroke without a step of an ideal drive, with instantaneous flyback, slow forward
    /// stroke, no ringing and no load
    #[serde(rename = "zero_step_stroke_m")]
    pub zero_step_stroke: Real,
    /// Influence of the constant load on the slider.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loaded: Option<Loaded>,
    /// μF_N, friction limit, total of all identical contacts
    #[serde(rename = "limit_force_N")]
    pub limit_force: Real,
    /// μ_kF_N, tangential force in gross slip, total of all identical contacts, if there is a kinetic coefficient. The
    /// friction limit is then μ_sF_N.
    #[serde(rename = "kinetic_limit_force_N", skip_serializing_if = "Option::is_none")]
    pub kinetic_limit_force: Option<Real>,
    /// tangential stiffness ∂F_x/∂u in full stick, total of all identical contacts: count · 2G*a
    #[serde(rename = "tangential_stiffness_N_m")]
    pub tangential_stiffness: Real,
    /// normal stiffness ∂F_N/∂d, total of all identical contacts: count · 2E*a
    #[serde(rename = "normal_stiffness_N_m")]
    pub normal_stiffness: Real,
    /// resonance frequency of the two bodies on the contact in full stick: √(k/m)/2π, with its tangential stiffness k
    /// and the reduced mass m of the bodies. Absent if neither is free.
    #[serde(rename = "contact_resonance_Hz", skip_serializing_if = "Option::is_none")]
    pub resonance: Option<Real>,
}

/// Constant load on a body that only one contact holds.
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
pub struct Loaded {
    /// constant force along x on the slider, from loads and gravity. Absent if other contacts, springs or actuators
    /// hold it, too.
    #[serde(rename = "force_N")]
    pub force: Real,
    /// magnitude of the constant force on the slider divided by μF_N of all identical contacts
    pub share: Real,
    /// S₀, zero-step stroke if the constant force on the slider opposes the steps. Absent if the contact does not hold
    /// the force.
    #[serde(rename = "zero_step_stroke_m", skip_serializing_if = "Option::is_none")]
    pub zero_step_stroke: Option<Real>,
}

/// Returns the properties of all contacts.
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
        kinetic_friction: law.kinetic().map(|kinetic| Real(kinetic.friction())),
        damping: DampingInfo::of(job, c),
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
            kinetic_limit_force: pressed.kinetic_limit_force.map(Real),
            tangential_stiffness: Real(pressed.tangential_stiffness),
            normal_stiffness: Real(pressed.normal_stiffness),
            resonance: pressed.resonance.map(Real),
        }
    }
}

/// Returns the name of the body on one side of a contact, or `ground`.
pub fn name(job: &Job, side: Side) -> String {
    match side {
        Side::Ground => "ground".to_owned(),
        Side::Body(body) => job.scenario.scene.bodies.get(body).map(|b| b.name.clone()).unwrap_or_default(),
    }
}
