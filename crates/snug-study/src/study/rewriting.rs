//! Changes a study file's list of effects and leaves everything else, comments too, as it is.

use crate::error::StudyError;
use crate::study::Study;
use crate::study::{options, text_of};
use snug_files::Host;
use snug_model::CustomEffectSettings;
use snug_preprocess::Stretch;
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

/// The text of a study that counts this stretch of every window; else the text as it is, comments too, or written anew with every default
/// where it cannot be followed.
///
/// # Errors
/// [`StudyError::Syntax`] and [`StudyError::Serialize`].
pub fn with_stretch(text: &str, path: &Path, stretch: Stretch) -> Result<String, StudyError> {
    let mut wanted = Study::parse(text, path)?;
    if wanted.preprocess.stretch == Some(stretch) {
        return Ok(text.to_owned());
    }
    wanted.preprocess.stretch = Some(stretch);
    let Stretch { from_s, to_s } = stretch;
    let entry = format!("stretch: (from_s: {from_s:?}, to_s: {to_s:?})");
    match put_in(text, "preprocess", &entry) {
        Some(new) if Study::parse(&new, path).is_ok_and(|study| study == wanted) => Ok(new),
        _ => wanted.to_ron(),
    }
}

/// The text with this entry put in at the head of a section, which is put in, too, where there is none.
fn put_in(text: &str, section: &str, entry: &str) -> Option<String> {
    let Some(at) = text.find(&format!("{section}:")) else {
        let (before, after) = text.split_at(text.rfind(')')?);
        let before = before.trim_end();
        let comma = match before.ends_with([',', '(']) {
            true => "",
            false => ",",
        };
        return Some(format!(
            "{before}{comma}\n    {section}: ({entry}),\n{after}"
        ));
    };
    let open = at + text[at..].find('(')? + 1;
    Some(format!("{}{entry}, {}", &text[..open], &text[open..]))
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
    let model = text.find("model:");
    let Some(old) = model.and_then(|model| Some(model + text[model..].find("effects:")?)) else {
        return put_in(text, "model", &list);
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
    fn a_stretch_is_put_in_and_comments_stay() {
        let stretch = Stretch {
            from_s: 0.02,
            to_s: 0.12,
        };
        let path = Path::new("rig.ron");
        let put = |text: &str| with_stretch(text, path, stretch).unwrap();
        let entry = "stretch: (from_s: 0.02, to_s: 0.12)";
        let whole = put("// mine\n(preprocess: (window: Whole))");
        assert_eq!(
            whole,
            format!("// mine\n(preprocess: ({entry}, window: Whole))")
        );
        assert_eq!(put(&whole), whole);
        let added = put("(seed: 3)");
        assert_eq!(added, format!("(seed: 3,\n    preprocess: ({entry}),\n)"));
        let other = put("(preprocess: (stretch: (from_s: 1.0, to_s: 2.0)))");
        let study = Study::parse(&other, path).unwrap();
        assert_eq!(study.preprocess.stretch, Some(stretch));
        assert!(with_stretch("(seed 3)", path, stretch).is_err());
    }

    #[test]
    fn what_cannot_be_followed_is_written_anew_and_means_the_same() {
        let text = "( /* model: ( */ title: \"model: (\", model: (effects: [\"backlash\"]))";
        let study: Study = options().from_str(&rewritten(text, &[])).unwrap();
        assert!(study.model.effects.is_empty() && study.title == "model: (");
    }
}
