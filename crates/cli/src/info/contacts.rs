//! Contacts: pair, scales, stiffness.

use crate::job::Job;
use crate::real::Real;
use crate::summary::Parts;
use serde::Serialize;
use std::f64::consts::TAU;
use stickslip_contact::{FirstLoading, Interface, NormalGiven, TangentialGiven};
use stickslip_drive::scene::{Freedom, Side, Varying};

/// Rounding of Dundurs' β of two materials that are similar.
const ROUNDING: f64 = 1e-12;

/// A contact.
#[derive(Debug, Serialize)]
pub(super) struct ContactInfo {
    /// First and second body.
    pub(super) between: [String; 2],
    pub(super) materials: [String; 2],
    pub(super) profile: String,
    /// Number of identical contacts.
    pub(super) count: u32,
    /// E*.
    #[serde(rename = "normal_modulus_Pa")]
    pub(super) normal_modulus: Real,
    /// G*.
    #[serde(rename = "tangential_modulus_Pa")]
    pub(super) tangential_modulus: Real,
    /// Dundurs' β, [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂] (Dundurs, J. Appl. Mech. 36, 650, 1969).
    pub(super) dundurs_beta: Real,
    /// Whether β is 0, which makes the theory exact.
    pub(super) elastically_similar: bool,
    pub(super) friction: Real,
    /// κ = μE*/G*.
    pub(super) stick_slope: Real,
    /// At t = 0.
    pub(super) start: Pressed,
    /// At the smallest and the largest indentation of a load that varies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) least: Option<Pressed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) most: Option<Pressed>,
}

/// What depends on the indentation. Forces, radius and pressure are those of one contact, stiffnesses of all `count`.
#[derive(Debug, Serialize)]
pub(super) struct Pressed {
    /// F_N of one contact.
    #[serde(rename = "normal_force_N")]
    pub(super) normal_force: Real,
    /// d; negative: open.
    #[serde(rename = "indentation_m")]
    pub(super) indentation: Real,
    /// a.
    #[serde(rename = "contact_radius_m")]
    pub(super) radius: Real,
    /// Infinite at tips and edges; none for a list of springs.
    #[serde(rename = "peak_pressure_Pa", skip_serializing_if = "Option::is_none")]
    pub(super) peak_pressure: Option<Real>,
    /// u_c = κd.
    #[serde(rename = "gross_slip_displacement_m")]
    pub(super) gross_slip: Real,
    /// S₀ of the quasi-static, damped limit without load.
    #[serde(rename = "zero_step_stroke_m")]
    pub(super) zero_step_stroke: Real,
    /// What the constant load on the slider makes of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) loaded: Option<Loaded>,
    /// μF_N of all contacts.
    #[serde(rename = "limit_force_N")]
    pub(super) limit_force: Real,
    /// ∂F_x/∂u of all contacts in full stick; 0 without friction.
    #[serde(rename = "tangential_stiffness_N_m")]
    pub(super) tangential_stiffness: Real,
    /// ∂F_N/∂d of all contacts.
    #[serde(rename = "normal_stiffness_N_m")]
    pub(super) normal_stiffness: Real,
    /// Of the stuck contacts alone between their two bodies; none where neither is free.
    #[serde(rename = "contact_resonance_Hz", skip_serializing_if = "Option::is_none")]
    pub(super) resonance: Option<Real>,
}

/// A constant load on a body that depends on one contact only.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Loaded {
    /// Loads and gravity along x.
    #[serde(rename = "force_N")]
    pub(super) force: Real,
    /// |force|/μF_N.
    pub(super) share: Real,
    /// S₀ where the load opposes the steps; none where the contact does not hold it.
    #[serde(rename = "zero_step_stroke_m", skip_serializing_if = "Option::is_none")]
    pub(super) zero_step_stroke: Option<Real>,
}

/// All contacts.
pub(super) fn of(job: &Job) -> Parts<ContactInfo> {
    let contacts = job.model.contacts().enumerate();
    Parts(contacts.filter_map(|(c, (name, law))| Some((name.to_owned(), contact(job, c, law)?))).collect())
}

fn contact(job: &Job, c: usize, law: &Interface) -> Option<ContactInfo> {
    let contact = &job.scenario.scene.contacts.get(c)?.part;
    let depths = job.model.indentations(&job.start, c)?;
    let beta = law.pair().dundurs_beta();
    let varies = !job.has_constant_load(c);
    let pressed = |d: f64| pressed(job, c, law, d);
    Some(ContactInfo {
        between: contact.between.map(|side| name(job, side)),
        materials: job.scenario.materials_of(c).unwrap_or_default().map(str::to_owned),
        profile: job.scenario.profile_of(c).unwrap_or_default(),
        count: contact.count,
        normal_modulus: Real(law.normal_modulus()),
        tangential_modulus: Real(law.tangential_modulus()),
        dundurs_beta: Real(beta),
        elastically_similar: beta.abs() < ROUNDING,
        friction: Real(law.friction()),
        stick_slope: Real(law.stick_slope()),
        start: pressed(depths.start),
        least: varies.then(|| pressed(depths.least)),
        most: varies.then(|| pressed(depths.most)),
    })
}

