//! A contact at a given indentation: force, stiffness, and the stroke that an ideal inertia drive needs for a step.
//!
//! The results serve for `info` and summaries only. For varying loads they apply to the extreme [indentations](crate::Model::indentations).
//! The ideal inertia drive is quasi-static except for its flyback. A real slider comes close to the zero-step stroke S₀ only with damping.

use super::Setup;
use crate::scene::{Contact, Freedom, Normal, Scene, Side, Varying};
use std::f64::consts::TAU;
use stickslip_contact::{FirstLoading, Interface, NormalGiven, TangentialGiven};

/// Quantities of a contact at a given indentation. Forces, radius and pressure apply to one contact, stiffnesses to all identical contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressed {
    /// Normal force F_N of one contact, N.
    pub normal_force: f64,
    /// Indentation d, m; negative for an open contact.
    pub indentation: f64,
    /// Contact radius a, m.
    pub radius: f64,
    /// Largest contact pressure, Pa; infinite at tips and edges, `None` for a list of springs.
    pub peak_pressure: Option<f64>,
    /// Gross slip displacement u_c = κd, m.
    pub gross_slip: f64,
    /// Zero-step stroke S₀ without load in the quasi-static limit, m.
    pub zero_step_stroke: f64,
    /// Effect of a constant load on the slider.
    pub loaded: Option<Loaded>,
    /// Friction limit μF_N of all contacts, N.
    pub limit_force: f64,
    /// Tangential force μ_kF_N of all contacts in gross slip, N; `None` if there is only one friction coefficient.
    pub kinetic_limit_force: Option<f64>,
    /// Tangential contact stiffness ∂F_x/∂u of all contacts in full stick, N/m; 0 without friction.
    pub tangential_stiffness: f64,
    /// Normal contact stiffness ∂F_N/∂d of all contacts, N/m.
    pub normal_stiffness: f64,
    /// Resonance frequency of the two bodies on the stuck contacts alone, Hz; `None` if neither body is free.
    pub resonance: Option<f64>,
}

/// A constant load on a body that one contact alone holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loaded {
    /// Sum of loads and gravity along x, N.
    pub force: f64,
    /// Load relative to the friction limit, |force|/μF_N.
    pub share: f64,
    /// Zero-step stroke S₀ for steps against the load, m; `None` if the contact does not hold the load.
    pub zero_step_stroke: Option<f64>,
}

impl Pressed {
    /// Returns the quantities of contact `c` at indentation d (m); `None` if there is no such contact.
    pub fn of(setup: Setup<'_>, c: usize, d: f64) -> Option<Self> {
        let (_, law) = setup.model.contacts().nth(c)?;
        let count = f64::from(setup.scene.contacts.get(c)?.part.count);
        let limit = count * law.friction() * law.normal_force(d);
        Some(Self {
            normal_force: law.normal_force(d),
            indentation: d,
            radius: law.profile().radius(d),
            peak_pressure: law.peak_pressure(d),
            gross_slip: law
                .profile()
                .endless_scale()
                .map_or(law.gross_slip_displacement(d), |_| f64::INFINITY),
            zero_step_stroke: zero_step_stroke(law, d, 0.0).unwrap_or(0.0),
            loaded: steady_load(setup.scene, c).filter(|_| limit > 0.0).map(|force| {
                let share = force.abs() / limit;
                Loaded { force, share, zero_step_stroke: zero_step_stroke(law, d, share) }
            }),
            limit_force: limit,
            kinetic_limit_force: law.kinetic().map(|law| count * law.friction() * law.normal_force(d)),
            // Without friction no spring sticks.
            tangential_stiffness: if law.friction() > 0.0 { count * law.stick_stiffness(d) } else { 0.0 },
            normal_stiffness: count * law.normal_stiffness(d),
            resonance: setup.model.contact_resonance(c, d).map(|omega| omega / TAU),
        })
    }
}

/// Returns whether the normal load of a contact is constant.
pub fn has_constant_load(contact: &Contact) -> bool {
    match contact.normal {
        Normal::Force(load) | Normal::Indentation(load) | Normal::Radius(load) => {
            matches!(load, Varying::Constant(_))
        }
        Normal::Coupled => false,
    }
}

/// Returns the zero-step stroke S₀ against a load λμF_N (`share` = λ), m: the stroke below which an ideal inertia drive makes no step.
///
/// The flyback is instantaneous, in gross slip. Then u increases quasi-statically while F_x grows from -μF_N to λμF_N. By Masing's rule
/// this is twice the displacement of a first loading to ½(1+λ)μF_N. For f ~ rⁿ it is 2u_c[1 - ((1-λ)/2)^{n/(n+1)}]. `None` if the contact
/// does not hold the load.
pub fn zero_step_stroke(law: &Interface, d: f64, share: f64) -> Option<f64> {
    if !(0.0..1.0).contains(&share) {
        return None;
    }
    // Masing: twice a first loading to half of the force difference.
    let force = 0.5 * (1.0 + share) * law.friction() * law.normal_force(d);
    let loading =
        FirstLoading::solve(law, NormalGiven::Indentation(d), TangentialGiven::Force(force)).ok()?;
    Some(2.0 * loading.u)
}

/// Returns the constant force along x on a free body that contact `c` alone holds, N; `None` without such a force.
fn steady_load(scene: &Scene, c: usize) -> Option<f64> {
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
    // Two free bodies share a load by their masses.
    let (Some(body), None) = (bodies.next(), bodies.next()) else { return None };
    let on_it = scene.loads.iter().filter(|load| load.on == body).map(|load| load.x);
    let constant = on_it.map(|force| match force {
        Varying::Constant(force) => Some(force),
        Varying::Follows(_) => None,
    });
    let weight = scene.bodies[body].part.mass? * scene.gravity.components().0;
    let force = constant.sum::<Option<f64>>()? - weight;
    (force != 0.0).then_some(force)
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
