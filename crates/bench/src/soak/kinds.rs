//! Kinds of random scenarios.

mod along;
mod upright;

use super::sketch::Sketch;

/// Kind of scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// Slider on a moving foot with prescribed normal loads.
    Slider,
    /// As [`Self::Slider`], with a foot on a piezo stack.
    Stack,
    /// Two to four bodies in a chain along the slide, connected by contacts or springs.
    Chain,
    /// Slider with coupled normal motion on a moving foot.
    Planar,
    /// Slider on two contacts with coupled normal motion, which may rock.
    Rocking,
    /// Body released above, on or in the ground.
    Ball,
    /// Bodies on top of each other.
    Pile,
    /// No free coordinates: contacts on prescribed paths.
    Walk,
}

/// All kinds with their weights.
const WEIGHTS: [(f64, Kind); 8] = [
    (26.0, Kind::Slider),
    (12.0, Kind::Stack),
    (12.0, Kind::Chain),
    (20.0, Kind::Planar),
    (10.0, Kind::Rocking),
    (10.0, Kind::Ball),
    (5.0, Kind::Pile),
    (5.0, Kind::Walk),
];

impl Kind {
    /// All kinds in the order of tables.
    pub const ALL: [Self; 8] = [
        Self::Slider,
        Self::Stack,
        Self::Chain,
        Self::Planar,
        Self::Rocking,
        Self::Ball,
        Self::Pile,
        Self::Walk,
    ];

    /// Returns the name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Slider => "slider",
            Self::Stack => "stack",
            Self::Chain => "chain",
            Self::Planar => "planar",
            Self::Rocking => "rocking",
            Self::Ball => "ball",
            Self::Pile => "pile",
            Self::Walk => "walk",
        }
    }
}

/// Returns the kind and the scenario of a seed, as the text of a file.
pub fn scenario(seed: u64) -> (Kind, String) {
    let mut sketch = Sketch::new(seed);
    let kind = sketch.draw.among(&WEIGHTS, Kind::Slider);
    sketch.title += &format!(", {}", kind.name());
    match kind {
        Kind::Slider => along::slider(&mut sketch),
        Kind::Stack => along::stack(&mut sketch),
        Kind::Chain => along::chain(&mut sketch),
        Kind::Planar => upright::planar(&mut sketch),
        Kind::Rocking => upright::rocking(&mut sketch),
        Kind::Ball => upright::ball(&mut sketch),
        Kind::Pile => upright::pile(&mut sketch),
        Kind::Walk => along::walk(&mut sketch),
    }
    (kind, sketch.text())
}
