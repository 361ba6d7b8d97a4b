//! Checks of a [`Scene`]: references and ranges of numbers.
//!
//! The crate `stickslip_contact` checks the physics of a single contact. Model construction checks conditions that involve several parts.

use crate::scene::{
    Axis, Contact, ContactStart, Freedom, Named, Normal, NormalDamping, Point, Scene, Side, Varying,
};
use crate::{Field, Part, SceneError, SceneFault};

/// Checks all numbers and references of a [`Scene`].
pub(super) fn check(scene: &Scene) -> Result<(), SceneError> {
    let check = Check(scene);
    for (i, body) in scene.bodies.iter().enumerate() {
        for (field, value) in [(Field::Mass, body.part.mass), (Field::Inertia, body.part.inertia)] {
            value.map_or(Ok(()), above_zero).map_err(|fault| fault.of(Part::Body(i), field))?;
        }
        for (axis, coordinate) in body.part.coordinates() {
            let of = |field: Field| move |fault: SceneFault| fault.of(Part::Body(i), field);
            finite(coordinate.position).map_err(of(Field::Position(axis)))?;
            finite(coordinate.velocity).map_err(of(Field::Velocity(axis)))?;
            if let Freedom::Follows(w) = coordinate.freedom {
                check.signal(w).map_err(of(Field::Coordinate(axis)))?;
            }
        }
    }
    scene.contacts.iter().enumerate().try_for_each(|(i, contact)| check.contact(i, &contact.part))?;
    check.links()?;
    check.loads()?;
    check.stops()?;
    let of = |field: Field| move |fault: SceneFault| fault.of(Part::Gravity, field);
    finite(scene.gravity.acceleration).map_err(of(Field::Acceleration))?;
    finite(scene.gravity.incline).map_err(of(Field::Incline))
}

/// A [`Scene`] with functions to check references.
struct Check<'a>(&'a Scene);

