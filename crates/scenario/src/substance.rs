//! Classes of materials by name, with ranges of Young's modulus, density and strength.
//!
//! The model contains only moduli. The name of a material shows what was intended: a modulus far outside the range is probably an error.

/// Class of materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Substance {
    /// Name of the class.
    pub name: &'static str,
    /// Smallest and largest Young's modulus of common grades, Pa.
    pub modulus: (f64, f64),
    /// Uniaxial yield stress of strong common grades, Pa; for brittle materials a third of the hardness.
    pub strength: f64,
    /// Typical density, kg/m³.
    pub density: f64,
    /// Words and phrases that identify the class.
    words: &'static [&'static str],
}

/// All classes. The numbers are typical values with at most two significant digits, chosen to detect missing prefixes.
///
/// Ranges of moduli agree with handbooks (for comparison M. F. Ashby, *Materials Selection in Mechanical Design*, appendix A). Strengths
/// are those of strong grades; of ceramics and glasses a third of the hardness, for H ≈ 3Y (D. Tabor, *The Hardness of Metals*, 1951).
/// Phrases of several words come before single words, and special classes before general ones.
///
/// Steel without another word is structural steel: S235 to S355 yield at 235 to 355 MPa (EN 10025-2). Bearing steel of 60 HRC yields at
/// about 2 GPa, 17-4PH in condition H900 at 1.17 GPa (ASTM A564).
const SUBSTANCES: &[Substance] = &[
    of("silicon nitride", (280.0, 320.0), 5.0, 3200.0, &["silicon nitride", "si3n4"]),
    of("silicon carbide", (400.0, 460.0), 8.0, 3200.0, &["silicon carbide", "sic"]),
    of(
        "tungsten carbide",
        (450.0, 700.0),
        5.3,
        15000.0,
        &["tungsten carbide", "cemented carbide", "hard metal", "hardmetal", "wc"],
    ),
    of(
        "alumina",
        (215.0, 450.0),
        6.7,
        3950.0,
        &["aluminium oxide", "aluminum oxide", "alumina", "al2o3", "ruby", "sapphire", "corundum"],
    ),
    of("glass", (60.0, 100.0), 2.0, 2500.0, &["fused silica", "glass", "silica", "sio2", "quartz", "bk7"]),
    of(
        "rubber",
        (0.0005, 0.1),
        0.03,
        1100.0,
        &["silicone rubber", "rubber", "silicone", "pdms", "elastomer"],
    ),
    of("cast iron", (69.0, 180.0), 0.8, 7200.0, &["cast iron"]),
    of(
        "hardened steel",
        (189.0, 217.0),
        2.0,
        7850.0,
        &["bearing steel", "tool steel", "hardened", "100cr6", "52100", "440c"],
    ),
    of("precipitation-hardened steel", (189.0, 217.0), 1.2, 7850.0, &["17-4ph"]),
    of("structural steel", (189.0, 217.0), 0.355, 7850.0, &["steel", "stainless", "structural"]),
    of("zirconia", (190.0, 220.0), 4.0, 6050.0, &["zirconia", "zro2"]),
    of("diamond", (1000.0, 1220.0), 30.0, 3510.0, &["diamond"]),
    of("tungsten", (310.0, 415.0), 1.5, 19300.0, &["tungsten"]),
    of("titanium", (90.0, 130.0), 1.2, 4430.0, &["titanium", "ti6al4v"]),
    of("nickel", (190.0, 220.0), 1.0, 8900.0, &["nickel"]),
    of("copper", (110.0, 148.0), 0.4, 8960.0, &["copper"]),
    of("bronze", (70.0, 125.0), 0.8, 8800.0, &["bronze"]),
    of("brass", (90.0, 120.0), 0.5, 8500.0, &["brass"]),
    of("aluminium", (68.0, 82.0), 0.5, 2700.0, &["aluminium", "aluminum", "dural"]),
    of("gold", (76.0, 82.0), 0.2, 19300.0, &["gold"]),
    of("silver", (69.0, 83.0), 0.3, 10500.0, &["silver"]),
    of("silicon", (130.0, 190.0), 4.0, 2330.0, &["silicon"]),
    of("piezo ceramic", (48.0, 120.0), 1.0, 7700.0, &["pzt"]),
    of("PEEK", (3.4, 4.2), 0.1, 1300.0, &["peek"]),
    of("PTFE", (0.4, 0.75), 0.025, 2200.0, &["ptfe", "teflon"]),
    of("polyamide", (1.5, 4.0), 0.1, 1140.0, &["polyamide", "nylon"]),
    of("POM", (2.5, 5.0), 0.08, 1410.0, &["pom", "delrin", "acetal"]),
    of("polyethylene", (0.2, 1.4), 0.03, 950.0, &["polyethylene", "uhmwpe", "hdpe"]),
    of("PMMA", (2.2, 3.8), 0.08, 1190.0, &["pmma", "acrylic", "plexiglas"]),
    of("polycarbonate", (2.0, 2.5), 0.07, 1200.0, &["polycarbonate"]),
    of("polyimide", (2.4, 4.5), 0.1, 1420.0, &["polyimide", "vespel", "kapton"]),
    of("epoxy", (2.3, 3.1), 0.08, 1200.0, &["epoxy"]),
];

