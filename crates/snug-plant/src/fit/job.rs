//! The fit of a dataset: jobs of some partitions each, results written and made to count partition by partition.

use super::in_vain::InVain;
use crate::engine::thresholds::GIVEN_UP_AFTER_S;
use crate::engine::{Engine, Session, rows_of};
use crate::error::PlantError;
use crate::functions::fit::{TAKEN, function};
use crate::functions::results;
use crate::rows;
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::partition::{COLUMNS, Partition, of_row};
use crate::storage::schema::{self, IDENTITY};
use crate::storage::store::Store;
use arrow::array::{ArrayRef, AsArray, RecordBatch};
use arrow::compute::{concat_batches, partition};
use arrow::datatypes::SchemaRef;
use datafusion::common::Column;
use datafusion::logical_expr::{Expr, lit};
use snug_study::Study;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

/// Rows of one job, unless told otherwise: some 20 s of one core for three parameters, and 1 GB of signals that are read.
pub const ROWS_PER_JOB: usize = 20_000;

/// How a dataset is fitted.
#[derive(Debug, Clone)]
pub struct FitSettings {
    /// Effects beside the study's own, from the catalogue or the study.
    pub effects: Vec<String>,
    /// Where.
    pub engine: Engine,
    /// Whether partitions that have results of the same rows are left as they are.
    pub resume: bool,
    /// Rows of one job.
    pub rows_per_job: usize,
    /// What is left is not tried when for so long no partition was fitted and those that were tried failed \[s\].
    pub given_up_after_s: u64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            effects: Vec::new(),
            engine: Engine::default(),
            resume: false,
            rows_per_job: ROWS_PER_JOB,
            given_up_after_s: GIVEN_UP_AFTER_S,
        }
    }
}

/// What a fit came to.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Fitted {
    /// Rows that have results now.
    pub rows: usize,
    /// Partitions that have.
    pub partitions: usize,
    /// Partitions that were left as they are.
    pub left: usize,
}

/// A part of the dataset and what counts of it.
type Part = (Partition, Commit);

/// Fits every row of the dataset at `data` and puts the results to `to`; `progress` hears of every job that is done.
///
/// # Errors
/// [`PlantError::Partitions`] names those that have no results now, each with its reason; all others have theirs, whole.
pub async fn fit(
    data: Store,
    to: Store,
    settings: &FitSettings,
    progress: &(dyn Fn(&Fitted) + Sync),
) -> Result<Fitted, PlantError> {
    let data = Dataset::open(data, "tightenings", "import").await?;
    let mut study = data.study()?;
    study.check_effects(&settings.effects)?;
    study.model.effects.extend(settings.effects.iter().cloned());
    fit_with(&data, &study, to, settings, progress).await
}

/// The same with the model of a study, whatever the settings say of effects.
pub(crate) async fn fit_with(
    data: &Dataset,
    study: &Study,
    to: Store,
    settings: &FitSettings,
    progress: &(dyn Fn(&Fitted) + Sync),
) -> Result<Fitted, PlantError> {
    let results = Dataset::make(to, "results", study).await?;
    let session = settings.engine.session(&[&data.store]).await?;
    let work = Work {
        schema: results::results(study)?,
        study: results.manifest.study.clone(),
        session,
        data,
        results: &results,
    };
    let mut fitted = Fitted::default();
    let mut to_do = Vec::new();
    for part in data.partitions().await? {
        match settings.resume && work.is_done(&part).await? {
            true => fitted.left += 1,
            false => to_do.push(part),
        }
    }
    let mut failed: Vec<(String, String)> = Vec::new();
    let mut in_vain = InVain::none(Duration::from_secs(settings.given_up_after_s));
    for job in jobs(&to_do, settings.rows_per_job) {
        failed.extend(work.job(job, &mut fitted, &mut in_vain).await?);
        progress(&fitted);
    }
    match failed.is_empty() {
        true => Ok(fitted),
        false => Err(PlantError::Partitions {
            failed,
            partitions: to_do.len(),
        }),
    }
}

