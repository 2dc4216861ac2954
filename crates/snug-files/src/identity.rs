//! Which file a path leads to, whatever it is called.

use crate::Disk;
use std::io;
use std::path::Path;

/// One file or folder of this machine. Two paths lead to the same one exactly when these are equal: links of both kinds
/// are seen through.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Identity {
    #[cfg(unix)]
    device_and_inode: (u64, u64),
    #[cfg(not(unix))]
    full_path: std::path::PathBuf,
}

impl Identity {
    /// Of what `path` leads to; `None` where nothing is.
    ///
    /// # Errors
    /// What the operating system says, unless it is that nothing is there.
    pub fn of(disk: &dyn Disk, path: &Path) -> io::Result<Option<Self>> {
        let metadata = match disk.metadata(path) {
            Ok(metadata) => metadata,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        };
        #[cfg(unix)]
        {
            Ok(Some(Self::of_metadata(&metadata)))
        }
        #[cfg(not(unix))]
        {
            let _ = metadata;
            Ok(Some(Self {
                full_path: std::fs::canonicalize(path)?,
            }))
        }
    }

    /// Of what is known of it.
    #[cfg(unix)]
    pub(crate) fn of_metadata(metadata: &std::fs::Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self {
            device_and_inode: (metadata.dev(), metadata.ino()),
        }
    }
}
