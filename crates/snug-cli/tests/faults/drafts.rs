//! `init` writes over nothing that is there, and whoever needs it is told.

use crate::program::{ended, snug, text};
use std::fs;
use std::path::Path;

/// A table that a study can be drafted for.
fn table() -> String {
    let row = |k: i32| {
        let t = f64::from(k) * 0.01;
        format!("{t},{},{}\n", (5.0 * t).sin(), (5.0 * t - 0.3).sin() / 20.0)
    };
    let rows = (0..600).map(row);
    std::iter::once("time,torque,angle\n".to_owned())
        .chain(rows)
        .collect()
}

#[test]
fn a_folder_without_a_study_gets_one_that_runs() {
    let folder = tempfile::tempdir().unwrap();
    let (data, out) = (folder.path().join("rig"), folder.path().join("out"));
    fs::create_dir(&data).unwrap();
    fs::write(data.join("a.csv"), table()).unwrap();
    let (code, said) = ended(&mut snug(&[
        "run",
        "--data",
        text(&data),
        "--out",
        text(&out),
    ]));
    assert_eq!(code, 1, "{said}");
    assert!(
        said.contains(&format!("snug init {}", text(&data))),
        "{said}"
    );

    let study = folder.path().join("rig.ron");
    let drafted = |more: &[&str]| {
        let words = ["init", text(&data), "--study", text(&study)];
        ended(&mut snug(&[&words, more].concat()))
    };
    let (code, said) = drafted(&[]);
    assert_eq!(code, 0, "{said}");
    assert!(
        said.contains("▁") && said.contains("taken as Torque in NewtonMetre"),
        "{said}"
    );
    let compare = format!("snug compare --study {}", text(&study));
    assert!(said.contains(&compare), "{said}");
    let (code, said) = ended(&mut snug(&[
        "compare",
        "--study",
        text(&study),
        "--out",
        text(&out),
    ]));
    assert_eq!(code, 0, "{said}");

    fs::write(&study, "mine").unwrap();
    let (code, said) = drafted(&[]);
    assert_eq!(
        (code, fs::read_to_string(&study).unwrap().as_str()),
        (2, "mine"),
        "{said}"
    );
    assert!(said.contains("--write writes over it"), "{said}");
    assert_eq!(drafted(&["--write"]).0, 0);
    assert!(
        fs::read_to_string(&study)
            .unwrap()
            .contains("path: \"rig\"")
    );
}

#[test]
fn no_study_is_written_over_a_measurement() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("a.csv");
    fs::write(&data, table()).unwrap();
    let link = folder.path().join("rig.ron");
    std::os::unix::fs::symlink(&data, &link).unwrap();
    let over = |study: &Path| {
        ended(&mut snug(&[
            "init",
            text(&data),
            "--study",
            text(study),
            "--write",
        ]))
    };
    for study in [&data, &link] {
        let (code, said) = over(study);
        assert_eq!(code, 2, "{said}");
        assert!(
            said.contains("its name must end in .ron, and lead to none of the measurements"),
            "{said}"
        );
        assert_eq!(fs::read_to_string(&data).unwrap(), table());
    }
}
