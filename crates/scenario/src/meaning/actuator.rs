//! Piezo stacks: data of each stack, its command, and the signal chain between command and stroke.
//!
//! A voltage waveform is converted to the free stroke of its stack: its values are multiplied by the stroke per volt, m/V. The model
//! therefore contains lengths only. Only the blocks of the piezo chain know voltages; their columns are in V and A.

use super::Builder;
use super::ceramic::Ceramic;
use super::coupling::direction;
use super::data_sheet::stack;
use crate::fault::Fault;
use crate::form::{ActuatorForm, Moving, WaveformForm, WaveformRef};
use crate::path::At;
use crate::quantity::dimension;
use crate::units::Kind;
use stickslip_drive::scene::{Actuator, Axis, Direction, Freedom, Named, Side, Varying};
use stickslip_piezo::data_sheet::{QUALITY, Stack};
use stickslip_piezo::driver::Spec;

/// Data of an actuator in addition to those in the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Piezo {
    /// Name.
    pub name: String,
    /// Stiffness, stroke per volt, capacitance and mass, from the scenario or the data sheet.
    pub stack: Stack,
    /// Shares of the stack's own mass at its two ends, kg.
    pub ends: [f64; 2],
    /// Quality factor of the default damping; `None` if the scenario gives the damping.
    pub quality: Option<f64>,
    /// Command as a free stroke, m, before compensation, driver, hysteresis and creep.
    pub command: Varying,
    /// Whether the command is a voltage.
    pub by_voltage: bool,
    /// Limits of the driver, if there is one.
    pub driver: Option<Spec>,
    /// Voltage of the stroke in the data sheet, V.
    pub nominal: Option<f64>,
    /// Voltage resolution, V, if given.
    pub resolution: Option<f64>,
    /// Hysteresis and creep.
    pub ceramic: Ceramic,
    /// Index of the driver among the blocks of the model; `None` without a driver or with a constant command.
    pub block: Option<usize>,
}

