//! One verb of the diagnosis from tightenings to answer: compare, diagnose, add, improve.

use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::question::{Goal, Question};
use crate::selection::model_selection::ModelSelection;
use crate::settings::DiagnoseSettings;
use crate::verdict::answer::{Answer, Examination};
use crate::watch::Watch;

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
    let counted = Cases::checked(cases, &tally, left_out)?;
    let selection = ModelSelection {
        cases: counted,
        own: &question.effects,
        custom: &question.custom,
        clusters: Clusters::of(cases),
        settings,
        watch,
    };
    let path = match &question.goal {
        Goal::Compare => selection.compare()?,
        Goal::Diagnose => selection.diagnose()?,
        Goal::Add(effects) => selection.add(effects)?,
        Goal::Improve => selection.improve()?,
    };
    Examination {
        question,
        cases: counted,
        settings,
        path,
        // What was found is told, however it ended.
        watch: watch.to_the_end(),
    }
    .answer()
}
