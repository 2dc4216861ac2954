use crate::csv::CsvLayout;
use crate::finding_log::{About, FindingLog};
use crate::mat::MatFile;
use crate::mcap::McapLayout;
use crate::range::Range;
use crate::thesis_layout::ThesisLayout;
use crate::{IngestError, mcap};
use serde::{Deserialize, Serialize};
use snug_campaign::{Finding, Recording};
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
}

/// How measurement files are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Format {
    /// MAT files of any level in the layout of the thesis (`.mat`), and Snug's own recordings (`.mcap`).
    Thesis(ThesisLayout),
    /// Delimited text with declared columns (`.csv`, `.tsv`, `.txt`).
    Csv(CsvLayout),
    /// MCAP with declared topics (`.mcap`).
    Mcap(McapLayout),
}

impl Default for Format {
    fn default() -> Self {
        Self::Thesis(ThesisLayout::default())
    }
}

/// The files that a source reads, and what else lies there.
#[derive(Debug, Clone, PartialEq)]
pub struct Listing {
    /// Files in the order in which they are to be read.
    pub files: Vec<PathBuf>,
    /// Files that look like data, but are of another format.
    pub findings: Vec<Finding>,
}

/// What one file gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Ingested {
    /// Recordings, mostly one; a recording that Snug wrote holds one per measurement file.
    pub recordings: Vec<Recording>,
    /// What a reader of the results must know about the file.
    pub findings: Vec<Finding>,
}

/// Endings of files that hold measurements in some program.
const DATA_ENDINGS: &[&str] = &[
    "mat", "mcap", "csv", "tsv", "txt", "json", "h5", "hdf5", "parquet", "arrow", "feather", "xls",
    "xlsx", "tdms", "dxd", "d7d", "dat", "bag", "db3", "mf4", "mdf", "zip", "gz",
];

impl Format {
    /// Endings of the files it reads, in lower case.
    pub fn endings(&self) -> &'static [&'static str] {
        match self {
            Self::Thesis(_) => &["mat", "mcap"],
            Self::Csv(_) => &["csv", "tsv", "txt"],
            Self::Mcap(_) => &["mcap"],
        }
    }
}

impl Source {
    /// Checks the settings that no type can check.
    ///
    /// # Errors
    /// [`IngestError::Setting`] naming the field.
    pub fn check(&self) -> Result<(), IngestError> {
        match &self.format {
            Format::Thesis(layout) => layout.check(),
            Format::Csv(layout) => layout.check(),
            Format::Mcap(layout) => layout.check(),
        }
    }

    /// The declared ranges, which are the segments 1, 2, … of every recording; none for the layout of the thesis.
    pub fn ranges(&self) -> &[Range] {
        match &self.format {
            Format::Thesis(_) => &[],
            Format::Csv(layout) => &layout.ranges,
            Format::Mcap(layout) => &layout.ranges,
        }
    }
}

/// The files of a source in `path` (a folder, or one file whatever its ending), sorted by name unless the source names
/// them.
///
/// Of a folder only its own files count, not those of folders within. MCAP recordings beside MAT files are not read: they
/// may hold the same tightenings. They, and files that other programs keep data in, are a finding; anything else is
/// passed over.
///
/// # Errors
/// [`IngestError::NoSuchPath`], [`IngestError::NotAFile`], [`IngestError::NothingToRead`], [`IngestError::NoSuchFile`].
pub fn list(source: &Source, path: &Path) -> Result<Listing, IngestError> {
    if path.is_file() {
        return Ok(Listing {
            files: vec![path.to_owned()],
            findings: Vec::new(),
        });
    }
    if !path.is_dir() {
        let path = path.to_owned();
        return Err(if path.exists() {
            IngestError::NotAFile { path }
        } else {
            IngestError::NoSuchPath { path }
        });
    }
    if !source.files.is_empty() {
        return named(source, path);
    }
    let endings = source.format.endings();
    let mut files = Vec::new();
    let mut others = Vec::new();
    for entry in std::fs::read_dir(path).map_err(|error| IngestError::Read(error).in_file(path))? {
        let file = entry
            .map_err(|error| IngestError::Read(error).in_file(path))?
            .path();
        // `._x.mat` and the like are shadows that systems and programs leave behind.
        let hidden = file
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if !file.is_file() || hidden {
            continue;
        }
        if endings.contains(&ending(&file).as_str()) {
            files.push(file);
        } else {
            others.push(file);
        }
    }
    if files.is_empty() {
        return Err(IngestError::NothingToRead {
            folder: path.to_owned(),
            expected: dotted(endings),
            others: others.len(),
        });
    }
    if files.iter().any(|file| ending(file) == "mat") {
        // A recording beside the files it was made of would count every tightening twice.
        let (read, recordings) = files.into_iter().partition(|file| ending(file) == "mat");
        files = read;
        others.extend::<Vec<PathBuf>>(recordings);
    }
    files.sort();
    others.sort();
    Ok(Listing {
        files,
        findings: others
            .iter()
            .filter_map(|file| other_format(file, endings))
            .collect(),
    })
}

fn named(source: &Source, folder: &Path) -> Result<Listing, IngestError> {
    let mut files = Vec::with_capacity(source.files.len());
    for name in &source.files {
        let file = folder.join(name);
        if !file.is_file() {
            return Err(IngestError::NoSuchFile {
                folder: folder.to_owned(),
                file: name.clone(),
            });
        }
        files.push(file);
    }
    Ok(Listing {
        files,
        findings: Vec::new(),
    })
}

fn other_format(file: &Path, endings: &[&str]) -> Option<Finding> {
    if !DATA_ENDINGS.contains(&ending(file).as_str()) {
        return None;
    }
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let mut log = FindingLog::new(&name);
    if endings.contains(&ending(file).as_str()) {
        log.note(
            "recording_beside_mat",
            About::File,
            "not read, because it may hold the same tightenings as the .mat files beside it"
                .to_owned(),
        );
    } else {
        log.note(
            "other_format",
            About::File,
            format!(
                "not read: the study's source reads {} only",
                dotted(endings)
            ),
        );
    }
    log.finish().pop()
}

/// Reads one file of a source; `lever_arm_m` is the rig's, by which lengths of the grip become angles.
///
/// # Errors
/// [`IngestError::File`] around the reason; [`IngestError::finding`] makes a finding of it.
pub fn read(source: &Source, file: &Path, lever_arm_m: f64) -> Result<Ingested, IngestError> {
    tracing::debug!(file = %file.display(), "reading");
    read_content(&source.format, file, lever_arm_m).map_err(|error| error.in_file(file))
}

fn read_content(format: &Format, file: &Path, lever_arm_m: f64) -> Result<Ingested, IngestError> {
    let content = std::fs::read(file).map_err(IngestError::Read)?;
    match format {
        Format::Thesis(_) if ending(file) == "mcap" => {
            mcap::read(&McapLayout::default(), &content, file, lever_arm_m)
        }
        Format::Thesis(layout) => layout.recording(&MatFile::from_bytes(content)?, file),
        Format::Csv(layout) => layout.recording(&content, file, lever_arm_m),
        Format::Mcap(layout) => mcap::read(layout, &content, file, lever_arm_m),
    }
}

fn ending(file: &Path) -> String {
    file.extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase()
}

fn dotted(endings: &[&str]) -> String {
    let dotted: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    dotted.join(" or ")
}

#[cfg(test)]
mod tests;
