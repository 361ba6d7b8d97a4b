//! Driver electronics of a stack.

use super::{Builder, Piezo, ceramic, range};
use crate::fault::Fault;
use crate::form::{ActuatorForm, ControlForm, DriverForm};
use crate::path::At;
use std::f64::consts::FRAC_1_SQRT_2;
use stickslip_drive::component::Input;
use stickslip_drive::scene::{Actuator, Named, Scene, Varying};
use stickslip_piezo::driver::{Control, Driver, Low, Spec};

/// Smallest and largest damping ratio of the low-pass.
const RATIO: (f64, f64) = (0.05, 10.0);
/// Voltages relative to the nominal voltage beyond which a warning is given. Makers allow about 20 % of opposite polarity.
const BEYOND: (f64, f64) = (-0.2, 1.1);
/// Rounding tolerance at the ends of the window, relative to its width.
const ROUNDING: f64 = 1e-9;

impl Builder<'_> {
    /// Adds the driver of an actuator as a block after its command, and returns the output signal. A constant command needs no block,
    /// because its voltage has settled.
    pub(super) fn driver(
        &mut self,
        actuator: &At<'_>,
        (i, command): (usize, Varying),
        form: &DriverForm,
    ) -> Result<Varying, Fault> {
        let at = actuator.key("driver");
        let stack = self.stacks[i].stack;
        let Some(capacitance) = stack.capacitance else {
            let fault = actuator.missing("capacitance").against_path(actuator.key("data_sheet").path());
            return Err(fault.against_path(at.path()).help(
                "a driver charges the stack: give the capacitance of the data sheet, such as \"7.2 uF\"",
            ));
        };
        let spec = spec(&at, form, (capacitance, stack.stroke_per_volt.unwrap_or(1.0)))?;
        self.stacks[i].driver = Some(spec);
        let resolution = form.resolution.map(|step| range::above_zero(&at.key("resolution"), step));
        self.stacks[i].resolution = resolution.transpose()?;
        let (first, reach) = match command {
            Varying::Constant(value) => (value, (value, value)),
            Varying::Follows(signal) => {
                (ceramic::first(&self.scene, signal).value, ceramic::reach(&self.scene, signal))
            }
        };
        if let Some((low, high)) = spec.window {
            let [first, least, most] = [first, reach.0, reach.1].map(|value| value / spec.gain);
            let slack = ROUNDING * (high - low);
            let outside = |what: String| {
                let fault = actuator.key("voltage").fault(what).against_path(at.key("window").path());
                Err(fault.against(["waveforms"]).help("widen the window, or shift the waveform into it"))
            };
            let window = format!("the driver's window, {} V to {} V", range::short(low), range::short(high));
            if most < low - slack || least > high + slack {
                let (least, most) = (range::short(least), range::short(most));
                return outside(format!("expected voltages inside {window}, got {least} V to {most} V"));
            }
            if first < low - slack || first > high + slack {
                return outside(format!("expected a start inside {window}, got {} V", range::short(first)));
            }
        }
        let coupling = if form.reciprocal { Some(self.coupling(&at, i)?) } else { None };
        if let (Some(coupling), Control::Charge) = (coupling, spec.control) {
            // V = (Q - kαe)/(C(1 - κ)). The force k(αV - e) is that of a stack of stiffness k/(1 - κ) and free stroke αQ/C.
            self.scene.actuators[i].part.stiffness /= 1.0 - coupling;
        }
        let Varying::Follows(signal) = command else { return Ok(command) };
        let driver = Driver::new(spec, signal, reach);
        let driver = match self.scene.waveforms.get(signal) {
            Some(waveform) => driver.commanded_within(waveform.part.quickest()),
            None => driver,
        };
        let driver = match coupling.filter(|_| spec.control == Control::Voltage) {
            Some(coupling) => driver.reciprocal(coupling, self.elongation(i)),
            None => driver,
        };
        let place = self.scene.blocks.len();
        self.stacks[i].block = Some(place);
        self.scene.blocks.push(Named { name: self.stacks[i].name.clone(), part: driver.shared() });
        Ok(Varying::Follows(self.scene.waveforms.len() + place))
    }
}

