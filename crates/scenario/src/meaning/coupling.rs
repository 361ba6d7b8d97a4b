//! Springs, loads and gravity.

use super::point::point;
use super::{Builder, range};
use crate::fault::Fault;
use crate::form::{DirectionForm, LoadForm, Moving};
use crate::path::At;
use crate::quantity::Dimension;
use std::f64::consts::PI;
use stickslip_drive::scene::{Direction, Gravity, Load, Named, Point, Spring, Stop, Varying};

impl Builder<'_> {
    /// Adds all springs in the order of the file.
    pub(super) fn springs(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("springs");
        for (name, spring) in form.springs.iter() {
            let at = at.key(name);
            let part = Spring {
                between: self.between(&at, &spring.between)?,
                at: self.points(&at, &spring.between, &spring.at)?,
                direction: direction(spring.direction),
                stiffness: spring.stiffness.si,
                damping: spring.damping.si,
                preload: spring.preload.si,
            };
            self.scene.springs.push(Named { name: name.to_owned(), part });
        }
        Ok(())
    }

    /// Adds all end stops in the order of the file.
    pub(super) fn stops(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("stops");
        for (name, stop) in form.stops.iter() {
            let at = at.key(name);
            let (direction, ends) = match (stop.x, stop.z) {
                (Some(ends), None) => (Direction::X, ends),
                (None, Some(ends)) => (Direction::Z, ends),
                _ => {
                    let fault = at.fault("expected the positions of the stops along either \"x\" or \"z\"");
                    return Err(
                        fault.help("such as \"x\": [\"0 mm\", \"1 mm\"]; null means no stop at that end")
                    );
                }
            };
            let part = Stop {
                on: self.body(&at.key("on"), &stop.on)?,
                direction,
                ends: ends.map(|end| end.map(|position| position.si)),
                stiffness: range::above_zero(&at.key("stiffness"), stop.stiffness)?,
                damping: range::at_least_zero(&at.key("damping"), stop.damping)?,
            };
            for end in ["low", "high"].map(|end| format!("{name}_{end}")) {
                if self.scene.contacts.iter().any(|contact| contact.name == end) {
                    let fault = at.fault(format!("the contact {end} has the name of this stop in results"));
                    return Err(fault.help("rename the stop or the contact"));
                }
            }
            self.scene.stops.push(Named { name: name.to_owned(), part });
        }
        Ok(())
    }

    /// Adds all loads.
    pub(super) fn loads(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("loads");
        for (i, load) in form.loads.iter().enumerate() {
            let part = self.load(&at.index(i), load)?;
            self.scene.loads.push(part);
        }
        Ok(())
    }

    fn load(&mut self, at: &At<'_>, form: &LoadForm) -> Result<Load, Fault> {
        let on = self.body(&at.key("on"), &form.on)?;
        if let (None, None, None) = (&form.x, &form.z, &form.pitch) {
            let fault = at.fault("a load needs a force \"x\" or \"z\", or a moment \"pitch\"");
            return Err(fault.help("such as { \"on\": \"slider\", \"x\": \"-0.02 N\" }"));
        }
        if let (None, None, Some(_)) = (&form.x, &form.z, form.at) {
            let fault = at.key("at").fault("a moment has no point of application").on_key();
            return Err(fault.help("remove it, or give a force \"x\" or \"z\""));
        }
        let x = self.component(&at.key("x"), form.x.as_ref())?;
        let z = self.component(&at.key("z"), form.z.as_ref())?;
        let pitch = self.component(&at.key("pitch"), form.pitch.as_ref())?;
        Ok(Load { on, at: form.at.as_ref().map_or_else(Point::default, point), x, z, pitch })
    }

    /// Returns a component of a load, 0 by default.
    fn component<D: Dimension>(&mut self, at: &At<'_>, form: Option<&Moving<D>>) -> Result<Varying, Fault> {
        form.map_or(Ok(Varying::default()), |form| self.varying(at, form))
    }

    /// Sets gravity, if given.
    pub(super) fn gravity(&mut self) -> Result<(), Fault> {
        let Some(form) = &self.form.gravity else { return Ok(()) };
        let root = At::ROOT;
        let at = root.key("gravity");
        let acceleration = range::at_least_zero(&at.key("acceleration"), form.acceleration)?;
        let incline = form.incline.si;
        if !(-PI..=PI).contains(&incline) {
            let fault = at.key("incline").expected("an angle between -180 deg and 180 deg");
            return Err(fault.help("a number without a unit is in rad"));
        }
        self.scene.gravity = Gravity { acceleration, incline };
        Ok(())
    }
}

pub(super) fn direction(form: DirectionForm) -> Direction {
    match form {
        DirectionForm::X => Direction::X,
        DirectionForm::Z => Direction::Z,
    }
}
