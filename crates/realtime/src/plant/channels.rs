//! Inputs and outputs of a drive, by name.

use crate::wire::MOST_VALUES;
use stickslip_drive::inputs::Input;
use stickslip_drive::scene::Axis;
use stickslip_drive::{Model, Scene};
use thiserror::Error;

/// An output of a drive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Name of the channel, with its unit.
    pub name: String,
    /// Source of the value.
    pub(crate) reading: Reading,
}

/// Source of an output value. Motions of bodies are read directly, because computing a row of all channels evaluates every contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// Simulated time.
    Time,
    /// Coordinate of a body, or its velocity.
    Coordinate {
        /// Index of the body in the model.
        body: usize,
        /// Coordinate.
        axis: Axis,
        /// Whether the velocity is read.
        is_rate: bool,
    },
    /// Index in a row of all channels.
    Row(usize),
}

/// Error for inputs or outputs.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ChannelError {
    /// The channel does not exist.
    #[error("there is no channel \"{}\"; channels: {known}", .name.escape_debug())]
    Unknown {
        /// The unknown name.
        name: String,
        /// Names of all channels.
        known: String,
    },
    /// A channel is named twice.
    #[error("channel \"{0}\" is named twice")]
    Twice(String),
    /// There are more values than a packet can hold.
    #[error("{0} {1} are too many: a packet has at most {MOST_VALUES}")]
    TooMany(usize, &'static str),
}

/// Returns all inputs of a scene, see [`stickslip_drive::inputs::inputs`].
///
/// # Errors
/// There are more values than a packet can hold.
pub fn inputs(scene: &Scene) -> Result<Vec<Input>, ChannelError> {
    let inputs = stickslip_drive::inputs::inputs(scene);
    if inputs.len() > MOST_VALUES { Err(ChannelError::TooMany(inputs.len(), "inputs")) } else { Ok(inputs) }
}

/// Returns the outputs with the given names, or by default the time and the positions and velocities of the bodies.
///
/// Forces are not included by default, because they require an evaluation of the contacts, which may take longer than a frame.
///
/// # Errors
/// A name is unknown or occurs twice, or there are more values than a packet can hold.
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

/// Returns the output for an index in a row of all channels.
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

    /// A coordinate that is read directly has the value of the row.
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
