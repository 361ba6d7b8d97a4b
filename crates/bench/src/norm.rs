//! Norm of the error of a run.

use crate::samples::Samples;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Axis, Freedom, Side, Varying};
use stickslip_scenario::Figures;

/// Free coordinate of the model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coordinate {
    /// Index of the body in the model.
    pub(crate) body: usize,
    pub(crate) axis: Axis,
    /// Name of the channel, such as `slider.x_m`.
    pub(crate) channel: String,
    /// Factor that converts the coordinate to a length: 1, or for an angle the distance of the farthest contact point from the reference
    /// point, m.
    arm: f64,
}

/// Norm: the largest error of any free coordinate, relative to a length. An angle counts as the displacement of the farthest contact
/// point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Norm {
    pub(crate) coordinates: Vec<Coordinate>,
    /// Length, m.
    pub(crate) length: f64,
    /// Description of the length.
    pub(crate) of: String,
}

/// Errors of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Errors {
    /// Error at the end.
    pub(crate) end: f64,
    /// Largest error at the sample times.
    pub(crate) trajectory: f64,
}

/// Returns the free coordinates of a model.
pub(crate) fn coordinates(scene: &Scene) -> Vec<Coordinate> {
    let mut coordinates = Vec::new();
    for (body, named) in scene.bodies.iter().enumerate() {
        for (axis, coordinate) in named.part.coordinates() {
            if coordinate.freedom == Freedom::Free {
                let unit = if axis == Axis::Pitch { "rad" } else { "m" };
                let channel = format!("{}.{}_{unit}", named.name, axis.key());
                let arm = if axis == Axis::Pitch { arm(scene, body) } else { 1.0 };
                coordinates.push(Coordinate { body, axis, channel, arm });
            }
        }
    }
    coordinates
}

/// Returns the distance of the farthest contact point of a body from its reference point, m; 1 if all contact points lie there.
fn arm(scene: &Scene, body: usize) -> f64 {
    let contacts = scene.contacts.iter().map(|contact| &contact.part);
    let ends = contacts.flat_map(|contact| contact.between.into_iter().zip(contact.at));
    let own = ends.filter(|(side, _)| *side == Side::Body(body));
    let farthest = own.map(|(_, at)| math::hypot(at.x, at.z)).fold(0.0, f64::max);
    if farthest > 0.0 { farthest } else { 1.0 }
}

impl Norm {
    /// Returns the norm. The length is the stroke of the evaluated waveform if a body or actuator follows it; otherwise the largest
    /// displacement of the reference. Returns `None` if nothing moves.
    pub(crate) fn new(
        scene: &Scene,
        figures: Figures,
        coordinates: Vec<Coordinate>,
        reference: &Samples,
    ) -> Option<Self> {
        let travel = |(i, coordinate): (usize, &Coordinate)| {
            let (low, high) = reference.range(i);
            coordinate.arm * (high - low)
        };
        let travelled = coordinates.iter().enumerate().map(travel).fold(0.0, f64::max);
        let (length, of) = stroke(scene, figures).unwrap_or((travelled, "the largest travel".to_owned()));
        (length > 0.0).then_some(Self { coordinates, length, of })
    }

    /// Returns the errors of a complete run.
    pub(crate) fn errors(&self, samples: &Samples, reference: &Samples) -> Errors {
        let moments = samples.moments().zip(reference.moments());
        let trajectory = moments.map(|(a, b)| self.distance(a, b)).fold(0.0, f64::max);
        Errors { end: self.distance(samples.end(), reference.end()), trajectory }
    }

    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let ways = self.coordinates.iter().zip(a.iter().zip(b));
        ways.map(|(coordinate, (a, b))| coordinate.arm * (a - b).abs()).fold(0.0, f64::max) / self.length
    }

    /// Returns the error of a coordinate relative to a known value.
    pub(crate) fn against(&self, coordinate: usize, value: f64, known: f64) -> f64 {
        self.coordinates[coordinate].arm * (value - known).abs() / self.length
    }
}

/// Returns the stroke of the evaluated waveform, m, and its description, if a body or an actuator follows it.
pub(crate) fn stroke(scene: &Scene, figures: Figures) -> Option<(f64, String)> {
    let waveform = figures.waveform.filter(|w| drives(scene, *w))?;
    let (low, high) = scene.waveforms[waveform].part.range();
    Some((high - low, format!("the stroke of \"{}\"", scene.waveforms[waveform].name)))
}

/// Returns whether a body or an actuator follows a waveform.
fn drives(scene: &Scene, waveform: usize) -> bool {
    let follows = Freedom::Follows(waveform);
    let bodies = scene.bodies.iter().flat_map(|body| body.part.coordinates());
    let lengths = bodies.filter(|(axis, _)| *axis != Axis::Pitch);
    let mut actuators = scene.actuators.iter().map(|actuator| actuator.part.stroke);
    lengths.into_iter().any(|(_, coordinate)| coordinate.freedom == follows)
        || actuators.any(
            |stroke| matches!(stroke, Varying::Follows(signal) if scene.waveform_of(signal) == Some(waveform)),
        )
}
