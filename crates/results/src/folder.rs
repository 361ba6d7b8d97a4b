//! The folder of a run: its files appear together, each whole.

use crate::checkpoint;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Letters and digits at the end of a draft's name, drawn anew until there is no such file.
const DRAWN: usize = 6;

/// A folder under construction. Every file is written under a temporary name beside its place, flushed, and renamed at
/// the end: after a crash there is the old file or the whole new one.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    staged: Vec<(String, NamedTempFile)>,
    /// Files of an earlier run that must not be taken for this one's.
    stale: Vec<String>,
    /// Whether that holds of its checkpoint as well.
    stale_checkpoint: bool,
}

impl Folder {
    /// Makes the folder if it is not there.
    ///
    /// # Errors
    /// What the system says.
    pub fn make(path: &Path) -> io::Result<Self> {
        fs::create_dir_all(path)?;
        Ok(Self { path: path.to_owned(), staged: Vec::new(), stale: Vec::new(), stale_checkpoint: false })
    }

    /// Files that go when the others appear, unless they are among them.
    pub fn forget(&mut self, names: Vec<String>) {
        self.stale = names;
    }

    /// The checkpoint of an earlier run goes, too.
    pub fn forget_checkpoint(&mut self) {
        self.stale_checkpoint = true;
    }

    /// An empty file beside the place of `name`.
    ///
    /// # Errors
    /// What the system says.
    pub fn draft(&self, name: &str) -> io::Result<NamedTempFile> {
        draft(&self.path, name)
    }

    /// Takes a written draft as the file `name`; it appears with [`Self::publish`].
    ///
    /// # Errors
    /// What the system says of writing it through.
    pub fn stage(&mut self, name: &str, mut file: NamedTempFile) -> io::Result<()> {
        file.flush()?;
        file.as_file().sync_all()?;
        self.staged.push((name.to_owned(), file));
        Ok(())
    }

    /// Writes a whole file; it appears with [`Self::publish`].
    ///
    /// # Errors
    /// What the system says.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut file = self.draft(name)?;
        file.write_all(bytes)?;
        self.stage(name, file)
    }

    /// Where a file lies now: its draft, or else its place.
    pub fn place(&self, name: &str) -> PathBuf {
        let draft = self.staged.iter().find(|(staged, _)| staged == name);
        draft.map_or_else(|| self.path.join(name), |(_, file)| file.path().to_owned())
    }

    /// Names staged so far.
    pub fn names(&self) -> Vec<String> {
        self.staged.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Gives all files their names, in the order they were staged.
    ///
    /// # Errors
    /// What the system says; the files before the one it says it of have their names.
    pub fn publish(self) -> io::Result<()> {
        for stale in &self.stale {
            if !self.staged.iter().any(|(name, _)| name == stale) {
                match fs::remove_file(self.path.join(stale)) {
                    Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                    _ => {}
                }
            }
        }
        if self.stale_checkpoint {
            checkpoint::remove(&self.path)?;
        }
        for (name, file) in self.staged {
            file.persist(self.path.join(name)).map_err(|error| error.error)?;
        }
        Ok(())
    }
}

/// Writes one whole file.
///
/// # Errors
/// What the system says; the file is then as it was.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = draft(folder, &path.file_name().unwrap_or_default().to_string_lossy())?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// An empty file under a temporary name in a folder.
///
/// # Errors
/// What the system says.
pub fn draft(folder: &Path, name: &str) -> io::Result<NamedTempFile> {
    let prefix = format!(".{name}-");
    let mut builder = Builder::new();
    builder.prefix(&prefix).rand_bytes(DRAWN);
    // Results are for everybody whom the user's mask lets read; temporary files are for nobody else by default.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

/// Removes what runs that were killed have left of drafts of these names. What cannot be removed stays: it is in nobody's way.
pub fn sweep(folder: &Path, names: &[impl AsRef<str>]) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_draft = entry
            .file_name()
            .to_str()
            .is_some_and(|found| names.iter().any(|name| is_draft_of(found, name.as_ref())));
        if is_draft && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether a name is one that [`draft`] gives.
fn is_draft_of(found: &str, name: &str) -> bool {
    let end = found.strip_prefix('.').and_then(|rest| rest.strip_prefix(name)?.strip_prefix('-'));
    end.is_some_and(|end| end.len() == DRAWN && end.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listing(path: &Path) -> Vec<String> {
        let entries = fs::read_dir(path).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = entries.collect();
        names.sort();
        names
    }

    #[test]
    fn files_appear_together_and_stale_ones_go() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a/b");
        let mut folder = Folder::make(&path).unwrap();
        fs::write(path.join("loop.png"), "old").unwrap();
        fs::write(path.join("mine.txt"), "kept").unwrap();
        folder.forget(vec!["loop.png".to_owned(), "none.png".to_owned(), "trace.csv".to_owned()]);
        folder.write("trace.csv", b"t\n").unwrap();
        assert!(!path.join("trace.csv").exists());
        folder.publish().unwrap();
        assert_eq!(listing(&path), ["mine.txt", "trace.csv"]);
        assert_eq!(fs::read(path.join("trace.csv")).unwrap(), b"t\n");
    }

    #[test]
    fn only_drafts_of_known_names_are_swept() {
        let root = tempfile::tempdir().unwrap();
        let left = draft(root.path(), "trace.csv").unwrap().keep().unwrap().1;
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
        sweep(root.path(), &["events.csv"]);
        assert!(left.exists());
        sweep(root.path(), &["events.csv", "trace.csv"]);
        assert!(!left.exists());
        assert_eq!(listing(root.path()).len(), others.len() + 1);
    }

    #[test]
    fn nothing_is_left_of_what_was_not_published() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = Folder::make(root.path()).unwrap();
        folder.write("trace.csv", b"t\n").unwrap();
        drop(folder);
        assert!(listing(root.path()).is_empty());
    }
}
