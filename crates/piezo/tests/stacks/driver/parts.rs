//! Models in which a foot follows a driver and carries a slider.

use crate::parts;
pub(crate) use crate::parts::{every, named, plan};
use stickslip_drive::scene::Scene;
use stickslip_drive::{Event, Model, Plan, Source, State, Stepper, Trace, Waveform};
use stickslip_piezo::Figures;
use stickslip_piezo::driver::{Control, Driver, Low, Spec};

/// Stroke per volt α, m/V, and capacitance, F, of the stacks.
pub(crate) const GAIN: f64 = 10e-9;
pub(crate) const FARADS: f64 = 1e-6;

/// Driver without limits.
pub(crate) fn ideal() -> Spec {
    Spec {
        capacitance: FARADS,
        gain: GAIN,
        window: None,
        current: None,
        resistance: None,
        low: None,
        control: Control::Voltage,
    }
}

pub(crate) fn low(frequency: f64, ratio: f64) -> Spec {
    Spec { low: Some(Low { frequency, ratio }), ..ideal() }
}

/// Table of (ms, V).
pub(crate) fn table(points: &[(f64, f64)]) -> Waveform {
    parts::table(points, GAIN)
}

/// Model in which the foot follows a driver.
pub(crate) fn scene(command: Waveform, spec: Spec) -> Scene {
    let range = command.range();
    parts::scene(command, vec![named("stack", Driver::new(spec, 0, range).shared())])
}

pub(crate) fn event(tolerance: f64, duration: f64) -> Plan {
    plan(Stepper::Event { tolerance }, duration)
}

pub(crate) struct Ran {
    pub(crate) model: Model,
    pub(crate) state: State,
    trace: Trace,
}

impl Ran {
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        parts::column(&self.model, &self.trace, name)
    }

    /// Results of the driver.
    pub(crate) fn figures(&self, spec: &Spec) -> Figures {
        Figures::of(self.state.block_memory(0).unwrap(), spec).unwrap()
    }

    /// Times and voltages.
    pub(crate) fn volts(&self) -> Vec<(f64, f64)> {
        self.column("time_s").into_iter().zip(self.column("stack.voltage_V")).collect()
    }

    /// Events of the driver.
    pub(crate) fn events(&self) -> Vec<(f64, &'static str)> {
        let own = |event: &Event| event.source == Source::Block(0);
        let events = self.trace.events().map(|(event, _)| *event);
        events.filter(own).map(|event| (event.t, event.kind.name())).collect()
    }

    /// Largest difference of the voltages from a closed form.
    pub(crate) fn worst(&self, exact: impl Fn(f64) -> f64) -> f64 {
        let misses = self.volts().into_iter().map(|(t, volts)| (volts - exact(t)).abs());
        misses.fold(0.0, f64::max)
    }
}

pub(crate) fn ran(scene: &Scene, plan: &Plan, every: f64) -> Ran {
    let (model, state, trace) = parts::trace(scene, plan, every);
    Ran { model, state, trace }
}