fn pressed(job: &Job, c: usize, law: &Interface, d: f64) -> Pressed {
    let count = f64::from(job.count(c));
    let limit = count * law.friction() * law.normal_force(d);
    Pressed {
        normal_force: Real(law.normal_force(d)),
        indentation: Real(d),
        radius: Real(law.profile().radius(d)),
        peak_pressure: law.peak_pressure(d).map(Real),
        gross_slip: Real(law.gross_slip_displacement(d)),
        zero_step_stroke: Real(zero_step_stroke(law, d, 0.0).unwrap_or(0.0)),
        loaded: load(job, c).filter(|_| limit > 0.0).map(|force| {
            let share = force.abs() / limit;
            let stroke = zero_step_stroke(law, d, share);
            Loaded { force: Real(force), share: Real(share), zero_step_stroke: stroke.map(Real) }
        }),
        limit_force: Real(limit),
        tangential_stiffness: Real(if law.friction() > 0.0 { count * law.stick_stiffness(d) } else { 0.0 }),
        normal_stiffness: Real(count * law.normal_stiffness(d)),
        resonance: job.model.contact_resonance(c, d).map(|omega| Real(omega / TAU)),
    }
}

/// S₀, m: the stroke below which an ideal inertia drive makes no step against a load of `share` = λ of μF_N. Its flyback
/// is instantaneous and slips as a whole; then u rises quasi-statically from F_x = -μF_N until λμF_N, by Masing's rule
/// twice the way of a first loading to ½(1+λ)μF_N. For f ~ rⁿ that is 2u_c[1 - ((1-λ)/2)^{n/(n+1)}]. None where the
/// contact does not hold the load.
fn zero_step_stroke(law: &Interface, d: f64, share: f64) -> Option<f64> {
    if !(0.0..1.0).contains(&share) {
        return None;
    }
    let force = 0.5 * (1.0 + share) * law.friction() * law.normal_force(d);
    let loading =
        FirstLoading::solve(law, NormalGiven::Indentation(d), TangentialGiven::Force(force)).ok()?;
    Some(2.0 * loading.u)
}

/// The constant force along x, N, on a free body that contact `c` alone holds; none where there is no such force.
fn load(job: &Job, c: usize) -> Option<f64> {
    let scene = &job.scenario.scene;
    let free = scene.contacts.get(c)?.part.between.into_iter().filter_map(|side| match side {
        Side::Body(body) if scene.bodies[body].part.x.freedom == Freedom::Free => Some(body),
        _ => None,
    });
    let alone = |body: usize| {
        let holds = |sides: [Side; 2]| sides.contains(&Side::Body(body));
        scene.contacts.iter().filter(|other| holds(other.part.between)).count() == 1
            && !scene.springs.iter().any(|spring| holds(spring.part.between) && spring.part.stiffness > 0.0)
            && !scene.actuators.iter().any(|actuator| holds(actuator.part.between))
    };
    let mut bodies = free.filter(|body| alone(*body));
    let (Some(body), None) = (bodies.next(), bodies.next()) else { return None };
    let on_it = scene.loads.iter().filter(|load| load.on == body).map(|load| load.x);
    let constant = on_it.map(|force| match force {
        Varying::Constant(force) => Some(force),
        Varying::Follows(_) => None,
    });
    let weight = scene.bodies[body].part.mass? * scene.gravity.acceleration * scene.gravity.incline.sin();
    let force = constant.sum::<Option<f64>>()? - weight;
    (force != 0.0).then_some(force)
}

/// Name of a side.
pub(super) fn name(job: &Job, side: Side) -> String {
    match side {
        Side::Ground => "ground".to_owned(),
        Side::Body(body) => job.scenario.scene.bodies.get(body).map(|b| b.name.clone()).unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_contact::{Pair, Profile};

    #[test]
    fn the_zero_step_stroke_has_its_closed_form_for_powers_and_a_punch() {
        let law = |profile| Interface::new(Pair::from_moduli(2.0, 1.5).unwrap(), profile, 0.3).unwrap();
        let d = 1e-3;
        let u_c = 0.3 * 2.0 / 1.5 * d;
        for share in [0.0_f64, 0.25, 0.5, 0.9] {
            for (profile, n) in [
                (Profile::cone(0.1).unwrap(), 1.0),
                (Profile::paraboloid(1.0).unwrap(), 2.0),
                (Profile::power(3.0, 8.0).unwrap(), 8.0),
            ] {
                let want = 2.0 * u_c * (1.0 - (0.5 * (1.0 - share)).powf(n / (n + 1.0)));
                let got = zero_step_stroke(&law(profile), d, share).unwrap();
                assert!((got / want - 1.0).abs() < 1e-12, "n = {n}, λ = {share}: {got}, {want}");
            }
            // A flat punch is the limit n → ∞: u_c (1+λ).
            let got = zero_step_stroke(&law(Profile::flat(0.1).unwrap()), d, share).unwrap();
            assert!((got / (u_c * (1.0 + share)) - 1.0).abs() < 1e-12);
        }
        assert_eq!(zero_step_stroke(&law(Profile::cone(0.1).unwrap()), d, 1.0), None);
        assert_eq!(zero_step_stroke(&law(Profile::cone(0.1).unwrap()), d, f64::NAN), None);
        assert_eq!(zero_step_stroke(&law(Profile::cone(0.1).unwrap()), -d, 0.0), Some(0.0));
    }
}
