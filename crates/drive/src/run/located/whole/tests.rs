//! Tests of block events during step doubling against closed forms.

use super::Detour;
use crate::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, SharedBlock, Standing, States,
};
use crate::run::advance::Advance;
use crate::run::horizon::Goal;
use crate::run::located::method::generally;
use crate::run::output::Opening;
use crate::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, NormalDamping, Point, Scene, Side,
    Varying,
};
use crate::{EventKind, Limits, Model, Plan, Sample, Shape, Source, Stepper, Timing, Trace, Waveform};
use std::sync::Arc;
use stickslip_contact::{Interface, Material, Pair, Profile};

const PERIOD: f64 = 1e-3;
const REACH: f64 = 1e-7;
/// Speed of the shuttle, m/s. It reverses at a quarter of the period and then every half period.
const SPEED: f64 = 4.0 * REACH / PERIOD;

/// Block whose state q moves back and forth between ±REACH at constant speed: law 0 forward, law 1 back.
#[derive(Debug)]
struct Shuttle {
    inputs: [Input; 1],
}

impl Component for Shuttle {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        States { scales: vec![REACH], integrals: 0 }
    }
    fn guards(&self, _: &usize) -> &[usize] {
        &[0]
    }
    fn guard(&self, _: usize, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> f64 {
        if *standing.law == 0 { REACH - at.states[0] } else { REACH + at.states[0] }
    }
    fn next(
        &self,
        _: usize,
        standing: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
    ) -> (EventKind, usize) {
        (EventKind::Own("turns"), 1 - *standing.law)
    }
    fn commit(&self, memory: &mut Vec<f64>, passage: &Passage) -> Result<f64, Refused> {
        memory[0] += passage.duration;
        Ok(0.0)
    }
    fn energy(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        0.0
    }
    fn columns(&self) -> Vec<&'static str> {
        Vec::new()
    }
}

impl Block for Shuttle {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }
    fn start(&self, _: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        (vec![0.0], vec![0.0])
    }
    fn slopes(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        _: &mut [f64],
    ) -> Powers {
        slopes[0] = if *standing.law == 0 { SPEED } else { -SPEED };
        Powers::default()
    }
    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample {
        let rate = if *standing.law == 0 { SPEED } else { -SPEED };
        Sample { value: at.states[0], rate, acceleration: 0.0 }
    }
    fn range(&self, _: &[(f64, f64)]) -> (f64, f64) {
        (-REACH, REACH)
    }
    fn guard_scale(&self, _: usize) -> f64 {
        REACH
    }
    fn rate(&self) -> f64 {
        1.0 / PERIOD
    }
    fn fill(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>, _: &mut Vec<f64>) {}
}

fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

/// Returns a slider on a foot that follows the shuttle, pressed by a load in N, with a kinetic coefficient as a share of the static one.
fn scene(load: f64, kinetic: f64) -> Option<Scene> {
    let steel = Pair::new(Material::new(210e9, 0.3).ok()?, Material::new(210e9, 0.3).ok()?);
    let interface = Interface::new(steel, Profile::paraboloid(1e-3).ok()?, 0.15).ok()?;
    let interface = interface.with_kinetic_friction(0.15 * kinetic).ok()?;
    let contact = Contact {
        between: [Side::Body(0), Side::Body(1)],
        at: [Point::default(); 2],
        interface,
        normal: Normal::Force(Varying::Constant(load)),
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    let shape = Shape::Sine { amplitude: REACH, phase: 0.0, offset: 0.0 };
    Some(Scene {
        waveforms: vec![named("read", Waveform::new(shape, Timing::every(PERIOD)).ok()?)],
        blocks: vec![named("shuttle", SharedBlock(Arc::new(Shuttle { inputs: [Input::Signal(0)] })))],
        bodies: vec![
            named("foot", Body { x: Coordinate::follows(1), ..Body::default() }),
            named("slider", Body { mass: Some(0.02), x: Coordinate::FREE, ..Body::default() }),
        ],
        contacts: vec![named("ball", contact)],
        ..Scene::default()
    })
}

/// Returns the final position of the slider, m, and the reversal times of the shuttle, s. `whole` selects step doubling.
fn run(model: &Model, whole: bool) -> Option<(f64, Vec<f64>)> {
    let limits = Limits { steps: 1_000_000, events: u64::MAX, wall: None };
    let stepper = Stepper::Event { tolerance: 1e-8 };
    let plan = Plan { duration: 3.1 * PERIOD, stepper, limits, every: None, until_steady: None };
    let (mut state, mut trace) = (model.start(&plan).ok()?, Trace::new(model));
    let mut run = generally(model, &plan, 1e-8);
    run.set_out(&mut state, Opening::Row, &mut trace);
    run.go(&mut state, Goal::Past(1e-9), &mut trace).ok()?;
    if whole {
        run.settle_books(&mut state);
        run.detour = Some(Detour { end: f64::MAX, length: PERIOD / 64.0, step: 1e-4 * PERIOD });
        run.take_whole(&mut state);
    }
    run.go(&mut state, Goal::End(plan.duration), &mut trace).ok()?;
    let own = trace.events().filter(|(event, _)| event.source == Source::Block(0));
    Some((state.body(model, 1)?.0, own.map(|(event, _)| event.t).collect()))
}

#[test]
fn a_block_turns_on_a_detour_when_it_should() {
    for load in (0..12).map(|n| 1.0 + 1e-4 * f64::from(n)) {
        let model = scene(load, 1.0).and_then(|scene| Model::new(&scene).ok());
        let both = model.as_ref().map(|model| [false, true].map(|whole| run(model, whole)));
        let Some([Some((located, _)), Some((place, turns))]) = both else { panic!("both end") };
        assert_eq!(turns.len(), 6, "{turns:?}");
        for (n, t) in turns.into_iter().enumerate() {
            let exact = (0.25 + 0.5 * n as f64) * PERIOD;
            assert!((t - exact).abs() < 1e-11 * PERIOD, "{n}: {t:e} {exact:e}");
        }
        assert!((place - located).abs() < 1e-4 * REACH, "{load}: {place:e} {located:e}");
    }
}

/// The force jumps where a contact breaks loose, so that no step across the jump agrees with its halves: short ones are accepted.
#[test]
fn a_contact_breaks_loose_on_a_detour() {
    let model = scene(1.0, 0.7).and_then(|scene| Model::new(&scene).ok());
    let both = model.as_ref().map(|model| [false, true].map(|whole| run(model, whole)));
    let Some([Some((located, _)), Some((place, _))]) = both else { panic!("both end") };
    assert!(located.abs() > 0.1 * REACH && (place - located).abs() < 1e-3 * REACH, "{place:e} {located:e}");
}
