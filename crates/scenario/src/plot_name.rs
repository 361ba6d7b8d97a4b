//! The pictures that a scenario may ask for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A picture a scenario asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlotName {
    /// The scene to scale: bodies, contacts, springs, forces, and what is free or follows a waveform.
    Layout,
    /// Tangential force over displacement of each contact.
    Loop,
    /// Positions over time.
    Trajectory,
    /// Energies over time, and what their books miss.
    Energy,
    /// Velocity over displacement, of every free coordinate.
    Phase,
    /// Events over time.
    Events,
    /// What every spring does over time: open, stick, slip forward or backward; from `springs.csv`.
    State,
    /// The memory curve of each contact at some moments, in its wedge; from `memory.csv`.
    Memory,
    /// Pressure, shear stress, displacement and slip under each contact at some moments, rings of stick and slip shaded; from
    /// `fields.csv`.
    Fields,
    /// Each contact as its row of springs at some moments, pressed and sheared; from `memory.csv`.
    Substitute,
    /// Friction work over radius and time; from `friction.csv`.
    Friction,
    /// Channels over a channel, as the scenario asks for them.
    #[serde(skip)]
    Xy,
    /// The waveforms and their rates over two periods.
    Waveform,
    /// Voltage, current, motion and contact forces over the last two periods.
    Drive,
}

impl PlotName {
    /// All that have a name in the file.
    pub const ALL: [Self; 13] = [
        Self::Layout,
        Self::Loop,
        Self::Trajectory,
        Self::Energy,
        Self::Phase,
        Self::Events,
        Self::State,
        Self::Memory,
        Self::Fields,
        Self::Substitute,
        Self::Friction,
        Self::Waveform,
        Self::Drive,
    ];

    /// Most pictures of channels over a channel.
    pub const MOST_OWN: usize = crate::meaning::plots::MOST_OWN;

    /// The name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Loop => "loop",
            Self::Trajectory => "trajectory",
            Self::Energy => "energy",
            Self::Phase => "phase",
            Self::Events => "events",
            Self::State => "state",
            Self::Memory => "memory",
            Self::Fields => "fields",
            Self::Substitute => "substitute",
            Self::Friction => "friction",
            Self::Xy => "xy",
            Self::Waveform => "waveform",
            Self::Drive => "drive",
        }
    }
}
