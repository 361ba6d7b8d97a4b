//! Printed report and exit status of a run.

use std::fmt::Display;
use std::io;
use std::path::Path;
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_run::Job;
use stickslip_run::Outcome;
use stickslip_run::Real;
use stickslip_run::complaint::words;
use stickslip_run::outlook::Outlook;
use stickslip_run::quantity;
use stickslip_run::summary::{DriveSummary, Fretting, Losses, SettlingSummary, Status, Summary};

/// Smallest error relative to the step length that is shown.
const SHOWN: f64 = 1e-4;
/// Relative change below which step lengths count as constant.
const EVEN: f64 = 1e-3;
/// Relative growth per period that rounds to 0 %.
const UNSEEN: f64 = 5e-5;

/// Printed report of one scenario.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Report {
    pub(crate) verdict: Verdict,
    /// Text on stdout.
    pub(crate) result: String,
    /// JSON on stdout.
    pub(crate) json: String,
    /// Warnings about the results, on stderr.
    pub(crate) warning: String,
    /// Errors, on stderr.
    pub(crate) error: String,
}

impl Report {
    fn failed(verdict: Verdict, error: String) -> Self {
        Self { verdict, result: String::new(), json: String::new(), warning: String::new(), error }
    }

    /// Report of a rejected scenario.
    pub(crate) fn refused(refusal: &impl Display) -> Self {
        Self::failed(Verdict::BadInput, refusal.to_string())
    }

    /// Report of a scenario that was not run because of an interruption.
    pub(crate) fn skipped(job: &Job) -> Self {
        Self::failed(
            Verdict::Interrupted,
            format!("{}: not run, because the command was interrupted", job.name),
        )
    }

    /// Report of a run whose output folder cannot be created.
    pub(crate) fn no_folder(job: &Job, error: &io::Error) -> Self {
        let folder = job.folder.display();
        let help = "   help: choose another folder with --out";
        Self::failed(
            Verdict::BadInput,
            format!("{}: the folder {folder} cannot be created: {}\n{help}", job.name, words(error)),
        )
    }

    /// Report of a run whose results cannot be written.
    pub(crate) fn not_written(job: &Job, error: &io::Error) -> Self {
        let folder = job.folder.display();
        // Only another command removes the temporary files of a run.
        let help = match error.kind() {
            io::ErrorKind::NotFound => {
                "\n   help: another run has removed the unfinished files in this folder; give each run its own folder with --out"
            }
            io::ErrorKind::ResourceBusy => {
                "\n   help: wait until the other command has ended, or choose another folder with --out"
            }
            _ => "",
        };
        Self::failed(
            Verdict::Stopped,
            format!("{}: the results cannot be written to {folder}: {}{help}", job.name, words(error)),
        )
    }

    /// Adds how to resume a stopped run with a checkpoint.
    pub(crate) fn resumable(mut self, job: &Job, outcome: &Outcome) -> Self {
        let limit = match &outcome.error {
            _ if outcome.excess.is_some() => " --set run.limits.memory=…",
            Some(RunError::OutOfTime { .. }) => " --set run.limits.wall=…",
            Some(RunError::TooManySteps { .. }) => " --set run.limits.steps=…",
            Some(error) if error.is_halt() => "",
            _ => return self,
        };
        self.error += &format!(
            "\n   help: `stickslip run --resume {}{limit}` resumes the run from the last checkpoint",
            job.folder.display()
        );
        self
    }

    /// Adds that plots could not be written.
    pub(crate) fn without_pictures(mut self, job: &Job, failure: Option<io::Error>) -> Self {
        if let Some(failure) = failure {
            let lines = [
                format!("{}: not all plots could be written: {}", job.name, words(&failure)),
                format!(
                    "   help: free disk space, then draw the plots with `stickslip plot {}`",
                    job.folder.display()
                ),
            ];
            self.complain(lines);
            self.verdict = self.verdict.max(Verdict::Stopped);
        }
        self
    }

