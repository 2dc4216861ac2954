//! Which effects of the catalogue can act on the rig at all.

use crate::data::cases::is_machine;
use crate::error::DiagnoseError;
use crate::library::terms;
use crate::pooled::fitted::Fitted;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_model::{Effect, Kind, Law};

/// The effects that may be missing beside `current`.
pub(crate) fn candidates(
    cases: &[FitTask<'_>],
    current: &Fitted,
    custom: &[Effect],
) -> Result<Vec<Effect>, DiagnoseError> {
    let case = &cases[0];
    let compared = case.quantity();
    let only_this = cases.iter().all(|case| case.quantity() == compared);
    let all = Effect::ALL.iter().filter(|&&effect| can_act(effect, case));
    let mut all = all
        .map(|&effect| case.model.scale().effect(effect, case.model.rig()))
        .collect::<Result<Vec<Effect>, _>>()?;
    all.retain(|effect| !(only_this && effect.same_as(compared).is_some()));
    all.extend(custom);
    all.extend(terms(is_machine(case))?);
    all.retain(|effect| !current.effects.contains(effect));
    // What a simulation cannot carry beside the effects that are there is no candidate.
    all.retain(|&effect| {
        let with = [current.effects.as_slice(), &[effect]].concat();
        cases[0].model_with(&with).is_ok()
    });
    Ok(all)
}

/// Whether `effect` could be what a measurement like `case` shows.
///
/// A machine has no muscles and nerves; what an accelerometer does wrong is not in a displacement that was measured by
/// itself; and a simulation that takes up the measured motion begins with it.
fn can_act(effect: Effect, case: &FitTask<'_>) -> bool {
    let description = effect.description();
    let has_accelerometer = case.quantity() == Quantity::Acceleration
        || case.tightening.motion.acceleration_rad_per_s2.is_some();
    let is_set = effect.sets_initial_motion() && case.input.is_restarted();
    let is_of_another = match description.kind {
        Kind::Muscular => is_machine(case),
        Kind::Measurement => !has_accelerometer && description.of_accelerometer(),
        _ => false,
    };
    !is_of_another && !is_set
}