impl Builder<'_> {
    /// Returns the coupling κ = kα²/C of a stack whose strain generates charge.
    fn coupling(&self, at: &At<'_>, i: usize) -> Result<f64, Fault> {
        let fault = |what: String| Err(at.key("reciprocal").fault(what));
        let ceramic = &self.stacks[i].ceramic;
        if !ceramic.idle && (ceramic.hysteresis.is_some() || ceramic.creep.is_some()) {
            return fault(
                "the charge due to strain is defined for a stack without hysteresis and creep".to_owned(),
            )
            .map_err(|fault| fault.help("leave it out, or use charge control"));
        }
        match self.stacks[i].stack.coupling() {
            Some(coupling) if coupling < 1.0 => Ok(coupling),
            coupling => {
                let coupling = range::short(coupling.unwrap_or(f64::NAN));
                fault(format!("expected kα²/C below 1, got {coupling}: the stack would generate energy"))
                    .map_err(|fault| fault.help("check stiffness, stroke per volt and capacitance"))
            }
        }
    }

    /// Returns the elongation of a stack as an input: second end minus first end.
    fn elongation(&self, i: usize) -> Input {
        let Actuator { between: [first, second], at: [near, far], direction, .. } =
            self.scene.actuators[i].part;
        Input::Length { between: [second, first], at: [far, near], direction }
    }
}

impl Piezo {
    /// Returns whether the charge due to strain acts on the driver, which then reads the elongation.
    pub fn is_reciprocal(&self, scene: &Scene) -> bool {
        self.inputs(scene)
            .is_some_and(|inputs| inputs.iter().any(|input| matches!(input, Input::Length { .. })))
    }

    /// Returns the range of the command, V, if the voltage window of the driver clips it; otherwise `None`.
    pub fn cut(&self, scene: &Scene) -> Option<(f64, f64)> {
        let spec = self.driver?;
        let (low, high) = spec.window?;
        // Input of the driver: the command or the output of the compensation.
        let &[Input::Signal(signal), ..] = self.inputs(scene)? else { return None };
        let (least, most) = ceramic::reach(scene, signal);
        let [least, most] = [least, most].map(|value| value / spec.gain);
        let slack = ROUNDING * (high - low);
        (least < low - slack || most > high + slack).then_some((least, most))
    }

    /// Returns the range of the command, V, or `None` if the stroke per volt is unknown.
    pub fn commanded(&self, scene: &Scene) -> Option<[f64; 2]> {
        let gain = self.stack.stroke_per_volt?;
        let (least, most) = match self.command {
            Varying::Constant(value) => (value, value),
            Varying::Follows(signal) => ceramic::reach(scene, signal),
        };
        Some([least / gain, most / gain])
    }

    /// Returns the range of commands, V, within the driver's window and the nominal voltage.
    pub fn allowed(&self) -> [f64; 2] {
        let (low, high) = self.window();
        let nominal = self.nominal.unwrap_or(f64::INFINITY);
        [low.max(BEYOND.0 * nominal), high.min(nominal)]
    }

    /// Returns the voltage window of the driver, V.
    fn window(&self) -> (f64, f64) {
        self.driver.and_then(|spec| spec.window).unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
    }

    /// Returns the inputs of the driver.
    fn inputs<'s>(&self, scene: &'s Scene) -> Option<&'s [Input]> {
        let block = scene.blocks.get(self.block?)?;
        self.driver.map(|_| block.part.0.inputs())
    }
}

