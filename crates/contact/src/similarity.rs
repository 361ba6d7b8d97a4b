//! Elastic similarity of two bodies, and what the theory neglects without it.

use crate::Pair;
use std::fmt;

/// How far two bodies are from elastically similar.
///
/// Between similar bodies, (1-2ν₁)/G₁ = (1-2ν₂)/G₂, pressure moves both surfaces alike along the contact, and tangential stress
/// moves both alike across it: pressing and sliding are two problems, as the theory takes them. Otherwise Dundurs' constant β (Dundurs,
/// J. Appl. Mech. 36, 650, 1969) is not 0, and what they do to each other is neglected. What is known of its size:
///
/// * **Second order.** Exchange of the two bodies turns the sign of β and no force: forces over displacements are even in β,
///   and what is missing of them begins with β². (Stresses miss terms of the first order: a contact that is only pressed has radial
///   shear of the order of βp, where friction bears it; elsewhere it slips.)
/// * **Normal stiffness, nothing slips.** 4Ga ln(3-4ν)/(1-2ν) of a rigid punch that is stuck to a half-space, instead of
///   4Ga/(1-ν) (Mossakovskii 1954; Spence, Proc. R. Soc. A 305, 55, 1968); for the same radius the same factor of any round profile
///   (Borodich, Keer, Proc. R. Soc. A 460, 507, 2004). With β = (1-2ν)/(2(1-ν)) that is artanh(β)/β = 1 + β²/3 + …, for two
///   elastic bodies the same function of their β. Where some of it slips it is less, without friction 1.
/// * **An example.** A nearly rigid sphere on ν = 0 (β = 0.5, factor ln 3 = 1.099), μ = 0.2986: the approach under a given load is 2.1 %
///   smaller by the boundary-element program CONTACT, whose example this is, than by this theory (`docs/validation/contact.md`).
///
/// Of the tangential force nothing but the order is known here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    beta: f64,
}

/// Rounding of β of two materials that are similar.
const ROUNDING: f64 = 1e-12;

impl Pair {
    /// How far the bodies are from elastically similar; [`Similarity`] says in words what that means.
    pub fn similarity(&self) -> Similarity {
        Similarity { beta: self.dundurs_beta() }
    }
}

impl Similarity {
    /// Dundurs' β: 0 for similar bodies, ±0.5 at most for ν ≥ 0.
    pub fn dundurs_beta(&self) -> f64 {
        self.beta
    }

    /// Whether the theory is exact but for rounding of β.
    pub fn is_exact(&self) -> bool {
        self.beta.abs() < ROUNDING
    }

    /// artanh(β)/β - 1: by how much of itself the normal stiffness at a given contact radius is too low if nothing slips.
    pub fn neglected_stiffness(&self) -> f64 {
        if self.is_exact() {
            return 0.0;
        }
        // The quotient would lose β² beside 1. β² ≤ 0.5625: 64 terms are all.
        let square = self.beta * self.beta;
        (1..=64).rev().fold(0.0, |sum, k| square * (1.0 / f64::from(2 * k + 1) + sum))
    }
}

impl fmt::Display for Similarity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_exact() {
            return write!(f, "elastically similar (β = 0): the theory is exact");
        }
        let percent = |part: f64| format!("{} %", short(100.0 * part, 2));
        write!(
            f,
            "not elastically similar (β = {}): pressing and sliding are coupled, which the theory leaves out. Forces miss terms of \
             order β² = {}; at a given contact radius the normal stiffness is up to {} too low (if nothing slips; less with friction)",
            short(self.beta, 3),
            percent(self.beta * self.beta),
            percent(self.neglected_stiffness()),
        )
    }
}

/// So many digits.
fn short(value: f64, digits: i32) -> String {
    let places = digits - 1 - math::log10(value.abs()).floor() as i32;
    if (0..=6).contains(&places) {
        format!("{value:.*}", usize::try_from(places).unwrap_or(0))
    } else {
        format!("{value:.*e}", usize::try_from(digits - 1).unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Material, Pair, Similarity};

    fn pair(first: (f64, f64), second: (f64, f64)) -> Similarity {
        let material = |(modulus, nu)| Material::new(modulus, nu).unwrap();
        Pair::new(material(first), material(second)).similarity()
    }

    /// A rigid punch, as far as a ratio of moduli of 1e12 makes it one.
    const RIGID: (f64, f64) = (1e21, 0.3);

    #[test]
    fn a_stuck_rigid_punch_has_mossakovskiis_stiffness() {
        // ν = 0: ln 3. ν = 1/3: 4Ga ln(3-4ν)/(1-2ν) = 6.130 Ga over 4Ga/(1-ν) = 6 Ga.
        assert!((pair((1e9, 0.0), RIGID).neglected_stiffness() - (3.0_f64.ln() - 1.0)).abs() < 1e-11);
        let third = pair((1e9, 1.0 / 3.0), RIGID).neglected_stiffness();
        assert!((6.0 * (1.0 + third) - 6.130).abs() < 5e-4, "{third}");
        for nu in [-0.9_f64, -0.2, 0.1, 0.27, 0.45] {
            let known = (1.0 - nu) * (3.0 - 4.0 * nu).ln() / (1.0 - 2.0 * nu) - 1.0;
            let found = pair((1e9, nu), RIGID).neglected_stiffness();
            assert!((found - known).abs() < 1e-11, "{nu}: {found} instead of {known}");
        }
    }

    #[test]
    fn exchanged_bodies_miss_the_same() {
        let (ruby, steel) = ((400e9, 0.27), (210e9, 0.30));
        let (one, other) = (pair(ruby, steel), pair(steel, ruby));
        assert_eq!(one.dundurs_beta(), -other.dundurs_beta());
        assert_eq!(one.neglected_stiffness(), other.neglected_stiffness());
        // β²/3 of a small β.
        let small = one.dundurs_beta().powi(2) / 3.0;
        assert!((one.neglected_stiffness() / small - 1.0).abs() < 0.01);
    }

    #[test]
    fn words_name_the_size() {
        assert_eq!(
            pair((400e9, 0.27), (210e9, 0.30)).to_string(),
            "not elastically similar (β = -0.0764): pressing and sliding are coupled, which the theory leaves out. Forces miss terms of \
             order β² = 0.58 %; at a given contact radius the normal stiffness is up to 0.20 % too low (if nothing slips; less with friction)"
        );
        // One material; a rigid body on an incompressible one.
        for similar in [pair((210e9, 0.3), (210e9, 0.3)), pair((1e6, 0.5), (1e21, 0.5))] {
            assert!(similar.is_exact());
            assert_eq!(similar.to_string(), "elastically similar (β = 0): the theory is exact");
            assert_eq!(similar.neglected_stiffness(), 0.0);
        }
        let tiny = pair((1e9, 0.3), (1e9, 0.300_01)).to_string();
        assert!(tiny.contains("(β = 6.04e-6)"), "{tiny}");
    }
}
