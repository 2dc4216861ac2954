//! The model of one rung of a ladder, as a study says it.

use crate::library::declaration;
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::parameters;
use snug_campaign::EffectParameter;
use snug_identify::FitTask;
use snug_model::CustomEffectSettings;

/// The model of one rung.
#[derive(Debug, Clone, PartialEq)]
pub struct RungModel {
    /// Its effects.
    pub effects: Vec<String>,
    /// Declarations of those effects that the study does not know yet.
    pub declarations: Vec<CustomEffectSettings>,
    /// Mass, damping and stiffness that go with them, as a place to begin; only where few long records were fitted.
    pub base: Vec<(String, f64)>,
    /// Sizes of the effects, shared ones and each tightening's own.
    pub parameters: Vec<EffectParameter>,
}

impl RungModel {
    pub(crate) fn of(cases: &[FitTask<'_>], fitted: &Fitted) -> Self {
        let effects = &fitted.effects;
        let names = effects.iter().map(|effect| effect.name().to_owned());
        let declared = effects.iter().filter_map(|&effect| declaration(effect));
        let sizes = effects
            .iter()
            .map(|&effect| parameters(cases, fitted, effect));
        Self {
            effects: names.collect(),
            declarations: declared.collect(),
            base: fitted.base(),
            parameters: sizes.flatten().collect(),
        }
    }

    /// What all tightenings share, by name.
    pub fn values(&self) -> Vec<(String, f64)> {
        let shared = self.parameters.iter().filter(|one| !one.per_tightening);
        let sizes = shared.map(|one| (one.name.clone(), one.value));
        self.base.iter().cloned().chain(sizes).collect()
    }
}
