//! What can be wrong with a scene on its own: places that do not exist, numbers out of their range.

use crate::SceneError;
use crate::scene::{Axis, ContactStart, Freedom, Normal, Point, Scene, Side, Varying};

/// Checks every number and every place of a scene.
pub(super) fn check(scene: &Scene) -> Result<(), SceneError> {
    let check = Check(scene);
    for body in &scene.bodies {
        let path = |key: &str| format!("bodies.{}.{key}", body.name);
        for (axis, coordinate) in body.part.coordinates() {
            let key = axis.key();
            finite(coordinate.position, || path(&format!("start.{key}")))?;
            finite(coordinate.velocity, || path(&format!("start.v{key}")))?;
            if let Freedom::Follows(w) = coordinate.freedom {
                check.waveform(w, || path(key))?;
            }
        }
    }
    check.contacts()?;
    for spring in &scene.springs {
        let path = |key: &str| format!("springs.{}.{key}", spring.name);
        check.between(spring.part.between, || path("between"))?;
        points(spring.part.at, || path("at"))?;
        at_least_zero(spring.part.stiffness, || path("stiffness"))?;
        at_least_zero(spring.part.damping, || path("damping"))?;
        finite(spring.part.preload, || path("preload"))?;
    }
    for actuator in &scene.actuators {
        let path = |key: &str| format!("actuators.{}.{key}", actuator.name);
        check.between(actuator.part.between, || path("between"))?;
        points(actuator.part.at, || path("at"))?;
        at_least_zero(actuator.part.stiffness, || path("stiffness"))?;
        at_least_zero(actuator.part.damping, || path("damping"))?;
        check.varying(actuator.part.stroke, || path("stroke"))?;
    }
    for (i, load) in scene.loads.iter().enumerate() {
        check.between([Side::Body(load.on), Side::Ground], || format!("loads[{i}].on"))?;
        points([load.at, Point::default()], || format!("loads[{i}].at"))?;
        for (axis, value) in [(Axis::X, load.x), (Axis::Z, load.z), (Axis::Pitch, load.pitch)] {
            check.varying(value, || format!("loads[{i}].{}", axis.key()))?;
        }
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
            points(part.at, || path("at"))?;
            finite(part.gap, || path("gap"))?;
            at_least_zero(part.damping, || path("damping"))?;
            match part.normal {
                Normal::Force(v) => self.varying(v, || path("normal.force"))?,
                Normal::Indentation(v) => self.varying(v, || path("normal.indentation"))?,
                Normal::Radius(v) => self.varying(v, || path("normal.radius"))?,
                Normal::Coupled => {}
            }
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

fn points(at: [Point; 2], path: impl Fn() -> String) -> Result<(), SceneError> {
    at.iter().flat_map(|point| [point.x, point.z]).try_for_each(|value| finite(value, &path))
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
