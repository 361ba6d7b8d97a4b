//! The foot: the body that the waveform of the figures moves under the body that steps.

use crate::Setting;
use stickslip_drive::scene::{Direction, Freedom, Side, Varying};

/// How the waveform moves a foot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Foot {
    /// Its x follows the waveform.
    Follows,
    /// A stack that the waveform commands moves it: it may lag behind, ring and fall short.
    Driven {
        /// Its place among the bodies.
        body: usize,
        /// The place of the stack among the actuators.
        stack: usize,
    },
}

impl Foot {
    /// That of a setting's figures: of the bodies that touch the one that steps, the one that the waveform of the figures moves. None without
    /// such a body, and with two that are driven apart.
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

    /// The column with the voltage of its stack; none where no driver makes that.
    pub fn voltage(self, setting: &Setting) -> Option<String> {
        let Self::Driven { stack, .. } = self else { return None };
        let name = &setting.scenario.scene.actuators.get(stack)?.name;
        let has_driver =
            setting.scenario.stacks.iter().any(|piezo| piezo.name == *name && piezo.driver.is_some());
        has_driver.then(|| format!("{name}.voltage_V"))
    }

    /// The body whose motion has to be watched for its travel.
    pub fn driven(self) -> Option<usize> {
        match self {
            Self::Follows => None,
            Self::Driven { body, .. } => Some(body),
        }
    }
}

/// The stack that a waveform commands and that moves a body along x.
fn stack(setting: &Setting, body: usize, waveform: usize) -> Option<usize> {
    let scene = &setting.scenario.scene;
    scene.actuators.iter().position(|it| {
        let commands =
            matches!(it.part.stroke, Varying::Follows(signal) if scene.waveform_of(signal) == Some(waveform));
        commands && it.part.direction == Direction::X && it.part.between.contains(&Side::Body(body))
    })
}
