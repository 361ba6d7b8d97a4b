//! Detects whether friction holds a body. A distance that the body flies or slides in a period does not count as a step.

use stickslip_drive::scene::Side;
use stickslip_drive::{Event, Model, Run, Source};
use stickslip_run::Job;

/// State of a body that no contact holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Loose {
    /// All contacts of the body are open.
    Flies,
    /// All contacts of the body are in gross slip or open.
    Slides,
}

/// Observer of the contacts of a body.
pub(crate) struct Grip {
    contacts: Vec<usize>,
    /// Indices of the indentation channels of these contacts.
    depths: Vec<usize>,
    /// True if one of the contacts had an event since [`Self::begin`].
    was_met: bool,
    row: Vec<f64>,
}

impl Grip {
    /// Creates the observer for the body with index `body`.
    pub(crate) fn new(job: &Job, body: usize) -> Self {
        let contacts = job.scenario.scene.contacts.iter().enumerate();
        let own = contacts.filter(|(_, contact)| contact.part.between.contains(&Side::Body(body)));
        let channels = job.model.channels();
        let depth = |name: &str| {
            let name = format!("{name}.d_m");
            channels.iter().position(|channel| channel.name == name)
        };
        let (contacts, depths) = own.filter_map(|(c, contact)| Some((c, depth(&contact.name)?))).unzip();
        Self { contacts, depths, was_met: false, row: Vec::new() }
    }

    /// Starts a new time interval.
    pub(crate) fn begin(&mut self) {
        self.was_met = false;
    }

    /// Records an event.
    pub(crate) fn event(&mut self, event: &Event) {
        self.was_met |= matches!(event.source, Source::Contact(c) if self.contacts.contains(&c));
    }

    /// Returns the state of the body if no contact held it during the whole interval, and `None` otherwise.
    ///
    /// Touching and sticking are events. In an interval without events, the state of the contacts at its end holds for the whole interval.
    pub(crate) fn loose(&mut self, model: &Model, run: &Run<'_>) -> Option<Loose> {
        let gives_way = |c: &usize| run.state().has_given_way(model, *c);
        if self.was_met || self.contacts.is_empty() || !self.contacts.iter().all(gives_way) {
            return None;
        }
        run.row(&mut self.row);
        let is_open = |place: &usize| self.row.get(*place).is_some_and(|depth| *depth <= 0.0);
        Some(if self.depths.iter().all(is_open) { Loose::Flies } else { Loose::Slides })
    }
}
