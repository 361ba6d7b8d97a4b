//! Atomic publishing of a results folder.
//!
//! No system call renames several files at once. Therefore the summary marks complete results. The summary is removed first and written
//! last. At any time the folder contains the old results, the new results, or no summary. A folder without a summary is not read.

mod drafts;

pub(crate) use drafts::has_drafts;
pub use drafts::{draft, sweep};

use crate::checkpoint;
use crate::disk::{Disk, System};
use crate::files::{
    BRANCH, CURVE, MAP, PARTIAL_BRANCH, PARTIAL_CURVE, PARTIAL_SENSITIVITY, SENSITIVITY, STEADY, SUMMARY,
};
use crate::theory::CONTACT;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Files that are published last and show that all other files of a result are complete.
const SUMMARIES: [&str; 10] = [
    SUMMARY,
    CONTACT,
    STEADY,
    BRANCH,
    PARTIAL_BRANCH,
    CURVE,
    PARTIAL_CURVE,
    MAP,
    SENSITIVITY,
    PARTIAL_SENSITIVITY,
];

/// A results folder under construction.
///
/// Every file is written under a temporary name in the folder, flushed to disk, and renamed at the end. After a crash either the old file
/// or the complete new file exists.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Folders that were created: the folder itself first, then its parents.
    made: Vec<PathBuf>,
    staged: Vec<(String, NamedTempFile)>,
    /// Files of an earlier run that are removed at the end.
    stale: Vec<String>,
    /// Whether the checkpoint of an earlier run is removed, too.
    stale_checkpoint: bool,
    /// Reserved disk space, which is released when the disk is full.
    reserve: Option<File>,
    /// Lock of the folder against other commands. `None` if the file system has no locks.
    lock: Option<File>,
    disk: Box<dyn Disk>,
}

impl Folder {
    /// Creates the folder if necessary and locks it against other commands.
    ///
    /// # Errors
    /// `ResourceBusy` if another command is writing to the folder, or an error of the operating system.
    pub fn make(path: &Path) -> io::Result<Self> {
        Self::on(path, Box::new(System))
    }

