//! Where measurements lie, and how one file of them is read.

mod entry;
mod listing;
pub(crate) mod units;

pub use listing::{Listing, list, list_on};

use crate::csv::CsvLayout;
use crate::declared::json::JsonLayout;
use crate::declared::mat::MatLayout;
use crate::error::IngestError;
use crate::file::ingested::Ingested;
use crate::layout::Layout;
use crate::mcap::McapLayout;
use crate::memory::Budget;
use crate::recording::range::Range;
use crate::thesis_layout::ThesisLayout;
use serde::{Deserialize, Serialize};
use snug_files::{Disk, Host};
use std::path::{Path, PathBuf};

/// Where measurements lie and how they are written: the `source` of a study.
///
/// The default reads a folder of MAT files in the layout of the thesis, and Snug's own MCAP recordings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Source {
    /// Folder, or one file. Relative paths count from the study file. Default `.`.
    pub path: PathBuf,
    /// Names of the files that are read, in this order; none: all in the folder, by name. Default none.
    pub files: Vec<String>,
    /// How they are written. Default `Thesis`.
    pub format: Format,
    /// Memory that reading one file may take \[MB\]; none (default): a quarter of what this machine has to give.
    pub memory_mb: Option<u32>,
}

/// How measurement files are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Format {
    /// MAT files of any level in the layout of the thesis (`.mat`), and Snug's own recordings (`.mcap`).
    Thesis(ThesisLayout),
    /// Delimited text with declared columns (`.csv`, `.tsv`, `.txt`).
    Csv(CsvLayout),
    /// MCAP with declared topics (`.mcap`).
    Mcap(McapLayout),
    /// MAT files of any level with declared variables (`.mat`).
    Mat(MatLayout),
    /// JSON with declared paths (`.json`).
    Json(JsonLayout),
}

impl Default for Format {
    fn default() -> Self {
        Self::Thesis(ThesisLayout::default())
    }
}

impl Format {
    pub(crate) fn layout(&self) -> &dyn Layout {
        match self {
            Self::Thesis(layout) => layout,
            Self::Csv(layout) => layout,
            Self::Mcap(layout) => layout,
            Self::Mat(layout) => layout,
            Self::Json(layout) => layout,
        }
    }

    /// Endings of the files it reads, in lower case.
    pub fn endings(&self) -> &'static [&'static str] {
        self.layout().endings()
    }
}

impl Source {
    /// Checks the settings that no type can check.
    ///
    /// # Errors
    /// [`IngestError::Setting`] naming the field.
    pub fn check(&self) -> Result<(), IngestError> {
        if self.memory_mb == Some(0) {
            let allowed = "a positive number, or none";
            return Err(IngestError::setting("memory_mb", 0, allowed));
        }
        self.format.layout().check()
    }

    /// The declared ranges, which are the segments 1, 2, … of every recording; none for the layout of the thesis.
    pub fn ranges(&self) -> &[Range] {
        self.format.layout().ranges()
    }
}

/// Reads one file of a source; `lever_arm_m` is the rig's, by which lengths of the grip become angles.
///
/// # Errors
/// As [`read_on`].
pub fn read(source: &Source, file: &Path, lever_arm_m: f64) -> Result<Ingested, IngestError> {
    read_on(&Host, source, file, lever_arm_m)
}

/// Reads one file of a source that lies on `disk`.
///
/// The file's start is judged before the rest is read, and all that is made of the file is taken from its budget
/// ([`Source::memory_mb`]). Of files whose reading takes more than their share of it, one is read at a time.
///
/// # Errors
/// [`IngestError::File`] around the reason; [`IngestError::finding`] makes a finding of it.
pub fn read_on(
    disk: &dyn Disk,
    source: &Source,
    file: &Path,
    lever_arm_m: f64,
) -> Result<Ingested, IngestError> {
    tracing::debug!(file = %file.display(), "reading");
    let budget = Budget::new(source.memory_mb);
    disk.open(file)
        .map_err(IngestError::Read)
        .and_then(|mut input| {
            let layout = source.format.layout();
            layout.read(input.as_mut(), file, lever_arm_m, &budget)
        })
        .map_err(|error| error.in_file(file))
}

#[cfg(test)]
mod tests;
