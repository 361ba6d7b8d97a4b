//! A component of the test: a first-order lag with a limited rate between a waveform and a body. It has a state, an event
//! function (saturation), three laws and an energy.

use crate::parts::{FOOT_SLIDER, column, contact, event, follower, free, named, plan, trace, wave};
use std::sync::Arc;
use stickslip_contact::Profile;
use stickslip_drive::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, SharedBlock, Standing, States,
};
use stickslip_drive::scene::{Direction, Point, Scene, Side};
use stickslip_drive::{EventKind, Field, Method, Model, Part, Sample, Shape, Source, Stepper};

/// q̇ = (w - q)/τ with a limit: a spring of stiffness k loaded through a damper kτ.
#[derive(Debug)]
struct Lag {
    /// Time constant τ, s.
    time: f64,
    /// Largest |q̇|, m/s.
    limit: f64,
    /// Stiffness k, N/m.
    stiffness: f64,
    inputs: [Input; 1],
}

/// Laws: linear, or at the limit forward or backward.
const LINEAR: usize = 0;
const FORWARD: usize = 1;
const BACKWARD: usize = 2;

impl Lag {
    fn wish(&self, at: &Moment<'_, [Sample]>) -> f64 {
        (at.inputs[0].value - at.states[0]) / self.time
    }

    fn rate(&self, law: usize, at: &Moment<'_, [Sample]>) -> f64 {
        [self.wish(at), self.limit, -self.limit][law]
    }
}

impl Component for Lag {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        States { scales: vec![1e-8], integrals: 0 }
    }

    fn guards(&self, law: &usize) -> &[usize] {
        [&[FORWARD, BACKWARD][..], &[LINEAR], &[LINEAR]][*law]
    }

    /// Event functions are numbered by the law that they lead to.
    fn guard(&self, guard: usize, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> f64 {
        let wish = self.wish(at);
        match (*standing.law, guard) {
            (LINEAR, FORWARD) => self.limit - wish,
            (LINEAR, _) => self.limit + wish,
            (FORWARD, _) => wish - self.limit,
            _ => -wish - self.limit,
        }
    }

    fn next(
        &self,
        guard: usize,
        _: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
    ) -> (EventKind, usize) {
        (EventKind::Own(if guard == LINEAR { "follows" } else { "saturates" }), guard)
    }

    /// Adds up the path of its state, to show that the memory is updated once per accepted step.
    fn commit(&self, memory: &mut Vec<f64>, passage: &Passage) -> Result<f64, Refused> {
        let [last, way] = memory[..] else { return Err(Refused("a memory of another kind".to_owned())) };
        memory.copy_from_slice(&[passage.states[0], way + (passage.states[0] - last).abs()]);
        Ok(0.0)
    }

    fn energy(&self, _: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> f64 {
        0.5 * self.stiffness * at.states[0].powi(2)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["q_m", "slip_path_m"]
    }
}

impl Block for Lag {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        (vec![inputs[0].value], vec![inputs[0].value, 0.0])
    }

    fn slopes(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        _: &mut [f64],
    ) -> Powers {
        let rate = self.rate(*standing.law, at);
        slopes[0] = rate;
        // Power k w of the source; the spring stores k q, damper and limiter dissipate the rest.
        let (w, q) = (at.inputs[0].value, at.states[0]);
        Powers { input: self.stiffness * w * rate, loss: self.stiffness * (w - q) * rate }
    }

    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample {
        let rate = self.rate(*standing.law, at);
        let acceleration = if *standing.law == LINEAR { (at.inputs[0].rate - rate) / self.time } else { 0.0 };
        Sample { value: at.states[0], rate, acceleration }
    }

    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64) {
        inputs[0]
    }

    fn guard_scale(&self, _: usize) -> f64 {
        self.limit
    }

    fn rate(&self) -> f64 {
        1.0 / self.time
    }

    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>) {
        row.extend([at.states[0], standing.memory[1]]);
    }
}

const PERIOD: f64 = 4e-3;
const STROKE: f64 = 0.4e-6;
const TIME: f64 = 0.2e-3;
/// Velocities of the triangle and of the limit, m/s.
const SPEED: f64 = 2.0 * STROKE / PERIOD;
const LIMIT: f64 = 0.6 * SPEED;

