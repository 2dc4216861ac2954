//! Where the parameters of effects stand in a model, and where in another.

use snug_model::{BASE_PARAMETERS, Effect, Law};

/// Index, in a model that has the effects `to`, of the parameter that is number `index` in one that has `from`; `None` where its
/// effect is not there. Names say nothing of it: they depend on which other effects are there.
pub(crate) fn index_among(to: &[Effect], from: &[Effect], index: usize) -> Option<usize> {
    if index < BASE_PARAMETERS.len() {
        return Some(index);
    }
    let (effect, offset) = effect_of(from, index)?;
    (to.contains(&effect)).then(|| first_parameter(to, effect) + offset)
}

/// The effect whose parameter is number `index` in a model that has `effects`, and which of its parameters it is; `None` of the
/// base model's.
pub(crate) fn effect_of(effects: &[Effect], index: usize) -> Option<(Effect, usize)> {
    let first = |effect: &Effect| first_parameter(effects, *effect);
    let effect = effects.iter().rfind(|effect| first(effect) <= index)?;
    Some((*effect, index - first(effect)))
}

/// Index of an effect's first parameter in a model that has `effects`.
pub(crate) fn first_parameter(effects: &[Effect], effect: Effect) -> usize {
    let before = effects.iter().take_while(|known| **known != effect);
    BASE_PARAMETERS.len()
        + before
            .map(|known| known.description().parameters.len())
            .sum::<usize>()
}
