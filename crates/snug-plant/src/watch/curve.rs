//! The way down to one tightening: of each tool that changed, the one since then that its model explains worst.

use super::quantities::ERROR;
use super::summary::{Found, Watched};
use super::thresholds::MOST_CURVES;
use crate::engine::{reading_session, rows_of};
use crate::error::PlantError;
use crate::functions::fit::TAKEN;
use crate::functions::results;
use crate::rows;
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::partition::Partition;
use crate::storage::schema;
use crate::storage::store::Store;
use arrow::array::{AsArray, RecordBatch};
use arrow::datatypes::Date32Type;
use datafusion::prelude::{col, lit};
use snug_study::{Study, fit_tightenings};

/// One tightening as measured and as its model has it.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Its tool.
    pub tool: String,
    /// Its day.
    pub day: String,
    /// Its file and number.
    pub id: String,
    /// Its key in the dataset.
    pub key: String,
    /// What its fit leaves.
    pub error_over_noise: f64,
    /// What is shown.
    pub quantity: snug_campaign::Quantity,
    /// From sample to sample \[s\].
    pub interval_s: f64,
    /// Joint torque \[Nm\].
    pub torque_nm: Vec<f64>,
    /// As measured, in the quantity's SI unit.
    pub measured: Vec<f64>,
    /// As the model has it, in the quantity's SI unit.
    pub simulated: Vec<f64>,
}

/// Those of the tools that are told first.
pub async fn of_worst(
    results: &Dataset,
    data: &Store,
    watched: &Watched,
) -> Result<Vec<Curve>, PlantError> {
    let data = Dataset::open(data.clone(), "tightenings", "import").await?;
    let study = results.study()?;
    let commits = results.partitions().await?;
    let mut curves = Vec::new();
    for found in watched.tools.iter().take(MOST_CURVES) {
        if let Some((partition, key)) = worst(results, &study, &commits, found).await? {
            curves.extend(curve(&data, &study, &partition, &key).await?);
        }
    }
    Ok(curves)
}

/// The partition and key of the tightening with the largest error since a tool's change.
async fn worst(
    results: &Dataset,
    study: &Study,
    commits: &[(Partition, Commit)],
    found: &Found,
) -> Result<Option<(Partition, String)>, PlantError> {
    let since = found.since.as_deref().unwrap_or_default();
    let own = commits
        .iter()
        .filter(|(partition, _)| partition.tool == found.name && partition.day.as_str() >= since);
    let urls = results.urls(own.map(|(_, commit)| commit));
    if urls.is_empty() {
        return Ok(None);
    }
    let session = reading_session(&[&results.store]);
    let rows = rows_of(&session, urls, &results::results(study)?).await?;
    let largest = rows
        .filter(col(ERROR).is_not_null().and(col("day").is_not_null()))?
        .sort(vec![
            col(ERROR).sort(false, false),
            col("key").sort(true, false),
        ])?
        .limit(0, Some(1))?
        .select(vec![col("key"), col("day")])?;
    for batch in largest.collect().await? {
        if batch.num_rows() > 0 {
            let day = batch.column(1).as_primitive::<Date32Type>().value(0);
            let partition = Partition::new(&crate::storage::partition::date_of(day), &found.name)?;
            let key = batch.column(0).as_string::<i32>().value(0).to_owned();
            return Ok(Some((partition, key)));
        }
    }
    Ok(None)
}

async fn curve(
    data: &Dataset,
    study: &Study,
    partition: &Partition,
    key: &str,
) -> Result<Option<Curve>, PlantError> {
    let Some(commit) = data.commit_of(partition).await? else {
        return Ok(None);
    };
    let session = reading_session(&[&data.store]);
    let rows = rows_of(&session, data.urls([&commit]), &schema::tightenings()).await?;
    let wanted = TAKEN.fields().iter().map(|field| col(field.name()));
    let row = rows
        .filter(col("key").eq(lit(key)))?
        .select(wanted.collect::<Vec<_>>())?;
    for batch in row.collect().await? {
        if batch.num_rows() > 0 {
            return shown(study, partition, key, &batch);
        }
    }
    Ok(None)
}

fn shown(
    study: &Study,
    partition: &Partition,
    key: &str,
    batch: &RecordBatch,
) -> Result<Option<Curve>, PlantError> {
    let prepared = rows::prepared(batch).map_err(PlantError::columns(&partition.to_string()))?;
    let quantity = study.identify.fitted_output;
    let Some(one) = prepared.first() else {
        return Ok(None);
    };
    let Some(Ok((result, Some(traces)))) = fit_tightenings(study, &[one])?.into_iter().next()
    else {
        return Ok(None);
    };
    let signal = |motion: &snug_campaign::Motion| motion.get(quantity).unwrap_or(&[]).to_vec();
    Ok(Some(Curve {
        tool: partition.tool.clone(),
        day: partition.day.clone(),
        id: result.id.to_string(),
        key: key.to_owned(),
        error_over_noise: result.measures.error_over_noise.unwrap_or(f64::NAN),
        quantity,
        interval_s: traces.time_base.interval_s,
        measured: signal(&traces.measured),
        simulated: signal(&traces.simulated),
        torque_nm: traces.torque_nm,
    }))
}