/// Slider on a foot that follows a triangle through the lag.
fn scene(limit: f64) -> Scene {
    let lag = Lag { time: TIME, limit, stiffness: 1e5, inputs: [Input::Signal(0)] };
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    Scene {
        waveforms: vec![wave("triangle", Shape::Triangle { stroke: STROKE }, PERIOD)],
        blocks: vec![named("lag", SharedBlock(Arc::new(lag)))],
        // Signal after the only waveform.
        bodies: vec![named("foot", follower(1)), named("slider", free(0.02))],
        contacts: vec![named("ball", ball)],
        ..Scene::default()
    }
}

/// Closed form: on a ramp q = v(t - τ(1 - e^{-t/τ})) until v(1 - e^{-t/τ}) reaches the limit r. Then q grows at r until (w - q)/τ
/// = r again after the reversal at T/2.
#[test]
fn its_saturation_is_an_event_at_the_time_of_the_closed_form() {
    let (model, state, trace) = trace(&scene(LIMIT), &event(1e-10, 0.75 * PERIOD), 1e-5);
    let saturates = -TIME * (1.0 - LIMIT / SPEED).ln();
    let q1 = SPEED * (saturates - TIME * (1.0 - (-saturates / TIME).exp()));
    // w = 2S - vt (S the stroke) behind the peak: 2S - vt - q₁ - r(t - t₁) = rτ.
    let follows = (2.0 * STROKE - q1 + LIMIT * saturates - LIMIT * TIME) / (SPEED + LIMIT);
    let own: Vec<_> =
        trace.events().map(|(event, _)| *event).filter(|e| e.source == Source::Block(0)).collect();
    let kinds: Vec<&str> = own.iter().map(|event| event.kind.name()).collect();
    assert_eq!(kinds[..2], ["saturates", "follows"], "{own:?}");
    assert!((own[0].t - saturates).abs() < 1e-9 * PERIOD, "{} {saturates}", own[0].t);
    assert!((own[1].t - follows).abs() < 1e-9 * PERIOD, "{} {follows}", own[1].t);
    assert_eq!(model.source_name(own[0].source, |_| String::new()), "lag");
    // Before and in between, the foot follows the closed form.
    let (t, foot) = (column(&model, &trace, "time_s"), column(&model, &trace, "foot.x_m"));
    for (t, foot) in t.into_iter().zip(foot).filter(|(t, _)| *t <= follows) {
        let exact = if t < saturates {
            SPEED * (t - TIME * (1.0 - (-t / TIME).exp()))
        } else {
            q1 + LIMIT * (t - saturates)
        };
        assert!((foot - exact).abs() < 1e-10 * STROKE, "{t}: {foot} {exact}");
    }
    // Steps use Dormand–Prince; there is no closed form.
    assert!(state.tally().steps(Method::DormandPrince) > 0 && state.tally().steps(Method::Swing) == 0);
    let expected =
        model.expected(&model.start(&event(1e-10, PERIOD)).unwrap(), Stepper::Event { tolerance: 1e-10 });
    assert!(expected.takes(Method::DormandPrince) && !expected.takes(Method::Swing));
}

/// The energy balance closes with the lag, and its memory equals the path of the state.
#[test]
fn its_energy_is_in_the_books_and_its_memory_moves_once_per_step() {
    let (model, _, trace) = trace(&scene(LIMIT), &event(1e-10, 2.0 * PERIOD), 2e-5);
    let (error, input) = (column(&model, &trace, "energy.error_J"), column(&model, &trace, "energy.input_J"));
    let through = input.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let elastic = column(&model, &trace, "energy.elastic_J");
    let stored = elastic.iter().fold(0.0, |most: f64, x| most.max(*x));
    assert!(stored > 0.5 * 1e5 * (0.5 * STROKE).powi(2), "the lag's spring is in the books: {stored}");
    let open = error.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(open < 1e-8 * through, "{open} of {through}");
    let q = column(&model, &trace, "lag.q_m");
    let gone: f64 = q.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    // The path between rows is longer than their difference. In a row the memory is that of the start of the step.
    let way = model.channels().iter().position(|channel| channel.name == "lag.slip_path_m").unwrap();
    let (end, values) = trace.events().last().unwrap();
    assert_eq!(end.t, 2.0 * PERIOD);
    let last = &values[way];
    assert!((gone - last).abs() < 1e-3 * last, "{gone} {last}");
}

