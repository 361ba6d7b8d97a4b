//! Memory that other processes write, too: a file that is mapped, as words.
//!
//! Whatever they write, words are numbers: nothing in it is trusted, no length and no place is read from it.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicU64;
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
pub struct Shared {
    path: PathBuf,
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
        let mapping = imp::Mapping::make(path, mark, length)?;
        Ok(Self { path: path.to_owned(), mapping })
    }

    /// The words.
    pub fn words(&self) -> &[AtomicU64] {
        self.mapping.words()
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // Clients that have it mapped keep it; what cannot be removed is taken over by the next run.
        let _ = std::fs::remove_file(&self.path);
    }
}

#[cfg(target_os = "linux")]
mod imp {
    use super::{AtomicU64, MemoryError, Path, io};
    use rustix::fs::{FlockOperation, flock};
    use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};
    use std::fs::{File, OpenOptions};
    use std::os::unix::fs::{FileExt, OpenOptionsExt};
    use std::ptr::NonNull;

    const WORD: usize = size_of::<AtomicU64>();

    pub(super) struct Mapping {
        start: NonNull<AtomicU64>,
        length: usize,
        /// Keeps the lock.
        _file: File,
    }

    impl Mapping {
        pub(super) fn make(path: &Path, mark: u64, length: usize) -> Result<Self, MemoryError> {
            let failed = |source| MemoryError::System { path: path.to_owned(), source };
            let file = OpenOptions::new()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .mode(0o600)
                .custom_flags(libc::O_NOFOLLOW)
                .open(path);
            let file = file.map_err(failed)?;
            if flock(&file, FlockOperation::NonBlockingLockExclusive).is_err() {
                return Err(MemoryError::InUse(path.to_owned()));
            }
            let found = file.metadata().map_err(failed)?;
            let mut head = [0; WORD];
            let mut is_ours = || file.read_exact_at(&mut head, 0).is_ok_and(|()| head == mark.to_ne_bytes());
            if !found.is_file() || (found.len() > 0 && !is_ours()) {
                return Err(MemoryError::Foreign(path.to_owned()));
            }
            let bytes = length * WORD;
            // A client of the run that was killed may still have it mapped: it never gets shorter.
            file.set_len(found.len().max(bytes as u64)).map_err(failed)?;
            let access = ProtFlags::READ | ProtFlags::WRITE;
            #[allow(unsafe_code, reason = "memory that other processes write is not to be had otherwise")]
            // SAFETY: a new mapping at a place that the system chooses takes no memory that anybody has.
            let start = unsafe { mmap(std::ptr::null_mut(), bytes, access, MapFlags::SHARED, &file, 0) };
            let start = start.map_err(|errno| failed(io::Error::from(errno)))?;
            let start =
                NonNull::new(start.cast()).ok_or_else(|| failed(io::ErrorKind::OutOfMemory.into()))?;
            let mapping = Self { start, length, _file: file };
            mapping.words().iter().for_each(|word| word.store(0, std::sync::atomic::Ordering::Relaxed));
            Ok(mapping)
        }

        pub(super) fn words(&self) -> &[AtomicU64] {
            #[allow(unsafe_code, reason = "the words of the mapping, whose length nobody else knows")]
            // SAFETY: the mapping has `length` words, begins at a page, and lives as long as `self`. Every value of a word is
            // a number, and whoever else writes them, this process reads and writes them by atomics only. The file was made
            // as long as the mapping and is its user's alone; if that user cuts it, the system ends the process (SIGBUS).
            unsafe {
                std::slice::from_raw_parts(self.start.as_ptr(), self.length)
            }
        }
    }

    impl Drop for Mapping {
        fn drop(&mut self) {
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

        pub(super) fn words(&self) -> &[AtomicU64] {
            match *self {}
        }
    }
}
