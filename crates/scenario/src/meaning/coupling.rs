//! Springs, actuators, loads, gravity.

use super::{Builder, range};
use crate::fault::Fault;
use crate::form::{DirectionForm, LoadForm};
use crate::path::At;
use std::f64::consts::PI;
use stickslip_drive::scene::{Actuator, Gravity, Load, Named, Spring};

impl Builder<'_> {
    /// All springs, in the order of the file.
    pub(super) fn springs(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("springs");
        for (name, spring) in form.springs.iter() {
            let at = at.key(name);
            along_x(&at, spring.direction)?;
            let part = Spring {
                between: self.between(&at, &spring.between)?,
                stiffness: range::at_least_zero(&at.key("stiffness"), spring.stiffness)?,
                damping: range::at_least_zero(&at.key("damping"), spring.damping)?,
                preload: spring.preload.si,
            };
            self.scene.springs.push(Named { name: name.to_owned(), part });
        }
        Ok(())
    }

    /// All actuators, in the order of the file.
    pub(super) fn actuators(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("actuators");
        for (name, actuator) in form.actuators.iter() {
            let at = at.key(name);
            along_x(&at, actuator.direction)?;
            let later = [
                ("voltage", actuator.voltage),
                ("stroke_per_volt", actuator.stroke_per_volt),
                ("capacitance", actuator.capacitance),
                ("driver", actuator.driver),
                ("hysteresis", actuator.hysteresis),
                ("creep", actuator.creep),
            ];
            if let Some((key, _)) = later.iter().find(|(_, value)| value.is_some()) {
                return Err(at.key(key).not_yet().help("give the free \"stroke\" that follows a waveform"));
            }
            let Some(stroke) = &actuator.stroke else {
                return Err(at.missing("stroke").help("such as {\"follows\": \"drive\"}"));
            };
            let part = Actuator {
                between: self.between(&at, &actuator.between)?,
                stiffness: range::above_zero(&at.key("stiffness"), actuator.stiffness)?,
                damping: range::at_least_zero(&at.key("damping"), actuator.damping)?,
                stroke: self.varying(&at.key("stroke"), stroke)?,
            };
            self.scene.actuators.push(Named { name: name.to_owned(), part });
        }
        Ok(())
    }

    /// All loads.
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
        for (key, value) in [("z", form.z), ("pitch", form.pitch), ("at", form.at)] {
            if value.is_some() {
                return Err(at.key(key).not_yet());
            }
        }
        let on = self.body(&at.key("on"), &form.on)?;
        let Some(x) = &form.x else {
            return Err(at.missing("x").help("the force along the slide, such as \"-0.02 N\""));
        };
        Ok(Load { on, x: self.varying(&at.key("x"), x)? })
    }

    /// Gravity, where there is any.
    pub(super) fn gravity(&mut self) -> Result<(), Fault> {
        let Some(form) = &self.form.gravity else { return Ok(()) };
        let root = At::ROOT;
        let at = root.key("gravity");
        let acceleration = range::at_least_zero(&at.key("acceleration"), form.acceleration)?;
        let incline = form.incline.si;
        if !(-PI..=PI).contains(&incline) {
            let fault = at.key("incline").expected("an angle between -180 deg and 180 deg");
            return Err(fault.help("a bare number is in rad"));
        }
        self.scene.gravity = Gravity { acceleration, incline };
        Ok(())
    }
}

fn along_x(at: &At<'_>, direction: DirectionForm) -> Result<(), Fault> {
    match direction {
        DirectionForm::X => Ok(()),
        DirectionForm::Z => {
            let fault = at.key("direction").fault("\"z\" is part of the form but not yet in this version");
            Err(fault.help("leave it out: along x"))
        }
    }
}
