//! How far off a run is, as one number.

use crate::samples::Samples;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Axis, Freedom, Side, Varying};
use stickslip_scenario::Figures;

/// A free coordinate of the scene.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coordinate {
    /// Place of its body in the scene.
    pub(crate) body: usize,
    pub(crate) axis: Axis,
    /// Name of its channel, such as `slider.x_m`.
    pub(crate) channel: String,
    /// 1, or what turns an angle into a way: the distance of the farthest contact point from the reference point, m.
    arm: f64,
}

/// The norm: the largest error of any free coordinate, in parts of a length. An angle counts as the way it makes at the
/// farthest contact point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Norm {
    pub(crate) coordinates: Vec<Coordinate>,
    /// m.
    pub(crate) length: f64,
    /// What the length is.
    pub(crate) of: String,
}

/// Errors of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Errors {
    /// At the end.
    pub(crate) end: f64,
    /// The largest over the common moments.
    pub(crate) trajectory: f64,
}

/// The free coordinates of a scene.
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

/// Distance of the farthest contact point of a body from its reference point, m; 1 where all lie in it.
fn arm(scene: &Scene, body: usize) -> f64 {
    let contacts = scene.contacts.iter().map(|contact| &contact.part);
    let ends = contacts.flat_map(|contact| contact.between.into_iter().zip(contact.at));
    let own = ends.filter(|(side, _)| *side == Side::Body(body));
    let farthest = own.map(|(_, at)| math::hypot(at.x, at.z)).fold(0.0, f64::max);
    if farthest > 0.0 { farthest } else { 1.0 }
}

impl Norm {
    /// In parts of the stroke of the scenario's waveform where bodies or actuators follow it, otherwise of the largest travel
    /// of the reference. None where nothing moves.
    pub(crate) fn new(
        scene: &Scene,
        figures: Figures,
        coordinates: Vec<Coordinate>,
        reference: &Samples,
    ) -> Option<Self> {
        let stroke = figures.waveform.filter(|w| drives(scene, *w)).map(|w| {
            let (low, high) = scene.waveforms[w].part.range();
            (high - low, format!("the stroke of \"{}\"", scene.waveforms[w].name))
        });
        let travel = |(i, coordinate): (usize, &Coordinate)| {
            let (low, high) = reference.range(i);
            coordinate.arm * (high - low)
        };
        let travelled = coordinates.iter().enumerate().map(travel).fold(0.0, f64::max);
        let (length, of) = stroke.unwrap_or((travelled, "the largest travel".to_owned()));
        (length > 0.0).then_some(Self { coordinates, length, of })
    }

    /// Errors of a run that came to its end.
    pub(crate) fn errors(&self, samples: &Samples, reference: &Samples) -> Errors {
        let moments = samples.moments().zip(reference.moments());
        let trajectory = moments.map(|(a, b)| self.distance(a, b)).fold(0.0, f64::max);
        Errors { end: self.distance(samples.end(), reference.end()), trajectory }
    }

    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let ways = self.coordinates.iter().zip(a.iter().zip(b));
        ways.map(|(coordinate, (a, b))| coordinate.arm * (a - b).abs()).fold(0.0, f64::max) / self.length
    }

    /// Error of a coordinate against a value known from elsewhere.
    pub(crate) fn against(&self, coordinate: usize, value: f64, known: f64) -> f64 {
        self.coordinates[coordinate].arm * (value - known).abs() / self.length
    }
}

/// Whether a body or an actuator follows a waveform.
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
