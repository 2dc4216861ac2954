//! The model as a study file: beside the study it came from, or in the working folder; nobody else's file is written over.

use crate::bench::{Bench, locked};
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use snug_study::{Study, with_stretch, write_with_effects};
use std::path::{Path, PathBuf};

/// Writes the study with these effects; where it stands.
pub(crate) fn save(bench: &Bench, effects: &EffectSet) -> Result<PathBuf, WorkbenchError> {
    let mut saved = locked(&bench.saved);
    let path = free(&preferred(bench.study_file()), saved.as_ref());
    let failed = |source| WorkbenchError::Save {
        path: path.clone(),
        source,
    };
    let is_on_its_data = |file: &&Path| {
        Study::read(file).is_ok_and(|study| study.source.path == bench.study().source.path)
    };
    let text = match bench.study_file().filter(is_on_its_data) {
        // Its comments stay, and its data lie where they lay.
        Some(file) => {
            let text = std::fs::read_to_string(file).map_err(failed)?;
            match bench.study().preprocess.stretch {
                Some(stretch) => with_stretch(&text, file, stretch)?,
                None => text,
            }
        }
        // It was given other data, or there is none.
        None => on_absolute_data(bench.study()).map_err(failed)?.to_ron()?,
    };
    let laws = &bench.study().model.custom;
    let written = write_with_effects(&path, &text, effects.names(), laws)?;
    *saved = Some((path.clone(), written));
    Ok(path)
}

/// The study with its data named from the root, so that it can be run from any folder.
fn on_absolute_data(study: &Study) -> std::io::Result<Study> {
    let mut study = study.clone();
    let path = std::path::absolute(&study.source.path)?;
    study.set_data(&path);
    Ok(study)
}

fn preferred(study_file: Option<&Path>) -> PathBuf {
    let stem = study_file.and_then(Path::file_stem);
    match (study_file, stem) {
        (Some(file), Some(stem)) => {
            file.with_file_name(format!("{}.workbench.ron", stem.to_string_lossy()))
        }
        _ => PathBuf::from("workbench.ron"),
    }
}

/// The first of `path` and its numbered kin that is not there, or is as this workbench left it.
fn free(path: &Path, saved: Option<&(PathBuf, String)>) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let numbered = (2..).map(|number| path.with_file_name(format!("{stem}-{number}.ron")));
    let is_ours = |path: &PathBuf| {
        saved.is_some_and(|(known, text)| {
            known == path && std::fs::read_to_string(path).is_ok_and(|there| there == *text)
        })
    };
    let mut all = std::iter::once(path.to_path_buf()).chain(numbered);
    all.find(|path| !path.exists() || is_ours(path))
        .unwrap_or_else(|| path.to_path_buf())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_study_that_was_given_stays_and_so_do_files_of_others() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("rig.ron");
        std::fs::write(&file, "// mine\n(seed: 3)").unwrap();
        let study = Study::read(&file).unwrap();
        let bench = Bench::new(study, Some(file.clone()));
        let other = folder.path().join("rig.workbench.ron");
        std::fs::write(&other, "another's").unwrap();
        let effects = EffectSet::from_address("backlash");
        let first = save(&bench, &effects).unwrap();
        assert_eq!(first, folder.path().join("rig.workbench-2.ron"));
        let text = std::fs::read_to_string(&first).unwrap();
        assert!(
            text.starts_with("// mine\n") && text.contains("effects: [\"backlash\"]"),
            "{text}"
        );
        // Saved again it is the same file, unless somebody changed it.
        assert_eq!(save(&bench, &EffectSet::default()).unwrap(), first);
        std::fs::write(&first, "changed").unwrap();
        assert_ne!(save(&bench, &effects).unwrap(), first);
        assert_eq!(std::fs::read_to_string(&other).unwrap(), "another's");
        assert_eq!(
            std::fs::read_to_string(&file).unwrap(),
            "// mine\n(seed: 3)"
        );
    }

    #[test]
    fn a_study_that_was_given_other_data_is_saved_with_those() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("rig.ron");
        std::fs::write(&file, "// mine\n(seed: 3)").unwrap();
        let other = folder.path().join("other");
        let mut study = Study::read(&file).unwrap();
        study.set_data(&other);
        let bench = Bench::new(study, Some(file));
        let saved = save(&bench, &EffectSet::from_address("backlash")).unwrap();
        let saved = Study::read(&saved).unwrap();
        assert_eq!(saved.source.path, other);
        assert_eq!(saved.model.effects, ["backlash"]);
    }
}