    /// Report of a run that has written its results.
    pub(crate) fn ended(
        job: &Job,
        (outcome, summary): (&Outcome, &Summary),
        place: &Path,
    ) -> io::Result<Self> {
        let folder = place.display();
        let beside = if place == job.folder {
            String::new()
        } else {
            format!("; the complete results of an earlier run in {} are kept", job.folder.display())
        };
        let (verdict, error) = match (summary.stop(), summary.status) {
            (Some((error, _)), Status::Interrupted) => (
                Verdict::Interrupted,
                format!("{}: {error}; the results so far are in {folder}{beside}", job.name),
            ),
            (Some((error, help)), _) => {
                let message = format!("{}: stopped: {error}\n   help: {help}", job.name);
                (Verdict::Stopped, format!("{message}\n   the results so far are in {folder}"))
            }
            (None, _) => (Verdict::Done, String::new()),
        };
        let result = if verdict == Verdict::Done { result(job, outcome, summary) } else { String::new() };
        let own = summary.warnings.iter().filter(|warning| warning.is_of_results());
        let warnings: Vec<String> = own.map(|warning| format!("warning: {}: {warning}", job.name)).collect();
        Ok(Self { verdict, result, json: summary.line()?, warning: warnings.join("\n"), error })
    }

    /// Adds how well real time was kept.
    pub(crate) fn with_pace(mut self, words: Option<String>) -> Self {
        if let Some(words) = words.filter(|_| !self.result.is_empty()) {
            self.result += &format!("\n  {words}");
        }
        self
    }

    /// Adds that the search for the periodic orbit was interrupted.
    pub(crate) fn without_outlook(mut self, job: &Job) -> Self {
        let folder = job.folder.display();
        let said = "interrupted during the search for the periodic orbit; all other results are in";
        self.complain([format!("{}: {said} {folder}", job.name)]);
        self.verdict = self.verdict.max(Verdict::Interrupted);
        self
    }

    /// Adds error messages.
    fn complain(&mut self, lines: impl IntoIterator<Item = String>) {
        let before = std::mem::take(&mut self.error);
        let all: Vec<String> = [before].into_iter().filter(|said| !said.is_empty()).chain(lines).collect();
        self.error = all.join("\n");
    }

    /// Treats warnings about the results as errors.
    pub(crate) fn judged_strictly(self) -> Self {
        let verdict = if self.warning.is_empty() { self.verdict } else { self.verdict.max(Verdict::Stopped) };
        Self { verdict, ..self }
    }
}

/// Describes the settling of the step length.
fn settling(steps: &DriveSummary) -> String {
    let length = |length: Real| quantity(length, "m");
    let last = length(steps.last());
    match (&steps.settling, &steps.steady) {
        (_, Some(steady)) => {
            let error = Some(steady.error).filter(|e| e.0 > SHOWN * steady.step.0.abs());
            let error = error.map(|error| format!(" ± {}", length(error))).unwrap_or_default();
            let back = back_step(&steady.losses);
            let step = length(steady.step);
            format!("steady step {step}{error}, settled from period {}{back}", steady.from + 1)
        }
        (SettlingSummary::NotSettled { change_m: None, .. }, _) => {
            format!("not settled: the run has only one step, of {last}")
        }
        (SettlingSummary::NotSettled { change_m: Some(change), limit_m, limit_error_m }, _) => {
            let limit = limit_m.zip(*limit_error_m);
            let limit = limit.map(|(l, e)| format!(", extrapolated limit {} ± {}", length(l), length(e)));
            let limit = limit.unwrap_or_default();
            format!("not settled: the step of {last} changes by {} per period{limit}", length(*change))
        }
        (SettlingSummary::Irregular { spread_m }, _) => {
            format!("not settled: step lengths vary by ± {} without a pattern", length(*spread_m))
        }
        (SettlingSummary::Drifts { change_m }, _) if change_m.0.abs() <= EVEN * steps.last().0.abs() => {
            format!("drifts: the body moves away by {last} per period")
        }
        (SettlingSummary::Drifts { change_m }, _) => {
            format!("drifts: the step of {last} changes by {} per period", length(*change_m))
        }
        (SettlingSummary::Beats { periods, growth, mean_m, amplitude_m }, _) => {
            let growth = growth.filter(|growth| growth.0.abs() >= UNSEEN).map(|growth| {
                let how = if growth.0 < 0.0 { "decaying" } else { "growing" };
                format!(", {how} by {:.2} % per period", 100.0 * growth.0.abs())
            });
            let (about, amplitude) = (length(*mean_m), length(*amplitude_m));
            let growth = growth.unwrap_or_default();
            format!(
                "the step oscillates about {about} with an amplitude of {amplitude} and a period of about {:.1} drive periods{growth}",
                periods.0
            )
        }
        (SettlingSummary::Settled, None) => "settled".to_owned(),
    }
}

