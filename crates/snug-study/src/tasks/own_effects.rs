//! A study's own effects: as they act on its rig, and where m, c, k and their sizes begin with them.

use crate::error::StudyError;
use crate::study::Study;
use snug_diagnose::starts_together;
use snug_identify::FitTask;
use snug_model::Effect;

/// The named effects, the study's own among them, as they act on its rig.
pub(crate) fn effects(
    study: &Study,
    names: &[String],
    cases: &[FitTask<'_>],
) -> Result<Vec<Effect>, StudyError> {
    let Some(first) = cases.first() else {
        return Ok(Vec::new());
    };
    let scale = study.model.scale;
    let named = names.iter().map(|name| {
        let effect = study.model.effect(name)?;
        scale.effect(effect, &first.tightening.rig)
    });
    Ok(named.collect::<Result<_, _>>()?)
}

/// The study beginning where one fit of all its recordings ends: a line through a force that bends is no place from which each
/// recording alone comes to it. `None` where the study has no effects or that fit says nothing.
pub(super) fn begun_together(study: &Study, cases: &[FitTask<'_>]) -> Option<Study> {
    if study.model.effects.is_empty() {
        return None;
    }
    let own = effects(study, &study.model.effects, cases).ok()?;
    let starts = starts_together(cases, &own).ok()?;
    let mut study = study.clone();
    for (name, value) in starts {
        let told = study.model.parameters.entry(name).or_default();
        if !told.fixed {
            told.value = Some(value);
        }
    }
    Some(study)
}
