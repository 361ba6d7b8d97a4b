//! Types of curves.

/// Type of a curve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Kind {
    /// Step length versus stroke or amplitude of the waveform named in `figures`.
    StepAmplitude,
    /// Mean velocity versus frequency of the waveform named in `figures`.
    SpeedFrequency,
    /// Mean velocity and power versus a load against the steps of the body named in `figures`.
    ForceSpeed,
    /// Step length versus a load against the steps of the body named in `figures`.
    StepLoad,
    /// Step length versus the sum of the normal forces of the body's contacts.
    Preload,
    /// Step length versus any parameter of the scenario, given by its key path.
    Vary(String),
}

impl Kind {
    /// All types without a key path.
    pub const NAMED: [Self; 5] =
        [Self::StepAmplitude, Self::SpeedFrequency, Self::ForceSpeed, Self::StepLoad, Self::Preload];

    /// Returns the name in arguments and files.
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

    /// Returns the curve type with this name, among the types without a key path.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::NAMED.into_iter().find(|kind| kind.name() == name)
    }

    /// Returns whether the parameter is a load.
    #[must_use]
    pub fn is_of_load(&self) -> bool {
        matches!(self, Self::ForceSpeed | Self::StepLoad)
    }

    /// Returns whether the curve has velocities instead of step lengths.
    #[must_use]
    pub fn is_of_speed(&self) -> bool {
        matches!(self, Self::SpeedFrequency | Self::ForceSpeed)
    }
}
