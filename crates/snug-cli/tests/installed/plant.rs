//! `snug plant`: a program of its own, started where it is installed.

use crate::machine::{Machine, ended};

#[test]
fn it_says_how_the_plant_is_installed() {
    let machine = Machine::new();
    let (code, said, told) = ended(&mut machine.snug(&["plant", "--help"]));
    assert_eq!((code, said.as_str()), (1, ""));
    assert!(
        told.contains("cargo install --locked --path crates/snug-plant"),
        "{told}"
    );
}

#[test]
fn an_installed_plant_gets_the_words_and_its_code_comes_back() {
    let machine = Machine::new();
    let script = machine.path("script");
    std::fs::write(
        &script,
        "#!/bin/sh\necho \"$SNUG_PROGRAM plant: $*\"\nexit 7\n",
    )
    .unwrap();
    machine.install(&script, "snug-plant");
    let (code, said, told) = ended(&mut machine.snug(&["plant", "fit", "--help"]));
    assert_eq!(
        (code, said.as_str()),
        (7, "snug plant: fit --help\n"),
        "{told}"
    );
}
