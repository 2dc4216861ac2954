use std::ffi::OsString;
use std::path::Path;
use std::{fs, io};

/// Writes a file whole or not at all: until all of `text` is on its way, `path` keeps what it holds.
///
/// The text is written beside the file, into one whose name ends in `.part`, which then takes its place. A link is
/// followed, and the file's permissions stay.
///
/// # Errors
/// What the operating system says; the file is then as it was.
pub fn write_whole(path: &Path, text: &str) -> io::Result<()> {
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let mut part = OsString::from(&place);
    part.push(".part");
    let written = fs::write(&part, text)
        .and_then(|()| match fs::metadata(&place) {
            Ok(known) => fs::set_permissions(&part, known.permissions()),
            Err(_) => Ok(()),
        })
        .and_then(|()| fs::rename(&part, &place));
    if written.is_err() {
        // What is left of the attempt; the first error says why.
        fs::remove_file(&part).ok();
    }
    written
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_or_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("study.ron");
        write_whole(&path, "first").unwrap();
        write_whole(&path, "second").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "second");
        let taken = folder.path().join("taken");
        fs::create_dir(&taken).unwrap();
        write_whole(&taken, "no file can stand here").unwrap_err();
        let mut names: Vec<_> = (fs::read_dir(&folder).unwrap())
            .map(|entry| entry.unwrap().file_name())
            .collect();
        names.sort();
        assert_eq!(names, ["study.ron", "taken"], "nothing else is left behind");
    }
}
