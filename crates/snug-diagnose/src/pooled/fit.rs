//! Given effects fitted to all tightenings, or asked of some of them.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::long_record;
use crate::pooled::model::{PooledModel, Start};
use crate::pooled::sharing::Sharing;
use snug_least_squares::PooledSettings;
use snug_model::Effect;

/// Fits exactly these effects, from where `from` ended where it is given; sizes that differ between groups there, differ here.
pub(crate) fn fit_effects(
    cases: Cases<'_>,
    effects: &[Effect],
    from: Option<&Fitted>,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let sharing = from.map_or_else(Sharing::default, |from| from.sharing.clone());
    fit_sharing(cases, effects, &sharing, from, clusters)
}

/// The same, sizes shared as `sharing` says.
pub(crate) fn fit_sharing(
    cases: Cases<'_>,
    effects: &[Effect],
    sharing: &Sharing,
    from: Option<&Fitted>,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let mut pooled = PooledModel::shared_by(cases, effects, sharing)?;
    let start = from.map(|fitted| fitted.start(&pooled));
    fit_from(&mut pooled, start, clusters)
}

/// Fits from this start, or where there is none from the usual one.
pub(crate) fn fit_from(
    pooled: &mut PooledModel<'_>,
    start: Option<Start>,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let end = match (clusters.are_whole(), start) {
        (true, start) => {
            let start = start.unwrap_or_else(|| pooled.usual_start());
            pooled.fit(&start, &PooledSettings::default())?
        }
        (false, Some(start)) => long_record::to_the_end(pooled, &start)?,
        (false, None) => long_record::from_the_records(pooled)?,
    };
    Ok(Fitted::new(pooled, end, &clusters))
}

/// Fits exactly these effects, from where the parameters that are `named` have these values and the others as in `from`, to ever longer
/// beginnings; sizes that differ between groups there, differ here.
pub(crate) fn fit_named(
    cases: Cases<'_>,
    effects: &[Effect],
    from: &Fitted,
    named: &[(String, f64)],
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let mut pooled = PooledModel::shared_by(cases, effects, &from.sharing)?;
    let start = pooled.with_named(&from.start(&pooled), named);
    let end = long_record::grown(&mut pooled, &start)?;
    Ok(Fitted::new(&pooled, end, &clusters))
}

/// What `fitted` says of the tightenings `members`, which are `cases`, when they are asked alone.
pub(crate) fn fit_part(
    cases: Cases<'_>,
    members: &[usize],
    fitted: &Fitted,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let mut pooled = PooledModel::shared_by(cases, &fitted.effects, &fitted.sharing)?;
    let start = fitted.start_of(&pooled, members);
    let end = pooled.fit(&start, &PooledSettings::default())?;
    Ok(Fitted::new(&pooled, end, &clusters))
}
