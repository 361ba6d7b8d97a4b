//! Paraboloid between graded bodies against its MDR integral and closed forms.

use approx::assert_relative_eq;
use std::sync::Arc;
use stickslip_contact::{Apex, Engine, Interface, Material, Outcome, Pair, Profile, ProfileError, Springs};

const RADIUS: f64 = 3e-3;
const DEPTH: f64 = 1e-5;
const MU: f64 = 0.3;

fn materials(nu: f64) -> [Material; 2] {
    [Material::new(210e9, nu).unwrap(), Material::new(70e9, nu).unwrap()]
}

fn law(k: f64, nu: f64) -> Interface {
    let [first, second] = materials(nu);
    let profile = Profile::graded_paraboloid(RADIUS, k, DEPTH, [first, second]).unwrap();
    Interface::new(Pair::new(first, second), profile, MU).unwrap()
}

/// F_N = 2E\* h_N ∫₀ᵃ (x/z₀)ᵏ (d - g) dx by the midpoint rule, with h_N of ν = 1/(2+k).
#[test]
fn the_force_is_the_integral_over_graded_springs() {
    for k in [0.1, 0.3, 0.7] {
        let law = law(k, 1.0 / (2.0 + k));
        let stiffening = 2.0 * (1.0 + k) * (1.0 + k) * (0.5 * k * std::f64::consts::PI).cos() / (2.0 + k);
        for d in [1e-9, 1e-7, 1e-5] {
            let a = ((1.0 + k) * RADIUS * d).sqrt();
            assert_relative_eq!(law.profile().radius(d), a, max_relative = 1e-14);
            assert_relative_eq!(law.profile().depth(a), d, max_relative = 1e-14);
            let cells = 100_000;
            let width = a / f64::from(cells);
            let springs = (0..cells).map(|i| {
                let x = (f64::from(i) + 0.5) * width;
                (x / DEPTH).powf(k) * (d - x * x / ((1.0 + k) * RADIUS)) * width
            });
            let force = 2.0 * law.pair().normal_modulus() * stiffening * springs.sum::<f64>();
            assert_relative_eq!(law.normal_force(d), force, max_relative = 1e-5);
        }
    }
}

/// F_x = μF_N[1 - (1 - u/u_c)^((3+k)/2)], c = a √(1 - u/u_c), S₀ = 2u_c[1 - 2^(-2/(3+k))]; a row of springs comes near.
#[test]
fn the_tangential_force_is_that_of_a_power_law() {
    let (k, d) = (0.3, 1e-7);
    let law = law(k, 0.3);
    let limit = MU * law.normal_force(d);
    let gross = law.gross_slip_displacement(d);
    assert_relative_eq!(gross, law.stick_slope() * d, max_relative = 1e-14);
    assert_relative_eq!(2.0 * (1.0 - 0.5_f64.powf(2.0 / (3.0 + k))), 0.686_023_57, max_relative = 1e-8);
    let row = Springs::new(law.profile(), 4000, law.profile().reduced_stiffness(1.01 * d)).unwrap();
    for (engine, allowed) in [(Engine::Curve, 1e-12), (Engine::Row(Arc::new(row)), 1e-3)] {
        let memory = engine.memory(&law, Apex { d, u: 0.0 });
        for share in [0.1, 0.343_011_785, 0.9] {
            let u = share * gross;
            let wanted = limit * (1.0 - (1.0 - share).powf(0.5 * (3.0 + k)));
            let found = memory.force(&law, Apex { d, u });
            assert_relative_eq!(found, wanted, max_relative = allowed);
            let Outcome { stick_radius, .. } = memory.preview(&law, Apex { d, u });
            let radius = law.profile().radius(d);
            assert_relative_eq!(memory.radius(&law, d), radius, max_relative = allowed);
            assert_relative_eq!(stick_radius, radius * (1.0 - share).sqrt(), max_relative = allowed);
        }
    }
}

/// The exponent 0 is the paraboloid itself; other exponents end where they are not defined.
#[test]
fn the_exponent_is_checked() {
    let graded = |k, depth| Profile::graded_paraboloid(RADIUS, k, depth, materials(0.3));
    assert_eq!(graded(0.0, DEPTH), Profile::paraboloid(RADIUS));
    for k in [-0.1, 1.0, f64::NAN] {
        assert!(matches!(graded(k, DEPTH), Err(ProfileError::Grading(_))), "{k}");
    }
    for depth in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        assert!(matches!(graded(0.3, depth), Err(ProfileError::Depth(_))), "{depth}");
    }
}
