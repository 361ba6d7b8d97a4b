//! Names of the plots of a scenario.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name of a predefined plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlotName {
    /// The model to scale: bodies, contacts, springs, forces and directions of motion.
    Layout,
    /// Tangential force over displacement of each contact.
    Loop,
    /// Positions over time.
    Trajectory,
    /// Energy balance over time.
    Energy,
    /// Velocity over displacement, of every free coordinate.
    Phase,
    /// Events over time, one row per source.
    Events,
    /// State of each spring over time: open, stick, forward slip or backward slip; from `springs.csv`.
    State,
    /// Slip memory of each contact at several times: reversal displacements over depth; from `memory.csv`.
    Memory,
    /// Pressure, shear stress, displacement and slip under each contact at several times; stick and slip zones are shaded; from
    /// `fields.csv`.
    Fields,
    /// Each contact as its row of springs at several times, compressed and sheared; from `memory.csv`.
    Substitute,
    /// Friction work over radius and time; from `friction.csv`.
    Friction,
    /// User-defined plot of channels over a channel.
    #[serde(skip)]
    Xy,
    /// The waveforms and their rates over two periods.
    Waveform,
    /// Voltage, current, motion and contact forces over the last two periods.
    Drive,
}

impl PlotName {
    /// All names that a scenario may contain.
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

    /// Maximum number of user-defined plots of channels over a channel.
    pub const MOST_OWN: usize = crate::meaning::plots::MOST_OWN;

    /// Returns the name of the plot in the scenario file.
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
