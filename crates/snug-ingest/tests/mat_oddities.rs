//! MAT 7.3 files with what MATLAB and other programs write besides plain arrays, and files made to do harm.
#![cfg(feature = "hdf5")]
#![allow(clippy::unwrap_used)]

use snug_ingest::IngestError;
use snug_ingest::mat::{Content, MatFile, Unsupported, Value};
use std::path::Path;

fn open(file: &str) -> Result<MatFile, IngestError> {
    MatFile::read(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/data")
            .join(file),
    )
}

#[test]
fn oddities_of_version_7_3() {
    let file = open("mat/h5py_odd.mat").unwrap();
    let value = |name: &str| -> &Value { file.variable(name).unwrap() };
    assert_eq!(
        value("handle").content,
        Content::Unsupported(Unsupported::FunctionHandle)
    );
    assert_eq!(value("when").class_name(), "datetime");
    assert!(matches!(value("when").content, Content::Unsupported(_)));
    assert_eq!(value("old_object").class_name(), "polynom");
    assert_eq!(
        value("old_object").field("c").unwrap()[0].to_f64().unwrap(),
        [1.0, 2.0]
    );
    assert!(matches!(
        value("unfilled").content,
        Content::Unsupported(Unsupported::ForeignHdf5 { .. })
    ));
    let global: Vec<&str> = file
        .variables
        .iter()
        .filter(|v| v.global)
        .map(|v| v.name.as_str())
        .collect();
    assert_eq!(global, ["shared"]);
    let Content::Struct { fields, .. } = &value("no_elements").content else {
        panic!("{:?}", value("no_elements"));
    };
    let names: Vec<&str> = fields.iter().map(|field| field.name.as_str()).collect();
    assert_eq!(
        (value("no_elements").dims.as_slice(), names),
        (&[0, 2][..], vec!["bb", "a"])
    );
    assert_eq!(value("big_endian").to_f64().unwrap(), [0.0, 1.0, 2.0]);
    assert_eq!(value("scalar").to_f64().unwrap(), [2.5]);
    assert_eq!(value("flags").content, Content::Logical(vec![true, false]));
    assert_eq!(value("remark").text().unwrap(), "plain HDF5 µ");
    assert!(matches!(value("records").content, Content::Unsupported(_)));
    assert!(matches!(&value("zero_sparse").content, Content::Sparse(s) if s.rows.is_empty()));
    assert_eq!(
        (
            value("zero_sparse").dims.as_slice(),
            value("lazy").dims.as_slice()
        ),
        (&[4, 3][..], &[2, 200][..])
    );
}

#[test]
fn files_made_to_do_harm_are_refused() {
    for file in [
        "cells_in_a_circle",
        "eight_terabytes",
        "one_text_many_times",
    ] {
        let error = open(&format!("mat_hostile/{file}.mat")).expect_err(file);
        assert!(error.finding().message.len() > 40, "{error}");
    }
}

/// One of its chunks says that it is 4 GB long; the file has 21 kB.
#[test]
fn a_chunk_that_ends_beyond_the_file_is_refused_before_room_is_made_for_it() {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../fixtures/fuzz/hdf5/chunk_beyond_file.mat");
    MatFile::read(&file).unwrap_err();
}
