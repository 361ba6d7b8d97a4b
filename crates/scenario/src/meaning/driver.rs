//! Driver electronics of a stack.

use super::{Builder, Piezo, ceramic, range};
use crate::fault::Fault;
use crate::form::{ControlForm, DriverForm};
use crate::path::At;
use stickslip_drive::scene::{Named, Scene, Varying};
use stickslip_piezo::driver::{Control, Driver, Low, Spec};

/// Damping ratios of a low-pass.
const RATIO: (f64, f64) = (0.05, 10.0);
/// How far beyond an end of the window a voltage may start, as a part of the window: rounding of what it is made of.
const ROUNDING: f64 = 1e-9;

impl Builder<'_> {
    /// The driver of an actuator as a block after its command, and the signal that it makes. A constant command is a voltage that
    /// has settled.
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
            return Err(fault
                .against_path(at.path())
                .help("a driver charges it: such as \"7.2 uF\", as the data sheet says"));
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
        let Varying::Follows(signal) = command else { return Ok(command) };
        let driver = Driver::new(spec, signal, reach).shared();
        let place = self.scene.blocks.len();
        self.stacks[i].block = Some(place);
        self.scene.blocks.push(Named { name: self.stacks[i].name.clone(), part: driver });
        Ok(Varying::Follows(self.scene.waveforms.len() + place))
    }
}

/// Says of a command that the window cuts it.
pub(super) fn cut(piezo: &Piezo, scene: &Scene) -> Option<Fault> {
    let (spec, Varying::Follows(waveform)) = (piezo.driver?, piezo.command) else { return None };
    let (low, high) = spec.window?;
    let (least, most) = scene.waveforms.get(waveform)?.part.range();
    let [least, most] = [least, most].map(|value| value / spec.gain);
    let slack = ROUNDING * (high - low);
    if least >= low - slack && most <= high + slack {
        return None;
    }
    let at = At::ROOT.key("actuators").key(&piezo.name).key("driver").key("window").path();
    let [least, most] = [least, most].map(range::short);
    let message = format!("the command goes from {least} V to {most} V and is cut at the ends of the window");
    Some(Fault::new(at, message).help("widen the window, or take a smaller stroke"))
}

/// What a driver can do, checked.
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
        return Err(fault.help("\"sink_current\" is that out of the stack, \"current\" that into it"));
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
