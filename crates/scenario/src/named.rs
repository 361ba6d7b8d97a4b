//! Elastic constants of materials by name, at room temperature, each with its source. Contacts may name them without a description in the
//! scenario.
//!
//! A test checks that the values lie in the ranges of `substance`. Friction depends on the pair, so the table has no coefficients.

use crate::form::{Form, MaterialForm};
use crate::quantity::Pressure;

/// Material that a contact may name without a description in the scenario.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedMaterial {
    /// Name.
    pub name: &'static str,
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Grade of the material and source of the numbers.
    pub source: &'static str,
}

/// All named materials. For crystals, the constants are those of an isotropic polycrystal.
pub const MATERIALS: &[NamedMaterial] = &[
    of(
        "alumina",
        370.0,
        0.22,
        "99.5 % Al2O3: data sheet of AD-995 (370 GPa by ASTM F417, 0.22 by ASTM C848)",
    ),
    of("aluminium", 69.0, 0.33, "6061-T6: 10.0 Msi and 0.33, appendix of Multimedia Engineering Mechanics"),
    of("brass", 97.0, 0.31, "free-cutting brass C36000: data sheet (97 GPa, 0.31)"),
    of("glass", 70.0, 0.20, "soda-lime float glass: EN 572-1 (70 GPa, 0.2)"),
    of(
        "hardened steel",
        210.0,
        0.30,
        "bearing steel 100Cr6 (ISO 683-17), 58 to 65 HRC: data sheets (210 GPa, 0.3)",
    ),
    of("PTFE", 0.5, 0.46, "unfilled; data sheets range from 0.3 to 0.8 GPa; creeps (0.46)"),
    of("ruby", 400.0, 0.23, SAPPHIRE),
    of("sapphire", 400.0, 0.23, SAPPHIRE),
    of(
        "silicon",
        160.0,
        0.22,
        "polycrystal: 158(8) GPa, Sharpe et al. 2000; 0.22(1), Sharpe et al. 1997; crystals 130 to 188 GPa",
    ),
    of("steel", 210.0, 0.30, "structural, S235 to S355: EN 1993-1-1, 3.2.6 (210 GPa, 0.3)"),
    of("titanium", 114.0, 0.33, "Ti-6Al-4V: 16.5 Msi and 0.33, appendix of Multimedia Engineering Mechanics"),
    of(
        "zirconia",
        210.0,
        0.30,
        "Y-TZP: 210 GPa of data sheets; 0.30 is customary, data sheets seldom give one",
    ),
];

/// Source for both ruby and sapphire; the chromium of ruby is a fraction of a per cent.
const SAPPHIRE: &str = "mean over directions of alpha-Al2O3, C11 496, C12 164, C13 115, C33 498, C44 148 GPa of data sheets; a crystal 335 to 470 GPa";

const fn of(name: &'static str, gigapascals: f64, poisson_ratio: f64, source: &'static str) -> NamedMaterial {
    NamedMaterial { name, youngs_modulus: gigapascals * 1e9, poisson_ratio, source }
}

/// Adds the named materials that contacts use and the scenario does not describe. Names must match exactly. If the scenario describes a
/// material whose name differs only in capitals, nothing is added.
pub(crate) fn fill(form: &mut Form) {
    let is_known = |material: &&NamedMaterial, name: &str| material.name == name;
    let named = form.contacts.iter().flat_map(|(_, contact)| &contact.materials.0);
    let mut wanted: Vec<&'static NamedMaterial> = Vec::new();
    // Searches the short table first, because the scenario may be long.
    for material in named.filter_map(|name| MATERIALS.iter().find(|material| is_known(material, name))) {
        if !wanted.contains(&material) {
            wanted.push(material);
        }
    }
    wanted.retain(|material| !form.materials.names().any(|own| own.eq_ignore_ascii_case(material.name)));
    for material in wanted {
        let youngs_modulus = Pressure::new(material.youngs_modulus);
        let described = MaterialForm { youngs_modulus, poisson_ratio: material.poisson_ratio };
        form.materials.add(material.name.to_owned(), described);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::substance;

    #[test]
    fn every_material_is_of_its_kind_and_says_where_it_is_from() {
        for material in MATERIALS {
            let kind = substance(material.name).unwrap();
            let (low, high) = kind.modulus;
            assert!((low..=high).contains(&material.youngs_modulus), "{}", material.name);
            assert!(material.source.len() > 20 && (0.0..0.5).contains(&material.poisson_ratio));
        }
        assert!(MATERIALS.windows(2).all(|pair| pair[0].name.to_lowercase() < pair[1].name.to_lowercase()));
    }

    /// Mean over all directions by Voigt (Hill 1952), from the constants in the source; the mean by Reuss is slightly lower.
    #[test]
    fn sapphire_is_the_mean_of_its_crystal() {
        let (c11, c12, c13, c33, c44) = (496.0, 164.0, 115.0, 498.0, 148.0);
        let c66: f64 = (c11 - c12) / 2.0;
        let bulk: f64 = (2.0 * c11 + c33 + 2.0 * c12 + 4.0 * c13) / 9.0;
        let shear = (2.0 * c11 + c33 - c12 - 2.0 * c13 + 3.0 * (2.0 * c44 + c66)) / 15.0;
        let youngs = 9.0 * bulk * shear / (3.0 * bulk + shear);
        let poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
        let sapphire = MATERIALS.iter().find(|material| material.name == "sapphire").unwrap();
        assert!((0.97..=1.0).contains(&(sapphire.youngs_modulus / 1e9 / youngs)), "{youngs}");
        assert!((sapphire.poisson_ratio - poisson).abs() < 0.005, "{poisson}");
    }
}
