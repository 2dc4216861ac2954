//! Changes a study file's list of effects and leaves everything else, comments too, as it is.

use crate::study::options;
use crate::{Study, StudyError};
use std::path::Path;

/// Writes `effects` into the file's model.
///
/// Only the list itself is replaced, or put in where there was none. Should the file be written in a way that this cannot
/// follow, it is written anew with every default, and its comments are lost.
///
/// # Errors
/// [`StudyError::Read`] and [`StudyError::Syntax`] for a file that is no study, [`StudyError::Write`].
pub fn rewrite_effects(path: &Path, effects: &[String]) -> Result<(), StudyError> {
    let read = |source| StudyError::Read {
        path: path.to_path_buf(),
        source,
    };
    let text = std::fs::read_to_string(path).map_err(read)?;
    let mut wanted = parse(path, &text)?;
    wanted.model.effects = effects.to_vec();
    let replaced = with_effects(&text, effects);
    let new = match replaced {
        Some(new) if parse(path, &new).is_ok_and(|study| study == wanted) => new,
        _ => wanted.to_ron()?,
    };
    std::fs::write(path, new).map_err(|source| StudyError::Write {
        path: path.to_path_buf(),
        source,
    })
}

fn parse(path: &Path, text: &str) -> Result<Study, StudyError> {
    options()
        .from_str(text)
        .map_err(|source| StudyError::Syntax {
            path: path.to_path_buf(),
            line: source.span.start.line,
            column: source.span.start.col,
            message: source.code.to_string(),
        })
}

/// The text with the model's list of effects replaced or put in.
fn with_effects(text: &str, effects: &[String]) -> Option<String> {
    let quoted: Vec<String> = effects.iter().map(|name| format!("{name:?}")).collect();
    let list = format!("effects: [{}]", quoted.join(", "));
    let Some(model) = text.find("model:") else {
        let end = text.rfind(')')?;
        let (before, after) = text.split_at(end);
        let comma = if before.trim_end().ends_with([',', '(']) {
            ""
        } else {
            ","
        };
        return Some(format!(
            "{}{comma}\n    model: ({list}),\n{after}",
            before.trim_end()
        ));
    };
    let open = model + text[model..].find('(')? + 1;
    let Some(old) = text[open..].find("effects:").map(|at| open + at) else {
        return Some(format!("{}{list}, {}", &text[..open], &text[open..]));
    };
    let end = old + text[old..].find(']')? + 1;
    Some(format!("{}{list}{}", &text[..old], &text[end..]))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn rewritten(text: &str, effects: &[&str]) -> String {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let effects: Vec<String> = effects.iter().map(|name| (*name).to_owned()).collect();
        rewrite_effects(file.path(), &effects).unwrap();
        std::fs::read_to_string(file.path()).unwrap()
    }

    #[test]
    fn only_the_list_changes() {
        let text = "// mine\n(\n    model: (\n        effects: [\"backlash\"], // found before\n    ),\n)\n";
        assert_eq!(
            rewritten(text, &["backlash", "coulomb_friction"]),
            "// mine\n(\n    model: (\n        effects: [\"backlash\", \"coulomb_friction\"], // found before\n    ),\n)\n"
        );
    }

    #[test]
    fn a_list_is_put_in_where_there_was_none() {
        assert_eq!(
            rewritten("(seed: 3, model: (intersample: Linear))", &["backlash"]),
            "(seed: 3, model: (effects: [\"backlash\"], intersample: Linear))"
        );
        assert_eq!(
            rewritten("// mine\n(seed: 3)", &["backlash"]),
            "// mine\n(seed: 3,\n    model: (effects: [\"backlash\"]),\n)"
        );
    }

    #[test]
    fn what_cannot_be_followed_is_written_anew_and_means_the_same() {
        let text = "( /* model: ( */ title: \"model: (\", model: (effects: [\"backlash\"]))";
        let study: Study = options().from_str(&rewritten(text, &[])).unwrap();
        assert!(study.model.effects.is_empty() && study.title == "model: (");
    }
}
