//! Verdict about a random scenario.

/// Verdict about a scenario. Of several runs, the last verdict in this order counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// Within the tolerance, with a satisfied energy balance.
    Right,
    /// As [`Self::Right`], with a warning before the run.
    Warned,
    /// Refused before the run, with the reason.
    Refused,
    /// Ended with a named error where it left the range of the model.
    Left,
    /// Ended at a limit of the scenario.
    Limited,
    /// Undecided: neither method is accurate enough to judge the other.
    Undecided,
    /// Deviation explained by the growth of a perturbation of the tolerance's size, but not by that of a perturbation of 1e-9. This happens
    /// for grazing contacts.
    Grazing,
    /// Energy balance violated.
    Unbalanced,
    /// Wrong result without an error message.
    Wrong,
    /// Stopped with an error.
    Stopped,
    /// Not finished in time.
    Hung,
    /// The program panicked.
    Panicked,
}

impl Verdict {
    /// All verdicts in the order of tables.
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

    /// Returns the name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Warned => "warned",
            Self::Refused => "refused",
            Self::Left => "left the model",
            Self::Limited => "limited",
            Self::Undecided => "undecided",
            Self::Grazing => "grazing",
            Self::Unbalanced => "unbalanced",
            Self::Wrong => "wrong",
            Self::Stopped => "stopped",
            Self::Hung => "hung",
            Self::Panicked => "panicked",
        }
    }

    /// Returns whether the verdict is a fault of the program.
    pub fn is_fault(self) -> bool {
        self >= Self::Unbalanced
    }
}

/// Result for the scenario of a seed.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Seed.
    pub seed: u64,
    /// Name of the kind of scenario.
    pub kind: &'static str,
    /// Verdict.
    pub verdict: Verdict,
    /// Message; empty for right scenarios.
    pub note: String,
    /// Errors at the two coarser tolerances relative to the finest, in natural units; NaN if unknown.
    pub errors: [f64; 2],
    /// Growth factor S of a perturbation of the start by 1e-9; 1 if it was not needed.
    pub growth: f64,
    /// Largest error of the energy balance relative to the energy throughput, in tolerances.
    pub books: f64,
    /// Error relative to a row of springs with fixed steps, in natural units, and the own error of that method; NaN if unknown.
    pub row: [f64; 2],
    /// Number of runs, total wall time (s), wall time of the longest run (s).
    pub runs: (u32, f64, f64),
    /// Number of intervals integrated with the full force law, in all runs.
    pub detours: u64,
}

impl Finding {
    /// Returns an empty finding for a seed.
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

    /// Records a verdict. The worst verdict is kept; of equal verdicts, the first.
    pub(super) fn turns(&mut self, verdict: Verdict, note: impl FnOnce() -> String) {
        if verdict > self.verdict {
            (self.verdict, self.note) = (verdict, note());
        }
    }

    /// Adds wall time and counts of a run.
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
        assert_eq!(faults, ["unbalanced", "wrong", "stopped", "hung", "panicked"]);
    }
}
