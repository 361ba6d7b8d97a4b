//! Quantities that follow waveforms.

use crate::scene::{Axis, Freedom, Normal, Scene, Varying};

/// A quantity that follows a waveform.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Follower {
    /// Index of the waveform.
    pub waveform: usize,
    /// Name of the quantity as in the scenario, such as `foot.x` or `ball.force`.
    pub what: String,
    /// Whether the quantity is a force; otherwise it is a length or an angle.
    pub is_force: bool,
}

/// Returns all quantities that follow a waveform.
pub fn followers(scene: &Scene) -> Vec<Follower> {
    let mut followers = Vec::new();
    // In the order of the scenario: bodies, contacts, actuators, loads.
    let mut add = |waveform, what: String, is_force| followers.push(Follower { waveform, what, is_force });
    for body in &scene.bodies {
        for (axis, coordinate) in body.part.coordinates() {
            if let Freedom::Follows(signal) = coordinate.freedom
                && let Some(w) = scene.waveform_of(signal)
            {
                add(w, format!("{}.{}", body.name, axis.key()), false);
            }
        }
    }
    for contact in &scene.contacts {
        let (value, word) = match contact.part.normal {
            Normal::Force(value) => (value, "force"),
            Normal::Indentation(value) => (value, "indentation"),
            Normal::Radius(value) => (value, "radius"),
            Normal::Coupled => continue,
        };
        if let Varying::Follows(w) = value {
            add(w, format!("{}.{word}", contact.name), word == "force");
        }
    }
    for actuator in &scene.actuators {
        if let Varying::Follows(signal) = actuator.part.stroke
            && let Some(w) = scene.waveform_of(signal)
        {
            add(w, format!("{}.stroke", actuator.name), false);
        }
    }
    for load in &scene.loads {
        let Some(body) = scene.bodies.get(load.on) else { continue };
        for (axis, value) in [(Axis::X, load.x), (Axis::Z, load.z), (Axis::Pitch, load.pitch)] {
            if let Varying::Follows(w) = value {
                add(w, format!("load on {}.{}", body.name, axis.key()), true);
            }
        }
    }
    followers
}
