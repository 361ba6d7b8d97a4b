//! Inputs and outputs of a drive, by name.

use super::commanded::{Part, values};
use crate::wire::MOST_VALUES;
use std::fmt;
use stickslip_drive::scene::Axis;
use stickslip_drive::{Generator, Interpolation, Model, Scene, Shape};
use thiserror::Error;

/// Something of a drive that is fed from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Name of the waveform.
    pub name: String,
    /// Value before any came, in the unit of what follows.
    pub initial: f64,
    /// Which values it takes.
    pub takes: Takes,
    /// How a value gets into the run.
    pub(crate) feed: Feed,
}

/// Which values an input takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Takes {
    /// From the smallest to the largest.
    Range(f64, f64),
    /// +1 or −1.
    Sign,
    /// A number of steps: 0, 1, 2, … up to 2⁵³, or −1 for no end.
    Count,
}

/// Largest count: up to here every whole number is a double.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

impl Takes {
    /// Whether a value is among them; what is not a number never is.
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
            Self::Count => f.write_str("0, 1, 2, … or, for no end, -1"),
        }
    }
}

/// How a value gets into the run; places are those of the scene's waveforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Feed {
    /// It is there from the start of the frame on.
    Hold(usize),
    /// It is reached at the end of the frame, straight.
    Lead(usize),
    /// It is part of what the cycles of a generator are that begin from now on.
    Command(usize, Part),
    /// It does not: it is written down beside the others.
    Note,
}

impl Input {
    /// A value that feeds nothing, such as what a controller aims at: it comes with the others, and is recorded and drawn beside
    /// them.
    pub fn note(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            initial: 0.0,
            takes: Takes::Range(f64::MIN, f64::MAX),
            feed: Feed::Note,
        }
    }

    /// Whether a value is reached straight at the end of the frame; any other is there from its start on.
    pub fn is_led(&self) -> bool {
        matches!(self.feed, Feed::Lead(_))
    }
}

/// Something of a drive that is told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Name of the channel, with its unit.
    pub name: String,
    /// Where it is read.
    pub(crate) reading: Reading,
}

/// Where a value is read: a row of all channels looks into every contact, which takes longer than a frame may.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// Off the clock of the run.
    Time,
    /// A coordinate of a body, or its rate.
    Coordinate {
        /// Place of the body in the scene.
        body: usize,
        /// Which coordinate.
        axis: Axis,
        /// Whether its rate.
        is_rate: bool,
    },
    /// At a place of a row.
    Row(usize),
}

/// Why channels cannot be had.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ChannelError {
    /// No such channel.
    #[error("there is no channel \"{}\"; there are {known}", .name.escape_debug())]
    Unknown {
        /// The name.
        name: String,
        /// Those that there are.
        known: String,
    },
    /// Twice the same.
    #[error("channel \"{0}\" is asked for twice")]
    Twice(String),
    /// More than a packet holds.
    #[error("{0} {1} are too many: a packet holds {MOST_VALUES}")]
    TooMany(usize, &'static str),
}

/// All inputs of a scene, in its order: a value of each waveform that is fed, four of each generator. What nothing follows feeds
/// nothing.
///
/// # Errors
/// More than a packet holds.
pub fn inputs(scene: &Scene) -> Result<Vec<Input>, ChannelError> {
    let mut inputs = Vec::new();
    for (place, waveform) in scene.waveforms.iter().enumerate() {
        let (name, part) = (waveform.name.clone(), &waveform.part);
        match part.shape() {
            Shape::Generator(generator) => inputs.extend(commands(&name, place, generator)),
            Shape::Input { initial, .. } => {
                let (low, high) = part.range();
                let feed = match part.interpolation() {
                    Some(Interpolation::Held) => Feed::Hold(place),
                    Some(Interpolation::Linear) => Feed::Lead(place),
                    None => Feed::Note,
                };
                inputs.push(Input { name, initial: *initial, takes: Takes::Range(low, high), feed });
            }
            _ => {}
        }
    }
    if inputs.len() > MOST_VALUES { Err(ChannelError::TooMany(inputs.len(), "inputs")) } else { Ok(inputs) }
}

/// What is commanded of the generator at a place of the scene.
fn commands(name: &str, place: usize, generator: &Generator) -> impl Iterator<Item = Input> {
    let ((least, most), (slowest, fastest)) = (generator.strokes, generator.frequencies);
    let takes = [Takes::Range(least, most), Takes::Range(slowest, fastest), Takes::Sign, Takes::Count];
    let initial = values(&generator.initial);
    Part::ALL.into_iter().zip(takes).map(move |(part, takes)| Input {
        name: format!("{name}.{}", part.name()),
        initial: initial[part as usize],
        takes,
        feed: Feed::Command(place, part),
    })
}

