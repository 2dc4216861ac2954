//! Whether recordings are of one machine in one state.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::equation::is_one_with_friction;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::pooled::thresholds::ONE_MACHINE;
use snug_identify::FitTask;
use snug_model::{Effect, Law};

/// Recordings of one machine share mass, damping and stiffness, unless each with its own leaves far less: then something differs
/// between them, as how warm a bearing is or which way it turns. Dry friction and an offset make such differences, too; where they
/// explain far more, the machine is one. Beside it the fit of each by itself.
pub(crate) fn one_machine_or_several<'a>(
    cases: Cases<'a>,
    effects: &[Effect],
    clusters: Clusters,
) -> Result<(Cases<'a>, Option<Fitted>), DiagnoseError> {
    if !cases.are_of_one_machine() {
        return Ok((cases, None));
    }
    let several = cases.each_its_own();
    let [apart, together] = [several, cases].map(|all| fit_effects(all, effects, None, clusters));
    let (apart, together) = (apart?, together?);
    let cases = match leaves_far_less(&apart, &together) && !is_one(&cases, effects) {
        true => several,
        false => cases,
    };
    Ok((cases, Some(apart)))
}

/// The same asked of the model that was found: `None` where the recordings share mass, damping and stiffness still. A load that differs
/// between them hides behind what was missing.
pub(crate) fn several_after_all<'a>(
    cases: Cases<'a>,
    found: &Fitted,
    clusters: Clusters,
) -> Result<Option<Cases<'a>>, DiagnoseError> {
    if !cases.are_of_one_machine() || is_one(&cases, &found.effects) {
        return Ok(None);
    }
    let several = cases.each_its_own();
    let apart = fit_effects(several, &found.effects, Some(found), clusters)?;
    Ok(leaves_far_less(&apart, found).then_some(several))
}

fn leaves_far_less(apart: &Fitted, together: &Fitted) -> bool {
    apart.squares() < ONE_MACHINE * together.squares()
}

/// Whether what dry friction or an offset, which these effects are not, asks of each recording is no difference between machines.
fn is_one(cases: &[FitTask<'_>], effects: &[Effect]) -> bool {
    let is_there = |plain: &Effect| {
        let mut effects = effects.iter();
        effects.any(|one| one.name() == plain.name() || one.of_all() == Some(plain.name()))
    };
    !Effect::PLAIN.iter().all(is_there) && is_one_with_friction(cases)
}
