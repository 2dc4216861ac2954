//! Made-up advisories against made-up lock files, and the committed snapshot.
#![allow(clippy::unwrap_used)]

use super::*;

fn snapshot(advisories: &str) -> Snapshot {
    toml::from_str(&format!(
        r#"
        copy_date = "2026-01-01"
        newest_id = "RUSTSEC-2026-0001"
        looked_up_on = "2026-01-02"
        looked_up = ["rope", "cord"]
        {advisories}
        "#
    ))
    .unwrap()
}

fn one(fields: &str) -> Snapshot {
    snapshot(&format!(
        r#"
        [[advisory]]
        id = "RUSTSEC-2026-0001"
        package = "rope"
        date = "2026-01-01"
        title = "Frays"
        {fields}
        "#
    ))
}

fn ids_found(snapshot: &Snapshot, version: &str) -> usize {
    let lockfile = Lockfile::of(&[("rope", version), ("cord", "1.0.0")]);
    check_except(snapshot, &lockfile, &[]).problems.len()
}

#[test]
fn affected_versions_are_found_and_others_are_not() {
    let frays = one(r#"patched = [">= 1.2.3", "^0.9.4"]
        unaffected = ["< 0.5.0"]"#);
    for version in ["0.5.0", "0.9.3", "1.0.0", "1.2.2"] {
        assert_eq!(ids_found(&frays, version), 1, "{version}");
    }
    for version in ["0.4.9", "0.9.4", "1.2.3", "2.0.0", "1.11.1+lib-1.10.0"] {
        assert_eq!(ids_found(&frays, version), 0, "{version}");
    }
}

#[test]
fn what_nobody_put_right_applies_to_every_version_until_it_is_withdrawn() {
    let unmaintained = r#"informational = "unmaintained"
        patched = []"#;
    assert_eq!(ids_found(&one(unmaintained), "9.9.9"), 1);
    let withdrawn = format!("{unmaintained}\nwithdrawn = \"2026-01-03\"");
    assert_eq!(ids_found(&one(&withdrawn), "9.9.9"), 0);
}

#[test]
fn an_exception_accepts_its_advisory_and_must_go_with_it() {
    let lockfile = Lockfile::of(&[("rope", "1.0.0")]);
    let exceptions = [("RUSTSEC-2026-0001", "it hangs still")];
    let accepted = check_except(&one("patched = []"), &lockfile, &exceptions);
    assert_eq!(accepted.problems, []);
    assert!(accepted.notes[0].contains("it hangs still"));
    let idle = check_except(&one(r#"patched = [">= 1.0.0"]"#), &lockfile, &exceptions);
    assert!(idle.problems[0].what.contains("applies to nothing"));
}

#[test]
fn packages_nobody_looked_up_are_named() {
    let lockfile = Lockfile::of(&[("rope", "1.0.0"), ("twine", "1.0.0")]);
    let outcome = check_except(&snapshot("advisory = []"), &lockfile, &[]);
    assert!(
        outcome.summary.contains("1 of 2 packages"),
        "{}",
        outcome.summary
    );
    assert!(outcome.gaps[0].contains("twine"));
}

/// The committed snapshot says nothing twice and nothing about packages it does not claim to cover, and it bites: a version
/// that is known to be affected is found.
#[test]
fn the_committed_snapshot_is_sound() {
    let snapshot = Snapshot::read(&crate::root()).unwrap();
    let ids: BTreeSet<&str> = snapshot.advisories.iter().map(|a| &*a.id).collect();
    assert_eq!(ids.len(), snapshot.advisories.len());
    for advisory in &snapshot.advisories {
        assert!(
            snapshot.looked_up.contains(&advisory.package),
            "{}",
            advisory.id
        );
        assert!(advisory.date <= snapshot.copy_date, "{}", advisory.id);
        assert!(advisory.id <= snapshot.newest_id, "{}", advisory.id);
    }
    let old = Lockfile::of(&[("crossbeam-epoch", "0.9.18"), ("rand", "0.9.2")]);
    assert_eq!(check_except(&snapshot, &old, &[]).problems.len(), 2);
}
