//! Batches: variants of one scene that differ in numbers, one line of figures each.

use crate::figure::{Figure, FigureError, Placed, Reading};
use crate::line::{Ended, LineFault, Lines};
use crate::number::{Number, NumberError};
use crate::sketch::Sketch;
use std::num::NonZero;
use std::slice::ChunksMut;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use stickslip_drive::{Model, Plan, Scene, SceneError, VariantError, Variants};
use stickslip_scenario::Scenario;

/// Lines that a core takes at a time: milliseconds of work, so that none waits long for another at the end.
const CHUNK: usize = 32;

/// Variants of one scene, run side by side: one workspace a core, in which each is built, started and run in the room of the one
/// before.
///
/// What a line says depends on its own numbers alone: it is the same for any number of cores, and what
/// [`stickslip_drive::run`](stickslip_drive::run()) makes of the scene with these numbers. What is wrong with a variant stands in its line, and the others go on.
#[derive(Debug, Clone)]
pub struct Batch {
    scene: Scene,
    plan: Plan,
    model: Model,
    varied: Vec<Number>,
    figures: Vec<Figure>,
    placed: Vec<Placed>,
    cores: usize,
}

impl Batch {
    /// The scene and the plan of a scenario, on all cores; without numbers that vary and without figures. Its output is that of a
    /// run, and nothing here.
    ///
    /// # Errors
    /// A scene that makes no model.
    pub fn of(scenario: &Scenario) -> Result<Self, SceneError> {
        Self::new(scenario.scene.clone(), scenario.plan)
    }

    /// The same of a scene and a plan.
    ///
    /// # Errors
    /// A scene that makes no model.
    pub fn new(scene: Scene, plan: Plan) -> Result<Self, SceneError> {
        let model = Model::new(&scene)?;
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        let plan = Plan { every: None, ..plan };
        Ok(Self { scene, plan, model, varied: Vec::new(), figures: Vec::new(), placed: Vec::new(), cores })
    }

    /// Lets a number of the scene vary, by its key path in the scenario file, such as `bodies.slider.mass`; in SI. Numbers of a
    /// variant come in the order of these calls.
    ///
    /// # Errors
    /// A path that names none.
    pub fn vary(&mut self, path: &str) -> Result<&mut Self, NumberError> {
        self.varied.push(Number::named(&self.scene, path)?);
        Ok(self)
    }

    /// Asks for a figure.
    ///
    /// # Errors
    /// A channel or a waveform that is not there.
    pub fn tell(&mut self, figure: Figure) -> Result<&mut Self, FigureError> {
        self.placed.push(figure.place(&self.scene, &self.model)?);
        self.figures.push(figure);
        Ok(self)
    }

    /// On so many cores, at least one; all there are by default.
    pub fn on(&mut self, cores: usize) -> &mut Self {
        self.cores = cores.max(1);
        self
    }

    /// The numbers that vary, as the scene itself has them.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        self.varied.iter().map(|number| number.get(&self.scene).unwrap_or(f64::NAN))
    }

    /// Runs so many variants. `number` writes the numbers of a variant, by its place, over those of the scene; it is asked on any core
    /// and in any order. `goes_on` is told how many are done, on the calling thread, every few of them; with `false` all stop, and
    /// lines that were not run say so.
    pub fn run(
        &self,
        count: usize,
        number: impl Fn(usize, &mut [f64]) + Sync,
        mut goes_on: impl FnMut(usize) -> bool,
    ) -> Lines {
        let mut lines = Lines::new(count, &self.figures);
        let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
        let queue = Mutex::new(Queue::of(&mut lines));
        let work = |each: &mut dyn FnMut(usize)| {
            let mut worker = Worker::new(self, &stop);
            while let Some(mut chunk) = Queue::next(&queue) {
                let finished = chunk.ends.len();
                worker.fill(&mut chunk, &number);
                each(done.fetch_add(finished, Ordering::Relaxed) + finished);
            }
        };
        thread::scope(|scope| {
            for _ in 1..self.cores.min(count.div_ceil(CHUNK)) {
                scope.spawn(|| work(&mut |_| {}));
            }
            work(&mut |done| {
                if !goes_on(done) {
                    stop.store(true, Ordering::Relaxed);
                }
            });
        });
        lines
    }
}

