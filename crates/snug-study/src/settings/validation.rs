//! What is kept for validation: which ranges and files.

use crate::error::StudyError;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Which tightenings are not fitted but only simulated, with the mean parameters of the fitted ones: those of a range with what was
/// fitted of the same recording, those of a file with what was fitted of all other files.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ValidationSettings {
    /// Names of the source's ranges; default none.
    pub ranges: Vec<String>,
    /// Names of files, in which `*` stands for any characters and `?` for one, for example `["TP6_*", "test-3.csv"]`; default
    /// none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// Samples at the start of each that are simulated but not scored; default 0.
    pub unscored_samples: usize,
}

impl ValidationSettings {
    /// Whether anything is kept.
    pub(crate) fn keeps_any(&self) -> bool {
        !(self.ranges.is_empty() && self.files.is_empty())
    }

    /// Whether a file is kept as a whole.
    pub(crate) fn keeps(&self, file: &Path) -> bool {
        let name = name_of(file);
        self.files.iter().any(|pattern| matches(pattern, &name))
    }

    /// The files that are fitted and, behind them, those that are kept.
    ///
    /// # Errors
    /// [`StudyError::NoSuchValidationFile`] where a name or pattern stands for none of them, [`StudyError::NothingToFit`] where
    /// all are kept.
    pub(crate) fn last(&self, files: Vec<PathBuf>) -> Result<Vec<PathBuf>, StudyError> {
        let is_any = |pattern: &&String| !files.iter().any(|one| matches(pattern, &name_of(one)));
        if let Some(name) = self.files.iter().find(is_any) {
            return Err(StudyError::NoSuchValidationFile {
                name: name.clone(),
                known: files.iter().map(|file| name_of(file)).collect(),
            });
        }
        let (kept, mut all): (Vec<_>, Vec<_>) =
            files.into_iter().partition(|file| self.keeps(file));
        if all.is_empty() && !kept.is_empty() {
            return Err(StudyError::NothingToFit { files: kept.len() });
        }
        all.extend(kept);
        Ok(all)
    }
}

fn name_of(file: &Path) -> String {
    (file.file_name().unwrap_or_default())
        .to_string_lossy()
        .into_owned()
}

/// Whether `name` is what `pattern` says, in which `*` stands for any characters and `?` for one.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    // Where the latest star stands and how far it reaches: of several stars only the last has to be tried again.
    let (mut at, mut in_name, mut star) = (0, 0, None);
    while in_name < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, in_name));
                at += 1;
            }
            Some(&one) if one == '?' || one == name[in_name] => {
                (at, in_name) = (at + 1, in_name + 1);
            }
            _ => match star {
                Some((before, reach)) => {
                    star = Some((before, reach + 1));
                    (at, in_name) = (before + 1, reach + 1);
                }
                None => return false,
            },
        }
    }
    pattern[at..].iter().all(|one| *one == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_matched_as_on_a_command_line() {
        for (pattern, name, is_it) in [
            ("test.csv", "test.csv", true),
            ("test.csv", "test.csv2", false),
            ("TP6_*", "TP6_QS_Soft_8.mat", true),
            ("TP6_*", "TP16_QS_Soft_8.mat", false),
            ("*_8.mat", "TP6_8_8.mat", true),
            ("*Soft*8*", "TP6_QS_Soft_8.mat", true),
            ("run?.csv", "run7.csv", true),
            ("run?.csv", "run.csv", false),
            ("*", "", true),
            ("", "a", false),
            ("**a*b", "aab", true),
            ("*ab", "abaab", true),
        ] {
            assert_eq!(matches(pattern, name), is_it, "{pattern} {name}");
        }
    }
}