impl Builder<'_> {
    /// Computes the stack data of all actuators, before waveforms are read.
    pub(super) fn stacks(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("actuators");
        for (name, actuator) in form.actuators.iter() {
            let stack = stack(&at.key(name), actuator)?;
            self.stacks.push(Piezo {
                name: name.to_owned(),
                stack,
                ends: [0.0; 2],
                quality: None,
                command: Varying::default(),
                by_voltage: actuator.voltage.is_some(),
                driver: None,
                nominal: actuator
                    .data_sheet
                    .as_ref()
                    .and_then(|sheet| sheet.voltage)
                    .map(|voltage| voltage.si),
                resolution: None,
                ceramic: Ceramic::default(),
                block: None,
            });
        }
        Ok(())
    }

    /// Returns the stroke per volt of a named waveform, m/V; `None` if the waveform is not the voltage of an actuator.
    pub(super) fn gain(&self, waveform: &str) -> Option<f64> {
        let commands = |actuator: &ActuatorForm| match &actuator.voltage {
            Some(Moving::Follows(WaveformRef::Name(name))) => name == waveform,
            _ => false,
        };
        let mut of = self.form.actuators.iter().zip(&self.stacks).filter(|((_, form), _)| commands(form));
        of.next().and_then(|(_, piezo)| piezo.stack.stroke_per_volt)
    }

    /// Adds all actuators in the order of the file, each with its command as stroke.
    pub(super) fn actuators(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("actuators");
        for (i, (name, actuator)) in form.actuators.iter().enumerate() {
            let at = at.key(name);
            let between = self.between(&at, &actuator.between)?;
            let stroke = self.command(&at, i, actuator)?;
            let part = Actuator {
                between,
                at: self.points(&at, &actuator.between, &actuator.at)?,
                direction: direction(actuator.direction),
                stiffness: self.stacks[i].stack.stiffness,
                damping: 0.0,
                stroke,
            };
            self.stacks[i].command = stroke;
            self.scene.actuators.push(Named { name: name.to_owned(), part });
        }
        self.inertia();
        for (i, (_, actuator)) in form.actuators.iter().enumerate() {
            let damping = self.damping(i, actuator);
            self.scene.actuators[i].part.damping = damping;
        }
        Ok(())
    }

    /// Replaces the command of each actuator by the output of its signal chain. Signals of blocks are numbered after all waveforms.
    pub(super) fn chains(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("actuators");
        for (i, (name, actuator)) in form.actuators.iter().enumerate() {
            let stroke = self.chain(&at.key(name), i, actuator)?;
            self.scene.actuators[i].part.stroke = stroke;
        }
        Ok(())
    }

    /// Builds the signal chain: command → [inverse creep and inverse hysteresis] → driver → hysteresis → creep → stroke. Each element is
    /// a block and optional.
    ///
    /// All signals are free strokes, m. One volt corresponds to `self.stacks[i].stack.stroke_per_volt`, m/V.
    fn chain(&mut self, at: &At<'_>, i: usize, actuator: &ActuatorForm) -> Result<Varying, Fault> {
        self.stacks[i].ceramic = self.ceramic(at, i, actuator)?;
        let command = self.compensation(i, self.stacks[i].command);
        let driven = match &actuator.driver {
            Some(form) => self.driver(at, (i, command), form)?,
            None => command,
        };
        Ok(self.response(i, driven))
    }

    /// Returns the command of an actuator as a free stroke.
    fn command(&mut self, at: &At<'_>, i: usize, actuator: &ActuatorForm) -> Result<Varying, Fault> {
        let (stroke, voltage) = match (&actuator.stroke, &actuator.voltage) {
            (Some(stroke), None) => (Some(stroke), None),
            (None, Some(voltage)) => (None, Some(voltage)),
            (Some(_), Some(_)) => {
                let fault = at.key("voltage").fault("this actuator already follows a stroke").on_key();
                return Err(fault.against_path(at.key("stroke").path()).help("keep one of them"));
            }
            (None, None) => {
                let fault = at.missing("stroke").against_path(at.key("voltage").path());
                return Err(fault.help("such as {\"follows\": \"drive\"}, or a \"voltage\""));
            }
        };
        if let Some(stroke) = stroke {
            let electric = [
                ("stroke_per_volt", actuator.stroke_per_volt.is_some()),
                ("driver", actuator.driver.is_some()),
            ];
            if let Some((key, _)) = electric.iter().find(|(_, given)| *given) {
                let fault = at.key(key).fault("this actuator follows a stroke, not a voltage").on_key();
                let fault = fault.against_path(at.key("stroke").path());
                return Err(fault.help("let a \"voltage\" follow the waveform instead of the \"stroke\""));
            }
            return self.varying(&at.key("stroke"), stroke);
        }
        let Some(voltage) = voltage else { return Ok(Varying::default()) };
        let Some(gain) = self.stacks[i].stack.stroke_per_volt else {
            let fault = at.missing("stroke_per_volt");
            let sheet = at.key("data_sheet").path();
            return Err(fault
                .against_path(sheet)
                .help("or a \"data_sheet\" with \"stroke\" and \"voltage\""));
        };
        self.commanded(&at.key("voltage"), voltage, gain)
    }

    /// Returns a voltage as free stroke. A waveform that drives stacks with different strokes per volt is added once for each value.
    fn commanded(
        &mut self,
        at: &At<'_>,
        voltage: &Moving<dimension::Voltage>,
        gain: f64,
    ) -> Result<Varying, Fault> {
        let waveform = match voltage {
            Moving::Constant(voltage) => return Ok(Varying::Constant(gain * voltage.si)),
            Moving::Follows(waveform) => waveform,
        };
        let follows = at.key("follows");
        let (form, mut place) = match waveform {
            WaveformRef::Name(name) => {
                let place = self.follow(at, waveform, Kind::Voltage)?;
                (
                    self.form.waveforms.0.iter().find(|(known, _)| known == name).map(|(_, form)| form),
                    Some(place),
                )
            }
            WaveformRef::Inline(form) => (Some(&**form), None),
        };
        if let Some(form @ (WaveformForm::Input(_) | WaveformForm::Generator(_))) = form {
            let what = if matches!(form, WaveformForm::Input(_)) { "an input" } else { "a generator" };
            let fault = follows.fault(format!("in this version a voltage cannot follow {what}"));
            return Err(fault
                .against(["waveforms"])
                .help("let the \"stroke\" follow it: stroke = stroke per volt × voltage"));
        }
        if place.is_some_and(|place| self.courses[place].gain != Some(gain)) {
            place = None;
        }
        if let (None, Some(form)) = (place, form) {
            let added = self.add((&follows, follows.path().to_string()), form, Some(gain))?;
            let course = &self.courses[added];
            if let Some(found) = course.kind.filter(|kind| *kind != Kind::Voltage) {
                let help = format!("its values have the unit of {}", found.article());
                return Err(follows.fault("expected a waveform of voltages").help(help));
            }
            place = Some(added);
        }
        Ok(place.map_or(Varying::default(), Varying::Follows))
    }

    /// Adds the stacks' own masses to the bodies at their ends.
    fn inertia(&mut self) {
        for (piezo, actuator) in self.stacks.iter_mut().zip(&self.scene.actuators) {
            let is_free = actuator.part.between.map(|side| match side {
                Side::Ground => false,
                Side::Body(body) => is_free(&self.scene.bodies[body].part, actuator.part.direction),
            });
            piezo.ends = piezo.stack.ends(is_free);
            for (side, share) in actuator.part.between.into_iter().zip(piezo.ends) {
                if let (Side::Body(body), true) = (side, share > 0.0) {
                    let mass = &mut self.scene.bodies[body].part.mass;
                    *mass = Some(mass.unwrap_or(0.0) + share);
                }
            }
        }
    }

    /// Returns the damping of an actuator: given, or from the quality factor and the moved masses.
    fn damping(&mut self, i: usize, form: &ActuatorForm) -> f64 {
        if let Some(damping) = form.damping {
            return damping.si;
        }
        // An actuator with only a stroke and a stiffness has no damping by default.
        let described = form.data_sheet.is_some() || form.voltage.is_some() || form.mass.is_some();
        if !described {
            return 0.0;
        }
        let part = &self.scene.actuators[i].part;
        let masses = part.between.map(|side| match side {
            Side::Body(body) if is_free(&self.scene.bodies[body].part, part.direction) => {
                self.scene.bodies[body].part.mass.unwrap_or(f64::INFINITY)
            }
            Side::Body(_) | Side::Ground => f64::INFINITY,
        });
        self.stacks[i].quality = Some(QUALITY);
        self.stacks[i].stack.damping(masses, QUALITY)
    }
}

fn is_free(body: &stickslip_drive::scene::Body, direction: Direction) -> bool {
    let axis = match direction {
        Direction::X => Axis::X,
        Direction::Z => Axis::Z,
    };
    body.coordinates().iter().any(|(own, coordinate)| *own == axis && coordinate.freedom == Freedom::Free)
}
