//! A contact at an indentation: force, stiffness, what an ideal inertia drive needs to step.
//!
//! Told by `info` and summaries before or beside a run; no run asks. Indentations come from
//! [`Model::indentations`](crate::Model::indentations), so that a load that varies has these numbers at its
//! least and its largest. The ideal inertia drive is quasi-static but for its flyback: a real slider comes
//! near to S₀ only with a damper. The undamped ruby drive, S₀ = 29.377 nm by this function's formula, starts
//! to step at about 0.96 u_c = 38 nm.

use super::Setup;
use crate::scene::{Contact, Freedom, Normal, Scene, Side, Varying};
use std::f64::consts::TAU;
use stickslip_contact::{FirstLoading, Interface, NormalGiven, TangentialGiven};

/// What depends on the indentation. Forces, radius and pressure are those of one contact, stiffnesses of all `count`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressed {
    /// F_N of one contact, N.
    pub normal_force: f64,
    /// d, m; negative: open.
    pub indentation: f64,
    /// a, m.
    pub radius: f64,
    /// Largest pressure, Pa. Infinite at tips and edges; none for a list of springs.
    pub peak_pressure: Option<f64>,
    /// u_c = κd, m.
    pub gross_slip: f64,
    /// S₀ of the quasi-static, damped limit without load, m.
    pub zero_step_stroke: f64,
    /// What the constant load on the slider makes of it.
    pub loaded: Option<Loaded>,
    /// μF_N of all contacts, N.
    pub limit_force: f64,
    /// ∂F_x/∂u of all contacts in full stick, N/m; 0 without friction.
    pub tangential_stiffness: f64,
    /// ∂F_N/∂d of all contacts, N/m.
    pub normal_stiffness: f64,
    /// Frequency of the stuck contacts alone between their two bodies, Hz; none where neither is free.
    pub resonance: Option<f64>,
}

/// A constant load on a body that depends on one contact only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loaded {
    /// Loads and gravity along x, N.
    pub force: f64,
    /// |force|/μF_N.
    pub share: f64,
    /// S₀, m, where the load opposes the steps; none where the contact does not hold it.
    pub zero_step_stroke: Option<f64>,
}

impl Pressed {
    /// Contact `c` at indentation d, m; none where there is no such contact.
    pub fn of(setup: Setup<'_>, c: usize, d: f64) -> Option<Self> {
        let (_, law) = setup.model.contacts().nth(c)?;
        let count = f64::from(setup.scene.contacts.get(c)?.part.count);
        let limit = count * law.friction() * law.normal_force(d);
        Some(Self {
            normal_force: law.normal_force(d),
            indentation: d,
            radius: law.profile().radius(d),
            peak_pressure: law.peak_pressure(d),
            gross_slip: law.gross_slip_displacement(d),
            zero_step_stroke: zero_step_stroke(law, d, 0.0).unwrap_or(0.0),
            loaded: steady_load(setup.scene, c).filter(|_| limit > 0.0).map(|force| {
                let share = force.abs() / limit;
                Loaded { force, share, zero_step_stroke: zero_step_stroke(law, d, share) }
            }),
            limit_force: limit,
            // Without friction nothing sticks, however deep.
            tangential_stiffness: if law.friction() > 0.0 { count * law.stick_stiffness(d) } else { 0.0 },
            normal_stiffness: count * law.normal_stiffness(d),
            resonance: setup.model.contact_resonance(c, d).map(|omega| omega / TAU),
        })
    }
}

/// Whether the load of a contact never changes.
pub fn has_constant_load(contact: &Contact) -> bool {
    match contact.normal {
        Normal::Force(load) | Normal::Indentation(load) | Normal::Radius(load) => {
            matches!(load, Varying::Constant(_))
        }
        Normal::Coupled => false,
    }
}

/// S₀, m: the stroke below which an ideal inertia drive makes no step against a load of `share` = λ of μF_N. Its flyback
/// is instantaneous and slips as a whole; then u rises quasi-statically from F_x = -μF_N until λμF_N, by Masing's rule
/// twice the way of a first loading to ½(1+λ)μF_N. For f ~ rⁿ that is 2u_c[1 - ((1-λ)/2)^{n/(n+1)}]. None where the
/// contact does not hold the load.
pub fn zero_step_stroke(law: &Interface, d: f64, share: f64) -> Option<f64> {
    if !(0.0..1.0).contains(&share) {
        return None;
    }
    // Masing: from -μF_N to λμF_N is twice a first loading to half of the difference.
    let force = 0.5 * (1.0 + share) * law.friction() * law.normal_force(d);
    let loading =
        FirstLoading::solve(law, NormalGiven::Indentation(d), TangentialGiven::Force(force)).ok()?;
    Some(2.0 * loading.u)
}

/// The constant force along x, N, on a free body that contact `c` alone holds; none where there is no such force.
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
    // Two free bodies share a load by their masses: no one of them is the slider.
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
