//! Whether recordings are of one machine in one state.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::equation::is_one_with_friction;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::pooled::thresholds::ONE_MACHINE;
use snug_model::Effect;

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
    let leaves_far_less = apart.squares() < ONE_MACHINE * together.squares();
    let cases = match leaves_far_less && !is_one_with_friction(&cases) {
        true => several,
        false => cases,
    };
    Ok((cases, Some(apart)))
}
