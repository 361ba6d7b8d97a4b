//! What is run: a scenario, its constants assembled, its start.

use crate::plausibility;
use stickslip_drive::facts::{Setup, has_constant_load};
use stickslip_drive::scene::{Freedom, Normal, Side};
use stickslip_drive::{Accuracy, Model, State, Stepper};
use stickslip_scenario::{Scenario, Warning};

/// A scenario with its constants and its start: what is measured and judged is measured and judged of these.
pub struct Setting {
    /// What is to be run.
    pub scenario: Scenario,
    /// Its constants, assembled.
    pub model: Model,
    /// The state at t = 0.
    pub start: State,
}

impl Setting {
    /// Number of identical contacts behind contact `c`.
    pub fn count(&self, c: usize) -> u32 {
        self.scenario.scene.contacts.get(c).map_or(1, |contact| contact.part.count)
    }

    /// What facts are told of.
    pub fn setup(&self) -> Setup<'_> {
        Setup { scene: &self.scenario.scene, model: &self.model, start: &self.start }
    }

    /// Whether the load of contact `c` never changes.
    pub fn has_constant_load(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| has_constant_load(&contact.part))
    }

    /// Whether the force of contact `c` follows from the way of its bodies along the slide alone.
    pub fn has_law_without_time(&self, c: usize) -> bool {
        self.has_constant_load(c) && !self.is_damped(c)
    }

    /// Whether contact `c` has damping of its own.
    pub fn is_damped(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| contact.part.interface.damping() > 0.0)
    }

    /// Whether a waveform of its scene jumps.
    pub fn has_jumps(&self) -> bool {
        self.scenario.scene.waveforms.iter().any(|waveform| waveform.part.has_jumps())
    }

    /// Whether nothing but friction loses energy beside contact `c`: no other damped contact, no damper, and no block.
    pub fn loses_nothing_beside(&self, c: usize) -> bool {
        let scene = &self.scenario.scene;
        let mut others = (0..scene.contacts.len()).filter(|other| *other != c);
        let dampers = scene.springs.iter().map(|it| it.part.damping);
        let mut dampers = dampers.chain(scene.actuators.iter().map(|it| it.part.damping));
        scene.blocks.is_empty() && !others.any(|other| self.is_damped(other)) && dampers.all(|it| it == 0.0)
    }

    /// Whether the bodies' motion presses contact `c`.
    pub fn is_coupled(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| contact.part.normal == Normal::Coupled)
    }

    /// Whether a body that is free along z presses contact `c`.
    pub fn is_pressed_freely(&self, c: usize) -> bool {
        let scene = &self.scenario.scene;
        let is_free = |side: &Side| match side {
            Side::Body(b) => scene.bodies.get(*b).is_some_and(|body| body.part.z.freedom == Freedom::Free),
            Side::Ground => false,
        };
        self.is_coupled(c)
            && scene.contacts.get(c).is_some_and(|contact| contact.part.between.iter().any(is_free))
    }

    /// Gross-slip displacement u_c (m) and normal force (N) of one contact of `c` at t = 0: in equilibrium, if the run
    /// starts there.
    pub fn contact_scale(&self, c: usize) -> (f64, f64) {
        let contact = self.model.contacts().zip(self.start.memories()).nth(c);
        contact.map_or((0.0, 0.0), |((_, law), memory)| {
            let d = memory.apex().d;
            (law.gross_slip_displacement(d), law.normal_force(d))
        })
    }

    /// Everything odd about the scenario: what its file alone tells, then what its scene comes to.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = self.scenario.warnings.clone();
        warnings.extend(plausibility::of(self));
        warnings
    }

    /// What is odd about the scenario if this stepper takes it in frames.
    pub fn warnings_of_frames(&self, stepper: Stepper) -> Vec<Warning> {
        plausibility::of_frames(self, stepper)
    }

    /// Name of the stepper that the run takes and its tolerance or step with that word.
    pub fn stepper(&self) -> (&'static str, &'static str, f64) {
        let stepper = self.model.effective(self.scenario.plan.stepper);
        match stepper.accuracy() {
            Accuracy::Tolerance(tolerance) => (stepper.name(), "tolerance", tolerance),
            Accuracy::Step(step) => (stepper.name(), "step_s", step),
            // The longest of its steps.
            Accuracy::Frame { length, error } => {
                (stepper.name(), "step_s", length / self.model.substeps(length, error))
            }
        }
    }
}
