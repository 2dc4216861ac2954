//! Every Rust file of the workspace with its text, for the checks of what people read.

use crate::reading::{Error, read};
use std::path::{Path, PathBuf};

/// One Rust file.
#[derive(Debug)]
pub struct SourceFile {
    /// Where it stands, from the workspace's folder, with `/` between folders.
    pub path: String,
    /// What it holds.
    pub text: String,
}

impl SourceFile {
    /// The folder it stands in.
    pub fn folder(&self) -> &str {
        self.path.rsplit_once('/').map_or("", |(folder, _)| folder)
    }
}

/// Every Rust file of the workspace in this folder, by path.
///
/// # Errors
/// When a folder or file cannot be read.
pub fn all(root: &Path) -> Result<Vec<SourceFile>, Error> {
    let mut files = Vec::new();
    append(root, "", &mut files)?;
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// Appends the files of a folder and below, but for what cargo built (`target`) and what tools keep (`.git` and the like).
fn append(folder: &Path, inside: &str, files: &mut Vec<SourceFile>) -> Result<(), Error> {
    let unreadable = |source| Error::Unreadable {
        path: folder.to_path_buf(),
        source,
    };
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let paths: Result<Vec<PathBuf>, _> = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect();
    for path in paths.map_err(unreadable)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_dir = path.is_dir();
        if is_dir && name != "target" && !name.starts_with('.') {
            append(&path, &format!("{inside}{name}/"), files)?;
        } else if !is_dir && name.ends_with(".rs") {
            files.push(SourceFile {
                path: format!("{inside}{name}"),
                text: read(&path)?,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
impl SourceFile {
    /// A made-up one.
    pub fn of(path: &str, text: &str) -> Self {
        Self {
            path: path.into(),
            text: text.into(),
        }
    }
}
