//! The foot: the body in contact with the stepping body that is moved by the waveform named in `figures`.

use crate::Setting;
use stickslip_drive::scene::{Direction, Freedom, Side, Varying};

/// Type of drive of the foot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Foot {
    /// The x coordinate of the foot follows the waveform.
    Follows,
    /// A piezo stack moves the foot. The foot may lag behind the waveform, ring, or have a smaller stroke.
    Driven {
        /// Index of the foot among the bodies.
        body: usize,
        /// Index of the stack among the actuators.
        stack: usize,
    },
}

impl Foot {
    /// Returns the drive of the foot: of the body in contact with the stepping body that is moved by the waveform named in `figures`.
    ///
    /// Returns `None` if there is no such body, or if two bodies are driven differently.
    pub fn of(setting: &Setting) -> Option<Self> {
        let (scene, figures) = (&setting.scenario.scene, setting.scenario.figures);
        let (body, waveform) = (figures.body?, figures.waveform?);
        let touching = scene.contacts.iter().filter(|it| it.part.between.contains(&Side::Body(body)));
        let others = touching.flat_map(|it| it.part.between).filter_map(|side| match side {
            Side::Body(other) => Some(other).filter(|other| *other != body),
            Side::Ground => None,
        });
        let mut feet = others.filter_map(|other| match scene.bodies.get(other)?.part.x.freedom {
            Freedom::Follows(signal) => (scene.waveform_of(signal)? == waveform).then_some(Self::Follows),
            Freedom::Free => Some(Self::Driven { body: other, stack: stack(setting, other, waveform)? }),
            _ => None,
        });
        let first = feet.next()?;
        feet.all(|foot| foot == first).then_some(first)
    }

    /// Returns the name of the channel with the stack voltage. Returns `None` without a stack or a driver.
    pub fn voltage(self, setting: &Setting) -> Option<String> {
        let Self::Driven { stack, .. } = self else { return None };
        let name = &setting.scenario.scene.actuators.get(stack)?.name;
        let has_driver =
            setting.scenario.stacks.iter().any(|piezo| piezo.name == *name && piezo.driver.is_some());
        has_driver.then(|| format!("{name}.voltage_V"))
    }

    /// Returns the index of the foot if its motion must be recorded, because a stack drives it.
    pub fn driven(self) -> Option<usize> {
        match self {
            Self::Follows => None,
            Self::Driven { body, .. } => Some(body),
        }
    }
}

/// Returns the stack that the waveform commands and that moves the body along x.
fn stack(setting: &Setting, body: usize, waveform: usize) -> Option<usize> {
    let scene = &setting.scenario.scene;
    scene.actuators.iter().position(|it| {
        let commands =
            matches!(it.part.stroke, Varying::Follows(signal) if scene.waveform_of(signal) == Some(waveform));
        commands && it.part.direction == Direction::X && it.part.between.contains(&Side::Body(body))
    })
}
