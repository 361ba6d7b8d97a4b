//! Piezo stacks: what is known of each, its command, and what stands between command and stroke.
//!
//! A waveform of volts that a stack follows is read as the free stroke that it commands: its values are multiplied by the stack's
//! stroke per volt, m/V, where they are read. Lengths are then all that a scene knows, and its natural scales, its warnings
//! and its figures need no word of volts. Only blocks of the piezo side do, whose columns are volts and amperes.

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

/// What is known of an actuator beside what the scene holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Piezo {
    /// Its name.
    pub name: String,
    /// What its numbers come to.
    pub stack: Stack,
    /// Of its own mass, what each end has been given, kg.
    pub ends: [f64; 2],
    /// Quality factor that its damping was derived from, where the scenario does not give the damping.
    pub quality: Option<f64>,
    /// Its command as a free stroke, m: what it would follow if nothing stood between.
    pub command: Varying,
    /// Whether that is commanded as a voltage.
    pub by_voltage: bool,
    /// What its driver can do, where it has one.
    pub driver: Option<Spec>,
    /// Voltage for which the data sheet gives its stroke, V.
    pub nominal: Option<f64>,
    /// Smallest step of its voltage, V, where the scenario tells it.
    pub resolution: Option<f64>,
    /// Hysteresis and creep.
    pub ceramic: Ceramic,
    /// Place of the driver among the blocks of the scene: none where the command is constant.
    pub block: Option<usize>,
}

impl Builder<'_> {
    /// What the numbers of all actuators come to, before anything follows anything.
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

    /// Stroke per volt by which a named waveform is read, m/V; none where no actuator has it as its voltage.
    pub(super) fn gain(&self, waveform: &str) -> Option<f64> {
        let commands = |actuator: &ActuatorForm| match &actuator.voltage {
            Some(Moving::Follows(WaveformRef::Name(name))) => name == waveform,
            _ => false,
        };
        let mut of = self.form.actuators.iter().zip(&self.stacks).filter(|((_, form), _)| commands(form));
        of.next().and_then(|(_, piezo)| piezo.stack.stroke_per_volt)
    }

    /// All actuators, in the order of the file, each with its command for its stroke.
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

    /// What stands between each command and its stroke. Blocks are counted on from the last waveform: all of those are there now.
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

    /// command → [inverses of creep and hysteresis] → driver → hysteresis → creep → stroke, each a block where the scenario asks for it.
    ///
    /// All signals are free strokes, m; one of a volt is `self.stacks[i].stack.stroke_per_volt` (m/V).
    fn chain(&mut self, at: &At<'_>, i: usize, actuator: &ActuatorForm) -> Result<Varying, Fault> {
        self.stacks[i].ceramic = self.ceramic(at, i, actuator)?;
        let command = self.compensation(i, self.stacks[i].command);
        let driven = match &actuator.driver {
            Some(form) => self.driver(at, (i, command), form)?,
            None => command,
        };
        Ok(self.response(i, driven))
    }

    /// The command of an actuator as a free stroke.
    fn command(&mut self, at: &At<'_>, i: usize, actuator: &ActuatorForm) -> Result<Varying, Fault> {
        let (stroke, voltage) = match (&actuator.stroke, &actuator.voltage) {
            (Some(stroke), None) => (Some(stroke), None),
            (None, Some(voltage)) => (None, Some(voltage)),
            (Some(_), Some(_)) => {
                let fault = at.key("voltage").fault("this actuator follows a stroke already").on_key();
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
                let fault = at.key(key).fault("this actuator follows a stroke: no voltage makes it").on_key();
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

    /// A voltage as the free stroke that it commands. A waveform that stacks of different strokes per volt follow is there once for
    /// each.
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
            let fault = follows.fault(format!("a voltage cannot follow {what} in this version"));
            return Err(fault
                .against(["waveforms"])
                .help("let a \"stroke\" follow it: stroke per volt times voltage"));
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

    /// Gives the ends their share of the stacks' own masses.
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

    /// Damping of an actuator, given or by the quality factor of what it moves.
    fn damping(&mut self, i: usize, form: &ActuatorForm) -> f64 {
        if let Some(damping) = form.damping {
            return damping.si;
        }
        // Files that were there before stacks had numbers keep their bits.
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
