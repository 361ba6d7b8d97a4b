//! Scenes in which a foot follows a driver and carries a slider.

use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_drive::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, Point, Scene, Side, Varying,
};
use stickslip_drive::{
    Event, Limits, Model, Plan, Shape, Source, State, Stepper, Timing, Trace, Waveform, run,
};
use stickslip_piezo::Figures;
use stickslip_piezo::driver::{Control, Driver, Low, Spec};

/// α of these stacks, m/V, and their capacitance, F.
pub(crate) const GAIN: f64 = 10e-9;
pub(crate) const FARADS: f64 = 1e-6;

pub(crate) fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

/// A driver without limits.
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

/// A table of (ms, V), straight in between; two values at one time are a jump.
pub(crate) fn table(points: &[(f64, f64)]) -> Waveform {
    let points = points.iter().map(|(t, v)| (1e-3 * t, GAIN * v)).collect();
    Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap()
}

/// A periodic command, 1 ms, of a shape in metres.
pub(crate) fn every(shape: Shape) -> Waveform {
    Waveform::new(shape, Timing::every(1e-3)).unwrap()
}

pub(crate) fn scene(command: Waveform, spec: Spec) -> Scene {
    let steel = Material::new(210e9, 0.3).unwrap();
    let pair = Pair::new(steel, steel);
    let ball = Contact {
        between: [Side::Body(0), Side::Body(1)],
        at: [Point::default(); 2],
        interface: Interface::new(pair, Profile::paraboloid(1e-3).unwrap(), 0.15).unwrap(),
        normal: Normal::Force(Varying::Constant(1.0)),
        gap: 0.0,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    let range = command.range();
    Scene {
        waveforms: vec![named("drive", command)],
        blocks: vec![named("stack", Driver::new(spec, 0, range).shared())],
        bodies: vec![
            named("foot", Body { x: Coordinate::follows(1), ..Body::default() }),
            named("slider", Body { mass: Some(0.02), x: Coordinate::FREE, ..Body::default() }),
        ],
        contacts: vec![named("ball", ball)],
        ..Scene::default()
    }
}

pub(crate) fn plan(stepper: Stepper, duration: f64) -> Plan {
    let limits = Limits { steps: 5_000_000, events: 1_000_000, wall: Some(60.0) };
    Plan { duration, stepper, limits, every: None, until_steady: None }
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
        let place = self.model.channels().iter().position(|channel| channel.name == name).unwrap();
        self.trace.column(place).collect()
    }

    /// What the driver says it has done.
    pub(crate) fn figures(&self, spec: &Spec) -> Figures {
        Figures::of(self.state.block_memory(0).unwrap(), spec).unwrap()
    }

    /// Times and voltages.
    pub(crate) fn volts(&self) -> Vec<(f64, f64)> {
        self.column("time_s").into_iter().zip(self.column("stack.voltage_V")).collect()
    }

    /// The driver's own events.
    pub(crate) fn events(&self) -> Vec<(f64, &'static str)> {
        let own = |event: &Event| event.source == Source::Block(0);
        let events = self.trace.events().map(|(event, _)| *event);
        events.filter(own).map(|event| (event.t, event.kind.name())).collect()
    }

    /// Farthest of the voltages from a closed form.
    pub(crate) fn worst(&self, exact: impl Fn(f64) -> f64) -> f64 {
        let misses = self.volts().into_iter().map(|(t, volts)| (volts - exact(t)).abs());
        misses.fold(0.0, f64::max)
    }
}

pub(crate) fn ran(scene: &Scene, plan: &Plan, every: f64) -> Ran {
    let model = Model::new(scene).unwrap();
    let plan = Plan { every: Some(every), ..*plan };
    let mut state = model.start(&plan).unwrap();
    let mut trace = Trace::new(&model);
    run(&model, &plan, &mut state, &mut trace).unwrap();
    Ran { model, state, trace }
}
