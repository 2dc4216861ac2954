//! A disk that fills while results are written.

use crate::program::{differing, ended, expected, few_files, results, snug, text, words};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// A small disk of its own; `None` where this process may not mount one.
struct SmallDisk {
    folder: TempDir,
}

impl SmallDisk {
    fn of_kb(kilobytes: u64) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let options = format!("size={kilobytes}k");
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &options, "tmpfs", text(folder.path())])
            .output();
        match mounted {
            Ok(output) if output.status.success() => Some(Self { folder }),
            _ => None,
        }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        Command::new("umount").arg(self.folder.path()).status().ok();
    }
}

fn run(data: &Path, out: &Path) -> (i32, String) {
    ended(&mut snug(&words("run", data, out)))
}

#[test]
fn a_full_disk_leaves_the_results_that_were_there_and_says_so() {
    let (small, large) = (few_files(1), few_files(3));
    let (old, new) = (expected(small.path()), expected(large.path()));
    let kilobytes = |results: &crate::program::Results| {
        results.values().map(Vec::len).sum::<usize>() as u64 / 1000
    };
    let (first, both) = (
        kilobytes(&old) * 21 / 20 + 200,
        (kilobytes(&old) + kilobytes(&new)) * 11 / 10,
    );
    let (mut failed, mut fitted) = (0, 0);
    for step in 0..=12 {
        let Some(disk) = SmallDisk::of_kb(first + (both - first) * step / 12) else {
            println!("skipped: no disk can be mounted here");
            return;
        };
        let out = disk.out();
        let (code, said) = run(small.path(), &out);
        assert_eq!(code, 0, "{said}");
        let (code, said) = run(large.path(), &out);
        let left = results(&out);
        if code == 0 {
            fitted += 1;
            assert!(differing(&left, &new).is_empty());
        } else {
            failed += 1;
            assert_eq!(code, 1, "{said}");
            assert!(
                differing(&left, &old).is_empty(),
                "{:?}",
                differing(&left, &old)
            );
            for told in ["No space left", "make room", text(&out)] {
                assert!(said.contains(told), "{told}: {said}");
            }
            assert!(!said.contains("panicked"), "{said}");
        }
    }
    assert!(failed > 3 && fitted > 0, "{failed} failed, {fitted} fitted");
}