/// Neighbouring partitions with so many rows together, or one that has more.
pub(crate) fn jobs(parts: &[Part], rows: usize) -> Vec<&[Part]> {
    let mut jobs = Vec::new();
    let (mut start, mut sum) = (0, 0);
    for (index, (_, commit)) in parts.iter().enumerate() {
        if index > start && sum + commit.rows() > rows {
            jobs.push(&parts[start..index]);
            (start, sum) = (index, 0);
        }
        sum += commit.rows();
    }
    if start < parts.len() {
        jobs.push(&parts[start..]);
    }
    jobs
}

struct Work<'a> {
    session: Session,
    data: &'a Dataset,
    results: &'a Dataset,
    study: String,
    schema: SchemaRef,
}

impl Work<'_> {
    async fn is_done(&self, (part, commit): &Part) -> Result<bool, PlantError> {
        let found = self.results.commit_of(part).await?;
        Ok(found.is_some_and(|found| found.made_from.as_ref() == Some(&commit.digest())))
    }

    /// Fits some partitions together, or each by itself where that fails; gives those that could not be, with the reason.
    async fn job(
        &self,
        parts: &[Part],
        fitted: &mut Fitted,
        in_vain: &mut InVain,
    ) -> Result<Vec<(String, String)>, PlantError> {
        if in_vain.given_up().is_none() {
            match self.fitted(parts).await {
                Ok(rows) => return self.publish(parts, &rows, fitted, in_vain).await,
                Err(error) => tracing::warn!(partitions = parts.len(), %error, "a job failed"),
            }
        }
        let mut failed = Vec::new();
        for part in parts {
            if let Some(why) = in_vain.given_up() {
                failed.push((part.0.to_string(), why));
                continue;
            }
            let one = std::slice::from_ref(part);
            match self.fitted(one).await {
                Ok(rows) => failed.extend(self.publish(one, &rows, fitted, in_vain).await?),
                Err(error) => {
                    in_vain.count(false);
                    failed.push((part.0.to_string(), reason(&error)));
                }
            }
        }
        Ok(failed)
    }

    /// The results of some partitions, in the order of days, tools, files and numbers.
    async fn fitted(&self, parts: &[Part]) -> Result<RecordBatch, PlantError> {
        let urls = self.data.urls(parts.iter().map(|(_, commit)| commit));
        let rows = rows_of(&self.session.context, urls, &schema::tightenings()).await?;
        let named = |name: &str| Expr::Column(Column::from_name(name));
        let mut taken = vec![lit(self.study.as_str())];
        taken.extend(TAKEN.fields().iter().map(|field| named(field.name())));
        let mut wanted: Vec<Expr> = IDENTITY.iter().map(|(name, ..)| named(name)).collect();
        wanted.push(function().call(taken).alias("fit"));
        let batches = self.session.answer_of(rows.select(wanted)?).await?;
        let flat: Vec<RecordBatch> = (batches.iter())
            .map(|batch| flattened(batch, &self.schema))
            .collect::<Result<_, _>>()?;
        let failed = PlantError::columns("results");
        let all = concat_batches(&self.schema, &flat).map_err(&failed)?;
        rows::sorted(&all, &["day", "tool", "file", "number", "key"]).map_err(&failed)
    }

    /// Writes each partition's results and makes them count, if they are of every row once.
    async fn publish(
        &self,
        parts: &[Part],
        rows: &RecordBatch,
        fitted: &mut Fitted,
        in_vain: &mut InVain,
    ) -> Result<Vec<(String, String)>, PlantError> {
        let found = by_partition(rows)?;
        let mut failed = Vec::new();
        for (part, commit) in parts {
            if let Some(why) = in_vain.given_up() {
                failed.push((part.to_string(), why));
                continue;
            }
            let own = found
                .get(part)
                .map_or_else(|| rows.slice(0, 0), Clone::clone);
            let keys: BTreeSet<&str> = text_column(&own, "key")
                .map_or_else(BTreeSet::new, |keys| keys.iter().flatten().collect());
            if own.num_rows() != commit.rows() || keys.len() != commit.rows() {
                let reason = format!(
                    "{} rows are stored, {} came back, {} of them different",
                    commit.rows(),
                    own.num_rows(),
                    keys.len()
                );
                in_vain.count(false);
                failed.push((part.to_string(), reason));
                continue;
            }
            let written = self.made_to_count(part, commit, own).await;
            in_vain.count(written.is_ok());
            match written {
                Ok(()) => {
                    fitted.rows += commit.rows();
                    fitted.partitions += 1;
                }
                Err(error) => failed.push((part.to_string(), reason(&error))),
            }
        }
        Ok(failed)
    }

    /// Writes the results of all rows of a partition, and then the marker that names them.
    async fn made_to_count(
        &self,
        part: &Partition,
        commit: &Commit,
        rows: RecordBatch,
    ) -> Result<(), PlantError> {
        let rows = [rows];
        let file = self.results.write("results", part, &self.schema, &rows);
        let now = Commit {
            files: vec![file.await?],
            made_from: Some(commit.digest()),
            ..Commit::default()
        };
        let before = self.results.commit_of(part).await?;
        self.results.publish(part, &now).await?;
        self.remove_all_but(&now, before).await
    }

    /// Takes the files away that counted before and do so no more.
    async fn remove_all_but(&self, now: &Commit, before: Option<Commit>) -> Result<(), PlantError> {
        for file in before.unwrap_or_default().files {
            if !now.files.iter().any(|kept| kept.name == file.name) {
                self.results.store.remove(&file.name).await?;
            }
        }
        Ok(())
    }
}

