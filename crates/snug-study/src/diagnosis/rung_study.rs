//! A rung of a ladder as a study: its model in the study, its effects as they act on the study's rig, and where a further fit begins with them.

use crate::study::Study;
use snug_campaign::{GroupSize, GroupSizes};
use snug_diagnose::{Answer, Begun, RungModel};
use snug_model::{Effect, GroupValue, ParameterSettings, ValuesByGroup};

/// The study with a rung's model. What all tightenings share is held where they put it together.
pub(super) fn with_rung(study: &Study, model: &RungModel) -> Study {
    let mut study = study.clone();
    study.model.effects.clone_from(&model.effects);
    for declaration in &model.declarations {
        if !study
            .model
            .custom
            .iter()
            .any(|known| known.name == declaration.name)
        {
            study.model.custom.push(declaration.clone());
        }
    }
    for (name, value) in &model.base {
        let told = study.model.parameters.entry(name.clone()).or_default();
        told.value = Some(*value);
    }
    for parameter in &model.parameters {
        if parameter.per_tightening {
            continue;
        }
        let told: &mut ParameterSettings = study
            .model
            .parameters
            .entry(parameter.name.clone())
            .or_default();
        if told.fixed && told.standard_error.is_none() {
            continue;
        }
        told.value = Some(parameter.value);
        told.fixed = true;
        told.standard_error = parameter.standard_error.or(Some(0.0));
        told.by_group = parameter.by_group.as_ref().map(values_by_group);
    }
    study
}

/// The sizes of groups as a study says them.
fn values_by_group(sizes: &GroupSizes) -> ValuesByGroup {
    let value = |one: &GroupSize| GroupValue {
        value: one.value,
        standard_error: one.standard_error,
    };
    let values = sizes
        .groups
        .iter()
        .map(|one| (one.group.clone(), value(one)));
    ValuesByGroup {
        factor: sizes.factor.clone(),
        values: values.collect(),
    }
}

/// The study with the model of the last rung.
pub(super) fn with_last_rung(study: &Study, answer: &Answer) -> Study {
    let last = answer.models.last();
    last.map_or_else(|| study.clone(), |model| with_rung(study, model))
}

/// These effects one after the other as the rungs of `answer` have them; where none has just these, as its last has them.
pub(super) fn begun(effects: Vec<Effect>, answer: &Answer) -> Vec<Begun> {
    let names: Vec<&str> = effects.iter().map(Effect::name).collect();
    let with = |first: &[&str]| {
        let has_just = |rung: &&RungModel| {
            rung.effects.len() == first.len()
                && first
                    .iter()
                    .all(|name| rung.effects.iter().any(|one| one == name))
        };
        let mut rungs = answer.models.iter().rev();
        rungs.find(has_just).or(answer.models.last())
    };
    (effects.iter().enumerate())
        .map(|(place, &effect)| Begun {
            effect,
            values: with(&names[..=place]).map_or_else(Vec::new, RungModel::values),
        })
        .collect()
}
