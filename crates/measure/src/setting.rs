//! A scenario with its model and its initial state.

use crate::plausibility;
use stickslip_drive::facts::{Setup, has_constant_load};
use stickslip_drive::scene::{Contact, Freedom, Normal, NormalDamping, Side};
use stickslip_drive::{Accuracy, Model, State, Stepper};
use stickslip_scenario::{Scenario, Warning};

/// A scenario, its model and its initial state. All evaluations and checks use these data.
pub struct Setting {
    /// Scenario.
    pub scenario: Scenario,
    /// Model of the scenario.
    pub model: Model,
    /// State at t = 0.
    pub start: State,
}

impl Setting {
    /// Returns the number of identical contacts that contact `c` represents.
    pub fn count(&self, c: usize) -> u32 {
        self.scenario.scene.contacts.get(c).map_or(1, |contact| contact.part.count)
    }

    /// Returns the arguments with which `facts` (properties known before a run) are computed.
    pub fn setup(&self) -> Setup<'_> {
        Setup { scene: &self.scenario.scene, model: &self.model, start: &self.start }
    }

    /// Returns whether the normal load of contact `c` is constant.
    pub fn has_constant_load(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| has_constant_load(&contact.part))
    }

    /// Returns whether the tangential force of contact `c` depends only on the path of its displacement u, not on time.
    pub fn has_law_without_time(&self, c: usize) -> bool {
        self.has_constant_load(c) && !self.depends_on_time(c)
    }

    /// Returns whether the tangential force of contact `c` depends on time: by damping, or by a friction coefficient that grows at rest.
    pub fn depends_on_time(&self, c: usize) -> bool {
        let grows = |contact: &Contact| contact.interface.growth().is_some();
        self.is_damped(c) || self.scenario.scene.contacts.get(c).is_some_and(|named| grows(&named.part))
    }

    /// Returns whether contact `c` has damping.
    pub fn is_damped(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|named| {
            named.part.interface.damping() > 0.0 || named.part.normal_damping != NormalDamping::None
        })
    }

    /// Returns whether a waveform of the model jumps.
    pub fn has_jumps(&self) -> bool {
        self.scenario.scene.waveforms.iter().any(|waveform| waveform.part.has_jumps())
    }

    /// Returns whether all dissipation in the model is friction or damping of contact `c`.
    ///
    /// If so, the model has no other damped contact, no damper and no block.
    pub fn loses_nothing_beside(&self, c: usize) -> bool {
        let scene = &self.scenario.scene;
        let mut others = (0..scene.contacts.len()).filter(|other| *other != c);
        let dampers = scene.springs.iter().map(|it| it.part.damping);
        let mut dampers = dampers.chain(scene.actuators.iter().map(|it| it.part.damping));
        scene.blocks.is_empty() && !others.any(|other| self.is_damped(other)) && dampers.all(|it| it == 0.0)
    }

    /// Returns whether the motion of bodies determines the normal load of contact `c`.
    pub fn is_coupled(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| contact.part.normal == Normal::Coupled)
    }

    /// Returns whether a body that is free along z presses contact `c`.
    pub fn is_pressed_freely(&self, c: usize) -> bool {
        let scene = &self.scenario.scene;
        let is_free = |side: &Side| match side {
            Side::Body(b) => scene.bodies.get(*b).is_some_and(|body| body.part.z.freedom == Freedom::Free),
            Side::Ground => false,
        };
        self.is_coupled(c)
            && scene.contacts.get(c).is_some_and(|contact| contact.part.between.iter().any(is_free))
    }

    /// Returns the gross slip displacement u_c, m, and the normal force, N, of one of the identical contacts `c` at t = 0.
    pub fn contact_scale(&self, c: usize) -> (f64, f64) {
        let contact = self.model.contacts().zip(self.start.memories()).nth(c);
        contact.map_or((0.0, 0.0), |((_, law), memory)| {
            let d = memory.apex().d;
            (law.gross_slip_displacement(d), law.normal_force(d))
        })
    }

    /// Returns all warnings about the values in the scenario file and about the plausibility of the model.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = self.scenario.warnings.clone();
        warnings.extend(plausibility::of(self));
        warnings
    }

    /// Returns warnings if the error is unbounded when `stepper` simulates the scenario in frames.
    pub fn warnings_of_frames(&self, stepper: Stepper) -> Vec<Warning> {
        plausibility::of_frames(self, stepper)
    }

    /// Returns the name of the integrator used, the name of its accuracy setting, and the value of this setting.
    pub fn stepper(&self) -> (&'static str, &'static str, f64) {
        let stepper = self.model.effective(self.scenario.plan.stepper);
        match stepper.accuracy() {
            Accuracy::Tolerance(tolerance) => (stepper.name(), "tolerance", tolerance),
            Accuracy::Step(step) => (stepper.name(), "step_s", step),
            // With `frames`, the accuracy is described by the longest time step.
            Accuracy::Frame { length, error } => {
                (stepper.name(), "step_s", length / self.model.substeps(length, error))
            }
        }
    }
}
