//! Fast runs of cases: parameters are set in the resolved scenario, without reading the scenario again. Model, state and workspace reuse
//! the memory of the previous run.

use super::Study;
use super::wanted::{Place, Wanted};
use crate::figure::{Figure, Placed, Reading};
use crate::number::Number;
use crate::sketch::Sketch;
use stickslip_drive::{Limits, Plan, Scene, Variants};
use stickslip_run::Watcher;

/// Data for fast runs of a study.
#[derive(Debug, Clone)]
pub(crate) struct Shortcut {
    numbers: Vec<Number>,
    figures: Vec<Placed>,
    scene: Scene,
    plan: Plan,
}

impl Shortcut {
    /// Creates the data for fast runs of a study. Returns `None` if a parameter cannot be set directly, a result needs rows of the time
    /// histories, or the run ends when its steps are steady.
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

/// Returns the form of a result that can be evaluated during a run, or `None` if the result has no such form.
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

/// Runs cases one after another.
pub(crate) struct Quick<'s> {
    shortcut: &'s Shortcut,
    scene: Scene,
    /// Waveforms with varied parameters, and whether they must be built again.
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

    /// Returns the results of a case, or `None` if the case fails.
    pub(crate) fn run(&mut self, numbers: &[f64]) -> Option<&[f64]> {
        // All parameters are set even if one is invalid, so that the next case does not inherit old values.
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
