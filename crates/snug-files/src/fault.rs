//! A disk that fails on purpose, for tests of whatever reads and writes through this crate.

use crate::{Disk, Host, Input, Output};
use std::fs::{File, Metadata};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// How a call fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// `EIO`: the medium is broken.
    Io,
    /// `ENOSPC`: the disk is full.
    NoSpace,
    /// `EACCES`: not allowed.
    Permission,
    /// A write or read takes half of what it was given, as an operating system may; other calls fail with `EIO`.
    Short,
}

impl Fault {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Io, Self::NoSpace, Self::Permission, Self::Short];

    fn error(self) -> io::Error {
        match self {
            Self::Io | Self::Short => io::Error::other("Input/output error (made)"),
            Self::NoSpace => ErrorKind::StorageFull.into(),
            Self::Permission => ErrorKind::PermissionDenied.into(),
        }
    }
}

/// How long a fault lasts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lasting {
    /// One call fails, the next ones do not.
    Once,
    /// Every call from then on fails: as if the process had been killed there, or the disk taken out.
    FromThenOn,
}

/// The operating system's file system, of which the call of a given number fails.
#[derive(Debug, Clone)]
pub struct FaultyDisk {
    calls: Arc<AtomicU64>,
    at: u64,
    fault: Fault,
    lasting: Lasting,
}

impl FaultyDisk {
    /// Fails at the call of number `at`, counted from 0.
    pub fn new(at: u64, fault: Fault, lasting: Lasting) -> Self {
        Self {
            calls: Arc::new(AtomicU64::new(0)),
            at,
            fault,
            lasting,
        }
    }

    /// Counts the calls and never fails.
    pub fn counting() -> Self {
        Self::new(u64::MAX, Fault::Io, Lasting::Once)
    }

    /// Calls until now: every one of the disk, and of its open files each read, write, seek and sync.
    pub fn calls(&self) -> u64 {
        self.calls.load(Ordering::SeqCst)
    }

    /// Whether the call at hand, which is counted, is to fail.
    fn fails(&self) -> bool {
        let call = self.calls.fetch_add(1, Ordering::SeqCst);
        match self.lasting {
            Lasting::Once => call == self.at,
            Lasting::FromThenOn => call >= self.at,
        }
    }

    fn pass(&self) -> io::Result<()> {
        match self.fails() {
            true => Err(self.fault.error()),
            false => Ok(()),
        }
    }

    /// What a call is passed on to.
    fn host(&self) -> io::Result<Host> {
        self.pass().map(|()| Host)
    }

    /// How many of `wanted` bytes may be moved.
    fn share(&self, wanted: usize) -> io::Result<usize> {
        match (self.fails(), self.fault, self.lasting) {
            (false, ..) => Ok(wanted),
            (true, Fault::Short, Lasting::Once) => Ok(wanted.div_ceil(2)),
            (true, fault, _) => Err(fault.error()),
        }
    }
}

/// An open file of a [`FaultyDisk`].
struct Faulty<F> {
    disk: FaultyDisk,
    file: F,
}

impl<F: Read> Read for Faulty<F> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let share = self.disk.share(buffer.len())?;
        self.file.read(&mut buffer[..share])
    }
}

impl<F: Seek> Seek for Faulty<F> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.disk.pass()?;
        self.file.seek(to)
    }
}

impl<F: Write> Write for Faulty<F> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let share = self.disk.share(bytes.len())?;
        self.file.write(&bytes[..share])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Output for Faulty<Box<dyn Output>> {
    fn sync(&mut self) -> io::Result<()> {
        self.disk.pass()?;
        self.file.sync()
    }
}

impl Disk for FaultyDisk {
    fn metadata(&self, path: &Path) -> io::Result<Metadata> {
        self.host()?.metadata(path)
    }

    fn link_metadata(&self, path: &Path) -> io::Result<Metadata> {
        self.host()?.link_metadata(path)
    }

    fn entries(&self, folder: &Path) -> io::Result<Vec<PathBuf>> {
        self.host()?.entries(folder)
    }

    fn open(&self, path: &Path) -> io::Result<Box<dyn Input>> {
        Ok(Box::new(Faulty {
            disk: self.clone(),
            file: self.host()?.open(path)?,
        }))
    }

    fn create(&self, path: &Path) -> io::Result<Box<dyn Output>> {
        Ok(Box::new(Faulty {
            disk: self.clone(),
            file: self.host()?.create(path)?,
        }))
    }

    fn open_lock(&self, path: &Path) -> io::Result<File> {
        self.host()?.open_lock(path)
    }

    fn create_folder(&self, path: &Path) -> io::Result<()> {
        self.host()?.create_folder(path)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.host()?.rename(from, to)
    }

    fn link(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.host()?.link(from, to)
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        self.host()?.remove_file(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        self.host()?.remove_folder(path)
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        self.host()?.sync_folder(folder)
    }
}
