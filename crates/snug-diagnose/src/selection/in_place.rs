//! A model with another effect in the place of one of its own.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fit::fit_from;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::{PooledModel, Start};
use crate::pooled::parameter_place::{effect_of, first_parameter};
use crate::ranking::resonances;
use crate::selection::model_selection::ModelSelection;
use snug_model::{Effect, Law, ParameterSpec};

impl ModelSelection<'_> {
    /// `full` with `other` in place of `effect`; `None` where that cannot be fitted.
    pub(super) fn with_other(
        &self,
        full: &Fitted,
        effect: Effect,
        other: Effect,
    ) -> Result<Option<Fitted>, DiagnoseError> {
        let doing = format!("trying {} in place of {}", other.name(), effect.name());
        self.watch.begin(&doing)?;
        Ok(fit_in_place(self.cases, full, effect, other, self.clusters).ok())
    }
}

/// `full` with `other` in place of `effect`, from whichever of its starts leads lowest: what both have a number for begins where it ended, and
/// a resonance also where the spectra show one.
fn fit_in_place(
    cases: Cases<'_>,
    full: &Fitted,
    effect: Effect,
    other: Effect,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let swap = |known: &Effect| if *known == effect { other } else { *known };
    let effects: Vec<Effect> = full.effects.iter().map(swap).collect();
    let mut pooled = PooledModel::shared_by(cases, &effects, &full.sharing)?;
    let as_before = begun(&pooled, full, effect, other);
    let mut end = fit_from(&mut pooled, Some(as_before), clusters);
    for values in resonances::starts(cases, full, other) {
        let start = pooled.with_effect(full.start(&pooled), other, &values);
        let again = fit_from(&mut pooled, Some(start), clusters);
        let is_lower = |again: &Fitted| match &end {
            Ok(end) => again.squares() < end.squares(),
            Err(_) => true,
        };
        if again.as_ref().is_ok_and(is_lower) {
            end = again;
        }
    }
    end
}

/// Where `full` ended, and of `other` in place of `effect` the numbers that both have.
fn begun(pooled: &PooledModel<'_>, full: &Fitted, effect: Effect, other: Effect) -> Start {
    let mut start = full.start(pooled);
    let (theirs, own) = (
        effect.description().parameters,
        other.description().parameters,
    );
    let first = first_parameter(&full.effects, effect);
    for (size, begins) in pooled.shared.iter().zip(&mut start.shared) {
        let place = effect_of(&pooled.effects, size.index);
        let Some((_, offset)) = place.filter(|(of, _)| *of == other) else {
            continue;
        };
        let is_same = |spec: &ParameterSpec| spec.name == own[offset].name;
        let ended = theirs.iter().position(is_same);
        if let Some(value) = ended.and_then(|place| full.shared_value(first + place, size)) {
            *begins = value;
        }
    }
    start
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, close, exact};
    use snug_identify::FitTask;
    use snug_model::Effect::{AttachedMass, SecondMode};

    /// From the catalogue's 12 Hz no step leads to 60.
    #[test]
    fn a_resonance_begins_where_the_spectra_show_it() {
        let sizes = [0.5, 60.0, 0.01];
        let cases: Vec<FitTask> = (0..4)
            .map(|number| exact(number, &[AttachedMass], &sizes))
            .collect();
        let tally = Tally::default();
        let cases = Cases::new(&cases, &tally);
        let full = fit_effects(cases, &[SecondMode], None, WHOLE).expect("it can be fitted");
        let found = fit_in_place(cases, &full, SecondMode, AttachedMass, WHOLE);
        let found = found.expect("it can be fitted");
        assert_eq!(found.effects, [AttachedMass]);
        for (found, size) in found.shared.iter().zip(sizes) {
            close(*found, size, 1e-3);
        }
    }
}
