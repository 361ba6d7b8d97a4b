//! Run data that are saved in the state and restored from it.
//!
//! All other run data are scratch and follow from the state. Examples are the interval, the contacts at the start of the next step, and the
//! motion of a closed-form step.

use super::Located;
use crate::equations::Equations;
use crate::interval::PhasePoint;
use crate::state::{LocatedWay, State, Takeoff, Underway, Whereabouts};
use stickslip_stepper::Attempt;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Saves everything that the next step depends on, and adds the number of evaluations to the counts of the state.
    pub(super) fn put_down(&mut self, state: &mut State) {
        let solver = &self.motion.solver;
        // The count does not depend on output.
        state.counts.evaluations += solver.evaluations() - self.output.evaluations;
        self.output.evaluations = solver.evaluations();
        // Reuses the storage of earlier data of the same kind.
        let mut way = match state.underway.take() {
            Some(Underway::Located(way)) => way,
            _ => self.spare.take().unwrap_or_else(|| Box::new(LocatedWay::BLANK)),
        };
        way.tolerance = self.setting.tolerance;
        (way.whereabouts, way.hand) = (self.motion.whereabouts, solver.hand());
        way.slopes.clear();
        // The capacity does not depend on whether there are slopes.
        way.slopes.reserve(self.setting.layout.total());
        if way.whereabouts == Whereabouts::Here {
            solver.first_slopes(&mut way.slopes);
        }
        (way.history, way.gait) = (self.control.history(), self.motion.pace.gait);
        way.allowed.copy(&self.motion.allowance.allowed);
        way.booked = self.ledger.booked;
        way.asked = self.interval.traits.asked;
        way.leap = self.takeoff.map(|input| Takeoff { from: self.swing.start(), input });
        (way.detour, way.last_detour, way.crawl) = (self.detour, self.last_detour, self.bounds.crawl);
        way.windows.clone_from(&self.bounds.windows);
        way.steps = self.horizon.steps.so_far();
        state.underway = Some(Underway::Located(way));
    }

    /// Restores the run data that an earlier run has saved in the state.
    pub(super) fn take_up(&mut self, state: &State, way: &LocatedWay) {
        self.control.set_history(way.history);
        self.motion.pace.gait = way.gait;
        self.motion.allowance.allowed.copy(&way.allowed);
        self.ledger.booked = way.booked;
        self.bounds.windows.clone_from(&way.windows);
        (self.detour, self.last_detour, self.bounds.crawl) = (way.detour, way.last_detour, way.crawl);
        if let Some(steps) = way.steps {
            self.horizon.steps.take_up(steps, state);
        }
        self.horizon.corner = state.next_corner();
        self.interval.begin(self.setting.model, state);
        self.interval.traits.asked = way.asked;
        self.motion.whereabouts = way.whereabouts;
        if way.whereabouts == Whereabouts::Here {
            let eq = self.setting.equations(state, &self.interval);
            self.motion.solver.take_up(&eq, (state.t, &state.y), way.hand, &way.slopes);
            self.watch.set_out(&eq, &self.motion.solver);
        }
        if let Some(leap) = way.leap {
            self.swing_from(leap.from);
            self.takeoff = Some(leap.input);
        }
        // These evaluations have been counted before.
        self.output.evaluations = self.motion.solver.evaluations();
    }

    /// Finds the event of the closed-form motion that begins at `from`. Returns false if there is no closed form.
    #[inline(always)]
    pub(super) fn swing_from(&mut self, from: PhasePoint) -> bool {
        let [slider] = &self.setting.model.free[..] else { return false };
        let length = slider.scale.0;
        self.swing.begin(&self.interval, slider, from) && self.swing.aim(length)
    }
}
