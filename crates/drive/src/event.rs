//! Events: the moments at which the law of motion changes.
//!
//! An event of a step from t₀ to t₁ lies in the half-open interval (t₀, t₁]; a guard that is zero at t₀ is the
//! event just handled and counts again only after it has been positive.

/// One event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Time, s.
    pub t: f64,
    /// Where it comes from.
    pub source: Source,
    /// What happened.
    pub kind: EventKind,
}

/// Where an event comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Contact at this place of the scene.
    Contact(usize),
    /// Waveform at this place of the scene.
    Waveform(usize),
    /// Block at this place of the scene.
    Block(usize),
}

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EventKind {
    /// The sense of sliding turns. Where the indentation varies that of the edge that drags, and not u.
    Reversal,
    /// u turns without a law that ends, or not when one does: told of the contacts of a body that the record watches, and only
    /// where [`Model::tells_turns`](crate::Model::tells_turns). No run counts it among its events.
    Turn,
    /// A piece of the memory is used up: a hysteresis loop closes.
    LoopClosed,
    /// Gross slip begins.
    GrossSlip,
    /// Gross slip ends.
    GrossSlipEnds,
    /// The contact begins to grow in full stick.
    FullStick,
    /// Slip begins in a contact that grew in full stick.
    SlipBegins,
    /// Two bodies touch.
    Touch,
    /// Two bodies part.
    LiftOff,
    /// A waveform turns a corner.
    Corner,
    /// A waveform jumps.
    Jump,
    /// A guard of a block fell: what that means, in the block's own word.
    Own(&'static str),
}

impl EventKind {
    /// Name in `events.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reversal => "reversal",
            Self::Turn => "turn",
            Self::LoopClosed => "loop closed",
            Self::GrossSlip => "gross slip",
            Self::GrossSlipEnds => "gross slip ends",
            Self::FullStick => "full stick",
            Self::SlipBegins => "slip begins",
            Self::Touch => "touch",
            Self::LiftOff => "lift-off",
            Self::Corner => "corner",
            Self::Jump => "jump",
            Self::Own(name) => name,
        }
    }
}
