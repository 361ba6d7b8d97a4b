//! Restitution of an impact with damping along the normal, against an integration of its own in dimensionless form.

use approx::assert_relative_eq;
use stickslip_contact::{Interface, Pair, Profile};

/// Paraboloid F = Kd^{3/2}, b = β(K/m)^{2/5}v^{1/5}; cone Kd², b = β(Kv/m)^{1/3}; flat Kd, b = β√(K/m). The coefficients come from an
/// integration with a tolerance of 1e-11 by another program.
const KNOWN: [(&str, [f64; 4]); 3] = [
    ("paraboloid", [0.91797, 0.84437, 0.71885, 0.53350]),
    ("cone", [0.90906, 0.82875, 0.69410, 0.50006]),
    ("flat", [0.92560, 0.85876, 0.74408, 0.57174]),
];
const TIMES: [f64; 4] = [0.05, 0.1, 0.2, 0.4];

fn law(profile: &str) -> Interface {
    let profile = match profile {
        "paraboloid" => Profile::paraboloid(1e-3),
        "cone" => Profile::cone(0.1),
        _ => Profile::flat(1e-3),
    };
    Interface::new(Pair::from_moduli(1e11, 8e10).unwrap(), profile.unwrap(), 0.3).unwrap()
}

#[test]
fn a_damped_impact_loses_what_is_known() {
    let (mass, speed) = (0.02, 0.3);
    for (name, known) in KNOWN {
        let law = law(name);
        let power: f64 = match name {
            "paraboloid" => 1.5,
            "cone" => 2.0,
            _ => 1.0,
        };
        let stiffness = law.normal_force(1e-6) / 1e-6_f64.powf(power);
        // m z̈ = Kd^p: the time scale is (m/(K v^{p-1}))^{1/(p+1)}.
        let time = (mass / (stiffness * f64::powf(speed, power - 1.0))).powf(1.0 / (power + 1.0));
        for (b, e) in TIMES.into_iter().zip(known) {
            let found = law.restitution((mass, speed), b * time);
            assert_relative_eq!(found, e, epsilon = 6e-6);
            let damping = law.damping_of_restitution((mass, speed), found).unwrap();
            assert_relative_eq!(damping, b * time, max_relative = 1e-6);
        }
    }
}

#[test]
fn a_restitution_out_of_range_has_no_damping() {
    let law = law("paraboloid");
    for e in [0.0, -0.1, 1.1, f64::NAN] {
        assert_eq!(law.damping_of_restitution((0.01, 0.1), e), None);
    }
    assert_eq!(law.damping_of_restitution((0.01, 0.1), 1.0), Some(0.0));
    assert!(law.damping_of_restitution((0.01, 0.1), 1e-3).unwrap() > 0.0);
    assert_eq!(law.damping_of_restitution((0.0, 0.1), 0.5), None);
}
