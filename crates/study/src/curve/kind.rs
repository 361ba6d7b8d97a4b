//! The curves that have a name, and those of any number.

/// What a curve is of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Kind {
    /// Step over the stroke, or amplitude, of the figures' waveform.
    StepAmplitude,
    /// Mean speed over the frequency of the figures' waveform.
    SpeedFrequency,
    /// Mean speed, and power, over a load against the steps of the figures' body.
    ForceSpeed,
    /// Step over such a load.
    StepLoad,
    /// Step over the normal force of the body's contacts.
    Preload,
    /// Step over any number of the scenario, by its key path.
    Vary(String),
}

impl Kind {
    /// The curves that need no path.
    pub const NAMED: [Self; 5] =
        [Self::StepAmplitude, Self::SpeedFrequency, Self::ForceSpeed, Self::StepLoad, Self::Preload];

    /// Its name, in arguments and files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::StepAmplitude => "step-amplitude",
            Self::SpeedFrequency => "speed-frequency",
            Self::ForceSpeed => "force-speed",
            Self::StepLoad => "step-load",
            Self::Preload => "preload",
            Self::Vary(_) => "vary",
        }
    }

    /// The curve of a name that needs no path.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::NAMED.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether it varies a load.
    #[must_use]
    pub fn is_of_load(&self) -> bool {
        matches!(self, Self::ForceSpeed | Self::StepLoad)
    }

    /// Whether it is one of speeds, and not of steps.
    #[must_use]
    pub fn is_of_speed(&self) -> bool {
        matches!(self, Self::SpeedFrequency | Self::ForceSpeed)
    }
}
