//! What help says of every verb.

use crate::machine::{Machine, ended};

/// Every verb that help lists.
fn verbs(help: &str) -> Vec<&str> {
    let listed = help.split("Commands:\n").nth(1).unwrap();
    let lines = listed.split("\n\n").next().unwrap().lines();
    let words = lines.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    words.filter(|word| !word.is_empty()).collect()
}

#[test]
fn help_names_the_program_and_leaves_nothing_open() {
    let machine = Machine::new();
    let (code, help, _) = ended(&mut machine.snug(&["-h"]));
    assert_eq!(code, 0);
    let verbs = verbs(&help);
    for verb in ["run", "improve", "workbench", "completions"] {
        assert!(verbs.contains(&verb), "{verb} in {help}");
    }
    let mut pages = vec![help.clone()];
    // The plant's program has the help of `snug plant`.
    for verb in verbs.iter().filter(|verb| **verb != "plant") {
        let (code, page, told) = ended(&mut machine.snug(&["help", verb]));
        assert_eq!(code, 0, "{verb}: {told}");
        pages.push(page);
    }
    pages.push(ended(&mut machine.snug(&["help", "plant"])).1);
    for page in &pages {
        assert!(!page.contains(['{', '}']), "{page}");
        assert!(
            !page.contains("cargo xtask") && !page.contains("fixtures"),
            "{page}"
        );
    }
    assert!(
        pages[0].contains("\n  snug run --data DIR "),
        "{}",
        pages[0]
    );
}