/// Lines that nobody has taken yet.
struct Queue<'l> {
    first: usize,
    ends: ChunksMut<'l, Result<Ended, LineFault>>,
    values: &'l mut [f64],
    width: usize,
}

/// Some of them, and the place of the first.
struct Chunk<'l> {
    first: usize,
    ends: &'l mut [Result<Ended, LineFault>],
    values: &'l mut [f64],
}

impl<'l> Queue<'l> {
    fn of(lines: &'l mut Lines) -> Self {
        let width = lines.width();
        Self { first: 0, ends: lines.ends.chunks_mut(CHUNK), values: &mut lines.values, width }
    }

    fn next(queue: &Mutex<Self>) -> Option<Chunk<'l>> {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        let ends = queue.ends.next()?;
        let width = queue.width;
        let (values, rest) = std::mem::take(&mut queue.values).split_at_mut(width * ends.len());
        queue.values = rest;
        let first = queue.first;
        queue.first += ends.len();
        Some(Chunk { first, ends, values })
    }
}

/// What one core works with.
struct Worker<'b> {
    batch: &'b Batch,
    stop: &'b AtomicBool,
    scene: Scene,
    /// Numbers of the scene itself, and of a variant.
    base: Vec<f64>,
    numbers: Vec<f64>,
    /// Waveforms whose numbers vary, and whether they have yet to be drawn.
    sketches: Vec<(usize, Sketch, bool)>,
    variants: Variants,
    reading: Reading<'b>,
}

impl<'b> Worker<'b> {
    fn new(batch: &'b Batch, stop: &'b AtomicBool) -> Self {
        let base: Vec<f64> = batch.numbers().collect();
        let mut sketches: Vec<(usize, Sketch, bool)> = Vec::new();
        for number in &batch.varied {
            if let Number::Waveform(w, _) = *number
                && sketches.iter().all(|(known, ..)| *known != w)
            {
                sketches.push((w, Sketch::of(&batch.scene.waveforms[w].part), false));
            }
        }
        Self {
            batch,
            stop,
            scene: batch.scene.clone(),
            numbers: base.clone(),
            base,
            sketches,
            variants: Variants::new(),
            reading: Reading::new(&batch.placed, stop),
        }
    }

    fn fill(&mut self, chunk: &mut Chunk<'_>, number: &impl Fn(usize, &mut [f64])) {
        let width = self.batch.placed.len();
        for (k, end) in chunk.ends.iter_mut().enumerate() {
            if self.stop.load(Ordering::Relaxed) {
                return;
            }
            self.numbers.copy_from_slice(&self.base);
            number(chunk.first + k, &mut self.numbers);
            *end = self.run();
            if end.is_ok() {
                chunk.values[k * width..(k + 1) * width].copy_from_slice(&self.reading.values);
            }
        }
    }

    fn run(&mut self) -> Result<Ended, LineFault> {
        self.set()?;
        let plan = &self.batch.plan;
        self.reading.begin(&self.scene, plan);
        self.variants.run(&self.scene, plan, &mut self.reading).map_err(|error| match error {
            VariantError::Scene(error) => LineFault::Scene(Box::new(error)),
            VariantError::Run(error) => LineFault::Run(Box::new(error)),
        })?;
        let state = self.variants.state();
        Ok(Ended { time: state.time(), counts: state.counts() })
    }

    /// Sets the numbers of a variant. All of them, whatever is wrong with one: the next variant finds none of another.
    fn set(&mut self) -> Result<(), LineFault> {
        let mut outcome = Ok(());
        for (place, (number, value)) in self.batch.varied.iter().zip(&self.numbers).enumerate() {
            if let Number::Waveform(w, quantity) = *number {
                let own = self.sketches.iter_mut().find(|(known, ..)| *known == w);
                own.into_iter().for_each(|(_, sketch, due)| *due |= sketch.set(quantity, *value));
            } else if let Err(why) = number.set(&mut self.scene, *value) {
                outcome = outcome.and(Err(LineFault::Number { place, why }));
            }
        }
        for (w, sketch, due) in self.sketches.iter_mut().filter(|(.., due)| *due) {
            match sketch.draw() {
                Ok(waveform) => (self.scene.waveforms[*w].part, *due) = (waveform, false),
                Err(why) => outcome = outcome.and(Err(LineFault::Waveform { place: *w, why })),
            }
        }
        outcome
    }
}
