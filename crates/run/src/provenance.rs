//! Metadata of plots: the origin of the data.

use crate::job::Job;
use crate::kept::Kept;

/// Key of the title.
pub const TITLE: &str = "Title";
/// Key of the program that computed the results.
pub const PROGRAM: &str = "Software";
/// Key of the hash of the scenario.
pub const HASH: &str = "Scenario SHA-256";
/// Key of the time reached.
pub const END: &str = "Simulated/s";
/// Key of the resolved scenario.
pub const SCENARIO: &str = "Scenario";
/// Key of the fingerprint of the tables.
pub const FINGERPRINT: &str = "Fingerprint";

/// Returns the metadata of the plots of a job as pairs of keys and texts.
pub fn provenance(job: &Job, kept: &Kept) -> Vec<(String, String)> {
    let (stepper, word, value) = job.stepper();
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, job.program.clone()),
        (HASH, job.hash.clone()),
        ("Stepper", stepper.to_owned()),
        (if word == "tolerance" { "Tolerance" } else { "Step/s" }, format!("{value:?}")),
        (END, format!("{:?}", kept.end())),
        (SCENARIO, job.resolved.clone()),
        (FINGERPRINT, kept.fingerprint().text()),
    ];
    entries.map(|(key, text)| (key.to_owned(), text)).to_vec()
}