/// An error in one line.
pub(crate) fn reason(error: &PlantError) -> String {
    let text = error.to_string();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn text_column<'a>(rows: &'a RecordBatch, name: &str) -> Option<&'a arrow::array::StringArray> {
    rows.column_by_name(name)?.as_string_opt()
}

/// Identity and what the function answered, side by side.
fn flattened(batch: &RecordBatch, schema: &SchemaRef) -> Result<RecordBatch, PlantError> {
    let failed = PlantError::columns("results");
    let mut columns: Vec<ArrayRef> = batch.columns()[..IDENTITY.len()].to_vec();
    let fit = batch.column(IDENTITY.len()).as_struct();
    columns.extend(fit.columns().iter().cloned());
    let cast = columns.iter().zip(schema.fields()).map(|(column, field)| {
        match column.data_type() == field.data_type() {
            true => Ok(column.clone()),
            false => arrow::compute::cast(column, field.data_type()),
        }
    });
    let columns = cast.collect::<Result<Vec<_>, _>>().map_err(&failed)?;
    RecordBatch::try_new(schema.clone(), columns).map_err(&failed)
}

/// Sorted rows, by their partitions.
fn by_partition(rows: &RecordBatch) -> Result<BTreeMap<Partition, RecordBatch>, PlantError> {
    let mut found = BTreeMap::new();
    if rows.num_rows() == 0 {
        return Ok(found);
    }
    let places: Vec<ArrayRef> = COLUMNS
        .iter()
        .filter_map(|name| rows.column_by_name(name).cloned())
        .collect();
    let ranges = partition(&places).map_err(PlantError::columns("results"))?;
    for range in ranges.ranges() {
        let part = of_row(&places[0], &places[1], range.start)?;
        found.insert(part, rows.slice(range.start, range.len()));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::storage::dataset::CommittedFile;

    #[test]
    fn jobs_hold_whole_partitions_and_all_of_them() {
        let part = |(tool, rows): (usize, usize)| {
            let file = CommittedFile {
                name: String::new(),
                rows,
                bytes: 0,
                sha256: String::new(),
            };
            let commit = Commit {
                files: vec![file],
                ..Commit::default()
            };
            (
                Partition::new("2026-03-01", &format!("T{tool}")).unwrap(),
                commit,
            )
        };
        let parts: Vec<Part> = [40, 50, 10, 300, 1, 99]
            .into_iter()
            .enumerate()
            .map(part)
            .collect();
        let sizes: Vec<usize> = jobs(&parts, 100).iter().map(|job| job.len()).collect();
        assert_eq!(sizes, [3, 1, 2]);
        assert!(jobs(&[], 100).is_empty());
    }
}
