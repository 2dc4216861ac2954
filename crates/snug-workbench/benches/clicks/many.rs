//! The mystery many times over: the same tightenings, made by more people.

use crate::server::study_in;
use std::path::{Path, PathBuf};

/// A study in `folder` on so many copies of the mystery.
pub fn study_of(folder: &Path, copies: usize) -> PathBuf {
    let study = study_in(folder);
    if copies == 1 {
        return study;
    }
    let mystery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/mystery");
    let data = folder.join("data");
    std::fs::create_dir(&data).unwrap();
    for file in std::fs::read_dir(mystery).unwrap() {
        let file = file.unwrap();
        let name = file.file_name().into_string().unwrap();
        for copy in 0..copies {
            let (person, rest) = name.split_at(3);
            std::fs::copy(file.path(), data.join(format!("{person}{copy}{rest}"))).unwrap();
        }
    }
    std::fs::write(&study, format!("(source: (path: {data:?}))")).unwrap();
    study
}
