//! Output files of a real-time loop: those written during the loop, and the report.

use super::failure::Failure;
use super::stage::Stage;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use stickslip_figures::realtime;
use stickslip_realtime::Report;
use stickslip_realtime::report::{frames_csv, histogram_csv};
use stickslip_realtime::session::Ended;
use stickslip_run::complaint::words;
use stickslip_run::folder::{Folder, draft, sweep};
use tempfile::NamedTempFile;

/// File names of the report.
const REPORT: &str = "realtime.json";
const HISTOGRAM: &str = "histogram.csv";
const FRAMES: &str = "frames.csv";
/// Reserved disk space for the report, bytes.
const RESERVE: usize = 1 << 16;

/// Files written during the loop. They receive their names when the loop has ended.
#[derive(Debug, Default)]
pub(super) struct Drafts {
    files: Vec<(NamedTempFile, PathBuf)>,
    /// Input files of the command, which must not be replaced.
    read: Vec<PathBuf>,
    /// Files of the report.
    reported: Vec<PathBuf>,
}

impl Drafts {
    /// Starts without files. `read` are the input files of the command, `report` is the folder of the report.
    pub(super) fn beside<'p>(read: impl IntoIterator<Item = &'p Path>, report: &Path) -> Self {
        let read = read.into_iter().filter_map(|path| path.canonicalize().ok()).collect();
        let reported = report.canonicalize().map(|at| names().iter().map(|name| at.join(name)).collect());
        Self { read, reported: reported.unwrap_or_default(), ..Self::default() }
    }

    /// Creates a file.
    pub(super) fn begin(&mut self, path: &Path) -> Result<BufWriter<File>, Failure> {
        let failed = |source| Failure::File { path: path.to_owned(), source };
        let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let name = path.file_name().ok_or_else(|| failed(std::io::ErrorKind::IsADirectory.into()))?;
        // A file replaces what is at its path, which must not be a device, a pipe or a link.
        match path.symlink_metadata() {
            Ok(there) if there.is_dir() => return Err(failed(std::io::ErrorKind::IsADirectory.into())),
            Ok(there) if !there.is_file() => return Err(Failure::NoPlainFile(path.to_owned())),
            _ => {}
        }
        let at = folder.canonicalize().map_err(failed)?.join(name);
        if self.read.contains(&at) {
            return Err(Failure::IsRead(path.to_owned()));
        }
        if self.reported.contains(&at) || self.files.iter().any(|(_, known)| *known == at) {
            return Err(Failure::Twice(path.to_owned()));
        }
        let file = draft(folder, &name.to_string_lossy()).map_err(failed)?;
        let writer = file.as_file().try_clone().map_err(failed)?;
        self.files.push((file, at));
        Ok(BufWriter::new(writer))
    }

    /// Gives all files their names.
    ///
    /// # Errors
    /// Fails if files cannot be renamed; they are deleted, the others are kept.
    pub(super) fn keep(self) -> Result<(), Failure> {
        let name = |(file, path): (NamedTempFile, PathBuf)| {
            let error = file.persist(&path).err()?.error;
            Some(format!("{}: {}", path.display(), words(&error)))
        };
        let lost: Vec<String> = self.files.into_iter().filter_map(name).collect();
        if lost.is_empty() { Ok(()) } else { Err(Failure::Cut(lost.join("; "))) }
    }
}

/// Returns the names of all files of the report.
fn names() -> Vec<String> {
    [REPORT, HISTOGRAM, FRAMES].map(str::to_owned).into_iter().chain(realtime::all_files()).collect()
}

/// Returns the folder of the report with reserved disk space.
pub(super) fn ready(stage: &Stage<'_>) -> Result<Folder, Failure> {
    Ok(Folder::ready(&stage.job.folder, RESERVE)?)
}

/// Writes the report. Returns its folder and file names.
pub(super) fn write(
    mut folder: Folder,
    stage: &Stage<'_>,
    report: &Report,
    ended: &Ended,
) -> Result<String, Failure> {
    let (at, stale) = (&stage.job.folder, names());
    folder.release();
    // An interrupted command may have left temporary files.
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[cfg(unix)]
    #[test]
    fn neither_what_is_read_nor_what_is_no_file_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let [scene, link] = ["scene.json", "link"].map(|name| folder.path().join(name));
        std::fs::write(&scene, "scene").unwrap();
        std::os::unix::fs::symlink(&scene, &link).unwrap();
        let mut drafts = Drafts::beside([scene.as_path()], folder.path());
        let report = folder.path().join(REPORT);
        assert!(matches!(drafts.begin(&report), Err(Failure::Twice(_))));
        assert!(matches!(drafts.begin(&scene), Err(Failure::IsRead(_))));
        assert!(matches!(drafts.begin(&link), Err(Failure::NoPlainFile(_))));
        assert!(matches!(drafts.begin(Path::new("/dev/null")), Err(Failure::NoPlainFile(_))));
        assert_eq!(std::fs::read(&scene).unwrap(), b"scene");
    }

    #[test]
    fn what_cannot_be_kept_is_told_and_the_others_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let paths = ["a", "b"].map(|name| folder.path().join(name));
        let mut drafts = Drafts::default();
        paths.iter().for_each(|path| drafts.begin(path).unwrap().write_all(b"words").unwrap());
        std::fs::create_dir(&paths[0]).unwrap();
        std::fs::write(paths[0].join("c"), "").unwrap();
        let failure = drafts.keep().unwrap_err();
        assert!(matches!(&failure, Failure::Cut(words) if words.contains("/a: ")), "{failure}");
        assert_eq!(std::fs::read(&paths[1]).unwrap(), b"words");
    }
}
