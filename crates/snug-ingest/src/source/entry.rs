//! What an entry of the data folder is.

use crate::error::IngestError;
use snug_files::Disk;
use std::fs::FileType;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// What a path leads to.
#[derive(Debug)]
pub(super) enum Entry {
    File,
    Folder,
    /// A device, a pipe, a socket.
    Other(&'static str),
    DanglingLink,
    LinkLoop,
    /// Nothing of that name.
    Nothing,
    /// The operating system does not say.
    Refused(io::Error),
}

impl Entry {
    pub(super) fn of(disk: &dyn Disk, path: &Path) -> Self {
        match disk.metadata(path) {
            Ok(metadata) => match metadata.file_type() {
                kind if kind.is_file() => Self::File,
                kind if kind.is_dir() => Self::Folder,
                kind => Self::Other(special(kind)),
            },
            Err(error) if error.kind() == ErrorKind::NotFound => Self::Nothing,
            Err(error) if is_loop(&error) => Self::LinkLoop,
            Err(error) => Self::Refused(error),
        }
    }

    /// Tells a link that leads nowhere from a name that is not there.
    pub(super) fn of_named(disk: &dyn Disk, path: &Path) -> Self {
        match Self::of(disk, path) {
            Self::Nothing if disk.link_metadata(path).is_ok() => Self::DanglingLink,
            entry => entry,
        }
    }

    /// Why this is no file that can be read, as an error; `expected` is what it should be.
    pub(super) fn error(self, path: PathBuf, expected: &'static str) -> IngestError {
        match self {
            Self::DanglingLink => IngestError::DanglingLink { path },
            Self::LinkLoop => IngestError::LinkLoop { path },
            Self::Nothing => IngestError::NoSuchPath { path },
            Self::Refused(error) => IngestError::Read(error).in_file(&path),
            Self::File | Self::Folder | Self::Other(_) => IngestError::NotAFile {
                found: self.name(),
                path,
                expected,
            },
        }
    }

    /// What it is called, where it is there and can be looked at.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Folder => "a folder",
            Self::Other(name) => name,
            _ => "a file",
        }
    }
}

#[cfg(unix)]
fn is_loop(error: &io::Error) -> bool {
    rustix::io::Errno::from_io_error(error) == Some(rustix::io::Errno::LOOP)
}

#[cfg(not(unix))]
fn is_loop(_: &io::Error) -> bool {
    false
}

#[cfg(unix)]
fn special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    if kind.is_fifo() {
        "a pipe"
    } else if kind.is_socket() {
        "a socket"
    } else {
        "a device"
    }
}

#[cfg(not(unix))]
fn special(_: FileType) -> &'static str {
    "neither a file nor a folder"
}
