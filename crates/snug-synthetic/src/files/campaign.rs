//! What a simulation gives, and how it is written: the measurement files, and the truth beside their folder, not in it.

use crate::error::SyntheticError;
use crate::files::file::SyntheticFile;
use crate::files::layout::MatStyle;
use crate::files::truth::Truth;
use std::fs;
use std::path::{Path, PathBuf};

/// A simulated campaign: its files, and what was really there.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticCampaign {
    /// The measurement files.
    pub files: Vec<SyntheticFile>,
    /// The truth behind them.
    pub truth: Truth,
}

impl SyntheticCampaign {
    /// Writes every file into `folder`, which is made if it is not there, and the truth beside it as
    /// `<folder>.truth.json`; gives the paths written.
    ///
    /// # Errors
    /// [`SyntheticError::Write`] with the path that could not be written.
    pub fn write(&self, folder: &Path, style: MatStyle) -> Result<Vec<PathBuf>, SyntheticError> {
        let failed = |path: &Path| {
            let path = path.to_owned();
            |source| SyntheticError::Write { path, source }
        };
        fs::create_dir_all(folder).map_err(failed(folder))?;
        let mut paths = Vec::new();
        for file in &self.files {
            let path = folder.join(&file.name);
            let bytes = file.mat(style).map_err(failed(&path))?;
            fs::write(&path, bytes).map_err(failed(&path))?;
            paths.push(path);
        }
        let mut beside = folder.as_os_str().to_owned();
        beside.push(".truth.json");
        let path = PathBuf::from(beside);
        fs::write(&path, self.truth.to_json()?).map_err(failed(&path))?;
        paths.push(path);
        Ok(paths)
    }
}
