//! Whether something holds a body: how far it flies, or slides, in a period is no step, however even.

use stickslip_drive::scene::Side;
use stickslip_drive::{Event, Model, Run, Source};
use stickslip_run::Job;

/// What a body does that nothing holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Loose {
    /// All its contacts are open.
    Flies,
    /// All of them slip grossly, or are open.
    Slides,
}

/// Watches the contacts of a body.
pub(crate) struct Grip {
    contacts: Vec<usize>,
    /// Places of their indentations among all channels.
    depths: Vec<usize>,
    /// Whether anything has happened to one of them since [`Self::begin`].
    was_met: bool,
    row: Vec<f64>,
}

impl Grip {
    /// Of a body, by its place.
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

    /// A stretch of time begins.
    pub(crate) fn begin(&mut self) {
        self.was_met = false;
    }

    /// An event in it.
    pub(crate) fn event(&mut self, event: &Event) {
        self.was_met |= matches!(event.source, Source::Contact(c) if self.contacts.contains(&c));
    }

    /// What the body did all through it if nothing held it. To touch and to stick are events: without one, contacts were all the
    /// time what they are at its end, where the run stands.
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