    /// Creates a folder for results that are written much later, and checks that it is writable.
    ///
    /// `bytes` of disk space are reserved until [`Self::release`]. A folder that was created is removed again if nothing is written.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn ready(path: &Path, bytes: usize) -> io::Result<Self> {
        let mut folder = Self::make(path)?;
        folder.reserve(bytes)?;
        Ok(folder)
    }

    fn on(path: &Path, disk: Box<dyn Disk>) -> io::Result<Self> {
        let is_there = |folder: &&Path| folder.as_os_str().is_empty() || folder.exists();
        let made = path.ancestors().take_while(|folder| !is_there(folder)).map(Path::to_owned).collect();
        fs::create_dir_all(path)?;
        let lock = lock(path)?;
        let (staged, stale) = (Vec::new(), Vec::new());
        let (path, stale_checkpoint, reserve) = (path.to_owned(), false, None);
        Ok(Self { path, made, staged, stale, stale_checkpoint, reserve, lock, disk })
    }

    /// Returns the path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Redirects the staged and all later files to the folder `path`. The previous folder remains unchanged.
    ///
    /// # Errors
    /// The same errors as for [`Self::make`].
    pub fn divert(&mut self, path: &Path) -> io::Result<()> {
        let mut other = Self::make(path)?;
        (self.path, self.made) = (path.to_owned(), std::mem::take(&mut other.made));
        self.lock = other.lock.take();
        Ok(())
    }

    /// Reserves disk space for the files that are written last, by an unnamed file that is deleted when the program ends.
    ///
    /// # Errors
    /// The disk space is not available, or another error of the operating system.
    pub fn reserve(&mut self, bytes: usize) -> io::Result<()> {
        self.reserve = Some(self.spare(bytes)?);
        Ok(())
    }

    /// Reserves disk space and returns an unnamed file that occupies it. Dropping the file releases the space.
    pub(crate) fn spare(&self, bytes: usize) -> io::Result<File> {
        let mut file = tempfile::tempfile_in(&self.path)?;
        file.write_all(&vec![0; bytes])?;
        Ok(file)
    }

    /// Releases the reserved disk space.
    pub fn release(&mut self) {
        self.reserve = None;
    }

    /// Marks files that are removed when the results are published, unless the results contain them.
    pub fn forget(&mut self, names: Vec<String>) {
        self.stale = names;
    }

    /// Marks the checkpoint of an earlier run for removal when the results are published.
    pub fn forget_checkpoint(&mut self) {
        self.stale_checkpoint = true;
    }

    /// Creates an empty temporary file for the file `name`.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn draft(&self, name: &str) -> io::Result<NamedTempFile> {
        draft(&self.path, name)
    }

    /// Flushes a temporary file to disk and stages it. [`Self::publish`] renames staged files to `name`.
    ///
    /// # Errors
    /// The file cannot be flushed to disk.
    pub fn stage(&mut self, name: &str, mut file: NamedTempFile) -> io::Result<()> {
        file.flush()?;
        self.disk.sync(file.as_file())?;
        self.staged.push((name.to_owned(), file));
        Ok(())
    }

    /// Writes `bytes` to a temporary file and stages it. [`Self::publish`] renames staged files to `name`.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut file = self.draft(name)?;
        self.disk.write(&mut file, bytes)?;
        self.stage(name, file)
    }

    /// Returns the current path of a file: the path of the temporary file if it is staged, or else the final path.
    pub fn place(&self, name: &str) -> PathBuf {
        let draft = self.staged.iter().find(|(staged, _)| staged == name);
        draft.map_or_else(|| self.path.join(name), |(_, file)| file.path().to_owned())
    }

    /// Returns the names of the staged files.
    pub fn names(&self) -> Vec<String> {
        self.staged.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Renames all staged files to their final names.
    ///
    /// An existing summary is removed first. The new summary is renamed last, when all other files are on disk.
    ///
    /// # Errors
    /// An error of the operating system. Some files may have been renamed, but there is no summary.
    pub fn publish(mut self) -> io::Result<()> {
        let is_summary = |(name, _): &(String, NamedTempFile)| SUMMARIES.contains(&name.as_str());
        let summary = self.staged.iter().position(is_summary).map(|place| self.staged.remove(place));
        // After a power failure, the old summary must not exist together with new tables.
        if let Some((name, _)) = &summary
            && self.remove(name)?
        {
            self.disk.sync_folder(&self.path)?;
        }
        for stale in &self.stale {
            if stale != SUMMARY && !self.staged.iter().any(|(name, _)| name == stale) {
                self.remove(stale)?;
            }
        }
        for (name, file) in std::mem::take(&mut self.staged) {
            self.disk.rename(file, &self.path.join(name))?;
        }
        self.disk.sync_folder(&self.path)?;
        if let Some((name, file)) = summary {
            self.disk.rename(file, &self.path.join(name))?;
            self.disk.sync_folder(&self.path)?;
        }
        if self.stale_checkpoint { checkpoint::remove(&self.path) } else { Ok(()) }
    }

    /// Removes a file. Returns whether the file existed.
    fn remove(&self, name: &str) -> io::Result<bool> {
        match self.disk.remove(&self.path.join(name)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            result => result.map(|()| true),
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if !self.made.is_empty() {
            self.staged.clear();
            // Folders that contain other files are kept.
            let _ = self.made.iter().try_for_each(fs::remove_dir);
        }
    }
}

/// Locks a folder. Returns `None` if the file system has no locks.
fn lock(path: &Path) -> io::Result<Option<File>> {
    let Ok(folder) = File::open(path) else { return Ok(None) };
    match folder.try_lock() {
        Ok(()) => Ok(Some(folder)),
        Err(TryLockError::WouldBlock) => {
            Err(io::Error::new(io::ErrorKind::ResourceBusy, "another command is writing into this folder"))
        }
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// Returns whether a folder contains the results of a completed run.
#[must_use]
pub fn is_complete(path: &Path) -> bool {
    let summary = crate::guard::json(&path.join(SUMMARY));
    summary.is_ok_and(|summary| summary.get("status").and_then(serde_json::Value::as_str) == Some("done"))
}

/// Writes one file atomically.
///
/// # Errors
/// An error of the operating system. The previous file remains unchanged.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = draft(folder, &path.file_name().unwrap_or_default().to_string_lossy())?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

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
    fn two_do_not_write_into_one_folder() {
        let root = tempfile::tempdir().unwrap();
        let mut first = Folder::make(root.path()).unwrap();
        let busy = Folder::make(root.path()).unwrap_err();
        assert_eq!(busy.kind(), io::ErrorKind::ResourceBusy);
        first.divert(&root.path().join("aside")).unwrap();
        let second = Folder::make(root.path()).unwrap();
        first.write("trace.csv", b"t\n").unwrap();
        first.publish().unwrap();
        drop(second);
        assert_eq!(listing(&root.path().join("aside")), ["trace.csv"]);
        assert_eq!(listing(root.path()), ["aside"]);
    }

    #[test]
    fn nothing_is_left_of_what_was_not_published() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = Folder::make(root.path()).unwrap();
        folder.write("trace.csv", b"t\n").unwrap();
        drop(folder);
        assert!(listing(root.path()).is_empty());
    }

    /// A file system that fails at one operation and at all later ones, like after a power failure.
    #[derive(Debug)]
    struct Failing {
        left: Cell<u32>,
    }

    impl Failing {
        fn count(&self) -> io::Result<()> {
            let left = self.left.get().checked_sub(1).ok_or(io::ErrorKind::StorageFull)?;
            self.left.set(left);
            Ok(())
        }
    }

    impl Disk for Failing {
        fn write(&self, file: &mut NamedTempFile, bytes: &[u8]) -> io::Result<()> {
            // Half of the bytes have been written.
            System.write(file, &bytes[..bytes.len() / 2])?;
            self.count()?;
            System.write(file, &bytes[bytes.len() / 2..])
        }

        fn sync(&self, file: &File) -> io::Result<()> {
            self.count().and_then(|()| System.sync(file))
        }

        fn sync_folder(&self, path: &Path) -> io::Result<()> {
            self.count().and_then(|()| System.sync_folder(path))
        }

        fn rename(&self, file: NamedTempFile, path: &Path) -> io::Result<()> {
            self.count().and_then(|()| System.rename(file, path))
        }

        fn remove(&self, path: &Path) -> io::Result<()> {
            self.count().and_then(|()| System.remove(path))
        }
    }

    #[test]
    fn whatever_fails_a_folder_is_the_old_one_the_new_one_or_without_a_summary() {
        let names = ["trace.csv", "events.csv", "scenario.json", SUMMARY];
        let write = |path: &Path, text: &str, left: u32| -> io::Result<()> {
            let mut folder = Folder::on(path, Box::new(Failing { left: Cell::new(left) }))?;
            folder.forget(vec!["loop.png".to_owned(), "springs.csv".to_owned()]);
            folder.forget_checkpoint();
            names.into_iter().try_for_each(|name| folder.write(name, format!("{text} {name}").as_bytes()))?;
            folder.publish()
        };
        let (mut ends, mut left) = ([0, 0, 0], 0);
        loop {
            let root = tempfile::tempdir().unwrap();
            let path = root.path().join("run");
            write(&path, "old", u32::MAX).unwrap();
            fs::write(path.join("loop.png"), "old").unwrap();
            fs::create_dir(path.join(checkpoint::FOLDER)).unwrap();
            let journal = path.join(checkpoint::FOLDER).join("journal");
            fs::write(&journal, "old").unwrap();
            let result = write(&path, "new", left);
            let read = |name: &str| fs::read_to_string(path.join(name)).ok();
            let is = |text: &str| names.iter().all(|name| read(name) == Some(format!("{text} {name}")));
            let end = match read(SUMMARY) {
                Some(_) if is("old") => 0,
                None => 1,
                Some(_) if is("new") => 2,
                found => panic!("after {left}: {found:?} beside {:?}", read("trace.csv")),
            };
            assert_eq!(
                read("loop.png").is_some(),
                end == 0 || listing(&path).contains(&"loop.png".to_owned())
            );
            // Until the run is published, its checkpoint is kept. Created folders are removed.
            assert!(end == 2 || journal.exists(), "after {left}");
            assert!(!listing(&path).iter().any(|name| name.starts_with('.')), "{:?}", listing(&path));
            ends[end] += 1;
            if result.is_ok() {
                assert!(end == 2 && !journal.exists() && read("loop.png").is_none());
                break;
            }
            left += 1;
        }
        // Two operations for each of four files, then the old summary and the folder, two stale files, four names, the folder twice.
        assert_eq!((left, ends), (18, [9, 8, 2]));
    }

    #[test]
    fn pictures_alone_leave_the_summary_where_it_is() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join(SUMMARY), "old").unwrap();
        let mut folder = Folder::make(root.path()).unwrap();
        folder.write("loop.png", b"new").unwrap();
        folder.publish().unwrap();
        assert_eq!(listing(root.path()), ["loop.png", SUMMARY]);
    }

    #[test]
    fn nothing_is_left_of_a_new_folder_that_nothing_came_into() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("new");
        let mut folder = Folder::ready(&path, 1 << 16).unwrap();
        assert!(path.exists());
        folder.write("trace.csv", b"t\n").unwrap();
        drop(folder);
        assert!(!path.exists());
        // An existing folder and published files are kept.
        drop(Folder::ready(root.path(), 1).unwrap());
        assert!(root.path().exists());
        let mut folder = Folder::ready(&path, 1).unwrap();
        folder.write("trace.csv", b"t\n").unwrap();
        folder.publish().unwrap();
        assert_eq!(listing(&path), ["trace.csv"]);
        assert!(Folder::ready(&path.join("trace.csv"), 1).is_err());
    }

    #[test]
    fn what_is_reserved_has_no_name() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = Folder::make(root.path()).unwrap();
        folder.reserve(1 << 20).unwrap();
        assert!(listing(root.path()).is_empty());
        folder.release();
        folder.publish().unwrap();
    }
}
