//! What error each component of a step may have, and how long a step may be at most.

use super::Run;
use crate::equations::Equations;
use crate::model::Contact;
use crate::state::State;
use crate::{Model, Plan, Waveform};
use stickslip_stepper::Attempt;

/// Steps of a row under a varying load in a period of the load, at least.
const CHORDS_PER_PERIOD: f64 = 4096.0;

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// Absolute error allowed per component: the tolerance times the natural scale, and never below what rounding
    /// of a far-travelled coordinate makes of the force, or rounding of time of the work of a fast follower.
    pub(super) fn set_scale(&mut self, state: &State) {
        let layout = self.layout;
        for (i, free) in self.model.free.iter().enumerate() {
            let (length, speed) = free.scale;
            let (x, v) = (
                8.0 * f64::EPSILON * state.y[i].abs(),
                8.0 * f64::EPSILON * state.y[layout.velocity(i)].abs(),
            );
            self.scale[i] = self.strict * length + x;
            self.scale[layout.velocity(i)] = self.strict * speed + x * (speed / length) + v;
        }
        let work = self.strict * self.work + 8.0 * f64::EPSILON * state.t * self.haste;
        self.scale[layout.dimension()..].fill(work);
    }

    /// Largest power that followers can put into the contacts now, W: μF_N times their speed.
    pub(super) fn haste(&self, state: &State) -> f64 {
        let model = self.model;
        let rate = |w: usize| model.waveforms[w].sample(&state.pieces[w], state.t).rate;
        let power = |contact: &Contact| {
            let speed: f64 = contact.u.driven.iter().map(|(w, a)| a * rate(*w)).sum();
            contact.count * contact.friction_limit() * speed.abs()
        };
        model.contacts.iter().map(power).sum()
    }
}

/// Absolute error allowed of the forces of growing contacts; the rest is known step by step. The integrals of work steer
/// the steps as well: energy books close at the tolerance.
pub(super) fn scale(model: &Model, tolerance: f64) -> Vec<f64> {
    let layout = model.layout();
    let mut scale = vec![0.0; layout.total()];
    for contact in &model.contacts {
        if let Some(slot) = contact.slot {
            let limit = contact.friction_limit();
            scale[layout.force(slot)] = tolerance * if limit > 0.0 { limit } else { 1.0 };
        }
    }
    scale
}

/// Longest step, s. A row under a varying load follows chords: it needs steps that leave the load no bend.
pub(super) fn longest(model: &Model, plan: &Plan) -> f64 {
    let waves = model.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min);
    let rows = model.contacts.iter().filter(|c| !c.engine.branches() && !c.is_constant());
    let load = |w: usize| model.waveforms[w].period().unwrap_or(plan.duration) / CHORDS_PER_PERIOD;
    rows.filter_map(|c| c.press.waveform().map(load)).fold(waves, f64::min)
}

/// How near to a singular moment a step must end, as a part of it. What is missed of a force that goes with a power 3/2 of
/// the time counts with the power 5/2, of the damping of the stuck springs with the power 3/2.
pub(super) fn slack(model: &Model, tolerance: f64) -> f64 {
    let damped = model.contacts.iter().any(|contact| contact.damping > 0.0);
    0.1 * tolerance.powf(if damped { 2.0 / 3.0 } else { 0.4 })
}
