//! Counts of integration methods and treatments of contacts in a run.
//!
//! Each accepted step counts once for its method, each interval once for every contact. A resumed run continues the counts.

use super::{Method, Treatment};
use stickslip_contact::Words;

/// Number of uses of each integration method and of each treatment of contacts.
#[derive(Debug, PartialEq, Eq, Default)]
pub struct Tally {
    methods: [u64; Method::ALL.len()],
    /// Number of intervals by contact and treatment.
    treatments: Vec<[u64; Treatment::ALL.len()]>,
}

impl Clone for Tally {
    fn clone(&self) -> Self {
        Self { methods: self.methods, treatments: self.treatments.clone() }
    }

    /// Reuses the memory.
    fn clone_from(&mut self, from: &Self) {
        self.methods = from.methods;
        self.treatments.clone_from(&from.treatments);
    }
}

impl Method {
    /// All methods.
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

    /// Returns the name of the method in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Walk => "steps along the path",
            Self::Swing => "closed form from event to event",
            Self::Parabola => "parabola",
            Self::Nystrom => "Runge–Kutta–Nyström 8(6)",
            Self::BriefNystrom => "Nyström 5",
            Self::DormandPrince => "Dormand–Prince 8(5,3)",
            Self::Brief => "Dormand–Prince 5(4)",
            Self::Radau => "Radau IIA 9, implicit",
            Self::Graded => "graded Dormand–Prince 8(5,3)",
            Self::Whole => "step doubling on the full force law",
            Self::AskedFor => "stepper of the scenario",
        }
    }
}

impl Treatment {
    /// All treatments.
    pub const ALL: [Self; 4] = [Self::Spared, Self::Apart, Self::Closed, Self::General];
}

impl Tally {
    /// Returns counts of zero for a number of contacts.
    pub(crate) fn of(contacts: usize) -> Self {
        Self { methods: Default::default(), treatments: vec![Default::default(); contacts] }
    }

    /// Resets the counts and reuses the allocated memory.
    pub(crate) fn clear(&mut self, contacts: usize) {
        self.methods = Default::default();
        self.treatments.clear();
        self.treatments.resize(contacts, Default::default());
    }

    /// Appends all counts to `words`.
    pub(crate) fn write(&self, words: &mut Vec<u64>) {
        words.extend(self.methods);
        self.treatments.iter().for_each(|counts| words.extend(counts));
    }

    /// Reads the counts for a number of contacts; `None` if they are incomplete.
    pub(crate) fn read(contacts: usize, words: &mut Words<'_>) -> Option<Self> {
        let mut tally = Self::of(contacts);
        let treatments = tally.treatments.iter_mut().flatten();
        for count in tally.methods.iter_mut().chain(treatments) {
            *count = words.tally()?;
        }
        Some(tally)
    }

    /// Returns the number of steps by an integration method.
    pub fn steps(&self, method: Method) -> u64 {
        self.methods[method as usize]
    }

    /// Returns the number of intervals in which a contact, given by its index, had a treatment.
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
