//! A study's own effects: as they act on its rig, and where m, c, k and their sizes begin with them.

use crate::error::StudyError;
use crate::study::Study;
use crate::tasks::cases::with_settled;
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

/// The study beginning where one fit of all its recordings ends, if it has effects: a line through a force that bends is no place from which
/// each recording alone comes to it. As it is where that fit says nothing.
pub(super) fn begun_together(mut study: Study, cases: &[FitTask<'_>]) -> Study {
    for (name, value) in starts(&study, cases).unwrap_or_default() {
        let told = study.model.parameters.entry(name).or_default();
        if !told.fixed {
            told.value = Some(value);
        }
    }
    study
}

/// Where that fit ends; nothing for a study without effects.
fn starts(study: &Study, cases: &[FitTask<'_>]) -> Result<Vec<(String, f64)>, StudyError> {
    if study.model.effects.is_empty() {
        return Ok(Vec::new());
    }
    let cases = with_settled(study, cases.iter().map(FitTask::lent).collect())?;
    let own = effects(study, &study.model.effects, &cases)?;
    Ok(starts_together(&cases, &own)?)
}