/// Comparison with the classical Runge–Kutta method, extrapolated.
#[test]
fn runs_without_events_agree() {
    let end = |plan: &_| {
        let (model, state, _) = trace(&scene(LIMIT), plan, 1.0);
        state.body(&model, 1).unwrap().0
    };
    let located = end(&event(1e-11, PERIOD));
    let stepped = end(&plan(Stepper::Rk4 { step: 20e-9 }, PERIOD));
    let verlet = end(&plan(Stepper::Verlet { step: 20e-9 }, PERIOD));
    assert!((stepped - located).abs() < 2e-5 * STROKE, "{stepped} {located}");
    assert!((verlet - located).abs() < 2e-5 * STROKE, "{verlet} {located}");
}

/// A block may exert forces: a dashpot between ground and slider equals a damper of the model.
#[test]
fn a_block_between_bodies_pushes_like_a_damper_of_the_scene() {
    let mut own = scene(f64::INFINITY);
    let between = [Side::Ground, Side::Body(1)];
    own.springs = vec![named("dashpot", crate::parts::damper(between, 0.5))];
    let mut brought = scene(f64::INFINITY);
    let input = Input::Length { between, at: [Point::default(); 2], direction: Direction::X };
    brought.blocks.push(named("dashpot", SharedBlock(Arc::new(Dashpot { damping: 0.5, inputs: [input] }))));
    let end = |scene: &Scene| {
        let (model, state, trace) = trace(scene, &event(1e-11, PERIOD), PERIOD);
        let damping = column(&model, &trace, "energy.damping_J").pop().unwrap();
        (state.body(&model, 1).unwrap().0, damping)
    };
    let ((x, lost), (x_own, lost_own)) = (end(&brought), end(&own));
    assert!((x - x_own).abs() < 1e-9 * STROKE, "{x} {x_own}");
    assert!((lost - lost_own).abs() < 1e-8 * lost_own, "{lost} {lost_own}");
}

#[test]
fn a_signal_that_is_not_there_is_refused() {
    let mut scene = scene(LIMIT);
    scene.bodies[0].part = follower(2);
    let error = Model::new(&scene).unwrap_err();
    assert_eq!(
        (error.part, error.field),
        (Part::Body(0), Field::Coordinate(stickslip_drive::scene::Axis::X))
    );
}

/// F = c ė between its sides; e is the length that it reads.
#[derive(Debug)]
struct Dashpot {
    damping: f64,
    inputs: [Input; 1],
}

impl Component for Dashpot {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        States::default()
    }
    fn guards(&self, _: &usize) -> &[usize] {
        &[]
    }
    fn guard(&self, _: usize, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        f64::INFINITY
    }
    fn next(
        &self,
        _: usize,
        standing: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
    ) -> (EventKind, usize) {
        (EventKind::Own("never"), *standing.law)
    }
    fn commit(&self, _: &mut Vec<f64>, _: &Passage) -> Result<f64, Refused> {
        Ok(0.0)
    }
    fn energy(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        0.0
    }
    fn columns(&self) -> Vec<&'static str> {
        Vec::new()
    }
}

impl Block for Dashpot {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }
    fn start(&self, _: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        (Vec::new(), Vec::new())
    }
    fn slopes(
        &self,
        _: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        _: &mut [f64],
        efforts: &mut [f64],
    ) -> Powers {
        efforts[0] = -self.damping * at.inputs[0].rate;
        Powers { input: 0.0, loss: self.damping * at.inputs[0].rate.powi(2) }
    }
    fn signal(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> Sample {
        Sample { value: 0.0, rate: 0.0, acceleration: 0.0 }
    }
    fn range(&self, _: &[(f64, f64)]) -> (f64, f64) {
        (0.0, 0.0)
    }
    fn guard_scale(&self, _: usize) -> f64 {
        1.0
    }
    fn rate(&self) -> f64 {
        1.0
    }
    fn fill(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>, _: &mut Vec<f64>) {}
}
