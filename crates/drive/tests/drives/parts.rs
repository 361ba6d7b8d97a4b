//! Construction of models and plans, and runs that must succeed.

use stickslip_contact::{Interface, Material, Memory, Pair, Profile};
use stickslip_drive::scene::{
    Actuator, Body, Contact, ContactStart, Coordinate, Direction, EngineChoice, Load, Named, Normal,
    NormalDamping, Point, Scene, Side, Spring, Varying,
};
use stickslip_drive::{
    Due, Entry, Limits, Model, Moments, Plan, Record, RunError, Schedule, Shape, State, Stepper, Timing,
    Trace, Wants, Waveform, run,
};

pub(crate) fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

pub(crate) fn wave(name: &str, shape: Shape, period: f64) -> Named<Waveform> {
    named(name, Waveform::new(shape, Timing::every(period)).unwrap())
}

pub(crate) fn sine(amplitude: f64) -> Shape {
    Shape::Sine { amplitude, phase: 0.0, offset: 0.0 }
}

pub(crate) fn follower(waveform: usize) -> Body {
    Body { x: Coordinate::follows(waveform), ..Body::default() }
}

pub(crate) fn free(mass: f64) -> Body {
    Body { mass: Some(mass), x: Coordinate::FREE, ..Body::default() }
}

/// Steel on steel: E = 210 GPa, ν = 0.3.
pub(crate) fn steel() -> Pair {
    let steel = Material::new(210e9, 0.3).unwrap();
    Pair::new(steel, steel)
}

/// One contact under a constant normal force (N).
pub(crate) fn contact(between: [Side; 2], profile: Profile, friction: f64, force: f64) -> Contact {
    Contact {
        between,
        at: [Point::default(); 2],
        interface: Interface::new(steel(), profile, friction).unwrap(),
        normal: Normal::Force(Varying::Constant(force)),
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    }
}

/// The contact between bodies of other moduli.
pub(crate) fn of_pair(pair: Pair, contact: &Contact) -> Contact {
    let old = &contact.interface;
    let interface = Interface::new(pair, old.profile().clone(), old.friction()).unwrap();
    Contact { interface, ..contact.clone() }
}

/// The contact with another profile.
pub(crate) fn of_profile(profile: Profile, contact: &Contact) -> Contact {
    let old = &contact.interface;
    let interface = Interface::new(old.pair(), profile, old.friction()).unwrap();
    Contact { interface, ..contact.clone() }
}

/// The contact with another coefficient of friction.
pub(crate) fn of_friction(friction: f64, contact: &Contact) -> Contact {
    let old = &contact.interface;
    let interface = Interface::new(old.pair(), old.profile().clone(), friction).unwrap();
    Contact { interface, ..contact.clone() }
}

/// The same contact with a damping time β, s.
pub(crate) fn damped(contact: &Contact, beta: f64) -> Contact {
    Contact { interface: contact.interface.clone().with_damping(beta), ..contact.clone() }
}

pub(crate) fn damper(between: [Side; 2], damping: f64) -> Spring {
    let at = [Point::default(); 2];
    Spring { between, at, direction: Direction::X, stiffness: 0.0, damping, preload: 0.0 }
}

/// An undamped actuator along x.
pub(crate) fn piezo(between: [Side; 2], stiffness: f64, stroke: Varying) -> Actuator {
    let at = [Point::default(); 2];
    Actuator { between, at, direction: Direction::X, stiffness, damping: 0.0, stroke }
}

/// A constant force (N) on a body.
pub(crate) fn push(on: usize, force: f64) -> Load {
    Load { on, x: Varying::Constant(force), ..Load::default() }
}

/// A foot that follows `shape` carries a free slider on one contact: bodies 0 and 1, contact 0.
pub(crate) fn foot_and_slider(drive: Named<Waveform>, mass: f64, contact: Contact) -> Scene {
    Scene {
        waveforms: vec![drive],
        bodies: vec![named("foot", follower(0)), named("slider", free(mass))],
        contacts: vec![named("ball", contact)],
        ..Scene::default()
    }
}