/// Warns of a command that the window clips.
pub(super) fn cut(piezo: &Piezo, scene: &Scene) -> Option<Fault> {
    let (least, most) = piezo.cut(scene)?;
    let at = At::ROOT.key("actuators").key(&piezo.name).key("driver").key("window").path();
    let [least, most] = [least, most].map(range::short);
    let message = format!("the command from {least} V to {most} V is clipped at the ends of the window");
    Some(Fault::new(at, message).help("widen the window, or reduce the stroke"))
}

/// Warns of a clipped command beyond the voltage range of the data sheet.
pub(super) fn beyond(piezo: &Piezo, scene: &Scene) -> Option<Fault> {
    let nominal = piezo.nominal.filter(|_| piezo.by_voltage)?;
    let (low, high) = piezo.window();
    let [least, most] = piezo.commanded(scene)?.map(|voltage| voltage.clamp(low, high));
    let (lowest, highest) = (BEYOND.0 * nominal, BEYOND.1 * nominal);
    let slack = ROUNDING * nominal;
    if least >= lowest - slack && most <= highest + slack {
        return None;
    }
    let at = At::ROOT.key("actuators").key(&piezo.name).key("voltage").path();
    let [least, most, nominal, lowest, highest] = [least, most, nominal, lowest, highest].map(range::short);
    let message = format!("the command is {least} V to {most} V, but the data sheet is for {nominal} V");
    let help = format!("voltages below {lowest} V or above {highest} V may depolarise or break the stack");
    Some(Fault::new(at, message).help(help))
}

/// Warns of a damping ratio without a low-pass.
pub(super) fn idle_ratio(name: &str, form: &ActuatorForm) -> Option<Fault> {
    let driver = form.driver.as_ref()?;
    // The default value counts as not given.
    if driver.bandwidth.is_some() || driver.damping_ratio == FRAC_1_SQRT_2 {
        return None;
    }
    let at = At::ROOT.key("actuators").key(name).key("driver").key("damping_ratio").path();
    let fault = Fault::new(at, "a damping ratio needs a low-pass, but there is no \"bandwidth\"".to_owned());
    Some(fault.help("give the \"bandwidth\", or leave it out"))
}

/// Returns the checked data of a driver.
fn spec(at: &At<'_>, form: &DriverForm, (capacitance, gain): (f64, f64)) -> Result<Spec, Fault> {
    let window = match form.window {
        None => None,
        Some([low, high]) if low.si < high.si => Some((low.si, high.si)),
        Some([low, _]) => {
            let at = at.key("window");
            let fault = at.index(1).expected(format_args!("a voltage above {} V", range::short(low.si)));
            return Err(fault.against_path(at.path()).help("a window is [smallest, largest]"));
        }
    };
    let current = form.current.map(|current| range::above_zero(&at.key("current"), current)).transpose()?;
    let sink = form.sink_current.map(|sink| range::above_zero(&at.key("sink_current"), sink)).transpose()?;
    if let (None, Some(_)) = (current, sink) {
        let fault = at.missing("current").against_path(at.key("sink_current").path());
        return Err(fault.help("\"sink_current\" flows out of the stack, \"current\" flows into it"));
    }
    let resistance =
        form.resistance.map(|value| range::at_least_zero(&at.key("resistance"), value)).transpose()?;
    let bandwidth = form.bandwidth.map(|value| range::above_zero(&at.key("bandwidth"), value)).transpose()?;
    let ratio = range::number_between(&at.key("damping_ratio"), form.damping_ratio, RATIO.0, RATIO.1)?;
    let spec = Spec {
        capacitance,
        gain,
        window,
        current: current.map(|source| (sink.unwrap_or(source), source)),
        resistance: resistance.filter(|resistance| *resistance > 0.0),
        low: bandwidth.map(|frequency| Low { frequency, ratio }),
        control: match form.control {
            ControlForm::Voltage => Control::Voltage,
            ControlForm::Charge => Control::Charge,
        },
    };
    match spec.check() {
        Ok(()) => Ok(spec),
        Err(error) => Err(at.fault(error.to_string())),
    }
}
