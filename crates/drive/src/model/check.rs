//! What can be wrong with a scene on its own: places that do not exist, numbers out of their range.

use crate::SceneError;
use crate::scene::{ContactStart, Freedom, Normal, Scene, Side, Varying};

/// Checks every number and every place of a scene.
pub(super) fn check(scene: &Scene) -> Result<(), SceneError> {
    let check = Check(scene);
    for body in &scene.bodies {
        let path = |key: &str| format!("bodies.{}.{key}", body.name);
        finite(body.part.start_x, || path("start.x"))?;
        finite(body.part.start_vx, || path("start.vx"))?;
        if let Freedom::Follows(w) = body.part.x {
            check.waveform(w, || path("x"))?;
        }
    }
    check.contacts()?;
    for spring in &scene.springs {
        let path = |key: &str| format!("springs.{}.{key}", spring.name);
        check.between(spring.part.between, || path("between"))?;
        at_least_zero(spring.part.stiffness, || path("stiffness"))?;
        at_least_zero(spring.part.damping, || path("damping"))?;
        finite(spring.part.preload, || path("preload"))?;
    }
    for actuator in &scene.actuators {
        let path = |key: &str| format!("actuators.{}.{key}", actuator.name);
        check.between(actuator.part.between, || path("between"))?;
        at_least_zero(actuator.part.stiffness, || path("stiffness"))?;
        at_least_zero(actuator.part.damping, || path("damping"))?;
        check.varying(actuator.part.stroke, || path("stroke"))?;
    }
    for (i, load) in scene.loads.iter().enumerate() {
        check.between([Side::Body(load.on), Side::Ground], || format!("loads[{i}].on"))?;
        check.varying(load.x, || format!("loads[{i}].x"))?;
    }
    finite(scene.gravity.acceleration, || "gravity.acceleration".to_owned())?;
    finite(scene.gravity.incline, || "gravity.incline".to_owned())
}

/// A scene whose places are looked up.
struct Check<'a>(&'a Scene);

impl Check<'_> {
    fn contacts(&self) -> Result<(), SceneError> {
        for contact in &self.0.contacts {
            let path = |key: &str| format!("contacts.{}.{key}", contact.name);
            let part = &contact.part;
            self.between(part.between, || path("between"))?;
            let (key, value) = match part.normal {
                Normal::Force(v) => ("normal.force", v),
                Normal::Indentation(v) => ("normal.indentation", v),
                Normal::Radius(v) => ("normal.radius", v),
            };
            self.varying(value, || path(key))?;
            match part.start {
                ContactStart::Untouched => {}
                ContactStart::Force(force) => finite(force, || path("start.force"))?,
                ContactStart::Displacement(u) => finite(u, || path("start.displacement"))?,
            }
            if part.count == 0 {
                return Err(SceneError::new(path("count"), "expected at least 1 contact, got 0"));
            }
        }
        Ok(())
    }

    fn between(&self, sides: [Side; 2], path: impl Fn() -> String) -> Result<(), SceneError> {
        let missing = |side: &Side| matches!(side, Side::Body(i) if *i >= self.0.bodies.len());
        match sides.iter().find(|side| missing(side)) {
            Some(side) => Err(SceneError::new(path(), format!("there is no body at {side:?}"))),
            None => Ok(()),
        }
    }

    fn waveform(&self, w: usize, path: impl Fn() -> String) -> Result<(), SceneError> {
        if w < self.0.waveforms.len() {
            return Ok(());
        }
        Err(SceneError::new(path(), format!("there is no waveform at place {w}")))
    }

    fn varying(&self, value: Varying, path: impl Fn() -> String) -> Result<(), SceneError> {
        match value {
            Varying::Constant(value) => finite(value, path),
            Varying::Follows(w) => self.waveform(w, path),
        }
    }
}

fn finite(value: f64, path: impl Fn() -> String) -> Result<(), SceneError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(SceneError::new(path(), format!("expected a finite number, got {value}")))
}

fn at_least_zero(value: f64, path: impl Fn() -> String) -> Result<(), SceneError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SceneError::new(path(), format!("expected a number of at least 0, got {value}")))
}
