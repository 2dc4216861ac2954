//! The parts of a file's name.

use std::ffi::OsStr;
use std::path::Path;

/// A file's name, and the same without its ending.
pub(crate) fn name_and_stem(path: &Path) -> (String, String) {
    let text = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    (text(path.file_name()), text(path.file_stem()))
}

/// A file's ending, in lower case, without the point.
pub(crate) fn ending(file: &Path) -> String {
    file.extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase()
}