/// Channels by their names; by default time, and places and velocities of the bodies. Forces are told where they are asked for:
/// contacts may wait for their next event, and leading a copy of each up to now takes longer than many a frame.
///
/// # Errors
/// A name that is none or comes twice, or more than a packet holds.
pub fn outputs(model: &Model, names: Option<&[String]>) -> Result<Vec<Output>, ChannelError> {
    let channels = model.channels();
    let mut chosen: Vec<Output> = Vec::new();
    match names {
        None => {
            let told = ["time_s", ".x_m", ".vx_m_s", ".z_m", ".vz_m_s", "_rad", "_rad_s"];
            let is_told = |name: &str| told.iter().any(|end| name.ends_with(end));
            let all = channels.into_iter().enumerate().filter(|(_, channel)| is_told(&channel.name));
            chosen.extend(all.map(|(place, channel)| output(model, channel.name, place)));
        }
        Some(names) => {
            for name in names {
                let Some(place) = channels.iter().position(|channel| channel.name == *name) else {
                    let known: Vec<&str> = channels.iter().map(|channel| channel.name.as_str()).collect();
                    return Err(ChannelError::Unknown { name: name.clone(), known: known.join(", ") });
                };
                if chosen.iter().any(|output| output.name == *name) {
                    return Err(ChannelError::Twice(name.clone()));
                }
                chosen.push(output(model, name.clone(), place));
            }
        }
    }
    if chosen.len() > MOST_VALUES {
        return Err(ChannelError::TooMany(chosen.len(), "channels"));
    }
    Ok(chosen)
}

/// The channel at a place of a row.
fn output(model: &Model, name: String, place: usize) -> Output {
    let axes =
        [(Axis::X, "x_m", "vx_m_s"), (Axis::Z, "z_m", "vz_m_s"), (Axis::Pitch, "pitch_rad", "vpitch_rad_s")];
    let coordinate = |owner: &str, quantity: &str| {
        let body = model.bodies().position(|body| body == owner)?;
        let (axis, _, rate) = axes.iter().find(|(_, value, rate)| quantity == *value || quantity == *rate)?;
        Some(Reading::Coordinate { body, axis: *axis, is_rate: quantity == *rate })
    };
    let reading = match name.rsplit_once('.') {
        None if name == "time_s" => Some(Reading::Time),
        None => None,
        Some((owner, quantity)) => coordinate(owner, quantity),
    };
    Output { reading: reading.unwrap_or(Reading::Row(place)), name }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Drive, Plant};
    use stickslip_run::Job;

    #[test]
    fn by_default_nothing_is_told_that_takes_a_row() {
        for example in ["p1", "three_ball_stage", "piezo_stack", "commanded", "rocking_slider"] {
            let file = format!("{}/../../scenarios/{example}.json", env!("CARGO_MANIFEST_DIR"));
            let job = Job::prepare(file.as_ref(), &[], "".as_ref()).unwrap();
            let told = outputs(&job.model, None).unwrap();
            assert!(told.len() > 2, "{example}");
            assert!(told.iter().all(|output| !matches!(output.reading, Reading::Row(_))), "{told:?}");
        }
    }

    /// Whatever way a value is read, it is that of the row.
    #[test]
    fn a_coordinate_is_read_as_in_a_row() {
        for example in ["p1", "three_ball_stage", "piezo_stack", "walking_drive"] {
            let file = format!("{}/../../scenarios/{example}.json", env!("CARGO_MANIFEST_DIR"));
            let job = Job::prepare(file.as_ref(), &[], "".as_ref()).unwrap();
            let names: Vec<String> = job.model.channels().into_iter().map(|channel| channel.name).collect();
            let chosen = outputs(&job.model, Some(&names)).unwrap();
            assert!(chosen.iter().any(|output| matches!(output.reading, Reading::Coordinate { .. })));
            let rows: Vec<Output> = (0..names.len())
                .map(|place| Output { name: names[place].clone(), reading: Reading::Row(place) })
                .collect();
            let start = || (job.start.clone(), 0);
            let plan = &job.scenario.plan;
            let drive =
                |outputs: &[Output]| Drive::new(&job.model, plan, start(), 37e-6, (&[], outputs)).unwrap();
            let (mut a, mut b) = (drive(&chosen), drive(&rows));
            let (mut told, mut read) = (vec![0.0; names.len()], vec![0.0; names.len()]);
            for _ in 0..60 {
                a.frame(&[], &mut told).unwrap();
                b.frame(&[], &mut read).unwrap();
                assert_eq!(told, read, "{example}");
            }
        }
    }
}
