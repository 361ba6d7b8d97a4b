//! Shared memory: a memory-mapped file of 64-bit words that other processes write, too.
//!
//! Any word may have any value at any time. Therefore no length and no address is read from the shared memory.

#[cfg(target_os = "linux")]
mod bus;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use thiserror::Error;

/// Error of creating or using shared memory.
#[derive(Debug, Error)]
pub enum MemoryError {
    /// The existing file is not a shared memory of this program.
    #[error("{}: this file is not a shared memory of stickslip; give another name", .0.display())]
    Foreign(PathBuf),
    /// Another run uses the file.
    #[error("{}: in use by another run; give another name", .0.display())]
    InUse(PathBuf),
    /// This operating system is not supported.
    #[error("{}: this system has no shared memory; use udp", .0.display())]
    Unknown(PathBuf),
    /// Another process truncated the file.
    #[error(
        "{}: another process truncated the shared memory or wrote beyond its records; the loop ended",
        .0.display()
    )]
    Cut(PathBuf),
    /// The operating system returned an error.
    #[error("{}: {source}", path.display())]
    System {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

/// Memory-mapped words that other processes may read and write at any time. Dropping this value removes the file.
///
/// The file has one more word, which contains the mark. If another process truncates the file, this word becomes 0. The operating system
/// fills the rest of a page with zeros. Accessing a missing page would end the process, so `bus` replaces it by zeros.
pub struct Shared {
    path: PathBuf,
    mark: u64,
    mapping: imp::Mapping,
}

impl Shared {
    /// Creates a file with words of value 0 and maps `length` of them.
    ///
    /// Only the user of the process can access the file. A file left by a killed run is reused. Any other existing file is an error.
    ///
    /// # Errors
    /// The file is not a shared memory of this program or is in use, or the operating system returns an error.
    pub fn make(path: &Path, mark: u64, length: usize) -> Result<Self, MemoryError> {
        let shared =
            Self { path: path.to_owned(), mark, mapping: imp::Mapping::make(path, mark, length + 1)? };
        shared.end().store(mark, Ordering::Relaxed);
        Ok(shared)
    }

    /// Returns the mapped words.
    pub fn words(&self) -> &[AtomicU64] {
        let all = self.mapping.words();
        &all[..all.len() - 1]
    }

    fn end(&self) -> &AtomicU64 {
        let all = self.mapping.words();
        &all[all.len() - 1]
    }

    /// Returns whether the file still has its length and the mark after the mapped words is unchanged.
    pub fn is_whole(&self) -> bool {
        self.end().load(Ordering::Relaxed) == self.mark
    }

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // Clients that have mapped the file keep their mapping. A file that cannot be removed is reused by the next run. Another file at
        // this path is not removed.
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
    /// Maximum number of attempts to open a file that another run removes at the same time.
    const TRIES: usize = 100;

    pub(super) struct Mapping {
        start: NonNull<AtomicU64>,
        length: usize,
        /// Handler of accesses to a truncated file. The handler must be dropped before the mapping.
        guard: Option<Guard>,
        /// Open file, which holds the file lock.
        file: File,
    }

    /// Opens or creates a file and locks it.
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
            // Another run may have removed the file between opening and locking. No client could find a removed file.
            if is_at(&file, path) {
                return Ok(file);
            }
        }
        Err(MemoryError::InUse(path.to_owned()))
    }

    /// Returns whether an open file is still the file at a path.
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
            // A file without a mark but with this length was left by a run that was killed before it wrote the mark.
            let mut is_ours = || {
                file.read_exact_at(&mut head, 0).is_ok()
                    && (head == mark.to_ne_bytes() || (head == [0; WORD] && found.len() == bytes as u64))
            };
            if !found.is_file() || (found.len() > 0 && !is_ours()) {
                return Err(MemoryError::Foreign(path.to_owned()));
            }
            // The file is written and not only extended, so that a full disk is reported here. It is never truncated, because a client of a
            // killed run may still have mapped it.
            file.write_all_at(&vec![0; bytes], 0).map_err(failed)?;
            let access = ProtFlags::READ | ProtFlags::WRITE;
            #[allow(unsafe_code, reason = "memory that other processes write is not to be had otherwise")]
            // SAFETY: a new mapping at an address that the system chooses does not overlap existing memory.
            let start = unsafe { mmap(std::ptr::null_mut(), bytes, access, MapFlags::SHARED, &file, 0) };
            let start = start.map_err(|errno| failed(io::Error::from(errno)))?;
            let start =
                NonNull::new(start.cast()).ok_or_else(|| failed(io::ErrorKind::OutOfMemory.into()))?;
            let mut mapping = Self { start, length, guard: None, file };
            mapping.guard = Some(Guard::over(start.as_ptr() as usize, bytes).map_err(failed)?);
            Ok(mapping)
        }

        /// Returns whether the mapped file is still the file at a path.
        pub(super) fn is_at(&self, path: &Path) -> bool {
            is_at(&self.file, path)
        }

        pub(super) fn words(&self) -> &[AtomicU64] {
            #[allow(unsafe_code, reason = "the words of the mapping, whose length nobody else knows")]
            // SAFETY: the mapping has `length` words, is page-aligned, and lives as long as `self`. Every bit pattern of a word is valid.
            // This process reads and writes the words by atomics only, whatever other processes do. The file was created with the length of
            // the mapping, and only its user can access it. If it is truncated, zeros replace the missing pages (`bus`).
            unsafe {
                std::slice::from_raw_parts(self.start.as_ptr(), self.length)
            }
        }
    }

    impl Drop for Mapping {
        fn drop(&mut self) {
            // The guard is dropped first, because the address range may be reused after the unmapping.
            self.guard = None;
            #[allow(unsafe_code, reason = "the mapping's end")]
            // SAFETY: this is the complete mapping that `make` created, and no reference into it outlives `self`. After an error it stays
            // mapped until the process ends.
            let _ = unsafe { munmap(self.start.as_ptr().cast(), self.length * WORD) };
        }
    }

    #[allow(unsafe_code, reason = "a pointer is not Send by itself")]
    // SAFETY: the mapping belongs to the process, not to a thread, and is accessed by atomics only.
    unsafe impl Send for Mapping {}

    #[allow(unsafe_code, reason = "nor Sync")]
    // SAFETY: a shared reference gives access to atomics only.
    unsafe impl Sync for Mapping {}
}

#[cfg(not(target_os = "linux"))]
mod imp {
    use super::{AtomicU64, MemoryError, Path};

    /// Placeholder on operating systems without support for shared memory.
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
        // State of a file whose run was killed before it wrote the mark, but after it wrote other words.
        let mut head = [0; 72];
        head[20] = 1;
        assert!(after(&head) && after(&[]) && after(&MARK.to_ne_bytes()));
        assert!(!after(&head[..71]) && !after(&[1; 72]));
    }

    /// The system sends SIGBUS to a process that accesses a page beyond the end of a file.
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
