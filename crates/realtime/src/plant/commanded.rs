//! Generators whose cycles are commanded from outside, by four values in each frame.

use super::PlantError;
use stickslip_drive::{Command, Heading, Run, Steps};

/// One of the values that make a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// Peak to peak, in the unit of what follows.
    Stroke,
    /// Hz.
    Frequency,
    /// +1 is forward, −1 backward.
    Heading,
    /// Cycles still to begin; −1 is without end.
    Steps,
}

impl Part {
    /// All, in the order of a packet.
    pub(crate) const ALL: [Self; 4] = [Self::Stroke, Self::Frequency, Self::Heading, Self::Steps];

    /// What comes behind the generator's name.
    pub(crate) fn name(self) -> &'static str {
        ["stroke", "frequency", "heading", "steps"][self as usize]
    }
}

/// The values of a command, in the order of [`Part`].
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

/// A generator, and what it was last told.
///
/// A controller tells all four values in every frame. A command is made of them where one has changed; and a number of steps counts
/// from the frame on in which it is another one than in the frame before. Taken anew in every frame it would never run out;
/// refused was to count up and up (all steps ever to begin), which needs the number that have begun before one can say two more.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Commanded {
    /// Place of its waveform in the scene.
    place: usize,
    /// What it was last told.
    told: [f64; Part::ALL.len()],
    /// What it is told now.
    tells: [f64; Part::ALL.len()],
}

impl Commanded {
    /// A generator by the place of its waveform in the scene, whose command is not known yet.
    pub(crate) fn new(place: usize) -> Self {
        Self { place, told: [f64::NAN; Part::ALL.len()], tells: [f64::NAN; Part::ALL.len()] }
    }

    /// Whether it is the waveform at this place.
    pub(crate) fn is_at(&self, place: usize) -> bool {
        self.place == place
    }

    /// Hears one value.
    #[inline]
    pub(crate) fn hear(&mut self, part: Part, value: f64) {
        self.tells[part as usize] = value;
    }

    /// Takes what it has heard as told before.
    pub(crate) fn know(&mut self) {
        self.told = self.tells;
    }

    /// Commands what it has heard, where that is something else than before.
    ///
    /// # Errors
    /// A command that the run does not take.
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
