//! Generators whose cycles are commanded by four input values per frame.

use super::PlantError;
use stickslip_drive::{Command, Heading, Run, Steps};

/// One of the four values of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// Stroke, peak to peak, in the unit of the driven quantity.
    Stroke,
    /// Frequency, Hz.
    Frequency,
    /// Direction: +1 forward, −1 backward.
    Heading,
    /// Number of cycles still to start; −1 for no limit.
    Steps,
}

impl Part {
    /// All values of a command, in the order of the input packet.
    pub(crate) const ALL: [Self; 4] = [Self::Stroke, Self::Frequency, Self::Heading, Self::Steps];

    /// Returns the suffix of the input name after the name of the generator.
    pub(crate) fn name(self) -> &'static str {
        ["stroke", "frequency", "heading", "steps"][self as usize]
    }
}

/// Returns the values of a command in the order of [`Part`].
pub(crate) fn values(command: &Command) -> [f64; Part::ALL.len()] {
    let heading = match command.heading {
        Heading::Forward => 1.0,
        Heading::Backward => -1.0,
    };
    let steps = match command.steps {
        Steps::Endless => -1.0,
        Steps::Left(steps) => steps as f64,
    };
    [command.stroke, command.frequency, heading, steps]
}

/// A generator with its last command.
///
/// A controller sends all four values in every frame. The generator gets a new command only if a value has changed. The number of cycles
/// therefore counts from the frame of its last change. If it were renewed in every frame, it would never be used up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Commanded {
    /// Index of the waveform in the model.
    place: usize,
    /// Values of the last command.
    told: [f64; Part::ALL.len()],
    /// Values received in this frame.
    tells: [f64; Part::ALL.len()],
}

impl Commanded {
    /// Creates a generator whose last command is unknown. `place` is the index of its waveform in the model.
    pub(crate) fn new(place: usize) -> Self {
        Self { place, told: [f64::NAN; Part::ALL.len()], tells: [f64::NAN; Part::ALL.len()] }
    }

    /// Returns whether `place` is the index of the waveform of this generator.
    pub(crate) fn is_at(&self, place: usize) -> bool {
        self.place == place
    }

    /// Sets one received value of the command.
    #[inline]
    pub(crate) fn hear(&mut self, part: Part, value: f64) {
        self.tells[part as usize] = value;
    }

    /// Stores the received values as the last command without giving this command to the run.
    pub(crate) fn know(&mut self) {
        self.told = self.tells;
    }

    /// Gives the received command to the run if it differs from the last command.
    ///
    /// # Errors
    /// The run rejects the command.
    #[inline]
    pub(crate) fn command(&mut self, run: &mut Run<'_>) -> Result<(), PlantError> {
        if self.told == self.tells {
            return Ok(());
        }
        let [stroke, frequency, heading, steps] = self.tells;
        let left = run.state().generated(self.place).map(|generated| generated.left);
        let steps = match left {
            Some(left) if self.told[Part::Steps as usize] == steps => left,
            _ if steps < 0.0 => Steps::Endless,
            _ => Steps::Left(steps as u64),
        };
        let heading = if heading < 0.0 { Heading::Backward } else { Heading::Forward };
        run.command(self.place, Command { stroke, frequency, heading, steps })?;
        self.told = self.tells;
        Ok(())
    }
}
