//! Applies the minimal code to models that are the benchmark drive with other parameters.

use super::{Floor, Rule};
use crate::clock::{Stopwatch, Times};
use crate::contestant::{Contestant, Stop};
use crate::samples::Samples;
use std::hint::black_box;
use stickslip_drive::scene::{Freedom, Normal, Varying};
use stickslip_drive::{Counts, Model, Scene, Shape};
use stickslip_run::Watcher;

/// Relative deviation from an integer up to which a number of periods counts as an integer.
const WHOLE: f64 = 1e-9;

/// Minimal code for a model, with N nodes.
pub(crate) struct Ground<const N: usize> {
    pub(crate) floor: Floor,
    pub(crate) periods: u32,
    pub(crate) rule: Rule<N>,
}

impl Floor {
    /// Returns the drive of a model and the number of its periods. Returns `None` unless the model is a slider on one paraboloid under
    /// constant load, on a foot that follows a sawtooth.
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

impl<const N: usize> Contestant for Ground<N> {
    fn sample(&self, _: f64, _: f64, _: &dyn Watcher) -> Result<(Samples, Counts), Stop> {
        let mut samples = Samples::new(1);
        let duration = f64::from(self.periods) * self.floor.period;
        let moments: Vec<f64> = Samples::grid(duration).collect();
        let slide = self.floor.slide(self.periods, &self.rule, &moments, |place| samples.push(place));
        samples.push(self.floor.place(self.periods, &self.rule));
        Ok((samples, Counts { steps: slide.arcs, evaluations: slide.arcs * N as u64, ..Counts::default() }))
    }

    fn time(&self, _: f64, times: u32, watcher: &dyn Watcher) -> Result<Times, Stop> {
        let watch = Stopwatch::start();
        for _ in 0..times {
            black_box(self.floor.place(black_box(self.periods), &self.rule));
            if !watcher.goes_on() {
                return Err(Stop::Interrupted);
            }
        }
        Ok(watch.each(times))
    }
}
