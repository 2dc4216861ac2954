//! What the compiler cannot see of an effect: a file that nobody named, a hook that goes with another, tests of its own.

use super::*;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Files of this folder that are no effect.
const BESIDE: [&str; 2] = ["tests", "trial"];

/// The text of every effect's file and every trend's, by name.
fn files() -> BTreeMap<String, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/effects");
    let entries = fs::read_dir(folder).expect("the sources are there");
    entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter_map(|path| {
            let name = path.file_stem()?.to_str()?.to_owned();
            let text = fs::read_to_string(&path).expect("a readable source");
            (!BESIDE.contains(&name.as_str())).then_some((name, text))
        })
        .collect()
}

#[test]
fn every_file_is_in_the_list_under_its_own_name() {
    let files = files();
    let trends = TRENDS.iter().map(|trend| trend.name);
    let names: Vec<&str> = Effect::ALL.iter().map(Effect::name).chain(trends).collect();
    for name in files.keys() {
        assert!(
            names.contains(&name.as_str()),
            "add `pub mod {name};` and its line in the list to effects.rs, and call the effect `{name}` in its file"
        );
    }
    for name in names {
        assert!(
            files.contains_key(name),
            "call the file of the effect `{name}` effects/{name}.rs"
        );
    }
}

#[test]
fn every_file_says_what_the_law_is_valid_for_and_tests_it() {
    for (name, text) in files() {
        assert!(
            text.contains("\n//! Valid for: ") && text.contains("\n//! Source: "),
            "add paragraphs `//! Valid for: …` and `//! Source: …` to the head of effects/{name}.rs"
        );
        let is_law = Effect::named(&name).is_some();
        assert!(
            !is_law || text.contains("#[test]"),
            "add `mod tests` to effects/{name}.rs: zero limit, sign, and a number from outside (`trial.rs` helps)"
        );
    }
}

#[test]
fn states_have_rates() {
    for effect in Effect::ALL {
        let (name, description) = (effect.name(), effect.description());
        assert_eq!(
            AnsweredHooks::of(effect).rates,
            !description.states.is_empty(),
            "{name}: states without rates, or rates without states; override `rates` (and answer `Some(())`) or name the \
             states in effects/{name}.rs"
        );
    }
}

#[test]
fn every_effect_answers_something() {
    for effect in Effect::ALL {
        assert!(
            AnsweredHooks::of(effect).are_any(),
            "{}: it changes nothing yet; override a hook of `Law` in its file",
            effect.name()
        );
    }
}
