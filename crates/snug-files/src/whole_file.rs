//! One file, there whole or not at all.

use crate::journal::exists;
use crate::{Disk, FilesError, Output};
use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
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
        let permissions = || match std::fs::metadata(&self.place) {
            Ok(known) => std::fs::set_permissions(&self.part, known.permissions()),
            Err(_) => Ok(()),
        };
        end(self.file.take())
            .and_then(|()| permissions())
            .and_then(|()| self.disk.rename(&self.part, &self.place))
            .map_err(FilesError::refused("write", &self.place))?;
        self.part.clear();
        self.sync_folder();
        Ok(())
    }

    /// The file takes its place unless there is something already.
    fn put_new(mut self) -> Result<(), FilesError> {
        end(self.file.take())
            .and_then(|()| self.claim())
            .map_err(FilesError::refused("write", &self.place))?;
        self.sync_folder();
        Ok(())
    }

    /// Gives what is whole its name, which nothing may have.
    fn claim(&mut self) -> io::Result<()> {
        match self.disk.link(&self.part, &self.place) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => {}
            // The name it was written by is taken away when this is dropped.
            done => return done,
        }
        // Some file systems know no second names: there an empty file holds the name for a moment.
        drop(self.disk.create(&self.place)?);
        match self.disk.rename(&self.part, &self.place) {
            Ok(()) => self.part.clear(),
            Err(error) => {
                self.disk.remove_file(&self.place).ok();
                return Err(error);
            }
        }
        Ok(())
    }

    fn sync_folder(&self) {
        let folder = self
            .place
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        // It stands; only whether it would outlast a power cut is open.
        if let Err(error) = self.disk.sync_folder(folder.unwrap_or(Path::new("."))) {
            tracing::warn!(%error, path = %self.place.display(), "the folder could not be synchronised");
        }
    }
}

/// All of a file is on the medium.
fn end(file: Option<Box<dyn Output>>) -> io::Result<()> {
    file.map_or(Ok(()), |mut file| {
        file.flush()?;
        file.sync()
    })
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

/// Writes a file that is not there yet whole or not at all.
///
/// # Errors
/// [`FilesError::Refused`], of the kind [`ErrorKind::AlreadyExists`] where something is there, which stays as it is.
pub fn write_new(disk: &dyn Disk, path: &Path, content: &[u8]) -> Result<(), FilesError> {
    let refused = || FilesError::refused("write", path);
    if exists(disk, path).map_err(refused())? {
        return Err(refused()(ErrorKind::AlreadyExists.into()));
    }
    let mut file = WholeFile::create(disk, path)?;
    file.write_all(content).map_err(refused())?;
    file.put_new()
}
