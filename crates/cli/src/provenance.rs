//! What a picture says about where it comes from, unseen.

use crate::job::Job;
use crate::kept::Kept;

/// Where the pictures of a job's results come from: keys and texts.
pub(crate) fn provenance(job: &Job, kept: &Kept) -> Vec<(String, String)> {
    let (stepper, word, value) = job.stepper();
    let entries = [
        ("Title", job.title().to_owned()),
        ("Software", job.program.clone()),
        ("Scenario SHA-256", job.hash.clone()),
        ("Stepper", stepper.to_owned()),
        (if word == "tolerance" { "Tolerance" } else { "Step/s" }, format!("{value:?}")),
        ("Simulated/s", format!("{:?}", kept.end())),
        ("Scenario", job.resolved.clone()),
    ];
    entries.map(|(key, text)| (key.to_owned(), text)).to_vec()
}
