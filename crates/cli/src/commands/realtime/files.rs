//! Files of a loop: those that are written while it runs, and its report.

use super::failure::Failure;
use super::stage::Stage;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use stickslip_figures::realtime;
use stickslip_realtime::Report;
use stickslip_realtime::report::{frames_csv, histogram_csv};
use stickslip_realtime::session::Ended;
use stickslip_results::folder::{Folder, draft, sweep};
use tempfile::NamedTempFile;

/// Names of the files of the report.
const REPORT: &str = "realtime.json";
const HISTOGRAM: &str = "histogram.csv";
const FRAMES: &str = "frames.csv";

/// Files that are written while the loop runs; they get their names when it is over.
#[derive(Debug, Default)]
pub(super) struct Drafts(Vec<(NamedTempFile, PathBuf)>);

impl Drafts {
    /// Begins a file.
    pub(super) fn begin(&mut self, path: &Path) -> Result<BufWriter<File>, Failure> {
        let failed = |source| Failure::File { path: path.to_owned(), source };
        let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let name = path.file_name().ok_or_else(|| failed(std::io::ErrorKind::IsADirectory.into()))?;
        let file = draft(folder, &name.to_string_lossy()).map_err(failed)?;
        let writer = file.as_file().try_clone().map_err(failed)?;
        self.0.push((file, path.to_owned()));
        Ok(BufWriter::new(writer))
    }

    /// Gives all of them their names.
    pub(super) fn keep(self) -> Result<(), Failure> {
        self.0.into_iter().try_for_each(|(file, path)| match file.persist(&path) {
            Ok(_) => Ok(()),
            Err(error) => Err(Failure::File { path, source: error.error }),
        })
    }
}

/// Writes the report; returns where it is.
pub(super) fn write(stage: &Stage<'_>, report: &Report, ended: &Ended) -> Result<String, Failure> {
    let at = &stage.job.folder;
    let mut folder = Folder::make(at)?;
    let stale: Vec<String> =
        [REPORT, HISTOGRAM, FRAMES].map(str::to_owned).into_iter().chain(realtime::all_files()).collect();
    // A command that was killed has left its drafts.
    sweep(at, &stale);
    folder.write(REPORT, report.pretty()?.as_bytes())?;
    folder.write(HISTOGRAM, histogram_csv(&ended.timing, &ended.floor).as_bytes())?;
    folder.write(FRAMES, frames_csv(&ended.timing, report.period_s).as_bytes())?;
    for (name, bytes) in realtime::draw(stage.job, report, ended, &stage.arguments.look.look())? {
        folder.write(&name, &bytes)?;
    }
    folder.forget(stale);
    let names = folder.names().join(", ");
    folder.publish()?;
    Ok(format!("{}: {names}", at.display()))
}
