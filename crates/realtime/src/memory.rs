//! Memory that other processes write, too: a file that is mapped, as words.
//!
//! Whatever they write, words are numbers: nothing in it is trusted, no length and no place is read from it.

#[cfg(target_os = "linux")]
mod bus;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use thiserror::Error;

/// Why there is no shared memory.
#[derive(Debug, Error)]
pub enum MemoryError {
    /// A file that is something else.
    #[error("{}: a file that is no shared memory of stickslip; give another name", .0.display())]
    Foreign(PathBuf),
    /// Another run has it.
    #[error("{}: in use by another run; give another name", .0.display())]
    InUse(PathBuf),
    /// Not on this system.
    #[error("{}: shared memory is not to be had on this system; use udp", .0.display())]
    Unknown(PathBuf),
    /// Another process has cut it.
    #[error(
        "{}: another process made the shared memory shorter, or wrote behind its records; the loop ended",
        .0.display()
    )]
    Cut(PathBuf),
    /// The system's word.
    #[error("{}: {source}", path.display())]
    System {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Words that other processes may read and write at any time; their file is gone when it is dropped.
///
/// Behind them lies the mark once more. Who makes the file shorter makes that 0: the system fills what remains of a page with zeros,
/// and where no page remains a page of zeros takes its place as soon as it is touched (`bus`), which would be the end of the process.
pub struct Shared {
    path: PathBuf,
    mark: u64,
    mapping: imp::Mapping,
}

impl Shared {
    /// Makes the file and maps `length` words of it, all 0.
    ///
    /// A file that a run left which was killed is taken over, any other one not. It is for its user alone.
    ///
    /// # Errors
    /// A file that is something else or in use; the system's word.
    pub fn make(path: &Path, mark: u64, length: usize) -> Result<Self, MemoryError> {
        let shared =
            Self { path: path.to_owned(), mark, mapping: imp::Mapping::make(path, mark, length + 1)? };
        shared.end().store(mark, Ordering::Relaxed);
        Ok(shared)
    }

    /// The words.
    pub fn words(&self) -> &[AtomicU64] {
        let all = self.mapping.words();
        &all[..all.len() - 1]
    }

    fn end(&self) -> &AtomicU64 {
        let all = self.mapping.words();
        &all[all.len() - 1]
    }

    /// Whether the file has its length still, and nobody has written behind the words.
    pub fn is_whole(&self) -> bool {
        self.end().load(Ordering::Relaxed) == self.mark
    }

    /// Where the file was made.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // Clients that have it mapped keep it; what cannot be removed is taken over by the next run. Where the path is another
        // file's by now, that is left alone.
        if self.mapping.is_at(&self.path) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

#[cfg(target_os = "linux")]
mod imp {
    use super::bus::Guard;
    use super::{AtomicU64, MemoryError, Path, io};
    use rustix::fs::{FlockOperation, flock};
    use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};
    use std::fs::{File, OpenOptions};
    use std::os::unix::fs::{FileExt, MetadataExt, OpenOptionsExt};
    use std::ptr::NonNull;

    const WORD: usize = size_of::<AtomicU64>();
    /// How often a file is opened anew that was removed meanwhile.
    const TRIES: usize = 100;

    pub(super) struct Mapping {
        start: NonNull<AtomicU64>,
        length: usize,
        /// Keeps the process alive where the file is made shorter; gone before the mapping.
        guard: Option<Guard>,
        /// Keeps the lock.
        file: File,
    }

    /// Opens a file, makes it where there is none, and locks it.
    fn locked(path: &Path) -> Result<File, MemoryError> {
        for _ in 0..TRIES {
            let file = OpenOptions::new()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .mode(0o600)
                .custom_flags(libc::O_NOFOLLOW)
                .open(path)
                .map_err(|source| MemoryError::System { path: path.to_owned(), source })?;
            if flock(&file, FlockOperation::NonBlockingLockExclusive).is_err() {
                break;
            }
            // Between the two a run may have ended and removed it: nobody would find what is mapped then.
            if is_at(&file, path) {
                return Ok(file);
            }
        }
        Err(MemoryError::InUse(path.to_owned()))
    }

    /// Whether a file is the one at a path.
    fn is_at(file: &File, path: &Path) -> bool {
        let [open, there] = [file.metadata(), std::fs::symlink_metadata(path)];
        matches!((open, there), (Ok(open), Ok(there)) if (open.dev(), open.ino()) == (there.dev(), there.ino()))
    }

    impl Mapping {
        pub(super) fn make(path: &Path, mark: u64, length: usize) -> Result<Self, MemoryError> {
            let failed = |source| MemoryError::System { path: path.to_owned(), source };
            let bytes = length * WORD;
            let file = locked(path)?;
            let found = file.metadata().map_err(failed)?;
            let mut head = [0; WORD];
            // Without a mark it is ours if it is as long as what is made here: a run was killed before it wrote that.
            let mut is_ours = || {
                file.read_exact_at(&mut head, 0).is_ok()
                    && (head == mark.to_ne_bytes() || (head == [0; WORD] && found.len() == bytes as u64))
            };
            if !found.is_file() || (found.len() > 0 && !is_ours()) {
                return Err(MemoryError::Foreign(path.to_owned()));
            }
            // Written, and not only as long: a disk that is full says so here. A client of the run that was killed may still have it
            // mapped: it never gets shorter.
            file.write_all_at(&vec![0; bytes], 0).map_err(failed)?;
            let access = ProtFlags::READ | ProtFlags::WRITE;
            #[allow(unsafe_code, reason = "memory that other processes write is not to be had otherwise")]
            // SAFETY: a new mapping at a place that the system chooses takes no memory that anybody has.
            let start = unsafe { mmap(std::ptr::null_mut(), bytes, access, MapFlags::SHARED, &file, 0) };
            let start = start.map_err(|errno| failed(io::Error::from(errno)))?;
            let start =
                NonNull::new(start.cast()).ok_or_else(|| failed(io::ErrorKind::OutOfMemory.into()))?;
            let mut mapping = Self { start, length, guard: None, file };
            mapping.guard = Some(Guard::over(start.as_ptr() as usize, bytes).map_err(failed)?);
            Ok(mapping)
        }

        /// Whether its file is the one at a path.
        pub(super) fn is_at(&self, path: &Path) -> bool {
            is_at(&self.file, path)
        }

        pub(super) fn words(&self) -> &[AtomicU64] {
            #[allow(unsafe_code, reason = "the words of the mapping, whose length nobody else knows")]
            // SAFETY: the mapping has `length` words, begins at a page, and lives as long as `self`. Every value of a word is
            // a number, and whoever else writes them, this process reads and writes them by atomics only. The file was made
            // as long as the mapping and is its user's alone; if that user cuts it, zeros take its place (`bus`).
            unsafe {
                std::slice::from_raw_parts(self.start.as_ptr(), self.length)
            }
        }
    }

    impl Drop for Mapping {
        fn drop(&mut self) {
            // First: what lies at this place afterwards is somebody else's.
            self.guard = None;
            #[allow(unsafe_code, reason = "the mapping's end")]
            // SAFETY: it is the mapping that `make` made, whole, and no reference into it outlives `self`. An error would
            // leave it mapped until the process ends.
            let _ = unsafe { munmap(self.start.as_ptr().cast(), self.length * WORD) };
        }
    }

    #[allow(unsafe_code, reason = "a pointer is not Send by itself")]
    // SAFETY: the mapping belongs to the process and not to a thread, and is used by atomics only.
    unsafe impl Send for Mapping {}

    #[allow(unsafe_code, reason = "nor Sync")]
    // SAFETY: a shared reference gives atomics and nothing else.
    unsafe impl Sync for Mapping {}
}

#[cfg(not(target_os = "linux"))]
mod imp {
    use super::{AtomicU64, MemoryError, Path};

    /// There is none.
    pub(super) enum Mapping {}

    impl Mapping {
        pub(super) fn make(path: &Path, _: u64, _: usize) -> Result<Self, MemoryError> {
            Err(MemoryError::Unknown(path.to_owned()))
        }

        pub(super) fn is_at(&self, _: &Path) -> bool {
            match *self {}
        }

        pub(super) fn words(&self) -> &[AtomicU64] {
            match *self {}
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    const MARK: u64 = 77;

    #[test]
    fn memory_has_one_owner_at_a_time_and_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let (path, owners) = (folder.path().join("loop"), AtomicUsize::new(0));
        let make = || {
            let mut made = 0;
            for _ in 0..20_000 {
                let Ok(shared) = Shared::make(&path, MARK, 8) else { continue };
                assert_eq!(owners.fetch_add(1, Ordering::SeqCst), 0);
                assert!(shared.mapping.is_at(&path));
                shared.words()[0].store(MARK, Ordering::Release);
                owners.fetch_sub(1, Ordering::SeqCst);
                made += 1;
            }
            made
        };
        let made = std::thread::scope(|scope| {
            [(); 3].map(|()| scope.spawn(make)).map(|thread| thread.join().unwrap())
        });
        assert!(made.iter().sum::<i32>() > 1000, "{made:?}");
    }

    #[test]
    fn what_is_there_is_taken_over_where_it_is_ours() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("loop");
        let after = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            Shared::make(&path, MARK, 8).is_ok()
        };
        // Killed before the mark was written, with other words there already.
        let mut head = [0; 72];
        head[20] = 1;
        assert!(after(&head) && after(&[]) && after(&MARK.to_ne_bytes()));
        assert!(!after(&head[..71]) && !after(&[1; 72]));
    }

    /// The system sends a process SIGBUS that touches what is no more.
    #[test]
    fn memory_whose_file_was_made_shorter_is_zeros_and_known() {
        let folder = tempfile::tempdir().unwrap();
        for (name, length) in [("nothing", 0), ("a_word", 8), ("half", 4096 + 24), ("the_mark", 8000)] {
            let path = folder.path().join(name);
            let shared = Shared::make(&path, MARK, 1000).unwrap();
            shared.words().iter().for_each(|word| word.store(5, Ordering::Relaxed));
            assert!(shared.is_whole());
            std::fs::OpenOptions::new().write(true).open(&path).unwrap().set_len(length).unwrap();
            assert!(!shared.is_whole(), "{name}");
            let last = &shared.words()[999];
            assert!(last.load(Ordering::Relaxed) == if length == 8000 { 5 } else { 0 }, "{name}");
            last.store(7, Ordering::Relaxed);
            assert!(last.load(Ordering::Relaxed) == 7 && !shared.is_whole(), "{name}");
        }
    }

    #[test]
    fn a_file_that_took_the_path_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("loop");
        let shared = Shared::make(&path, MARK, 8).unwrap();
        std::fs::remove_file(&path).unwrap();
        std::fs::write(&path, "another").unwrap();
        drop(shared);
        assert_eq!(std::fs::read(&path).unwrap(), b"another");
    }
}
