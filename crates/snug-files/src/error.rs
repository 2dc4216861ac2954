//! Why files could not be written, or must not be, each with what to do about it.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why files could not be written, or must not be.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilesError {
    /// The operating system refused.
    #[error("cannot {action} {}: {source}{}", path.display(), remedy(source))]
    Refused {
        /// What was to be done, as in "cannot … the file".
        action: &'static str,
        /// With which file or folder.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// An input stands where a result would be written.
    #[error(
        "{} would be written over {}, which is read: choose another folder for the results (--out)",
        output.display(), input.display()
    )]
    OutputIsInput {
        /// What is read.
        input: PathBuf,
        /// The name under which a result would be written; both lead to one file.
        output: PathBuf,
    },
    /// The results would lie among the measurements, where the next run takes them for such.
    #[error(
        "{} is the folder with the data and was given as the folder for the results, too: choose another one, inside it if you like (--out {})",
        folder.display(), folder.join("out").display()
    )]
    OutputAmongInputs {
        /// The folder.
        folder: PathBuf,
    },
    /// Another run writes into the folder.
    #[error(
        "{} is in use: another run{} writes its results there; wait for it (--wait), or choose another folder (--out)",
        folder.display(), told(holder)
    )]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// When that run began and which process it is, where that is known.
        holder: Option<String>,
    },
    /// Waiting for another run was ended.
    #[error("interrupted while waiting for another run; nothing was written")]
    Interrupted,
}

impl FilesError {
    pub(crate) fn refused<'a>(
        action: &'static str,
        path: &'a Path,
    ) -> impl FnOnce(io::Error) -> Self + 'a {
        move |source| Self::Refused {
            action,
            path: path.to_path_buf(),
            source,
        }
    }

    /// Whether the cause is what was asked for, rather than the machine.
    pub fn is_bad_argument(&self) -> bool {
        matches!(
            self,
            Self::OutputIsInput { .. } | Self::OutputAmongInputs { .. }
        )
    }
}

fn told(holder: &Option<String>) -> String {
    holder
        .as_ref()
        .map_or_else(String::new, |holder| format!(" ({holder})"))
}

/// What to do about an error of the operating system; begins with "; ".
pub fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "; make room there, or choose another disk"
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; allow it, or choose another folder"
        }
        ErrorKind::NotADirectory | ErrorKind::AlreadyExists => {
            "; a file has that name: choose another one"
        }
        _ => "",
    }
}
