//! Made-up sources at their budgets and beyond.
#![allow(clippy::unwrap_used)]

use super::*;

fn problems(files: &[SourceFile]) -> Vec<String> {
    let problems = check(files).problems;
    problems
        .iter()
        .map(|problem| problem.file.clone())
        .collect()
}

/// A function of so many lines.
fn long(lines: usize) -> String {
    format!("fn swing() {{\n{}}}\n", "    rope();\n".repeat(lines - 2))
}

/// So many files in one folder.
fn crowd(folder: &str, count: usize) -> Vec<SourceFile> {
    let path = |index: usize| format!("{folder}/rope{index}.rs");
    (0..count)
        .map(|index| SourceFile::of(&path(index), ""))
        .collect()
}

#[test]
fn a_file_has_at_most_its_budget_of_lines() {
    let of_lines = |lines: usize| SourceFile::of("src/rope.rs", &"//\n".repeat(lines));
    assert_eq!(problems(&[of_lines(FILE_LINES)]), [""; 0]);
    assert_eq!(problems(&[of_lines(FILE_LINES + 1)]), ["src/rope.rs"]);
}

#[test]
fn a_function_has_at_most_its_budget_of_lines_and_its_place_is_told() {
    let text = |lines: usize| format!("//! Ropes.\n\n{}", long(lines));
    let at_budget = SourceFile::of("src/rope.rs", &text(FUNCTION_LINES));
    assert_eq!(problems(&[at_budget]), [""; 0]);
    let beyond = [SourceFile::of("src/rope.rs", &text(FUNCTION_LINES + 1))];
    assert_eq!(problems(&beyond), ["src/rope.rs:3"]);
    assert!(check(&beyond).problems[0].what.contains("function swing"));
}

#[test]
fn a_function_ends_at_the_brace_that_stands_where_it_began() {
    let text = [
        "impl Rope {",
        "    pub(crate) const unsafe extern \"C\" fn hang<T>(",
        "        self,",
        "    ) -> T",
        "    where",
        "        T: Knot,",
        "    {",
        "        if true {",
        "        }",
        "    }",
        "    fn one() {}",
        "    fn hold(&self) -> [f64; 3] {",
        "        fn inner() {",
        "        }",
        "    }",
        "}",
    ];
    let text = text.join("\n");
    let found: Vec<(&str, usize, usize)> = functions(&text)
        .iter()
        .map(|one| (one.name, one.line, one.lines))
        .collect();
    let expected = [
        ("hang", 2, 9),
        ("one", 11, 1),
        ("hold", 12, 4),
        ("inner", 13, 2),
    ];
    assert_eq!(found, expected);
}

#[test]
fn declarations_types_and_words_are_no_functions() {
    let text = [
        "trait Rope {",
        "    fn hold(&self) -> f64;",
        "    fn hang<T>(",
        "        &self,",
        "    ) -> T",
        "    where",
        "        T: Knot;",
        "}",
        "type Swing = fn (f64) -> f64;",
        "/// fn rope() {",
        "let f = knot.map(|fn_| fn_ );",
    ];
    assert_eq!(functions(&text.join("\n")), []);
}

#[test]
fn a_folder_of_sources_holds_at_most_its_budget_of_files() {
    assert_eq!(problems(&crowd("swing/src", FOLDER_FILES)), [""; 0]);
    for folder in ["swing/src", "swing/src/rope/knots"] {
        assert_eq!(problems(&crowd(folder, FOLDER_FILES + 1)), [folder]);
    }
}

#[test]
fn catalogues_and_folders_of_tests_hold_any_number_and_that_is_told() {
    let many = crowd("swing/src/effects", FOLDER_FILES + 1);
    let outcome = check(&many);
    assert_eq!(outcome.problems, []);
    assert_eq!(outcome.notes.len(), 1);
    let told = format!("swing/src/effects holds {} files", FOLDER_FILES + 1);
    assert!(outcome.notes[0].contains(&told));
    assert_eq!(problems(&crowd("tests/stories", FOLDER_FILES + 1)), [""; 0]);
}
