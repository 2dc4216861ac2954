//! Every MAT file at hand gives what SciPy (levels 4 and 5) and h5py (7.3) read from it, or a clear error where they
//! give one. `tests/data/README.md` says how the tables were made.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use serde_json::Value as Json;
use snug_ingest::mat::{Content, MatFile, Value};
use std::path::{Path, PathBuf};

fn own_data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")
}

fn table(name: &str) -> Json {
    serde_json::from_slice(&std::fs::read(own_data().join(name)).unwrap()).unwrap()
}

#[test]
fn files_written_by_scipy_and_h5py() {
    check_all(&own_data().join("mat"), &table("written_expected.json"), 6);
}

#[test]
fn collected_files_of_every_version() {
    let Some(data) = std::env::var_os("SNUG_DATA") else {
        eprintln!("skipped: SNUG_DATA is not set");
        return;
    };
    check_all(
        &Path::new(&data).join("mat-files"),
        &table("mat_expected.json"),
        31,
    );
}

fn check_all(folder: &Path, table: &Json, files: usize) {
    let table = table.as_object().unwrap();
    assert_eq!(table.len(), files);
    for (file, expected) in table {
        let read = MatFile::read(&folder.join(file));
        if !cfg!(feature = "hdf5")
            && matches!(&read, Err(error) if error.code() == "unknown_format")
        {
            continue;
        }
        if expected.get("error").is_some() {
            let message = read.expect_err(file).to_string();
            assert!(
                message.contains(file) && message.len() > file.len() + 20,
                "{message}"
            );
            continue;
        }
        let read = read.unwrap_or_else(|error| panic!("{error}"));
        let expected = expected["variables"].as_object().unwrap();
        assert_eq!(
            read.variables.len(),
            expected.len(),
            "{file}: number of variables"
        );
        for (name, node) in expected {
            let value = read
                .variable(name)
                .unwrap_or_else(|| panic!("{file}: {name} is missing"));
            check(value, node, &format!("{file}: {name}"));
        }
    }
}

fn check(value: &Value, node: &Json, place: &str) {
    let kind = node["kind"].as_str().unwrap();
    if kind == "unsupported" {
        assert!(matches!(value.content, Content::Unsupported(_)), "{place}");
        return;
    }
    let dims: Vec<usize> = node["dims"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_u64().unwrap() as usize)
        .collect();
    assert_eq!(value.dims, dims, "{place}: shape");
    match (&value.content, kind) {
        (Content::Numeric { real, imaginary }, "numeric") => {
            assert_eq!(
                value.class_name(),
                node["class"].as_str().unwrap(),
                "{place}: class"
            );
            check_numbers(&real.to_f64(), node, place);
            assert_eq!(
                imaginary.is_some(),
                node.get("imag").is_some(),
                "{place}: complex"
            );
            if let Some(imaginary) = imaginary {
                assert_close(&imaginary.to_f64(), &numbers(&node["imag"]), place);
            }
        }
        (Content::Logical(_), "logical") => {
            check_numbers(&value.to_f64().unwrap(), node, place);
        }
        (Content::Text(_), "char") => {
            let rows: Vec<&str> = node["rows"]
                .as_array()
                .unwrap()
                .iter()
                .map(|row| row.as_str().unwrap())
                .collect();
            let read: Vec<String> = value
                .rows()
                .unwrap()
                .into_iter()
                .filter(|row| !row.is_empty())
                .collect();
            assert_eq!(read, rows, "{place}: text");
        }
        (Content::Cell(elements), "cell") => {
            for (index, node) in node["elements"].as_array().unwrap().iter().enumerate() {
                check(&elements[index], node, &format!("{place}{{{index}}}"));
            }
            assert_eq!(
                elements.len(),
                dims.iter().product::<usize>(),
                "{place}: cells"
            );
        }
        (Content::Struct { fields, .. }, "struct") => {
            let expected = node["fields"].as_array().unwrap();
            assert_eq!(fields.len(), expected.len(), "{place}: fields");
            for (field, node) in fields.iter().zip(expected) {
                assert_eq!(
                    field.name,
                    node[0].as_str().unwrap(),
                    "{place}: field order"
                );
                for (index, node) in node[1].as_array().unwrap().iter().enumerate() {
                    check(
                        &field.values[index],
                        node,
                        &format!("{place}.{}[{index}]", field.name),
                    );
                }
            }
        }
        (Content::Sparse(sparse), "sparse") => {
            let starts: Vec<usize> = numbers(&node["starts"])
                .iter()
                .map(|&n| n as usize)
                .collect();
            for (column, bounds) in starts.windows(2).enumerate() {
                assert!(
                    sparse.columns[bounds[0]..bounds[1]]
                        .iter()
                        .all(|&c| c == column),
                    "{place}"
                );
            }
            let logical = node.get("logical").and_then(Json::as_bool);
            assert_eq!(sparse.logical, logical.unwrap_or(false), "{place}: class");
            let rows: Vec<f64> = sparse.rows.iter().take(50).map(|&row| row as f64).collect();
            assert_eq!(rows, numbers(&node["rows"]), "{place}: rows");
            assert_close(&sparse.real, &numbers(&node["first"]), place);
            if let Some(imaginary) = &sparse.imaginary {
                assert_close(imaginary, &numbers(&node["imag"]), place);
            }
        }
        (content, kind) => panic!("{place}: expected {kind}, read {content:?}"),
    }
}

fn check_numbers(read: &[f64], node: &Json, place: &str) {
    assert_close(read, &numbers(&node["first"]), place);
    let sum = numbers(&Json::Array(vec![node["sum"].clone()]))[0];
    let scale: f64 = read.iter().map(|value| value.abs()).sum();
    if sum.is_nan() {
        assert!(read.iter().sum::<f64>().is_nan(), "{place}: sum");
    } else {
        // Only the order of the additions differs.
        assert!(
            (read.iter().sum::<f64>() - sum).abs() <= 1e-12 * scale,
            "{place}: sum"
        );
    }
}

/// The first numbers, bit for bit; NaN equals NaN.
fn assert_close(read: &[f64], expected: &[f64], place: &str) {
    assert!(
        read.len() >= expected.len(),
        "{place}: {} numbers",
        read.len()
    );
    for (read, expected) in read.iter().zip(expected) {
        assert!(
            read == expected || (read.is_nan() && expected.is_nan()),
            "{place}: {read} is not {expected}"
        );
    }
}

fn numbers(node: &Json) -> Vec<f64> {
    let number = |item: &Json| match item.as_str() {
        Some(text) => text.parse().unwrap(),
        None => item.as_f64().unwrap(),
    };
    node.as_array().unwrap().iter().map(number).collect()
}
