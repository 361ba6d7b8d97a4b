//! Kinds of materials by the names that people give them: what modulus they have, and what pressure they bear.
//!
//! A scene knows moduli only. The name beside them says what was meant, and a number far from it is a slip of the pen.

/// A kind of material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Substance {
    /// What it is called here.
    pub name: &'static str,
    /// Smallest and largest Young's modulus of its everyday varieties, Pa.
    pub modulus: (f64, f64),
    /// Uniaxial yield stress of its strong everyday varieties, Pa; of brittle ones a third of their hardness.
    pub strength: f64,
    /// Words of a name that mean it.
    words: &'static [&'static str],
}

/// Everyday orders of magnitude, put together by hand and taken from no single table: moduli as handbooks give their ranges (for
/// comparison M. F. Ashby, *Materials Selection in Mechanical Design*, appendix A), strengths of strong varieties, of ceramics
/// and glasses a third of the hardness, for H ≈ 3Y (D. Tabor, *The Hardness of Metals*, 1951). Two digits at best: what they are
/// for is a forgotten prefix. What has several words comes first.
const SUBSTANCES: &[Substance] = &[
    of("silicon nitride", (280.0, 320.0), 5.0, &["silicon nitride", "si3n4"]),
    of("silicon carbide", (400.0, 460.0), 8.0, &["silicon carbide", "sic"]),
    of(
        "tungsten carbide",
        (450.0, 700.0),
        5.3,
        &["tungsten carbide", "cemented carbide", "hard metal", "hardmetal", "wc"],
    ),
    of(
        "alumina",
        (215.0, 450.0),
        6.7,
        &["aluminium oxide", "aluminum oxide", "alumina", "al2o3", "ruby", "sapphire", "corundum"],
    ),
    of("glass", (60.0, 100.0), 2.0, &["fused silica", "glass", "silica", "sio2", "quartz", "bk7"]),
    of("rubber", (0.0005, 0.1), 0.03, &["silicone rubber", "rubber", "silicone", "pdms", "elastomer"]),
    of("cast iron", (69.0, 180.0), 0.8, &["cast iron"]),
    of("steel", (189.0, 217.0), 2.0, &["steel", "100cr6", "stainless", "17-4ph"]),
    of("zirconia", (190.0, 220.0), 4.0, &["zirconia", "zro2"]),
    of("diamond", (1000.0, 1220.0), 30.0, &["diamond"]),
    of("tungsten", (310.0, 415.0), 1.5, &["tungsten"]),
    of("titanium", (90.0, 130.0), 1.2, &["titanium", "ti6al4v"]),
    of("nickel", (190.0, 220.0), 1.0, &["nickel"]),
    of("copper", (110.0, 148.0), 0.4, &["copper"]),
    of("bronze", (70.0, 125.0), 0.8, &["bronze"]),
    of("brass", (90.0, 120.0), 0.5, &["brass"]),
    of("aluminium", (68.0, 82.0), 0.5, &["aluminium", "aluminum", "dural"]),
    of("gold", (76.0, 82.0), 0.2, &["gold"]),
    of("silver", (69.0, 83.0), 0.3, &["silver"]),
    of("silicon", (130.0, 190.0), 4.0, &["silicon"]),
    of("piezo ceramic", (48.0, 120.0), 1.0, &["pzt"]),
    of("PEEK", (3.4, 4.2), 0.1, &["peek"]),
    of("PTFE", (0.4, 0.75), 0.025, &["ptfe", "teflon"]),
    of("polyamide", (1.5, 4.0), 0.1, &["polyamide", "nylon"]),
    of("POM", (2.5, 5.0), 0.08, &["pom", "delrin", "acetal"]),
    of("polyethylene", (0.2, 1.4), 0.03, &["polyethylene", "uhmwpe", "hdpe"]),
    of("PMMA", (2.2, 3.8), 0.08, &["pmma", "acrylic", "plexiglas"]),
    of("polycarbonate", (2.0, 2.5), 0.07, &["polycarbonate"]),
    of("polyimide", (2.4, 4.5), 0.1, &["polyimide", "vespel", "kapton"]),
    of("epoxy", (2.3, 3.1), 0.08, &["epoxy"]),
];

/// A kind by its numbers in GPa.
const fn of(
    name: &'static str,
    (low, high): (f64, f64),
    strength: f64,
    words: &'static [&'static str],
) -> Substance {
    Substance { name, modulus: (low * 1e9, high * 1e9), strength: strength * 1e9, words }
}

/// The kind that a name means; none where it means none, or several.
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
        // steel2 and steel are one.
        let same = |have: &String, want: &String| {
            have == want || have.trim_end_matches(|c: char| c.is_ascii_digit()) == want
        };
        let Some(at) =
            left.windows(phrase.len()).position(|w| w.iter().zip(&phrase).all(|(a, b)| same(a, b)))
        else {
            continue;
        };
        left.drain(at..at + phrase.len());
        if found.is_some_and(|other| other.name != substance.name) {
            return None;
        }
        found = Some(substance);
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
            ("steel", "steel"),
            ("Stainless Steel", "steel"),
            ("steel_2", "steel"),
            ("steel2", "steel"),
            ("100Cr6", "steel"),
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
        for text in ["a", "upper", "s", "PTFE on steel", "glass filled PEEK", "steelish", "rubyist"] {
            assert_eq!(name(text), None, "{text}");
        }
        assert!(SUBSTANCES.iter().all(|s| s.modulus.0 < s.modulus.1 && s.strength < s.modulus.1));
    }
}
