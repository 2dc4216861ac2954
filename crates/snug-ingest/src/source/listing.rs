//! Which files of a folder are read, and why the others are not.

use super::Source;
use super::entry::Entry;
use crate::error::IngestError;
use crate::file::name::{ending, name_and_stem};
use snug_campaign::{Finding, Severity};
use snug_files::{Disk, Host, Identity};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The files that a source reads, and what else lies there.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Listing {
    /// Files in the order in which they are to be read.
    pub files: Vec<PathBuf>,
    /// One for every entry of the folder that is not read, by name: what it is, and whether measurements may be lost.
    pub findings: Vec<Finding>,
}

/// Endings of files that hold measurements in some program.
const DATA_ENDINGS: &[&str] = &[
    "mat", "mcap", "csv", "tsv", "txt", "json", "h5", "hdf5", "parquet", "arrow", "feather", "xls",
    "xlsx", "tdms", "dxd", "d7d", "dat", "bag", "db3", "mf4", "mdf", "zip", "gz",
];

/// The files of a source in `path`.
///
/// # Errors
/// As [`list_on`].
pub fn list(source: &Source, path: &Path) -> Result<Listing, IngestError> {
    list_on(&Host, source, path)
}

/// The files of a source in `path` (a folder, or one file whatever its ending) on `disk`, sorted by name unless the source
/// names them.
///
/// Of a folder only its own files count, not those of folders within. MCAP recordings beside MAT files are not read: they
/// may hold the same tightenings; nor is one file that has several names read twice. Every entry of the folder is either
/// read or a finding, unless the source names its files.
///
/// # Errors
/// [`IngestError::NoSuchPath`], [`IngestError::DanglingLink`], [`IngestError::LinkLoop`], [`IngestError::NotAFile`],
/// [`IngestError::NothingToRead`], [`IngestError::NoSuchFile`].
pub fn list_on(disk: &dyn Disk, source: &Source, path: &Path) -> Result<Listing, IngestError> {
    match Entry::of_named(disk, path) {
        Entry::File => Ok(Listing {
            files: vec![path.to_owned()],
            findings: Vec::new(),
        }),
        Entry::Folder if source.files.is_empty() => all(disk, source, path),
        Entry::Folder => named(disk, source, path),
        entry => Err(entry.error(path.to_owned(), "a folder or a file with measurements")),
    }
}

fn all(disk: &dyn Disk, source: &Source, folder: &Path) -> Result<Listing, IngestError> {
    let endings = source.format.endings();
    let mut entries = disk
        .entries(folder)
        .map_err(|error| IngestError::Read(error).in_file(folder))?;
    entries.sort();
    let mut listing = Listing::default();
    for path in entries {
        match unread(disk, &path, endings) {
            Some(finding) => listing.findings.push(finding),
            None => listing.files.push(path),
        }
    }
    if listing.files.is_empty() {
        return Err(IngestError::NothingToRead {
            folder: folder.to_owned(),
            expected: dotted(endings),
            found: listing.findings.iter().map(told).collect(),
        });
    }
    listing.without_recordings();
    listing.without_second_names(disk);
    listing.findings.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(listing)
}

fn named(disk: &dyn Disk, source: &Source, folder: &Path) -> Result<Listing, IngestError> {
    let mut listing = Listing::default();
    for name in &source.files {
        let file = folder.join(name);
        match Entry::of_named(disk, &file) {
            Entry::File => listing.files.push(file),
            Entry::Nothing => {
                return Err(IngestError::NoSuchFile {
                    folder: folder.to_owned(),
                    file: name.clone(),
                });
            }
            entry => return Err(entry.error(file, "a file, because the source names it")),
        }
    }
    listing.without_second_names(disk);
    Ok(listing)
}

impl Listing {
    /// A recording beside the files it was made of would count every tightening twice.
    fn without_recordings(&mut self) {
        if !self.files.iter().any(|file| ending(file) == "mat") {
            return;
        }
        let recordings = self.files.extract_if(.., |file| ending(file) != "mat");
        self.findings.extend(recordings.map(|path| {
            finding(
                Severity::Note,
                "recording_beside_mat",
                &path,
                "not read, because it may hold the same tightenings as the .mat files beside it",
            )
        }));
    }

    /// A file of two names would count every tightening twice.
    fn without_second_names(&mut self, disk: &dyn Disk) {
        let mut first_names: HashMap<Identity, PathBuf> = HashMap::new();
        let findings = &mut self.findings;
        self.files.retain(|path| {
            // What cannot be told is found out, and said, when it is read.
            let Ok(Some(identity)) = Identity::of(disk, path) else {
                return true;
            };
            let Some(first) = first_names.get(&identity) else {
                first_names.insert(identity, path.clone());
                return true;
            };
            let message = format!(
                "not read again: it is the same file as {}, which is read",
                name_and_stem(first).0
            );
            findings.push(finding(Severity::Note, "same_file", path, &message));
            false
        });
    }
}

/// Why an entry of the folder is not read; `None` for a file that is.
fn unread(disk: &dyn Disk, path: &Path, endings: &[&str]) -> Option<Finding> {
    let ends_like_one = endings.contains(&ending(path).as_str());
    // `._x.mat` and the like are shadows that systems and programs leave behind.
    let hidden = name_and_stem(path).0.starts_with('.');
    let severity = if ends_like_one && !hidden {
        Severity::LeftOut
    } else {
        Severity::Note
    };
    let entry = Entry::of(disk, path);
    let (code, message) = match &entry {
        Entry::File if hidden => (
            "not_read",
            "not read: hidden files are passed over".to_owned(),
        ),
        Entry::File if ends_like_one => return None,
        Entry::File if DATA_ENDINGS.contains(&ending(path).as_str()) => (
            "other_format",
            format!(
                "not read: the study's source reads {} only",
                dotted(endings)
            ),
        ),
        Entry::File => (
            "not_read",
            format!("not read: its name does not end in {}", dotted(endings)),
        ),
        Entry::Folder if !ends_like_one => (
            "not_read",
            "not read: folders inside the data folder are not looked into".to_owned(),
        ),
        Entry::Folder | Entry::Other(_) => (
            "not_a_file",
            format!("cannot be read: it is {}", entry.name()),
        ),
        // The folder lists it, so what is missing is what it leads to.
        Entry::Nothing | Entry::DanglingLink => (
            "dangling_link",
            "cannot be read: it is a link that leads nowhere; what it named was moved or removed"
                .to_owned(),
        ),
        Entry::LinkLoop => (
            "link_loop",
            "cannot be read: it is a link that leads back to itself".to_owned(),
        ),
        Entry::Refused(error) => ("unreadable_file", format!("cannot be read: {error}")),
    };
    Some(finding(severity, code, path, &message))
}

fn finding(severity: Severity, code: &str, path: &Path, message: &str) -> Finding {
    Finding {
        severity,
        code: code.to_owned(),
        file: name_and_stem(path).0,
        tightening: None,
        channel: None,
        message: message.to_owned(),
    }
}

/// An entry that is not read, in a few words.
fn told(finding: &Finding) -> String {
    let what = match finding.code.as_str() {
        "dangling_link" => " (a link that leads nowhere)",
        "link_loop" => " (a link that leads back to itself)",
        "not_a_file" => " (no file)",
        "unreadable_file" => " (not accessible)",
        _ => "",
    };
    format!("{}{what}", finding.file)
}

fn dotted(endings: &[&str]) -> String {
    let dotted: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    dotted.join(" or ")
}
