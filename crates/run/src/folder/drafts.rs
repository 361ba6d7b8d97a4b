//! Temporary files for results, created in the folder of the final file.

use std::fs::{self, DirEntry, File, TryLockError};
use std::io;
use std::path::Path;
use std::time::Duration;
use tempfile::{Builder, NamedTempFile};

/// Number of random characters at the end of a temporary name.
const DRAWN: usize = 6;

/// Age at which an unlocked temporary file counts as abandoned, on file systems without locks.
const LEFT: Duration = Duration::from_secs(60);

/// Creates an empty temporary file in a folder and locks it while it is open.
///
/// Unlocked temporary files of the same name were left by killed commands and are removed.
///
/// # Errors
/// An error of the operating system.
pub fn draft(folder: &Path, name: &str) -> io::Result<NamedTempFile> {
    sweep(folder, &[name]);
    let prefix = format!(".{name}-");
    let mut builder = Builder::new();
    builder.prefix(&prefix).rand_bytes(DRAWN);
    // Temporary files have restricted permissions by default. Results should follow the umask of the user.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    // Without locks, the file is not protected.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Removes temporary files that killed commands left for the files `names`. Files that are in use are kept.
pub fn sweep(folder: &Path, names: &[impl AsRef<str>]) {
    for entry in drafts(folder, names).filter(|entry| !is_written(entry)) {
        let _ = fs::remove_file(entry.path());
    }
}

/// Returns whether a file is open in another command. Without file locks, a file modified within the last minute counts as open.
fn is_written(entry: &DirEntry) -> bool {
    let Ok(file) = File::open(entry.path()) else { return false };
    match file.try_lock() {
        Ok(()) => false,
        Err(TryLockError::WouldBlock) => true,
        Err(TryLockError::Error(_)) => {
            let touched = entry.metadata().and_then(|found| found.modified());
            touched.is_ok_and(|touched| touched.elapsed().is_ok_and(|age| age < LEFT))
        }
    }
}

/// Returns whether the folder contains temporary files for the files `names`.
pub(crate) fn has_drafts(folder: &Path, names: &[impl AsRef<str>]) -> bool {
    drafts(folder, names).next().is_some()
}

fn drafts(folder: &Path, names: &[impl AsRef<str>]) -> impl Iterator<Item = DirEntry> {
    let is_draft = |entry: &DirEntry| {
        let is_named = |found: &str| names.iter().any(|name| is_draft_of(found, name.as_ref()));
        entry.file_name().to_str().is_some_and(is_named) && entry.file_type().is_ok_and(|kind| kind.is_file())
    };
    fs::read_dir(folder).into_iter().flatten().flatten().filter(is_draft)
}

/// Returns whether a file name has the form that [`draft`] creates.
fn is_draft_of(found: &str, name: &str) -> bool {
    let end = found.strip_prefix('.').and_then(|rest| rest.strip_prefix(name)?.strip_prefix('-'));
    end.is_some_and(|end| end.len() == DRAWN && end.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_drafts_of_known_names_are_swept() {
        let root = tempfile::tempdir().unwrap();
        let left = draft(root.path(), "trace.csv").unwrap().keep().unwrap().1;
        let sweep = |names: &[&str]| sweep(root.path(), names);
        let others = [
            ".trace.csv-mine",
            ".trace.csv-ab12cd3",
            ".trace.csv_ab12cd",
            ".notes.csv-ab12cd",
            "trace.csv-ab12cd",
        ];
        others.iter().for_each(|name| fs::write(root.path().join(name), "").unwrap());
        fs::create_dir(root.path().join(".trace.csv-folder")).unwrap();
        assert!(left.exists());
        sweep(&["events.csv"]);
        assert!(left.exists());
        sweep(&["events.csv", "trace.csv"]);
        assert!(!left.exists());
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), others.len() + 1);
    }

    #[test]
    fn what_another_command_is_writing_stays() {
        let root = tempfile::tempdir().unwrap();
        let left = draft(root.path(), "events.csv").unwrap().keep().unwrap().1;
        let own = draft(root.path(), "trace.csv").unwrap();
        assert!(left.exists());
        sweep(root.path(), &["events.csv", "trace.csv"]);
        assert!(!left.exists() && own.path().exists());
    }

    #[test]
    fn whoever_writes_a_file_again_takes_away_what_is_left_of_it() {
        let root = tempfile::tempdir().unwrap();
        let left = draft(root.path(), "loop.png").unwrap().keep().unwrap().1;
        super::super::write(&root.path().join("loop.png"), b"new").unwrap();
        assert!(!left.exists());
    }
}
