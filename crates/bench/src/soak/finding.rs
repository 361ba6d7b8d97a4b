//! What became of a scene.

/// How a scene ended; of several runs the last in this order counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// As exact as it was asked for, its books closed.
    Right,
    /// The same, and the program had said beforehand that something is odd.
    Warned,
    /// Refused before anything ran, with the reason.
    Refused,
    /// Ended by name where it left the range of the model.
    Left,
    /// Ended at a limit that the scene set itself.
    Limited,
    /// Neither method is exact enough to judge the other.
    Undecided,
    /// Off by more than its own sensitivity to a change of 1e-9 explains, but not more than that to one of the tolerance's own
    /// size: a contact that grazes.
    Grazing,
    /// Its energy books did not close.
    Unbalanced,
    /// Wrong, and nothing said so.
    Wrong,
    /// Stopped itself.
    Stopped,
    /// Did not end in time.
    Hung,
    /// Panicked.
    Panicked,
}

impl Verdict {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 12] = [
        Self::Right,
        Self::Warned,
        Self::Refused,
        Self::Left,
        Self::Limited,
        Self::Undecided,
        Self::Grazing,
        Self::Unbalanced,
        Self::Wrong,
        Self::Stopped,
        Self::Hung,
        Self::Panicked,
    ];

    /// In tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Warned => "warned",
            Self::Refused => "refused",
            Self::Left => "left the model",
            Self::Limited => "limited",
            Self::Undecided => "undecided",
            Self::Grazing => "grazing",
            Self::Unbalanced => "books open",
            Self::Wrong => "wrong",
            Self::Stopped => "stopped",
            Self::Hung => "hung",
            Self::Panicked => "panicked",
        }
    }

    /// Whether the program is at fault.
    pub fn is_fault(self) -> bool {
        self >= Self::Unbalanced
    }
}

/// What became of the scene of a seed.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Its seed.
    pub seed: u64,
    /// Name of its kind.
    pub kind: &'static str,
    /// How it ended.
    pub verdict: Verdict,
    /// What, where, how far; empty of what is right.
    pub note: String,
    /// Errors at each tolerance against the finest, in natural units; NaN where there is none.
    pub errors: [f64; 2],
    /// Growth S of a change of 1e-9 of the start; 1 where nobody needed to know.
    pub growth: f64,
    /// Largest error of the energy books, in tolerances, parts of the throughput.
    pub books: f64,
    /// Error against a row of springs by fixed steps, in natural units, and that reference's own; NaN where there is none.
    pub row: [f64; 2],
    /// Number of runs, their wall time (s) and that of the longest.
    pub runs: (u32, f64, f64),
    /// Stretches by the whole law in all runs.
    pub detours: u64,
}

impl Finding {
    /// Of a seed of which nothing is known yet.
    pub(super) fn new(seed: u64, kind: &'static str) -> Self {
        Self {
            seed,
            kind,
            verdict: Verdict::Right,
            note: String::new(),
            errors: [f64::NAN; 2],
            growth: 1.0,
            books: 0.0,
            row: [f64::NAN; 2],
            runs: (0, 0.0, 0.0),
            detours: 0,
        }
    }

    /// Something about a run; the worst is kept, of equals the first.
    pub(super) fn turns(&mut self, verdict: Verdict, note: impl FnOnce() -> String) {
        if verdict > self.verdict {
            (self.verdict, self.note) = (verdict, note());
        }
    }

    /// Books the work of a run.
    pub(super) fn took(&mut self, wall: f64, detours: u64) {
        let (runs, sum, longest) = self.runs;
        self.runs = (runs + 1, sum + wall, longest.max(wall));
        self.detours += detours;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_kept_and_the_first_of_equals() {
        let mut finding = Finding::new(3, "slider");
        finding.turns(Verdict::Wrong, || "off".to_owned());
        finding.turns(Verdict::Warned, || "odd".to_owned());
        finding.turns(Verdict::Wrong, || "off again".to_owned());
        assert_eq!((finding.verdict, finding.note.as_str()), (Verdict::Wrong, "off"));
        let faults: Vec<&str> =
            Verdict::ALL.into_iter().filter(|verdict| verdict.is_fault()).map(Verdict::name).collect();
        assert_eq!(faults, ["books open", "wrong", "stopped", "hung", "panicked"]);
    }
}
