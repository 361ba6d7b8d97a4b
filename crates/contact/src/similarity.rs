//! Elastic similarity of two bodies, and the error of the theory for bodies that are not similar.

use crate::Pair;
use std::fmt;

/// Deviation of two bodies from elastic similarity, measured by Dundurs' constant β (Dundurs, J. Appl. Mech. 36, 650, 1969).
///
/// For elastically similar bodies, (1-2ν₁)/G₁ = (1-2ν₂)/G₂, normal and tangential contact are uncoupled, as the theory assumes.
/// Otherwise β is not 0, and the theory neglects the coupling. Size of the error:
///
/// * **Forces: order β².** Exchange of the two bodies changes the sign of β but no force, so forces are even in β. Stresses have an
///   error of order β: a contact that is only pressed has radial shear of order βp and slips at its edge.
/// * **Normal stiffness without slip.** A rigid punch that sticks to a half-space has the stiffness 4Ga ln(3-4ν)/(1-2ν) (Mossakovskii
///   1954; Spence, Proc. R. Soc. A 305, 55, 1968). The theory gives 4Ga/(1-ν). The ratio is the same for any round profile of the
///   same radius (Borodich, Keer, Proc. R. Soc. A 460, 507, 2004). With β = (1-2ν)/(2(1-ν)) the ratio is artanh(β)/β = 1 + β²/3 + ….
///   Two elastic bodies have the same ratio with their own β. Slip reduces the ratio; without friction it is 1.
/// * **Example.** A nearly rigid sphere on a body with ν = 0 has β = 0.5 and a ratio of ln 3 = 1.099. For μ = 0.2986 the
///   boundary-element program CONTACT finds an approach that is 2.1 % smaller than here (`docs/validation/contact.md`).
///
/// For the tangential force only the order of the error is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    beta: f64,
}

/// Largest |β| of elastically similar materials, due to rounding.
const ROUNDING: f64 = 1e-12;

impl Pair {
    /// Returns the deviation of the bodies from elastic similarity. The result can be printed as text.
    pub fn similarity(&self) -> Similarity {
        Similarity { beta: self.dundurs_beta() }
    }
}

impl Similarity {
    /// Returns Dundurs' constant β: 0 for similar bodies, at most ±0.5 for ν ≥ 0.
    pub fn dundurs_beta(&self) -> f64 {
        self.beta
    }

    /// Returns whether the bodies are elastically similar, so that the theory is exact.
    pub fn is_exact(&self) -> bool {
        self.beta.abs() < ROUNDING
    }

    /// Returns artanh(β)/β - 1: the relative error of the normal stiffness at a given contact radius without slip.
    pub fn neglected_stiffness(&self) -> f64 {
        if self.is_exact() {
            return 0.0;
        }
        // The series avoids the loss of β² against 1; with β² ≤ 0.5625, 64 terms are sufficient.
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
            "not elastically similar (β = {}): the theory neglects the coupling of normal and tangential \
             contact. Forces lack terms of order β² = {}; at a given contact radius the normal stiffness is \
             up to {} too low (without slip; less with friction)",
            short(self.beta, 3),
            percent(self.beta * self.beta),
            percent(self.neglected_stiffness()),
        )
    }
}

/// Formats a value with the given number of significant digits.
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

    /// Rigid material, by a ratio of moduli of 1e12.
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
        // For small β the result is β²/3.
        let small = one.dundurs_beta().powi(2) / 3.0;
        assert!((one.neglected_stiffness() / small - 1.0).abs() < 0.01);
    }

    #[test]
    fn words_name_the_size() {
        assert_eq!(
            pair((400e9, 0.27), (210e9, 0.30)).to_string(),
            "not elastically similar (β = -0.0764): the theory neglects the coupling of normal and \
             tangential contact. Forces lack terms of order β² = 0.58 %; at a given contact radius the \
             normal stiffness is up to 0.20 % too low (without slip; less with friction)"
        );
        // Equal materials, and a rigid body on an incompressible one.
        for similar in [pair((210e9, 0.3), (210e9, 0.3)), pair((1e6, 0.5), (1e21, 0.5))] {
            assert!(similar.is_exact());
            assert_eq!(similar.to_string(), "elastically similar (β = 0): the theory is exact");
            assert_eq!(similar.neglected_stiffness(), 0.0);
        }
        let tiny = pair((1e9, 0.3), (1e9, 0.300_01)).to_string();
        assert!(tiny.contains("(β = 6.04e-6)"), "{tiny}");
    }
}
