//! What a run did, counted.
//!
//! One count per accepted step or leap, and one per contact and interval. Counts are part of the state beside those of steps
//! and events: a run that goes on goes on counting.

use super::{Method, Treatment};
use stickslip_contact::Words;

/// How often each method was taken, and each treatment given.
#[derive(Debug, PartialEq, Eq, Default)]
pub struct Tally {
    methods: [u64; Method::ALL.len()],
    /// By contact.
    treatments: Vec<[u64; Treatment::ALL.len()]>,
}

impl Clone for Tally {
    fn clone(&self) -> Self {
        Self { methods: self.methods, treatments: self.treatments.clone() }
    }

    /// In the room there is.
    fn clone_from(&mut self, from: &Self) {
        self.methods = from.methods;
        self.treatments.clone_from(&from.treatments);
    }
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Walk,
        Self::Swing,
        Self::Parabola,
        Self::Nystrom,
        Self::BriefNystrom,
        Self::DormandPrince,
        Self::Brief,
        Self::Radau,
        Self::Graded,
        Self::Whole,
        Self::AskedFor,
    ];

    /// What a user reads.
    pub fn name(self) -> &'static str {
        match self {
            Self::Walk => "walk from event to event",
            Self::Swing => "closed form from event to event",
            Self::Parabola => "parabola",
            Self::Nystrom => "Runge–Kutta–Nyström 8(6)",
            Self::BriefNystrom => "Nyström 5",
            Self::DormandPrince => "Dormand–Prince 8(5,3)",
            Self::Brief => "Dormand–Prince 5(4)",
            Self::Radau => "Radau IIA 9, implicit",
            Self::Graded => "Dormand–Prince 8(5,3) with crowded stages",
            Self::Whole => "step doubling on the full force law",
            Self::AskedFor => "the stepper asked for",
        }
    }
}

impl Treatment {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Spared, Self::Apart, Self::Closed, Self::General];
}

impl Tally {
    /// Nothing yet, of a number of contacts.
    pub(crate) fn of(contacts: usize) -> Self {
        Self { methods: Default::default(), treatments: vec![Default::default(); contacts] }
    }

    /// Nothing yet, in the room there is.
    pub(crate) fn clear(&mut self, contacts: usize) {
        self.methods = Default::default();
        self.treatments.clear();
        self.treatments.resize(contacts, Default::default());
    }

    /// Writes all counts.
    pub(crate) fn write(&self, words: &mut Vec<u64>) {
        words.extend(self.methods);
        self.treatments.iter().for_each(|counts| words.extend(counts));
    }

    /// Reads those of a number of contacts.
    pub(crate) fn read(contacts: usize, words: &mut Words<'_>) -> Option<Self> {
        let mut tally = Self::of(contacts);
        let treatments = tally.treatments.iter_mut().flatten();
        for count in tally.methods.iter_mut().chain(treatments) {
            *count = words.tally()?;
        }
        Some(tally)
    }

    /// Steps, or leaps, taken by a method.
    pub fn steps(&self, method: Method) -> u64 {
        self.methods[method as usize]
    }

    /// Intervals between two events in which a contact, by its place in the scene, was treated so.
    pub fn intervals(&self, contact: usize, treatment: Treatment) -> u64 {
        self.treatments.get(contact).map_or(0, |counts| counts[treatment as usize])
    }

    #[inline(always)]
    pub(crate) fn step(&mut self, method: Method) {
        self.methods[method as usize] += 1;
    }

    #[inline(always)]
    pub(crate) fn interval(&mut self, contact: usize, treatment: Treatment) {
        self.treatments[contact][treatment as usize] += 1;
    }
}
