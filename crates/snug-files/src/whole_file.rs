//! One file, there whole or not at all.

use crate::journal::exists;
use crate::{Disk, FilesError, Output};
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file that is written beside its place and takes it when it is whole. Dropped before, it leaves nothing.
///
/// A link is followed, and permissions stay.
pub struct WholeFile<'d> {
    disk: &'d dyn Disk,
    place: PathBuf,
    part: PathBuf,
    file: Option<Box<dyn Output>>,
}

impl<'d> WholeFile<'d> {
    /// Begins a file that will stand at `path`.
    ///
    /// # Errors
    /// [`FilesError::Refused`].
    pub fn create(disk: &'d dyn Disk, path: &Path) -> Result<Self, FilesError> {
        let place = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let mut name = OsString::from(".");
        name.push(place.file_name().unwrap_or_default());
        name.push(format!(".{}.part", std::process::id()));
        let part = place.with_file_name(name);
        // One of this name is of a process of the same number that is gone.
        let left = exists(disk, &part).and_then(|left| match left {
            true => disk.remove_file(&part),
            false => Ok(()),
        });
        let file = left
            .and_then(|()| disk.create(&part))
            .map_err(FilesError::refused("write", path))?;
        Ok(Self {
            disk,
            place,
            part,
            file: Some(file),
        })
    }

    /// The file takes its place.
    ///
    /// # Errors
    /// [`FilesError::Refused`]; what stood there stands there still.
    pub fn put(mut self) -> Result<(), FilesError> {
        let written = self.file.take().map_or(Ok(()), |mut file| {
            file.flush()?;
            file.sync()
        });
        let permissions = || match std::fs::metadata(&self.place) {
            Ok(known) => std::fs::set_permissions(&self.part, known.permissions()),
            Err(_) => Ok(()),
        };
        let folder = self
            .place
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        written
            .and_then(|()| permissions())
            .and_then(|()| self.disk.rename(&self.part, &self.place))
            .map_err(FilesError::refused("write", &self.place))?;
        // It stands; only whether it would outlast a power cut is open.
        if let Err(error) = self.disk.sync_folder(folder.unwrap_or(Path::new("."))) {
            tracing::warn!(%error, path = %self.place.display(), "the folder could not be synchronised");
        }
        self.part.clear();
        Ok(())
    }
}

impl Write for WholeFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.file {
            Some(file) => file.write(bytes),
            None => Ok(0),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), |file| file.flush())
    }
}

impl Drop for WholeFile<'_> {
    fn drop(&mut self) {
        if !self.part.as_os_str().is_empty() {
            // What is left of the attempt; the first error has said why.
            self.disk.remove_file(&self.part).ok();
        }
    }
}

/// Writes a file whole or not at all: until all of `content` is on the medium, `path` keeps what it holds.
///
/// # Errors
/// [`FilesError::Refused`]; the file is then as it was.
pub fn write_whole(disk: &dyn Disk, path: &Path, content: &[u8]) -> Result<(), FilesError> {
    let mut file = WholeFile::create(disk, path)?;
    file.write_all(content)
        .map_err(FilesError::refused("write", path))?;
    file.put()
}
