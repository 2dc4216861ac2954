//! What README.md says that a command prints is what it prints.
#![allow(clippy::unwrap_used, reason = "a failing test should say where")]

use std::path::Path;
use std::process::Command;

/// A command of README.md, and the lines that it is said to print: a line `…` stands for any, an end `…` for any end.
struct Shown<'a> {
    command: &'a str,
    lines: Vec<&'a str>,
}

/// Every `text` block right after an `sh` block that begins with a command on data of the repository.
fn shown(readme: &str) -> Vec<Shown<'_>> {
    let mut blocks = readme.split("\n```").skip(1).step_by(2).peekable();
    let mut shown = Vec::new();
    while let Some(block) = blocks.next() {
        let command = block
            .strip_prefix("sh\ncargo xtask ")
            .and_then(|rest| rest.lines().next());
        let text = blocks.peek().and_then(|next| next.strip_prefix("text\n"));
        if let (Some(command), Some(text)) = (command, text) {
            shown.push(Shown {
                command: command.split('#').next().unwrap().trim(),
                lines: text.lines().collect(),
            });
        }
    }
    shown
}

/// The first line that `output` does not hold where it should.
fn missing<'a>(shown: &Shown<'a>, output: &str) -> Option<&'a str> {
    let printed: Vec<&str> = output.lines().map(str::trim_end).collect();
    let is_like = |printed: &str, line: &str| match line.strip_suffix('…') {
        Some(start) => printed.starts_with(start),
        None => printed == line,
    };
    let mut at = 0;
    let mut stretches = shown.lines.split(|line| *line == "…");
    stretches.find_map(|stretch| {
        let first = (at..printed.len()).find(|&from| {
            let rest = &printed[from..];
            rest.len() >= stretch.len() && rest.iter().zip(stretch).all(|(p, l)| is_like(p, l))
        });
        match first {
            Some(from) => {
                at = from + stretch.len();
                None
            }
            None => (stretch.iter().copied())
                .find(|line| !printed[at..].iter().any(|printed| is_like(printed, line)))
                .or(stretch.first().copied()),
        }
    })
}

#[test]
fn what_the_readme_shows_is_what_is_printed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let shown = shown(&readme);
    assert!(
        shown.len() > 1,
        "README.md shows no output any more, or this test does not find it"
    );
    for shown in &shown {
        let out = tempfile::tempdir().unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_xtask"))
            .current_dir(root)
            .args(shown.command.split(' '))
            .arg("--out")
            .arg(out.path())
            .output()
            .unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        if let Some(line) = missing(shown, &printed) {
            panic!(
                "`cargo xtask {}` does not print this line of README.md there:\n{line}\nIt prints:\n{printed}\n\
                 Put what it prints into README.md, if that is better.",
                shown.command
            );
        }
    }
}

#[test]
fn lines_are_left_out_only_where_it_says_so() {
    let readme = "\n```sh\ncargo xtask run     # all of it\n```\n\nGives:\n\n```text\none\n…\nthree, …\n```\n";
    let shown = shown(readme);
    assert_eq!(shown[0].command, "run");
    assert_eq!(
        missing(&shown[0], "zero\none  \ntwo\nthree, four\nfive\n"),
        None
    );
    assert_eq!(missing(&shown[0], "one\nthree\n"), Some("three, …"));
    assert_eq!(missing(&shown[0], "three, four\none\n"), Some("three, …"));
}
