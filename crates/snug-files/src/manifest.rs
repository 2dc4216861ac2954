//! Which files of a folder are results as they were written.

use crate::digest::Digest;
use crate::{Disk, FilesError};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// The file in a folder of results that says what was written there.
pub(crate) const MANIFEST: &str = ".snug-results";
/// Longest manifest that is read \[bytes\]; one of ten results takes 400.
const LONGEST_BYTES: u64 = 1 << 16;

/// The results of a folder, by name. What is not in it, or was changed since, belongs to somebody else.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Manifest {
    results: BTreeMap<String, Digest>,
}

impl Manifest {
    /// Of `folder`; empty where nothing was written, or the manifest cannot be understood.
    ///
    /// # Errors
    /// [`FilesError::Refused`] for one that is there and cannot be read.
    pub fn read(disk: &dyn Disk, folder: &Path) -> Result<Self, FilesError> {
        let path = folder.join(MANIFEST);
        let refused = FilesError::refused("read", &path);
        let mut text = String::new();
        let read = match disk.open(&path) {
            Ok(file) => file.take(LONGEST_BYTES).read_to_string(&mut text),
            Err(error) => Err(error),
        };
        match read {
            Ok(_) => Ok(Self::parse(&text).unwrap_or_default()),
            Err(error) => match error.kind() {
                // Not text: nobody's manifest.
                std::io::ErrorKind::NotFound | std::io::ErrorKind::InvalidData => {
                    Ok(Self::default())
                }
                _ => Err(refused(error)),
            },
        }
    }

    fn parse(text: &str) -> Option<Self> {
        let mut results = BTreeMap::new();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let mut words = line.splitn(3, ' ');
            let crc32 = u32::from_str_radix(words.next()?, 16).ok()?;
            let bytes = words.next()?.parse().ok()?;
            results.insert(words.next()?.to_owned(), Digest { bytes, crc32 });
        }
        Some(Self { results })
    }

    pub fn insert(&mut self, name: &str, digest: Digest) {
        self.results.insert(name.to_owned(), digest);
    }

    pub fn text(&self) -> String {
        let mut text = "# The results in this folder: CRC-32, bytes, name. One that differs was changed since \
                        and will not be replaced.\n"
            .to_owned();
        for (name, Digest { bytes, crc32 }) in &self.results {
            text.push_str(&format!("{crc32:08x} {bytes} {name}\n"));
        }
        text
    }

    /// Whether `name` in `folder` is a result and still as it was written. A link is none.
    pub fn holds(&self, disk: &dyn Disk, folder: &Path, name: &str) -> bool {
        self.results.get(name).is_some_and(|known| {
            Digest::of(disk, &folder.join(name), known.bytes).as_ref() == Some(known)
        })
    }
}
