//! Made-up packages that use what they declare, or do not.
#![allow(clippy::unwrap_used)]

use super::*;

fn member(name: &str, kind: DependencyKind, sources: Sources) -> Member {
    Member {
        manifest: "crates/swing/Cargo.toml".into(),
        dependencies: vec![Declared {
            name: name.into(),
            kind,
        }],
        sources,
    }
}

fn problems(name: &str, kind: DependencyKind, sources: Sources) -> usize {
    let shared = BTreeSet::from([name.to_string()]);
    check(&shared, &[member(name, kind, sources)])
        .problems
        .len()
}

fn normal(text: &str) -> Sources {
    Sources {
        normal: text.into(),
        ..Sources::default()
    }
}

#[test]
fn a_dependency_is_used_as_a_path_an_import_or_a_macro() {
    for text in [
        "let knot = silk_rope::Knot::new();",
        "use silk_rope as rope;",
        "    pub(crate) use silk_rope::{Knot, Loop};",
        "silk_rope!(3);",
        "#[derive(silk_rope::Knot)]",
    ] {
        assert_eq!(
            problems("silk-rope", DependencyKind::Normal, normal(text)),
            0,
            "{text}"
        );
    }
}

#[test]
fn what_is_only_spelt_alike_is_unused() {
    for text in [
        "",
        "// silk_rope::Knot would do as well",
        "/// use silk_rope::Knot;",
        "use my_silk_rope::Knot;",
        "use silk_ropes::Knot;",
        "crate::silk_rope::Knot",
        "let silk_rope = 3;",
        "row(\"silk_rope::Knot\")",
    ] {
        assert_eq!(
            problems("silk-rope", DependencyKind::Normal, normal(text)),
            1,
            "{text}"
        );
    }
}

#[test]
fn each_kind_is_looked_for_where_it_belongs() {
    let tests_only = || Sources {
        all: "/// use rope::Knot;".into(),
        ..Sources::default()
    };
    assert_eq!(problems("rope", DependencyKind::Normal, tests_only()), 1);
    assert_eq!(problems("rope", DependencyKind::Build, tests_only()), 1);
    assert_eq!(
        problems("rope", DependencyKind::Development, tests_only()),
        0
    );
}

#[test]
fn what_no_member_takes_is_found() {
    let shared = BTreeSet::from(["rope".to_string(), "cord".to_string()]);
    let members = [member(
        "rope",
        DependencyKind::Normal,
        normal("rope::tie()"),
    )];
    let found = check(&shared, &members).problems;
    assert_eq!(found.len(), 1);
    assert!(
        found[0]
            .what
            .starts_with("cord is declared for the workspace")
    );
}
