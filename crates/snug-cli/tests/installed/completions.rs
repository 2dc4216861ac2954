//! Completions: what real shells make of a line that is not finished.

use crate::machine::{Machine, ended};
use std::process::Command;

/// Unfinished words of a line, and every way to go on.
const LINES: [(&[&str], &[&str]); 8] = [
    (&["imp"], &["improve"]),
    (&["add", "str"], &["stribeck_friction", "stretch_reflex"]),
    (&["add", "stretch_reflex", "back"], &["backlash"]),
    (&["effects", "lev"], &["lever_arm_error"]),
    (
        &["run", "--effects", "backlash,co"],
        &[
            "backlash,constant_load",
            "backlash,coulomb_friction",
            "backlash,co_contraction",
        ],
    ),
    (&["run", "--pre"], &["--preset"]),
    (&["run", "--preset", "t"], &["thesis"]),
    (&["completions", "ba"], &["bash"]),
];

/// Whether a shell is here; without one the check says that it is skipped.
fn is_here(machine: &Machine, shell: &str) -> bool {
    let here = machine.start("which").arg(shell).status();
    let here = here.is_ok_and(|status| status.success());
    if !here {
        println!("skipped: no {shell} on this machine");
    }
    here
}

fn lines_of(command: &mut Command) -> Vec<String> {
    let (code, said, told) = ended(command);
    assert_eq!((code, told.as_str()), (0, ""), "{said}");
    said.lines().map(str::to_owned).collect()
}

/// Ways to go on do not depend on their order.
fn assert_same(shell: &str, words: &[&str], mut found: Vec<String>, expected: &[&str]) {
    let mut expected = expected.to_vec();
    found.sort();
    expected.sort_unstable();
    assert_eq!(found, expected, "{shell}: {words:?}");
}

#[test]
fn bash_goes_on() {
    let machine = Machine::new();
    if !is_here(&machine, "bash") {
        return;
    }
    // What bash itself does when the key is pressed: the function that `complete` has for the program, the words so far in place.
    let script = r#"source <(snug completions bash)
        function=$(complete -p snug | sed 's/.*-F \([^ ]*\) .*/\1/')
        COMP_WORDS=(snug "$@") COMP_CWORD=$# COMP_TYPE=9
        "$function" snug "${@: -1}" snug
        printf '%s\n' "${COMPREPLY[@]}""#;
    for (words, expected) in LINES {
        let mut bash = machine.start("bash");
        let found = lines_of(bash.args(["--norc", "-c", script, "bash"]).args(words));
        assert_same("bash", words, found, expected);
    }
}

#[test]
fn fish_goes_on() {
    let machine = Machine::new();
    if !is_here(&machine, "fish") {
        return;
    }
    for (words, expected) in LINES {
        let line = format!("snug {}", words.join(" "));
        let script = format!("snug completions fish | source; complete -C '{line}'");
        let found = lines_of(machine.start("fish").args(["-c", &script]));
        let values = found.iter().filter_map(|one| one.split('\t').next());
        let values = values.map(str::to_owned).collect();
        assert_same("fish", words, values, expected);
    }
}

/// Types a line and the key into a zsh on a terminal of its own, and prints what then stands there.
const ZSH: &str = r#"zmodload zsh/zpty
zpty typed zsh -f -i
await() {
    local part; seen=
    repeat 200; do
        while zpty -r -t typed part; do seen+=$part; done
        [[ $seen == *$1* ]] && return
        sleep 0.05
    done
}
zpty -w typed 'PS1=; autoload -Uz compinit; compinit -u -D; source <(snug completions zsh); print rea""dy'
await ready
zpty -n -w typed "$LINE"$'\t'
await "$WANTED"
print -r -- $seen
zpty -d typed"#;

#[test]
fn zsh_goes_on() {
    let machine = Machine::new();
    if !is_here(&machine, "zsh") {
        return;
    }
    // Where there is one way only, zsh writes it out.
    for (words, expected) in LINES.iter().filter(|(_, expected)| expected.len() == 1) {
        let line = format!("snug {}", words.join(" "));
        let before = &words[..words.len() - 1];
        let wanted = [&["snug"], before, expected].concat().join(" ");
        let mut zsh = machine.start("zsh");
        let zsh = zsh.args(["-f", "-c", ZSH]).env("TERM", "dumb");
        let (_, said, told) = ended(zsh.env("LINE", &line).env("WANTED", &wanted));
        assert!(said.contains(&wanted), "{line}: {said} {told}");
    }
}

#[test]
fn every_shell_gets_its_script_and_no_other_does() {
    let machine = Machine::new();
    let program = machine.path("programs/snug");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let (code, script, told) = ended(&mut machine.snug(&["completions", shell]));
        assert_eq!((code, told.as_str()), (0, ""), "{shell}");
        assert!(
            script.contains(program.to_str().unwrap()),
            "{shell}: {script}"
        );
        assert!(script.contains(shell), "{script}");
    }
    let (code, _, told) = ended(&mut machine.snug(&["completions", "tcsh"]));
    assert_eq!(code, 2);
    assert!(
        told.contains("bash, elvish, fish, powershell, zsh"),
        "{told}"
    );
}
