//! What a plant asks of its results: which tool changed, when, in what; which differs from its sisters.

mod change_point;
mod curve;
mod daily;
mod page;
mod quantities;
mod sisters;
mod summary;
mod tables;
mod thresholds;

pub use summary::{Found, Watched};

use crate::error::PlantError;
use crate::storage::dataset::Dataset;
use crate::storage::store::Store;
use daily::{By, Series, daily};
use quantities::Quantities;
use summary::Judged;

/// What is watched, and where what is found goes.
#[derive(Debug, Clone)]
pub struct WatchSettings {
    /// Results of a fit.
    pub results: Store,
    /// The dataset that they were made from, for curves of single tightenings; `None` for a page without.
    pub data: Option<Store>,
    /// Where `watch.html`, `watch.json`, `watch.parquet` and `daily.parquet` are written.
    pub to: Store,
}

/// Watches tools, joints and stations over days.
///
/// # Errors
/// [`PlantError::Nothing`] where there are no results, [`PlantError::Engine`] where they cannot be read.
pub async fn watch(settings: &WatchSettings) -> Result<Watched, PlantError> {
    let results = Dataset::open(settings.results.clone(), "results", "fit").await?;
    let quantities = Quantities::of(&results.study()?)?;
    let mut series: Vec<Series> = Vec::new();
    for by in By::ALL {
        series.extend(daily(&results, &quantities, by).await?);
    }
    let judged = Judged::of(&series, &quantities)?;
    let watched = judged.watched();
    let curves = match &settings.data {
        Some(data) => curve::of_worst(&results, data, &watched).await?,
        None => Vec::new(),
    };
    let to = &settings.to;
    to.put("daily.parquet", tables::daily(&series)?).await?;
    to.put("watch.parquet", tables::judged(&judged)?).await?;
    to.put("watch.json", serde_json::to_vec_pretty(&watched)?)
        .await?;
    let page = page::page(&judged, &watched, &quantities, &curves);
    to.put("watch.html", page.into_bytes()).await?;
    Ok(watched)
}
