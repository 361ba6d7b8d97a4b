//! Points on bodies.

use super::Builder;
use crate::fault::Fault;
use crate::form::{PointForm, Points, Two};
use crate::path::At;
use crate::suggest;
use stickslip_drive::scene::Point;

impl Builder<'_> {
    /// Returns the points on both bodies of a contact, spring or actuator.
    pub(super) fn points(&self, at: &At<'_>, between: &Two, form: &Points) -> Result<[Point; 2], Fault> {
        let at = at.key("at");
        let mut points = [Point::default(); 2];
        for (name, form) in form.iter() {
            let Some(side) = between.0.iter().position(|known| known == name) else {
                return Err(self.stranger(&at.key(name), name, between));
            };
            points[side] = point(form);
        }
        Ok(points)
    }

    /// Returns the error for a point on a body that is not one of the two bodies of the part.
    fn stranger(&self, at: &At<'_>, name: &str, between: &Two) -> Fault {
        let sides = ["contacts.*.between", "springs.*.between", "actuators.*.between"];
        let shown = crate::document::shown(name);
        let fault = match self.form.bodies.find(name) {
            Some(_) => at.fault(format!("\"{shown}\" is neither of the two bodies in \"between\"")),
            None => at.fault(format!("there is no body \"{shown}\"")),
        };
        let fault = fault.against(sides).against_path(At::ROOT.key("bodies").key(name).path());
        fault.on_key().maybe_help(suggest::help(name, between.0.iter().map(String::as_str)))
    }
}

/// Converts a point.
pub(super) fn point(form: &PointForm) -> Point {
    Point { x: form.x.si, z: form.z.si }
}
