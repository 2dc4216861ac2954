//! Study files.

use super::Target;
use crate::mutation::Mutation;
use snug_study::Study;
use std::path::Path;

pub const TARGET: Target = Target {
    name: "study",
    file: "input.ron",
    mutate: Mutation::bytes,
    attempt,
};

fn attempt(file: &Path, _: &[u8]) {
    match Study::read(file) {
        Ok(study) => {
            let again = study
                .to_ron()
                .expect("a study that was read can be written");
            std::fs::write(file, again).unwrap();
            let same = Study::read(file).expect("a study as written can be read");
            // NaN is not equal to itself, so the texts are compared.
            assert_eq!(
                same.to_ron().unwrap(),
                std::fs::read_to_string(file).unwrap()
            );
        }
        Err(error) => assert!(error.to_string().len() < 6000, "{error}"),
    }
}
