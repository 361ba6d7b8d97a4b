//! What is drawn: kinds of scenes.

mod along;
mod upright;

use super::sketch::Sketch;

/// A kind of scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// A slider that its foot drags, its contacts pressed by prescription.
    Slider,
    /// The same with a foot on a piezo stack.
    Stack,
    /// Two to four bodies on one another along the slide, or tied.
    Chain,
    /// A slider whose height presses its contact, on a foot that moves.
    Planar,
    /// A slider on two such contacts, which may rock.
    Rocking,
    /// A body let go above, on or in the ground.
    Ball,
    /// Bodies on top of each other.
    Pile,
    /// Nothing is free: contacts walked along a path.
    Walk,
}

/// All kinds with how often each of them comes.
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
    /// All of them, in the order of tables.
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

    /// In tables.
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

/// The scenario of a seed, as the text of its file, and its kind.
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
