//! Effects fitted to many tightenings together, nothing judged: what a person sees who tries an effect by hand.

use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fit::fit_effects;
use crate::pooled::one_machine::one_machine_or_several;
use snug_campaign::WorkDone;
use snug_identify::FitTask;
use snug_model::Effect;

/// Where a fit of all tightenings together ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Together {
    /// What all tightenings share: names with unit suffix and values.
    pub shared: Vec<(String, f64)>,
    /// What every tightening has of its own, in the order of the cases: m, c, k first.
    pub own: Vec<Vec<(String, f64)>>,
    /// Root mean square of the residual: over noise, where that is known of every tightening, else in the output's
    /// unit.
    pub error: f64,
    /// Whether no step promised more.
    pub converged: bool,
    /// What it took.
    pub work: WorkDone,
}

/// Fits the study's base model with exactly these effects to all tightenings together.
///
/// Every tightening keeps its own m, c, k; the sizes of the effects are shared unless the effect says otherwise.
///
/// # Errors
/// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::Identify`] where one was not measured, otherwise
/// what the model or the fit refuses.
pub fn fit_together(cases: &[FitTask<'_>], effects: &[Effect]) -> Result<Together, DiagnoseError> {
    let tally = Tally::default();
    let counted = Cases::checked(cases, &tally, "there is none to fit")?;
    let fitted = fit_effects(counted, effects, None, Clusters::of(cases))?;
    Ok(Together {
        shared: fitted.shared_named(),
        own: (0..cases.len())
            .map(|member| fitted.own_named(member))
            .collect(),
        error: fitted.error(),
        converged: fitted.converged,
        work: tally.done(),
    })
}

/// Where the study's base model and these effects begin: where a fit of all recordings ends, which share m, c, k where they are of
/// one machine. Names with unit suffix and values; nothing of m, c, k where there are many tightenings.
///
/// # Errors
/// As [`fit_together`].
pub fn starts_together(
    cases: &[FitTask<'_>],
    effects: &[Effect],
) -> Result<Vec<(String, f64)>, DiagnoseError> {
    let tally = Tally::default();
    let clusters = Clusters::of(cases);
    let counted = Cases::checked(cases, &tally, "there is none to begin with")?;
    let (counted, _) = one_machine_or_several(counted, effects, clusters)?;
    let fitted = fit_effects(counted, effects, None, clusters)?;
    let base = fitted.base().into_iter();
    Ok(base.chain(fitted.shared_named()).collect())
}
