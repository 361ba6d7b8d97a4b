//! Cases of which nothing has to be read anew: their numbers are set in the scene that was read, model, state and workspace of each run
//! are made in the room of the one before.

use super::Study;
use super::wanted::{Place, Wanted};
use crate::figure::{Figure, Placed, Reading};
use crate::number::Number;
use crate::sketch::Sketch;
use stickslip_drive::{Limits, Plan, Scene, Variants};
use stickslip_run::Watcher;

/// What a study's results are where a run need not be recorded for them.
#[derive(Debug, Clone)]
pub(crate) struct Shortcut {
    numbers: Vec<Number>,
    figures: Vec<Placed>,
    scene: Scene,
    plan: Plan,
}

impl Shortcut {
    /// That of a study; none where a number is none of the scene, a result needs more than a few moments of the run, or the run ends
    /// when its steps are steady.
    pub(crate) fn of(study: &Study) -> Option<Self> {
        let scenario = &study.job.scenario;
        let scene = scenario.scene.clone();
        let figures =
            study.wanted.iter().map(|wanted| figure(study, wanted)?.place(&scene, &study.job.model).ok());
        let figures = figures.collect::<Option<_>>()?;
        let numbers = study.design.axes.iter().map(|axis| Number::named(&scene, &axis.path).ok());
        let numbers = numbers.collect::<Option<_>>()?;
        let limits = Limits { wall: None, ..scenario.plan.limits };
        let plan = Plan { every: None, limits, ..scenario.plan };
        plan.until_steady.is_none().then_some(Self { numbers, figures, scene, plan })
    }
}

/// The figure that a result is.
fn figure(study: &Study, wanted: &Wanted) -> Option<Figure> {
    let scenario = &study.job.scenario;
    if let Place::End(place) = wanted.place {
        return Some(Figure::End(study.job.model.channels().get(place)?.name.clone()));
    }
    if wanted.name != "steps.last_m" {
        return None;
    }
    let (body, waveform) = (scenario.figures.body?, scenario.figures.waveform?);
    Some(Figure::Step { channel: format!("{}.x_m", scenario.scene.bodies.get(body)?.name), waveform })
}

/// Where cases are run so, one after the other.
pub(crate) struct Quick<'s> {
    shortcut: &'s Shortcut,
    scene: Scene,
    /// Waveforms whose numbers vary, and whether they have yet to be drawn.
    sketches: Vec<(usize, Sketch, bool)>,
    variants: Variants,
    reading: Reading<'s>,
}

impl<'s> Quick<'s> {
    pub(crate) fn new(shortcut: &'s Shortcut, watcher: &'s dyn Watcher) -> Self {
        let mut sketches: Vec<(usize, Sketch, bool)> = Vec::new();
        for number in &shortcut.numbers {
            if let Number::Waveform(w, _) = *number
                && sketches.iter().all(|(known, ..)| *known != w)
            {
                sketches.push((w, Sketch::of(&shortcut.scene.waveforms[w].part), false));
            }
        }
        let reading = Reading::new(&shortcut.figures, watcher);
        Self { shortcut, scene: shortcut.scene.clone(), sketches, variants: Variants::new(), reading }
    }

    /// The results of a case with these numbers; none where something is wrong with it.
    pub(crate) fn run(&mut self, numbers: &[f64]) -> Option<&[f64]> {
        // All of them, whatever is wrong with one: the next case finds none of this one.
        let is_set = self.set(numbers);
        let plan = &self.shortcut.plan;
        self.reading.begin(&self.scene, plan);
        (is_set && self.variants.run(&self.scene, plan, &mut self.reading).is_ok())
            .then_some(&self.reading.values)
    }

    fn set(&mut self, numbers: &[f64]) -> bool {
        let mut is_good = true;
        for (number, value) in self.shortcut.numbers.iter().zip(numbers) {
            if let Number::Waveform(w, quantity) = *number {
                let own = self.sketches.iter_mut().find(|(known, ..)| *known == w);
                own.into_iter().for_each(|(_, sketch, due)| *due |= sketch.set(quantity, *value));
            } else {
                is_good &= number.set(&mut self.scene, *value).is_ok();
            }
        }
        for (w, sketch, due) in self.sketches.iter_mut().filter(|(.., due)| *due) {
            match sketch.draw() {
                Ok(waveform) => (self.scene.waveforms[*w].part, *due) = (waveform, false),
                Err(_) => is_good = false,
            }
        }
        is_good
    }
}
