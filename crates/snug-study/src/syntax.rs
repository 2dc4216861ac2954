//! What is wrong with the text of a study file, in plain words: field, what was found, what is allowed.

pub(crate) mod position;

use crate::syntax::position::Position;
use snug_campaign::{did_you_mean, excerpt};

/// What `error`, which the reader of RON raised at `place` of `text`, says to someone who wrote a study.
pub(crate) fn told(error: &ron::Error, text: &str, place: Position) -> String {
    use ron::Error as Ron;
    let field = position::field_at(text, place);
    if let Some(allowed) = kind_of_value(error) {
        return match field {
            Some((field, found)) => {
                format!("{field} is {}; allowed is {allowed}", excerpt(found))
            }
            None => format!("found {}; allowed is {allowed}", shown(text, place)),
        };
    }
    let within = field.map_or("the study", |(field, _)| field);
    match error {
        Ron::NoSuchStructField {
            expected,
            found: name,
            ..
        } => format!(
            "{within} has no field `{}`; allowed is {}{}",
            excerpt(name),
            one_of(expected),
            did_you_mean(name, expected)
        ),
        Ron::NoSuchEnumVariant {
            expected,
            found: name,
            ..
        } => format!(
            "{within} is `{}`; allowed is {}{}",
            excerpt(name),
            one_of(expected),
            did_you_mean(name, expected)
        ),
        Ron::MissingStructField { field, .. } => format!("{within} lacks its field `{field}`"),
        Ron::DuplicateStructField { field, .. } => {
            format!("{within} states its field `{field}` twice; allowed is once")
        }
        Ron::ExpectedMapColon => format!(
            "in {within}: found {}; allowed is `:` between a field's name and its value",
            shown(text, place)
        ),
        Ron::ExpectedStringEnd => format!(
            "in {within}: the text{} is not closed; allowed is a `\"` at both ends",
            position::open_text(text)
                .map_or_else(String::new, |from| format!(" that begins at {from}"))
        ),
        Ron::ExpectedComma
        | Ron::ExpectedArrayEnd
        | Ron::ExpectedMapEnd
        | Ron::ExpectedOptionEnd
        | Ron::ExpectedStructLikeEnd
        | Ron::ExpectedIdentifier
        | Ron::Eof => unclosed(error, text, place, within),
        Ron::TrailingCharacters => format!(
            "found {} behind the study's last `)`; allowed is nothing",
            shown(text, place)
        ),
        _ => match field {
            Some((field, found)) => format!("{field} is {}: {error}", excerpt(found)),
            None => error.to_string(),
        },
    }
}

/// A comma or a closing bracket is missing.
fn unclosed(error: &ron::Error, text: &str, place: Position, within: &str) -> String {
    let found = shown(text, place);
    match position::open_at(text, place) {
        Some((open, from)) => {
            let close = match open {
                '(' => ')',
                '[' => ']',
                _ => '}',
            };
            format!(
                "in {within}: found {found}; allowed is `,` or the `{close}` that closes the `{open}` at {from}"
            )
        }
        None => format!("in {within}: found {found}: {error}"),
    }
}

/// What a value must be whose kind is wrong.
fn kind_of_value(error: &ron::Error) -> Option<&'static str> {
    use ron::Error as Ron;
    Some(match error {
        Ron::ExpectedFloat | Ron::FloatUnderscore | Ron::UnderscoreAtBeginning => "a number",
        Ron::ExpectedInteger | Ron::InvalidIntegerDigit { .. } | Ron::IntegerOutOfBounds => {
            "a whole number, 0 or more"
        }
        Ron::ExpectedBoolean => "true or false",
        Ron::ExpectedString => "a text in quotes, \"like this\"",
        Ron::ExpectedArray => "a list in brackets, [like, this]",
        Ron::ExpectedMap => "a map in braces, {\"name\": value}",
        Ron::ExpectedStructLike | Ron::ExpectedNamedStructLike(_) => {
            "fields in parentheses, (name: value)"
        }
        _ => return None,
    })
}

/// What stands at `place`.
fn shown(text: &str, place: Position) -> String {
    position::found_at(text, place).map_or_else(
        || "the end of the file".to_owned(),
        |found| format!("`{}`", excerpt(found)),
    )
}

fn one_of(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => "nothing".to_owned(),
        [one] => one.clone(),
        [some @ .., last] => format!("{} or {last}", some.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use crate::study::Study;
    use std::path::Path;

    fn told(text: &str) -> String {
        let read = Study::parse(text, Path::new("rig.ron"));
        read.expect_err("the text is wrong on purpose").to_string()
    }

    /// Each names the file, the place, the field, what was found and what is allowed there.
    #[test]
    fn a_wrong_text_is_told_in_plain_words() {
        for (text, expected) in [
            (
                "(\n  model: (custom: [(parameters: [(name: \"p\", unit: \"N\"])]),\n)",
                "rig.ron:2:55: in parameters: found `]`; allowed is `,` or the `)` that closes the `(` at line 2, column 34",
            ),
            (
                "(\n  seed: 3\n  title: \"x\",\n)",
                "rig.ron:3:3: in seed: found `title`; allowed is `,` or the `)` that closes the `(` at line 1, column 1",
            ),
            (
                "(title: \"x)",
                "in title: the text that begins at line 1, column 9 is not closed; allowed is a `\"` at both ends",
            ),
            ("(seed = 3)", "in the study: found `=`; allowed is `:`"),
            (
                "",
                "found the end of the file; allowed is fields in parentheses",
            ),
            ("(seed: \"3\")", "seed is \"3\"; allowed is a whole number"),
            (
                "(selection: (minimum_fit_percent: abc))",
                "minimum_fit_percent is abc; allowed is a number",
            ),
            ("(title: x)", "title is x; allowed is a text in quotes"),
            (
                "(model: (effects: \"backlash\"))",
                "effects is \"backlash\"; allowed is a list in brackets",
            ),
            (
                "(identify: (fitted_output: Sped))",
                "fitted_output is `Sped`; allowed is `Displacement`, `Velocity` or `Acceleration`",
            ),
            (
                "(preprocess: (windw: Whole))",
                "preprocess has no field `windw`; allowed is `preset`, `window`,",
            ),
            (
                "(seed: 3, seed: 4)",
                "the study states its field `seed` twice",
            ),
            ("(seed: 3))", "found `)` behind the study's last `)`"),
        ] {
            let found = told(text);
            assert!(found.contains(expected), "{found}\n{expected}");
        }
    }
}
