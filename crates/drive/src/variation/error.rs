//! Why a run has no variation.

use thiserror::Error;

/// Why the derivatives of a run are not told.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum VariationError {
    /// A part whose laws are its own.
    #[error("no variation of `{0}` is known: drivers and materials have laws of their own")]
    Block(String),
    /// A body whose place is solved for.
    #[error("no variation of `{0}` is known: it has no mass along a free coordinate")]
    Massless(String),
    /// A contact whose stuck springs are damped: its force jumps between stick and slip.
    #[error("no variation of contact `{0}` is known: its force jumps where damped springs stick")]
    Damped(String),
    /// A contact on a row of springs.
    #[error("no variation of contact `{0}` is known: it is a row of springs")]
    Row(String),
    /// A profile whose contact length jumps.
    #[error("no variation of contact `{0}` is known: its stiffness jumps as it grows")]
    Profile(String),
    /// A number of the scene that makes another drive of it.
    #[error("no variation by this number is known: other parts act with it")]
    Form,
    /// Corners of several waveforms at one moment that a number of the scene moves apart.
    #[error("corners of several waveforms come at t = {t:e} s, and move apart")]
    MovesApart {
        /// Time, s.
        t: f64,
    },
    /// A turn that is as good as none: to either side of it the contact answers with another stiffness.
    #[error("contact `{contact}` stands still at t = {t:e} s: the motion has no derivative there")]
    Grazes {
        /// Name of the contact.
        contact: String,
        /// Time, s.
        t: f64,
    },
    /// Events that accumulate are not located one by one, and knots of a memory that is full are merged.
    #[error("events accumulate before t = {t:e} s: no variation leads through them")]
    Accumulates {
        /// Time, s.
        t: f64,
    },
    /// The variation does not come through.
    #[error("the variation takes steps without end at t = {t:e} s")]
    NotSmooth {
        /// Time, s.
        t: f64,
    },
    /// A run by a fixed step or in parts, or one that it did not follow from the beginning.
    #[error("a variation follows a run between located events from its beginning, of a scene in one part")]
    Unlocated,
}
