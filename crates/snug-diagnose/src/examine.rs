//! One verb of the diagnosis from tightenings to answer: compare, diagnose, add, improve.

use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::data::watch::Watch;
use crate::error::DiagnoseError;
use crate::pooled::decimated::decimated;
use crate::pooled::equation::PlainEquation;
use crate::pooled::fitted::Fitted;
use crate::pooled::one_machine::{one_machine_or_several, several_after_all};
use crate::question::{Goal, Question};
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::SelectionPath;
use crate::settings::DiagnoseSettings;
use crate::verdict::answer::{Answer, Examination};
use crate::verdict::changes::{are_above_all, changes};
use crate::verdict::earned::{is_declared_wrong, leaves_noise, restarted_too_seldom, turned_round};
use crate::verdict::tightening_fits::TighteningFits;
use crate::verdict::units::in_other_units;
use snug_campaign::words::changes::Changes;

/// Answers a question.
///
/// When `watch` ends the search, the answer is what was reached by then and says so.
///
/// # Errors
/// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::Identify`] where one was not measured, otherwise
/// what the model or the fit refuses.
pub fn examine(
    question: &Question<'_>,
    settings: &DiagnoseSettings,
    watch: &Watch<'_>,
) -> Result<Answer, DiagnoseError> {
    let cases = question.cases;
    let tally = Tally::default();
    let left_out = "every tightening was left out; the findings say why";
    let clusters = Clusters::of(cases);
    let counted = Cases::checked(cases, &tally, left_out)?;
    let sharing = question.sharing()?;
    let (counted, apart) = one_machine_or_several(counted, &question.effects, clusters)?;
    let selection = ModelSelection {
        cases: counted,
        own: &question.effects,
        sharing: &sharing,
        custom: &question.custom,
        clusters,
        settings,
        watch,
        may_ask_for_steps: question.may_ask_for_steps,
        until: question.until,
    };
    let compared = selection.compare()?;
    let units = (!settings.loads_differ)
        .then(|| in_other_units(cases, apart.as_ref().unwrap_or(compared.last())))
        .flatten();
    // What is missing is no question where recordings stand in units of their own or channels are not what they are said to be.
    let stand_apart = units.as_ref().is_some_and(|units| units.is_prefix);
    let is_declared_wrong = is_declared_wrong(cases, compared.last());
    let turned_round = turned_round(cases);
    let fell_away = restarted_too_seldom(counted, compared.last()).is_some();
    let goal = match stand_apart || is_declared_wrong || turned_round.is_some() || fell_away {
        true => &Goal::Compare,
        false => &question.goal,
    };
    let changes = match goal {
        Goal::Diagnose | Goal::Improve => changes_above_all(counted, &compared.rungs)?,
        Goal::Compare | Goal::Add(_) | Goal::ImproveFrom(_) => None,
    };
    let goal = match changes.is_some() {
        true => &Goal::Compare,
        false => goal,
    };
    let mut path = searched(&selection, goal, compared)?;
    let mut cases = counted;
    if !path.additions.is_empty()
        && !path.is_interrupted()
        && let Some(several) = several_after_all(counted, path.last(), clusters)?
    {
        cases = several;
        let selection = ModelSelection { cases, ..selection };
        path = searched(&selection, goal, selection.compare()?)?;
    }
    Examination {
        question,
        cases,
        settings,
        path: path.without_torque_noise(cases)?,
        units,
        is_declared_wrong,
        turned_round,
        changes,
        // What was found is told, however it ended.
        watch: watch.to_the_end(),
    }
    .answer()
}

/// What changes while the rig is measured, where that takes nearly all of what its own model leaves, and a simulation misses it.
fn changes_above_all(cases: Cases<'_>, own: &[Fitted]) -> Result<Option<Changes>, DiagnoseError> {
    let plain = PlainEquation::of(&cases);
    let found = plain.and_then(|plain| changes(&plain, cases, own, 0));
    let (Some(found), Some(last)) = (found.filter(are_above_all), own.last()) else {
        return Ok(None);
    };
    let fits = TighteningFits::of(&cases, last)?;
    Ok((!leaves_noise(&cases, &fits.seen())).then_some(found))
}

/// What a goal makes of the study's own model, looked for in as few of the samples as say the same.
fn searched(
    selection: &ModelSelection<'_>,
    goal: &Goal,
    compared: SelectionPath,
) -> Result<SelectionPath, DiagnoseError> {
    let slow = match goal {
        Goal::Compare => None,
        _ => decimated(&selection.cases, compared.last()),
    };
    match &slow {
        None => selected(selection, goal, compared),
        Some(slow) => {
            let search = ModelSelection {
                cases: selection.cases.others(slow),
                may_ask_for_steps: false,
                ..*selection
            };
            let path = selected(&search, goal, search.compare()?)?;
            selection.at_full_rate(path, compared)
        }
    }
}

/// What a goal makes of the study's own model.
fn selected(
    selection: &ModelSelection<'_>,
    goal: &Goal,
    compared: SelectionPath,
) -> Result<SelectionPath, DiagnoseError> {
    match goal {
        Goal::Compare => Ok(compared),
        Goal::Diagnose => selection.diagnose(compared),
        Goal::Add(effects) => selection.add(effects, compared),
        Goal::Improve => selection.improve(&[], compared),
        Goal::ImproveFrom(begun) => selection.improve(begun, compared),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pooled::together::fit_together;
    use crate::tests::made_up::{SAMPLES, exact, silent};
    use snug_identify::{FitTask, IdentifyError};

    #[test]
    fn a_tightening_that_was_not_measured_is_refused_by_name() {
        let refused = |case: FitTask<'_>, expected: IdentifyError| {
            let cases = [exact(0, &[], &[]), case];
            let question = Question::new(&cases, Goal::Diagnose);
            let examined = examine(&question, &DiagnoseSettings::default(), &silent());
            for error in [examined.err(), fit_together(&cases, &[]).err()] {
                let Some(DiagnoseError::Identify(error)) = error else {
                    panic!("{error:?}")
                };
                assert_eq!(error, expected);
            }
        };
        let (mut unmeasured, mut unscored) = (exact(1, &[], &[]), exact(1, &[], &[]));
        unmeasured.settings.to_mut().unscored_samples = 5;
        unmeasured
            .tightening
            .to_mut()
            .motion
            .acceleration_rad_per_s2 = None;
        let quantity = unmeasured.quantity();
        refused(unmeasured, IdentifyError::MissingOutput { quantity });
        unscored.settings.to_mut().unscored_samples = SAMPLES - 2;
        let (residuals, parameters) = (2, 3);
        refused(
            unscored,
            IdentifyError::TooShort {
                residuals,
                parameters,
            },
        );
    }
}
