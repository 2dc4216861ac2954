//! One writer per folder.

use crate::{Disk, FilesError, Identity};
use std::fs::{File, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// The file in a folder of results that the lock is taken on.
pub(crate) const LOCK: &str = ".snug-lock";
/// Between two looks at a lock that another run holds: short for a person, long for a processor.
const LOOK_EVERY: Duration = Duration::from_millis(200);
/// Looks at the note of a holder that has not written one yet, and the time between two: it takes microseconds.
const NOTE_LOOKS: u32 = 10;
const NOTE_EVERY: Duration = Duration::from_millis(5);
/// Longest note of a holder that is read \[bytes\].
const LONGEST_NOTE_BYTES: u64 = 200;

/// The right to write into a folder, until it is dropped or the process ends, however it ends.
///
/// The lock is advisory and the kernel's: it does not outlive the process. The file goes with the lock; one that a
/// killed process left is taken over.
#[derive(Debug)]
pub struct Lock {
    disk: Arc<dyn Disk>,
    path: PathBuf,
    /// `None` where the file system knows no locks.
    file: Option<File>,
}

/// Whether and how another run is waited for.
pub type Waiting<'a> = Option<&'a dyn Fn() -> bool>;

impl Lock {
    /// Takes the lock of `folder`, which is there. `waiting` is asked before every further look whether to go on.
    ///
    /// # Errors
    /// [`FilesError::Busy`], [`FilesError::Interrupted`], [`FilesError::Refused`].
    pub fn take(
        disk: Arc<dyn Disk>,
        folder: &Path,
        waiting: Waiting<'_>,
    ) -> Result<Self, FilesError> {
        let path = folder.join(LOCK);
        loop {
            let mut file = disk
                .open_lock(&path)
                .map_err(FilesError::refused("write into", folder))?;
            match file.try_lock() {
                Ok(()) if is_at(&*disk, &file, &path) => {
                    note(&mut file);
                    let file = Some(file);
                    return Ok(Self { disk, path, file });
                }
                // Whoever held it took the file away: the next one is free.
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => match waiting {
                    None => {
                        return Err(FilesError::Busy {
                            folder: folder.to_path_buf(),
                            holder: holder(&mut file),
                        });
                    }
                    Some(go_on) if go_on() => std::thread::sleep(LOOK_EVERY),
                    Some(_) => return Err(FilesError::Interrupted),
                },
                Err(TryLockError::Error(error)) => {
                    tracing::warn!(%error, folder = %folder.display(), "this file system knows no locks: do not run two at once");
                    let file = None;
                    return Ok(Self { disk, path, file });
                }
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // First the name, then the lock: nobody can take the lock of a file that is about to go.
        if let Err(error) = self.disk.remove_file(&self.path) {
            tracing::debug!(%error, path = %self.path.display(), "the lock's file stays; it holds nobody up");
        }
        drop(self.file.take());
    }
}

/// Whether `path` still leads to `file`.
fn is_at(disk: &dyn Disk, file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        let held = file.metadata().ok().as_ref().map(Identity::of_metadata);
        let there = Identity::of(disk, path).ok().flatten();
        held.is_some() && held == there
    }
    #[cfg(not(unix))]
    {
        let _ = (disk, file, path);
        true
    }
}

/// Says who holds the lock; for people only, so that a failure does no harm.
fn note(file: &mut File) {
    let since = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let since = since.replace('T', " ").replace('Z', " UTC");
    let text = format!("since {since}, process {}", std::process::id());
    let written = file
        .set_len(0)
        .and_then(|()| file.rewind())
        .and_then(|()| file.write_all(text.as_bytes()));
    if let Err(error) = written {
        tracing::debug!(%error, "the lock's file does not say since when it is held");
    }
}

/// What the holder says of itself; it may just be about to.
fn holder(file: &mut File) -> Option<String> {
    for _ in 0..NOTE_LOOKS {
        let mut text = String::new();
        file.rewind().ok()?;
        file.take(LONGEST_NOTE_BYTES)
            .read_to_string(&mut text)
            .ok()?;
        if !text.is_empty() {
            return Some(text);
        }
        std::thread::sleep(NOTE_EVERY);
    }
    None
}