/// Describes the back-step and its fraction of the forward motion.
fn back_step(losses: &Losses) -> String {
    let share = losses.back_step.map(|share| format!(" ({:.1} %)", 100.0 * share.0)).unwrap_or_default();
    match losses.back_step_length {
        Real(0.0) => ", no back-step".to_owned(),
        fall => format!(", back-step {}{share}", quantity(fall, "m")),
    }
}

/// Describes the periodic orbit.
fn lasting(outlook: &Outlook) -> String {
    match outlook {
        Outlook::Found(motion) => {
            format!("periodic orbit: {}; a disturbance {}", motion.step_words(), motion.words)
        }
        Outlook::NotFound { fault } => fault.clone(),
    }
}

/// Describes the last cycle of a contact.
fn cycle(fretting: &Fretting) -> String {
    let energy = |energy: Real| quantity(energy, "J");
    if fretting.regime == Some("still") {
        return "the contact stands still".to_owned();
    }
    if !fretting.closed {
        let friction = energy(fretting.friction_work());
        return format!("the last cycle is not closed; the friction work is {friction}");
    }
    let regime = match fretting.regime {
        Some("stick") => "stick, ".to_owned(),
        Some(regime) => format!("{regime} slip, "),
        None => String::new(),
    };
    match (fretting.dissipated, fretting.damping) {
        (Some(lost), Some(damping)) => {
            format!("{regime}{} dissipated per cycle, {} of it by damping", energy(lost), energy(damping))
        }
        (Some(lost), None) => format!("{regime}{} dissipated per cycle", energy(lost)),
        (None, _) => format!("{regime}{} dissipated by friction per cycle", energy(fretting.friction_work())),
    }
}

/// Returns the text of a complete run: the main results first, then the files.
fn result(job: &Job, outcome: &Outcome, summary: &Summary) -> String {
    let (simulated, wall) = (quantity(summary.simulated, "s"), quantity(Real(outcome.wall), "s"));
    let steady = summary.steady_after.map(|periods| format!(", steps constant after {periods} periods"));
    let mut lines =
        vec![format!("{}: {simulated} simulated in {wall}{}", job.name, steady.unwrap_or_default())];
    if let Some(steps) = &summary.steps {
        lines.push(format!("  {}, mean speed {}", settling(steps), quantity(steps.mean_speed, "m/s")));
        lines.extend(steps.oddity().iter().map(|line| format!("    {line}")));
        // If the step has settled, an unsuccessful search for the periodic orbit is not mentioned.
        let outlook =
            summary.outlook().filter(|it| matches!(it, Outlook::Found(_)) || steps.steady.is_none());
        lines.extend(outlook.map(|outlook| format!("  {}", lasting(outlook))));
    }
    lines.extend(summary.driver_limits().map(|line| format!("  {line}")));
    for (name, contact) in &summary.contacts.0 {
        if let Some(fretting) = &contact.fretting {
            lines.push(format!("  {name}: {}", cycle(fretting)));
        } else if let (None, Some(since)) = (&summary.steps, contact.at_rest_since) {
            lines.push(format!("  {name}: at rest since {}", quantity(since, "s")));
        }
    }
    lines.extend(summary.printed_notes().map(|note| format!("  {note}")));
    lines.push(format!("  {}: {}", job.folder.display(), summary.files().join(", ")));
    lines.join("\n")
}
