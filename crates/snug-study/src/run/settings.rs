//! How a study is run, beside what it says itself.

use snug_files::{Disk, Host};
use std::path::PathBuf;
use std::sync::Arc;

/// How a study is run, beside what it says itself.
#[derive(Debug, Clone)]
pub struct RunSettings {
    /// Folder for the results; made if it is not there.
    pub out: PathBuf,
    /// Threads; `None` for one a core. Results do not depend on it.
    pub threads: Option<usize>,
    /// The file that the study was read from, which is never written over.
    pub study_file: Option<PathBuf>,
    /// Whether to wait for another run that has the folder.
    pub wait: bool,
    /// The file system.
    pub disk: Arc<dyn Disk>,
}

impl RunSettings {
    /// Results into `out`, everything else as by default.
    pub fn new(out: impl Into<PathBuf>) -> Self {
        Self {
            out: out.into(),
            threads: None,
            study_file: None,
            wait: false,
            disk: Arc::new(Host),
        }
    }
}
