//! What is found in tables, MAT variables and JSON trees.
#![allow(clippy::unwrap_used)]

use super::*;
use std::path::PathBuf;

fn surveyed(name: &str, content: &str) -> Survey {
    let folder = tempfile::tempdir().unwrap();
    let file: PathBuf = folder.path().join(name);
    std::fs::write(&file, content).unwrap();
    survey(&file).unwrap()
}

/// Place and unit of every column.
fn places(survey: &Survey) -> Vec<String> {
    let told = |column: &SurveyedColumn| match &column.place {
        SurveyedPlace::Column(place) => format!("{place} {}", column.unit),
        SurveyedPlace::Path(path, part) => format!("{path} {part:?} {}", column.unit),
    };
    survey.columns.iter().map(told).collect()
}

#[test]
fn tables_with_units_above_or_beside_the_names() {
    let rows: String = (0..20)
        .map(|row| format!("{row},{},{}\n", 2 * row, if row == 0 { "4" } else { "" }))
        .collect();
    let found = surveyed("a.csv", &format!("t [ms],M (Nm),Ts\n{rows}"));
    assert_eq!(places(&found), ["t [ms] ms", "M (Nm) Nm"]);
    assert_eq!(found.numbers, [("Ts".to_owned(), 4.0)]);
    let found = surveyed("a.txt", &format!("t,M\ns,Nm\n{rows}"));
    assert_eq!(places(&found), ["t s", "M Nm"]);
    assert_eq!(
        places(&surveyed("a.csv", &rows)),
        ["column 0 ", "column 1 "]
    );
}

#[test]
fn trees_of_other_programs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/thesis");
    let thesis = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    for file in thesis.filter(|file| file.extension().is_some_and(|ending| ending == "mat")) {
        assert!(survey(&file).unwrap().is_thesis);
    }
    let rows: Vec<String> = (0..20).map(|row| format!("[{row}, 1]")).collect();
    let samples: Vec<String> = (0..20)
        .map(|row| format!("{{\"w\": {row}, \"id\": \"x\"}}"))
        .collect();
    let text = format!(
        r#"{{"fs": 100, "torque unit": "Nm", "t": [{}], "samples": [{}]}}"#,
        rows.join(","),
        samples.join(",")
    );
    let found = surveyed("a.json", &text);
    assert_eq!(
        places(&found),
        ["samples[].w Whole ", "t Column(0) ", "t Column(1) "]
    );
    assert_eq!(found.numbers, [("fs".to_owned(), 100.0)]);
    assert_eq!(found.texts, [("torque unit".to_owned(), "Nm".to_owned())]);
}

#[test]
fn what_cannot_be_surveyed() {
    let told = survey(Path::new("a.parquet")).unwrap_err().to_string();
    assert!(told.contains("a.parquet"), "{told}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.json");
    std::fs::write(&file, "{\"a\": [1,").unwrap();
    assert!(
        survey(&file)
            .unwrap_err()
            .to_string()
            .contains("line 1, column 9: no JSON")
    );
}
