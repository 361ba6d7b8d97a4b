//! Implementation of the trait [`Component`] for contacts.

use super::{Contact, Motion, fired};
use crate::EventKind;
use crate::component::{Component, Moment, Standing, States};
use stickslip_contact::{ContactError, Guard, Law, Memory, Segment};

impl Component for Contact {
    type Law = Law;
    type Memory = Memory;
    type Guard = Guard;
    type Inputs = Motion;
    type Segment = Segment;
    type Error = ContactError;

    /// Returns force, elastic energy and friction work as components of the state, for a contact that may grow in full stick.
    fn states(&self) -> States {
        match self.slot {
            None => States::default(),
            Some(_) => {
                let limit = self.friction_limit();
                States { scales: vec![if limit > 0.0 { limit } else { 1.0 }], integrals: 2 }
            }
        }
    }

    fn guards(&self, law: &Law) -> &[Guard] {
        Guard::of(self, law)
    }

    #[inline]
    fn guard(&self, guard: Guard, standing: Standing<'_, Law, Memory>, at: &Moment<'_, Motion>) -> f64 {
        guard.value(self, (standing.memory, standing.law), at.inputs)
    }

    fn next(
        &self,
        guard: Guard,
        standing: Standing<'_, Law, Memory>,
        at: &Moment<'_, Motion>,
    ) -> (EventKind, Law) {
        let (kind, course) = fired(self, guard, standing.law, at.inputs);
        (kind, Law::of(self, standing.memory, (course, at.inputs), 0.0, 0.0))
    }

    fn commit(&self, memory: &mut Memory, segment: &Segment) -> Result<f64, ContactError> {
        memory.commit(&self.interface, *segment)
    }

    /// Normal and tangential energy of one contact.
    fn energy(&self, standing: Standing<'_, Law, Memory>, at: &Moment<'_, Motion>) -> f64 {
        let normal = self.interface.normal_energy(at.inputs.d);
        normal + standing.memory.preview(&self.interface, at.inputs.apex()).elastic
    }

    fn columns(&self) -> Vec<&'static str> {
        if self.stop {
            return vec!["d_m", "fn_N"];
        }
        vec!["u_m", "d_m", "fx_N", "fn_N", "a_m", "stick_m", "state", "elastic_J", "friction_J"]
    }
}
