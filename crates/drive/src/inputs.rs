//! Inputs of a run: values of waveforms of kind `input`, and commands of generators.

use crate::{Command, CommandError, Generator, Heading, Interpolation, Run, Scene, Shape, Steps};
use std::fmt;

/// An input of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Name of the waveform; for a command `NAME.stroke`, `NAME.frequency`, `NAME.heading` or `NAME.steps`.
    pub name: String,
    /// Initial value, in the unit of the quantity that follows the waveform.
    pub initial: f64,
    /// SI unit. Empty for a heading and a number of steps.
    pub unit: &'static str,
    /// Allowed values.
    pub takes: Takes,
    /// Effect of the value on the run.
    pub feed: Feed,
}

/// Allowed values of an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Takes {
    /// Values from the smallest to the largest value.
    Range(f64, f64),
    /// +1 or −1.
    Sign,
    /// A number of cycles: 0, 1, 2, … up to 2⁵³, or −1 for no limit.
    Count,
}

/// Largest count, 2⁵³: all integers up to this value are exact in double precision.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

impl Takes {
    /// Returns the smallest and the largest value.
    pub fn bounds(self) -> (f64, f64) {
        match self {
            Self::Range(low, high) => (low, high),
            Self::Sign => (-1.0, 1.0),
            Self::Count => (-1.0, MOST_STEPS),
        }
    }

    /// Returns whether a value is allowed. NaN is never allowed.
    #[inline]
    pub fn has(self, value: f64) -> bool {
        match self {
            Self::Range(low, high) => value >= low && value <= high,
            Self::Sign => value.abs() == 1.0,
            Self::Count => (-1.0..=MOST_STEPS).contains(&value) && value.fract() == 0.0,
        }
    }
}

impl fmt::Display for Takes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range(low, high) => write!(f, "{low:e} to {high:e}"),
            Self::Sign => f.write_str("1 or -1"),
            Self::Count => f.write_str("0, 1, 2, … or -1 for no limit"),
        }
    }
}

/// Effect of an input value on the run, with the index of the waveform in the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feed {
    /// The waveform has the value from the current time on.
    Hold(usize),
    /// The waveform reaches the value at the next communication point, by linear interpolation.
    Lead(usize),
    /// The value is a part of the command for the cycles of a generator that start later.
    Command(usize, Part),
    /// The value is recorded but has no effect.
    Note,
}

impl Input {
    /// Creates an input that has no effect, such as the setpoint of a controller. The input is recorded and drawn like other inputs.
    pub fn note(name: &str) -> Self {
        let takes = Takes::Range(f64::MIN, f64::MAX);
        Self { name: name.to_owned(), initial: 0.0, unit: "", takes, feed: Feed::Note }
    }

    /// Returns whether the value is reached at the next communication point. Other values apply from the current time on.
    pub fn is_led(&self) -> bool {
        matches!(self.feed, Feed::Lead(_))
    }

    /// Returns whether the value is part of the command of a generator.
    pub fn is_command(&self) -> bool {
        matches!(self.feed, Feed::Command(..))
    }

    /// Returns the index of the waveform.
    pub fn place(&self) -> Option<usize> {
        match self.feed {
            Feed::Hold(place) | Feed::Lead(place) | Feed::Command(place, _) => Some(place),
            Feed::Note => None,
        }
    }
}

/// One of the four values of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
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
    /// All values of a command, in the order of their inputs.
    const ALL: [Self; 4] = [Self::Stroke, Self::Frequency, Self::Heading, Self::Steps];

    /// Returns the suffix of the input name after the name of the generator.
    fn name(self) -> &'static str {
        ["stroke", "frequency", "heading", "steps"][self as usize]
    }
}

/// Returns all inputs of a scene: one value per input waveform, four per generator. Waveforms without followers have no effect.
pub fn inputs(scene: &Scene) -> Vec<Input> {
    let mut inputs = Vec::new();
    for (place, waveform) in scene.waveforms.iter().enumerate() {
        let (name, part, unit) = (waveform.name.clone(), &waveform.part, scene.waveform_unit(place));
        match part.shape() {
            Shape::Generator(generator) => inputs.extend(commands((&name, unit), place, generator)),
            Shape::Input { initial, .. } => {
                let (low, high) = part.range();
                let feed = match part.interpolation() {
                    Some(Interpolation::Held) => Feed::Hold(place),
                    Some(Interpolation::Linear) => Feed::Lead(place),
                    None => Feed::Note,
                };
                inputs.push(Input { name, initial: *initial, unit, takes: Takes::Range(low, high), feed });
            }
            _ => {}
        }
    }
    inputs
}

/// Returns the command inputs of a generator.
fn commands(
    (name, unit): (&str, &'static str),
    place: usize,
    generator: &Generator,
) -> impl Iterator<Item = Input> {
    let ((least, most), (slowest, fastest)) = (generator.strokes, generator.frequencies);
    let takes = [Takes::Range(least, most), Takes::Range(slowest, fastest), Takes::Sign, Takes::Count];
    let initial = values(&generator.initial);
    Part::ALL.into_iter().zip(takes).map(move |(part, takes)| Input {
        name: format!("{name}.{}", part.name()),
        initial: initial[part as usize],
        unit: [unit, "Hz", "", ""][part as usize],
        takes,
        feed: Feed::Command(place, part),
    })
}

/// Returns the values of a command in the order of [`Part`].
fn values(command: &Command) -> [f64; Part::ALL.len()] {
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
/// A controller sends all four values each time. The generator gets a new command only if a value has changed. The number of cycles
/// therefore counts from the time of its last change. If it were renewed each time, it would never be used up.
#[derive(Debug, Clone, Copy)]
pub struct Commanded {
    /// Index of the waveform in the model.
    place: usize,
    /// Values of the last command.
    told: [f64; Part::ALL.len()],
    /// Values received since.
    tells: [f64; Part::ALL.len()],
}

impl Commanded {
    /// Creates the generators of some inputs, whose last commands are unknown.
    pub fn all(feeds: impl IntoIterator<Item = Feed>) -> Vec<Self> {
        let unknown = [f64::NAN; Part::ALL.len()];
        let first = feeds.into_iter().filter_map(|feed| match feed {
            Feed::Command(place, Part::Stroke) => Some(place),
            _ => None,
        });
        first.map(|place| Self { place, told: unknown, tells: unknown }).collect()
    }

    /// Sets one received value of the command, if it belongs to this generator.
    #[inline]
    pub fn hear(&mut self, feed: Feed, value: f64) {
        match feed {
            Feed::Command(place, part) if place == self.place => self.tells[part as usize] = value,
            _ => {}
        }
    }

    /// Stores the received values as the last command without giving this command to the run.
    pub fn know(&mut self) {
        self.told = self.tells;
    }

    /// Gives the received command to the run if it differs from the last command.
    ///
    /// # Errors
    /// The run rejects the command.
    #[inline]
    pub fn command(&mut self, run: &mut Run<'_>) -> Result<(), CommandError> {
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
