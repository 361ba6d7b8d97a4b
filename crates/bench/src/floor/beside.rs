//! The floor beside the program, for scenes that are the benchmark drive with other numbers.

use super::{Floor, Rule};
use crate::clock::Stopwatch;
use crate::instructions::Counted;
use crate::problem::Problem;
use crate::request::Request;
use std::hint::black_box;
use std::path::Path;
use stickslip_drive::scene::{Freedom, Normal, Varying};
use stickslip_drive::{Model, Scene, Shape};

/// Turns that the least code is timed in, and runs of each.
const TURNS: u32 = 15;
const RUNS: u32 = 50;
/// Periods closer to a whole number are one.
const WHOLE: f64 = 1e-9;

/// What the least code takes with so many nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Beside {
    pub(crate) nodes: u32,
    /// At the end, in parts of the norm.
    pub(crate) error: f64,
    /// Processor time of a run, s.
    pub(crate) time: f64,
    pub(crate) instructions: Option<u64>,
}

impl Floor {
    /// The floor of a scene, and the periods that it runs; none of scenes that are no slider on one paraboloid under a constant load
    /// on a foot that follows a sawtooth.
    pub(crate) fn of(scene: &Scene, model: &Model, duration: f64) -> Option<(Self, u32)> {
        let [waveform] = &scene.waveforms[..] else { return None };
        let [contact] = &scene.contacts[..] else { return None };
        let Shape::Sawtooth { stroke, flyback } = *waveform.part.shape() else { return None };
        let timing = *waveform.part.timing();
        let mut free = scene.bodies.iter().filter(|body| body.part.is_free());
        let (slider, None) = (free.next()?, free.next()) else { return None };
        let is_bare = scene.springs.is_empty()
            && scene.actuators.is_empty()
            && scene.loads.is_empty()
            && scene.blocks.is_empty()
            && contact.part.interface.damping() == 0.0
            && scene.gravity.acceleration == 0.0
            && (timing.delay, timing.phase, timing.cycles) == (0.0, 0.0, None)
            && matches!(contact.part.normal, Normal::Force(Varying::Constant(_)))
            && contact.part.interface.profile().exponent() == Some(2.0)
            && slider.part.x.freedom == Freedom::Free
            && (slider.part.x.position, slider.part.x.velocity) == (0.0, 0.0);
        let periods = duration / timing.period;
        if !is_bare || (periods - periods.round()).abs() > WHOLE * periods {
            return None;
        }
        let natural = model.contact_natural(0)?;
        let floor = Self {
            mass: slider.part.mass?,
            limit: natural.force * f64::from(contact.part.count),
            length: natural.displacement,
            stroke,
            period: timing.period,
            flyback,
        };
        Some((floor, periods.round() as u32))
    }
}

impl Beside {
    /// The floor of a problem with 4, 10 and 16 nodes; none of scenes that have no floor.
    pub(crate) fn all(problem: &Problem, file: &Path, request: &Request) -> Vec<Self> {
        let Some(of) = Floor::of(&problem.scene, &problem.model, problem.duration) else {
            return Vec::new();
        };
        let mut all =
            vec![Self::new::<4>(problem, &of), Self::new::<10>(problem, &of), Self::new::<16>(problem, &of)];
        for own in all.iter_mut().filter(|_| request.instructions) {
            own.instructions = Counted::Floor(own.nodes).instructions(file, &request.set);
        }
        all
    }

    /// With N nodes; its instructions are not counted yet.
    fn new<const N: usize>(problem: &Problem, (floor, periods): &(Floor, u32)) -> Self {
        let rule = Rule::<N>::default();
        let mut time = f64::INFINITY;
        for _ in 0..TURNS {
            let watch = Stopwatch::start();
            (0..RUNS).for_each(|_| {
                black_box(floor.place(black_box(*periods), &rule));
            });
            time = time.min(watch.each(RUNS).processor);
        }
        let error = problem.norm.against(0, floor.place(*periods, &rule), problem.reference.end()[0]);
        Self { nodes: N as u32, error, time, instructions: None }
    }
}
