//! A recording that was cut short, made whole in its place.

use crate::error::StudyError;
use snug_files::{Disk, FilesError, Host, Lock, WholeFile};
use snug_record::Recovery;
use std::fmt;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What became of a recording that was cut short.
#[derive(Debug, Clone)]
pub struct Recovered {
    /// The recording, which has an index now.
    pub path: PathBuf,
    /// The file as it was; `None` where nothing was missing and nothing was written.
    pub kept: Option<PathBuf>,
    /// What was there and what is missing.
    pub recovery: Recovery,
}

/// Makes a recording that was cut short whole: an index at its end, so that every reader opens it.
///
/// The file as it was is kept beside as `STEM.cut-1.ENDING`, unless it was whole already. The folder is locked meanwhile, so
/// that no recording is taken for cut while it is being written.
///
/// # Errors
/// [`StudyError::NotRecovered`] for a file that is no recording, [`StudyError::Files`].
pub fn recover(path: &Path) -> Result<Recovered, StudyError> {
    let refused = |action| {
        move |source| FilesError::Refused {
            action,
            path: path.to_path_buf(),
            source,
        }
    };
    let recording = |source| StudyError::NotRecovered {
        path: path.to_path_buf(),
        source,
    };
    let mut input = open(path).map_err(refused("read"))?;
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let _lock = Lock::take(Arc::new(Host), folder.unwrap_or(Path::new(".")), None)?;
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes).map_err(refused("read"))?;
    let mut file = BufWriter::new(WholeFile::create(&Host, path)?);
    let recovery = snug_record::recover(&bytes, &mut file).map_err(recording)?;
    if recovery.was_complete {
        return Ok(Recovered {
            path: path.to_path_buf(),
            kept: None,
            recovery,
        });
    }
    file.flush().map_err(refused("write"))?;
    let file = file.into_inner().map_err(io::IntoInnerError::into_error);
    let kept = keep(path).map_err(refused("keep the old content of"))?;
    file.map_err(refused("write"))?.put()?;
    Ok(Recovered {
        path: path.to_path_buf(),
        kept: Some(kept),
        recovery,
    })
}

/// Opens a regular file: a pipe or device would be waited for, or read without end.
fn open(path: &Path) -> io::Result<impl Read> {
    match Host.metadata(path)?.is_file() {
        true => Host.open(path),
        false => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is no regular file",
        )),
    }
}

/// Gives what stands at `path` a second name; returns that.
fn keep(path: &Path) -> io::Result<PathBuf> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    for number in 1.. {
        let kept = path.with_file_name(format!("{stem}.cut-{number}.{ending}"));
        match std::fs::hard_link(path, &kept) {
            Ok(()) => return Ok(kept),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            // This file system knows no second names.
            Err(_) if !kept.exists() => return std::fs::copy(path, &kept).map(|_| kept),
            Err(error) => return Err(error),
        }
    }
    unreachable!("a folder holds fewer files than there are numbers")
}

impl fmt::Display for Recovered {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(text, "{}: {}", self.path.display(), self.recovery)?;
        match &self.kept {
            Some(kept) => write!(text, "\nthe file as it was: {}", kept.display()),
            None => Ok(()),
        }
    }
}
