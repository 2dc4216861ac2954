//! What a campaign's result says of the study itself: in which words it is told, what its parameters are, what its preset selects.

use crate::study::Study;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{
    ParameterMeaning, PresetSummary, Rejection, RejectionCount, SignalUnits, TighteningId,
};
use snug_model::{BASE_PARAMETERS, Law, Model, Scale};
use snug_preprocess::Window;
use std::collections::BTreeMap;

/// Whether the results are told of a hand or of a machine, and whether that turns or slides.
pub(crate) fn vocabulary(study: &Study, units: &SignalUnits) -> Vocabulary {
    let is_settled = matches!(study.model.scale, Scale::Rig { .. });
    let is_open = study.model.scale == Scale::Automatic && study.preprocess.window == Window::Whole;
    match is_settled || is_open {
        true => Vocabulary::of_machine(units, study.preprocess.rig.lever_arm_m),
        false => Vocabulary::Hand,
    }
}

/// What the parameters of the model's effects are.
pub(crate) fn meanings(model: &Model) -> Vec<ParameterMeaning> {
    let effects: Vec<_> = model.effects().collect();
    let described = effects.iter().flat_map(|effect| {
        let specs = effect.description().parameters.iter();
        specs.map(move |spec| (effect.name(), spec.meaning))
    });
    model.parameters()[BASE_PARAMETERS.len()..]
        .iter()
        .zip(described)
        .map(|(parameter, (effect, meaning))| ParameterMeaning {
            name: parameter.name.clone(),
            effect: effect.to_owned(),
            meaning: meaning.to_owned(),
        })
        .collect()
}

/// What became of all tightenings under the study's preset.
pub(crate) fn preset_summary(
    study: &Study,
    outcomes: Vec<(TighteningId, Vec<Rejection>)>,
) -> PresetSummary {
    let mut counts: BTreeMap<Rejection, usize> = BTreeMap::new();
    for rejection in outcomes.iter().flat_map(|(_, rejections)| rejections) {
        *counts.entry(*rejection).or_default() += 1;
    }
    let mut rejections: Vec<RejectionCount> = counts
        .into_iter()
        .map(|(rejection, tightenings)| RejectionCount {
            rejection,
            tightenings,
        })
        .collect();
    rejections.sort_by_key(|count| std::cmp::Reverse(count.tightenings));
    PresetSummary {
        preset: study.preprocess.preset.name().to_owned(),
        tightenings: outcomes.len(),
        selected: outcomes.iter().filter(|(_, r)| r.is_empty()).count(),
        rejections,
        outcomes,
    }
}
