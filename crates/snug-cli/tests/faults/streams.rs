//! Readers that go away and redirections to a full disk.

use crate::program::{ended, few_files, results, snug, snug_below, words};
use std::process::Stdio;

#[test]
fn a_reader_that_has_gone_is_no_failure() {
    let data = few_files(1);
    let out = tempfile::tempdir().unwrap();
    let words = words("run", data.path(), out.path());
    let mut child = snug(&words).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{complaint}");
    assert!(!complaint.contains("panicked"), "{complaint}");
    assert_eq!(results(out.path()).len(), 7);
    for words in [
        &["effects"] as &[&str],
        &["effects", "backlash"],
        &["--help"],
    ] {
        let mut child = snug(words).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{words:?}");
    }
}

#[test]
fn a_full_disk_behind_standard_output_is_told() {
    let data = few_files(1);
    let out = tempfile::tempdir().unwrap();
    let words = words("run", data.path(), out.path());
    let full = || {
        Stdio::from(
            std::fs::File::options()
                .write(true)
                .open("/dev/full")
                .unwrap(),
        )
    };
    let (code, said) = ended(snug(&words).stdout(full()));
    assert_eq!(code, 1, "{said}");
    assert!(
        said.contains("the summary cannot be printed: No space left"),
        "{said}"
    );
    assert_eq!(results(out.path()).len(), 7, "the results are there");
    let (code, _) = ended(snug(&words).stdout(full()).stderr(full()));
    assert_eq!(code, 1);
    let (code, _) = ended(snug(&["run", "--data", "/nowhere"]).stderr(full()));
    assert_eq!(code, 1);
    let (code, _) = ended(&mut snug_below(r#"exec "$0" "$@" <&- >&- 2>&-"#, &words));
    assert_eq!(code, 0, "all three closed");
}
