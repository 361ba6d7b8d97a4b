//! Events: times at which the law of motion changes.
//!
//! An event of a step from t₀ to t₁ lies in the half-open interval (t₀, t₁]. An event function that is zero at t₀ belongs to the event just
//! handled; its next zero counts after the function has been positive.

/// Event of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Time, s.
    pub t: f64,
    /// Source of the event.
    pub source: Source,
    /// Kind of the event.
    pub kind: EventKind,
}

/// Source of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Contact by its index.
    Contact(usize),
    /// Waveform by its index.
    Waveform(usize),
    /// Block by its index.
    Block(usize),
}

/// Kind of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EventKind {
    /// The sense of slip reverses. Under varying indentation, the sense of slip at the contact edge counts, not the sign of u̇.
    Reversal,
    /// u̇ changes its sign at a time that is no event of the contact's law. Such a turn does not count as an event of the run. Turns are
    /// reported for contacts of watched bodies only, and only if [`Model::tells_turns`](crate::Model::tells_turns).
    Turn,
    /// A segment of the slip memory is used up, so that a hysteresis loop closes.
    LoopClosed,
    /// Gross slip begins.
    GrossSlip,
    /// Gross slip ends.
    GrossSlipEnds,
    /// A contact with two friction coefficients breaks loose: gross slip begins, and all friction limits fall to the kinetic ones.
    BreaksLoose,
    /// A contact that has broken loose sticks again.
    SticksAgain,
    /// The contact begins to grow in full stick.
    FullStick,
    /// Slip begins in a contact that has grown in full stick.
    SlipBegins,
    /// Two bodies touch.
    Touch,
    /// Two bodies separate.
    LiftOff,
    /// A waveform has a corner.
    Corner,
    /// A waveform jumps.
    Jump,
    /// An event function of a block crosses zero; the text is the block's name for the event.
    Own(&'static str),
}

impl EventKind {
    /// Returns the name of this kind of event in `events.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reversal => "reversal",
            Self::Turn => "turn",
            Self::LoopClosed => "loop closed",
            Self::GrossSlip => "gross slip",
            Self::GrossSlipEnds => "gross slip ends",
            Self::BreaksLoose => "breaks loose",
            Self::SticksAgain => "sticks again",
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