impl Check<'_> {
    fn contact(&self, i: usize, part: &Contact) -> Result<(), SceneError> {
        let of = |field: Field| move |fault: SceneFault| fault.of(Part::Contact(i), field);
        self.between(part.between).map_err(of(Field::Between))?;
        points(part.at).map_err(of(Field::Points))?;
        finite(part.gap).map_err(of(Field::Gap))?;
        at_least_zero(part.interface.damping()).map_err(of(Field::Damping))?;
        if let NormalDamping::Time(time) = part.normal_damping {
            at_least_zero(time).map_err(of(Field::NormalDamping))?;
        }
        match part.normal {
            Normal::Force(v) => self.varying(v).map_err(of(Field::NormalForce))?,
            Normal::Indentation(v) => self.varying(v).map_err(of(Field::NormalIndentation))?,
            Normal::Radius(v) => self.varying(v).map_err(of(Field::NormalRadius))?,
            Normal::Coupled => {}
        }
        match part.start {
            ContactStart::Untouched => {}
            ContactStart::Force(force) => finite(force).map_err(of(Field::StartForce))?,
            ContactStart::Rest(time) => at_least_zero(time).map_err(of(Field::StartRest))?,
            ContactStart::Displacement(u) => finite(u).map_err(of(Field::StartDisplacement))?,
        }
        if part.count == 0 {
            return Err(of(Field::Count)(SceneFault::NoContact));
        }
        Ok(())
    }

    /// Checks springs and actuators.
    fn links(&self) -> Result<(), SceneError> {
        for (i, spring) in self.0.springs.iter().enumerate() {
            let of = |field: Field| move |fault: SceneFault| fault.of(Part::Spring(i), field);
            self.between(spring.part.between).map_err(of(Field::Between))?;
            points(spring.part.at).map_err(of(Field::Points))?;
            at_least_zero(spring.part.stiffness).map_err(of(Field::Stiffness))?;
            at_least_zero(spring.part.damping).map_err(of(Field::Damping))?;
            finite(spring.part.preload).map_err(of(Field::Preload))?;
        }
        for (i, actuator) in self.0.actuators.iter().enumerate() {
            let of = |field: Field| move |fault: SceneFault| fault.of(Part::Actuator(i), field);
            self.between(actuator.part.between).map_err(of(Field::Between))?;
            points(actuator.part.at).map_err(of(Field::Points))?;
            above_zero(actuator.part.stiffness).map_err(of(Field::Stiffness))?;
            at_least_zero(actuator.part.damping).map_err(of(Field::Damping))?;
            match actuator.part.stroke {
                Varying::Constant(stroke) => finite(stroke),
                Varying::Follows(signal) => self.signal(signal),
            }
            .map_err(of(Field::Stroke))?;
        }
        Ok(())
    }

    fn stops(&self) -> Result<(), SceneError> {
        for (i, Named { part, .. }) in self.0.stops.iter().enumerate() {
            let of = |field: Field| move |fault: SceneFault| fault.of(Part::Stop(i), field);
            self.body(part.on).map_err(of(Field::On))?;
            above_zero(part.stiffness).map_err(of(Field::Stiffness))?;
            at_least_zero(part.damping).map_err(of(Field::Damping))?;
            for (end, position) in part.ends.into_iter().enumerate() {
                position.map_or(Ok(()), finite).map_err(of(Field::End(end)))?;
            }
            if let [Some(low), Some(high)] = part.ends
                && low >= high
            {
                return Err(of(Field::End(1))(SceneFault::StopOrder { low, high }));
            }
        }
        Ok(())
    }

    fn loads(&self) -> Result<(), SceneError> {
        for (i, load) in self.0.loads.iter().enumerate() {
            let of = |field: Field| move |fault: SceneFault| fault.of(Part::Load(i), field);
            self.body(load.on).map_err(of(Field::On))?;
            points([load.at, Point::default()]).map_err(of(Field::Points))?;
            for (axis, value) in [(Axis::X, load.x), (Axis::Z, load.z), (Axis::Pitch, load.pitch)] {
                self.varying(value).map_err(of(Field::Component(axis)))?;
            }
        }
        Ok(())
    }

    /// Checks that both sides of a contact or spring exist and differ.
    fn between(&self, sides: [Side; 2]) -> Result<(), SceneFault> {
        for side in sides {
            if let Side::Body(i) = side {
                self.body(i)?;
            }
        }
        let [first, second] = sides;
        Side::two(first, second).map(|_| ())
    }

    fn body(&self, i: usize) -> Result<(), SceneFault> {
        if i < self.0.bodies.len() { Ok(()) } else { Err(SceneFault::NoBody(i)) }
    }

    fn waveform(&self, w: usize) -> Result<(), SceneFault> {
        if w < self.0.waveforms.len() { Ok(()) } else { Err(SceneFault::NoWaveform(w)) }
    }

    /// Checks that a signal exists: a waveform or a block.
    fn signal(&self, signal: usize) -> Result<(), SceneFault> {
        let known = self.0.waveforms.len() + self.0.blocks.len();
        if signal < known { Ok(()) } else { Err(SceneFault::NoWaveform(signal)) }
    }

    fn varying(&self, value: Varying) -> Result<(), SceneFault> {
        match value {
            Varying::Constant(value) => finite(value),
            Varying::Follows(w) => self.waveform(w),
        }
    }
}

fn points(at: [Point; 2]) -> Result<(), SceneFault> {
    at.iter().flat_map(|point| [point.x, point.z]).try_for_each(finite)
}

fn finite(value: f64) -> Result<(), SceneFault> {
    if value.is_finite() { Ok(()) } else { Err(SceneFault::NotFinite(value)) }
}

fn above_zero(value: f64) -> Result<(), SceneFault> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(SceneFault::NotAboveZero(value)) }
}

fn at_least_zero(value: f64) -> Result<(), SceneFault> {
    if value >= 0.0 && value.is_finite() { Ok(()) } else { Err(SceneFault::BelowZero(value)) }
}
