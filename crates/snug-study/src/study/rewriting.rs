//! Changes a study file's list of effects and leaves everything else, comments too, as it is.

use crate::error::StudyError;
use crate::study::Study;
use crate::study::{options, text_of};
use snug_files::Host;
use snug_model::CustomEffectSettings;
use std::path::Path;

/// Writes `effects` into the file's model, and declares those laws among `custom` that the file does not declare yet.
///
/// Only the lists themselves are replaced, or put in where there were none. Should the file be written in a way that this cannot
/// follow, it is written anew with every default, and its comments are lost.
///
/// # Errors
/// [`StudyError::Read`] and [`StudyError::Syntax`] for a file that is no study, [`StudyError::Files`].
pub fn rewrite_effects(
    path: &Path,
    effects: &[String],
    custom: &[CustomEffectSettings],
) -> Result<(), StudyError> {
    match rewritten(&text_of(path)?, path, effects, custom)? {
        Some(new) => Ok(snug_files::write_whole(&Host, path, new.as_bytes())?),
        None => Ok(()),
    }
}

/// Writes a study of this `text` with `effects` to `path`, whole or not at all, as [`rewrite_effects`] puts them in; what was written.
///
/// # Errors
/// As [`rewrite_effects`].
pub fn write_with_effects(
    path: &Path,
    text: &str,
    effects: &[String],
    custom: &[CustomEffectSettings],
) -> Result<String, StudyError> {
    let new = rewritten(text, path, effects, custom)?.unwrap_or_else(|| text.to_owned());
    snug_files::write_whole(&Host, path, new.as_bytes())?;
    Ok(new)
}

/// The text with these effects; nothing where they are its own.
fn rewritten(
    text: &str,
    path: &Path,
    effects: &[String],
    custom: &[CustomEffectSettings],
) -> Result<Option<String>, StudyError> {
    let mut wanted = Study::parse(text, path)?;
    if wanted.model.effects == effects {
        return Ok(None);
    }
    wanted.model.effects = effects.to_vec();
    let declared: Vec<&str> = (wanted.model.custom.iter())
        .map(|law| law.name.as_str())
        .collect();
    let new: Vec<CustomEffectSettings> = (custom.iter())
        .filter(|law| effects.contains(&law.name) && !declared.contains(&law.name.as_str()))
        .cloned()
        .collect();
    wanted.model.custom.extend(new.iter().cloned());
    let replaced = with_effects(text, effects).and_then(|text| match new.as_slice() {
        [] => Some(text),
        new => with_laws(&text, new),
    });
    let new = match replaced {
        Some(new) if Study::parse(&new, path).is_ok_and(|study| study == wanted) => new,
        _ => wanted.to_ron()?,
    };
    Ok(Some(new))
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

/// The text with a list of the study's own laws put in behind the list of effects; `None` where it has one already.
fn with_laws(text: &str, laws: &[CustomEffectSettings]) -> Option<String> {
    if text.contains("custom:") {
        return None;
    }
    let written = options().to_string(&laws).ok()?;
    let list = text.find("effects:")?;
    let end = list + text[list..].find(']')? + 1;
    Some(format!(
        "{}, custom: {written}{}",
        &text[..end],
        &text[end..]
    ))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn rewritten(text: &str, effects: &[&str]) -> String {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let effects: Vec<String> = effects.iter().map(|name| (*name).to_owned()).collect();
        rewrite_effects(file.path(), &effects, &laws()).unwrap();
        std::fs::read_to_string(file.path()).unwrap()
    }

    fn laws() -> Vec<CustomEffectSettings> {
        vec![CustomEffectSettings {
            name: "cubic_damping".into(),
            expression: "p*v^3".into(),
            parameters: vec![snug_model::CustomParameterSettings {
                name: "p".into(),
                unit: "N s^3/m^3".into(),
                ..Default::default()
            }],
            ..Default::default()
        }]
    }

    /// A law that was found is declared beside the list that names it, once, and the file can be run.
    #[test]
    fn a_law_of_the_study_s_own_is_declared_where_it_is_used() {
        let first = rewritten(
            "// mine\n(model: (intersample: Linear))",
            &["cubic_damping"],
        );
        assert!(
            first.starts_with("// mine\n(model: (effects: [\"cubic_damping\"], custom: ["),
            "{first}"
        );
        let study: Study = options().from_str(&first).unwrap();
        assert_eq!(study.model.custom, laws());
        study.model.effect("cubic_damping").unwrap();
        let again: Study = options()
            .from_str(&rewritten(&first, &["cubic_damping"]))
            .unwrap();
        assert_eq!(again.model.custom.len(), 1);
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