pub(crate) const FOOT_SLIDER: [Side; 2] = [Side::Body(0), Side::Body(1)];

/// P1, the benchmark drive of `tests/data/drive_p1.json`.
pub(crate) fn p1() -> Scene {
    let sawtooth = wave("drive", Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 }, 1e-3);
    foot_and_slider(sawtooth, 0.02, contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0))
}

/// Plan with limits that prevent endless tests.
pub(crate) fn plan(stepper: Stepper, duration: f64) -> Plan {
    let limits = Limits { steps: 20_000_000, events: 1_000_000, wall: Some(120.0) };
    Plan { duration, stepper, limits, every: None, until_steady: None }
}

pub(crate) fn event(tolerance: f64, duration: f64) -> Plan {
    let limits = Limits { steps: 1_000_000, events: 100_000, wall: Some(120.0) };
    Plan { limits, ..plan(Stepper::Event { tolerance }, duration) }
}

/// Record that samples contact memories at its own times and keeps them with the rows.
pub(crate) struct Looker {
    schedule: Schedule,
    pub(crate) seen: Vec<(f64, Vec<Memory>)>,
    pub(crate) rows: Vec<Vec<f64>>,
}

impl Looker {
    pub(crate) fn new(moments: Moments, plan: &Plan) -> Self {
        Self { schedule: Schedule::new(moments, 0.0, plan.duration), seen: Vec::new(), rows: Vec::new() }
    }
}

impl Record for Looker {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => self.rows.push(values.to_vec()),
            Entry::Look(t, memories) => self.seen.push((t, memories.to_vec())),
            _ => {}
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => {
                let due = self.schedule.due();
                self.schedule.advance();
                Some(due)
            }
            Due::Mark => None,
        }
    }
}

/// Runs a model and samples its contact memories.
pub(crate) fn look(scene: &Scene, plan: &Plan, moments: Moments) -> (Model, State, Looker) {
    let model = Model::new(scene).unwrap();
    let mut state = model.start(plan).unwrap();
    let mut looker = Looker::new(moments, plan);
    run(&model, plan, &mut state, &mut looker).unwrap();
    (model, state, looker)
}

/// Runs a model from its start to the end of the plan.
pub(crate) fn try_end(scene: &Scene, plan: &Plan) -> Result<(Model, State), RunError> {
    let model = Model::new(scene).unwrap();
    let mut state = model.start(plan).unwrap();
    run(&model, plan, &mut state, &mut ()).map(|()| (model, state))
}

pub(crate) fn end(scene: &Scene, plan: &Plan) -> (Model, State) {
    try_end(scene, plan).unwrap()
}

/// Runs a model and keeps events, and rows every `every` s.
pub(crate) fn trace(scene: &Scene, plan: &Plan, every: f64) -> (Model, State, Trace) {
    let model = Model::new(scene).unwrap();
    let plan = Plan { every: Some(every), ..*plan };
    let mut state = model.start(&plan).unwrap();
    let mut trace = Trace::new(&model);
    run(&model, &plan, &mut state, &mut trace).unwrap();
    (model, state, trace)
}

/// Index of a channel in a row.
pub(crate) fn channel(model: &Model, name: &str) -> usize {
    model.channels().iter().position(|c| c.name == name).unwrap()
}

/// Values of a channel.
pub(crate) fn column(model: &Model, trace: &Trace, name: &str) -> Vec<f64> {
    trace.column(channel(model, name)).collect()
}

/// Order p of errors proportional to hᵖ: slope of the regression line of logarithms.
pub(crate) fn fitted_order(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(h, e)| (h.ln(), e.ln())).collect();
    let n = logs.len() as f64;
    let (x, y) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let (xy, xx) =
        logs.iter().fold((0.0, 0.0), |(xy, xx), p| (xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x).powi(2)));
    xy / xx
}
