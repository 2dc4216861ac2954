//! Given effects fitted to all tightenings, or asked of some of them.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::long_record;
use crate::pooled::model::{PooledModel, Start};
use snug_least_squares::PooledSettings;
use snug_model::Effect;

/// Fits exactly these effects, from where `from` ended where it is given.
pub(crate) fn fit_effects(
    cases: Cases<'_>,
    effects: &[Effect],
    from: Option<&Fitted>,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let mut pooled = PooledModel::new(cases, effects)?;
    let start = from.map(|fitted| fitted.start(&pooled));
    let end = match (clusters.are_whole(), start) {
        (true, start) => {
            let start = start.unwrap_or_else(|| pooled.usual_start());
            pooled.fit(&start, &PooledSettings::default())?
        }
        (false, Some(start)) => long_record::to_the_end(&mut pooled, &start)?,
        (false, None) => long_record::from_the_records(&mut pooled)?,
    };
    Ok(Fitted::new(&pooled, end, &clusters))
}

/// What `fitted` says of the tightenings `members`, which are `cases`, when they are asked alone.
pub(crate) fn fit_part(
    cases: Cases<'_>,
    members: &[usize],
    fitted: &Fitted,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let mut pooled = PooledModel::new(cases, &fitted.effects)?;
    let start = Start {
        own: fitted.own.clone(),
        shared: fitted.shared.clone(),
    };
    let end = pooled.fit(&start.of_members(members), &PooledSettings::default())?;
    Ok(Fitted::new(&pooled, end, &clusters))
}