/// Returns a class from moduli and strength in GPa and density in kg/m³.
const fn of(
    name: &'static str,
    (low, high): (f64, f64),
    strength: f64,
    density: f64,
    words: &'static [&'static str],
) -> Substance {
    Substance { name, modulus: (low * 1e9, high * 1e9), strength: strength * 1e9, density, words }
}

impl Substance {
    /// Returns whether both are grades of one material that differ only in strength, such as structural and hardened steel.
    fn is_akin_to(&self, other: &Self) -> bool {
        self.modulus == other.modulus && self.density == other.density
    }

    /// Returns the grade of the same material with the highest strength, or `None` if this is the strongest.
    pub fn strongest(&self) -> Option<&'static Self> {
        let stronger =
            SUBSTANCES.iter().filter(|other| other.is_akin_to(self) && other.strength > self.strength);
        stronger.max_by(|a, b| a.strength.total_cmp(&b.strength))
    }
}

/// Returns the most special class that a material name denotes. Returns `None` for an unknown name and for a name of several materials.
pub fn substance(name: &str) -> Option<&'static Substance> {
    let words = |text: &str| -> Vec<String> {
        let plain = text.to_lowercase();
        plain
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .map(str::to_owned)
            .collect()
    };
    let mut left = words(name);
    let mut found: Option<&Substance> = None;
    for (substance, phrase) in SUBSTANCES.iter().flat_map(|s| s.words.iter().map(move |w| (s, words(w)))) {
        // `steel2` counts as `steel`.
        let same = |have: &String, want: &String| {
            have == want || have.trim_end_matches(|c: char| c.is_ascii_digit()) == want
        };
        let Some(at) =
            left.windows(phrase.len()).position(|w| w.iter().zip(&phrase).all(|(a, b)| same(a, b)))
        else {
            continue;
        };
        left.drain(at..at + phrase.len());
        if found.is_some_and(|other| !other.is_akin_to(substance)) {
            return None;
        }
        found = found.or(Some(substance));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_mean_kinds_word_by_word() {
        let name = |text| substance(text).map(|substance| substance.name);
        for (text, kind) in [
            ("steel", "structural steel"),
            ("Stainless Steel", "structural steel"),
            ("steel_2", "structural steel"),
            ("steel2", "structural steel"),
            ("100Cr6", "hardened steel"),
            ("hardened steel", "hardened steel"),
            ("Steel, hardened", "hardened steel"),
            ("steel 100Cr6", "hardened steel"),
            ("hardened stainless steel", "hardened steel"),
            ("17-4PH steel", "precipitation-hardened steel"),
            ("ruby ball", "alumina"),
            ("aluminium oxide", "alumina"),
            ("Al2O3", "alumina"),
            ("aluminum 7075", "aluminium"),
            ("silicon", "silicon"),
            ("silicon-nitride", "silicon nitride"),
            ("tungsten carbide", "tungsten carbide"),
            ("tungsten", "tungsten"),
            ("silicone rubber", "rubber"),
        ] {
            assert_eq!(name(text), Some(kind), "{text}");
        }
        for text in
            ["a", "upper", "s", "PTFE on steel", "glass filled PEEK", "steelish", "rubyist", "hardened glass"]
        {
            assert_eq!(name(text), None, "{text}");
        }
        assert!(SUBSTANCES.iter().all(|s| s.modulus.0 < s.modulus.1 && s.strength < s.modulus.1));
    }

    /// Densities of solids lie within a factor of 25, so a wrong prefix (a factor of 1000) is detected.
    #[test]
    fn densities_are_those_of_solids_and_classes_of_steel_differ_in_strength() {
        assert!(SUBSTANCES.iter().all(|s| (900.0..20_000.0).contains(&s.density)));
        let [steel, hard] = ["steel", "hardened steel"].map(|name| substance(name).unwrap());
        assert_eq!((steel.strongest(), hard.strongest()), (Some(hard), None));
        assert!(hard.strength / steel.strength > 4.0 && substance("zirconia").unwrap().strongest().is_none());
    }
}
