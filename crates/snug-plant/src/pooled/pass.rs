//! One pass over a dataset: every row is asked, and what the rows of a partition and a group say is added up by the engine.

use super::function::{ASKED, GROUPED, block_function, group_function};
use super::question::{Held, Totals};
use super::sum::sum_function;
use crate::PlantError;
use crate::dataset::{Commit, Dataset};
use crate::engine::{answered, rows_of};
use crate::fit::{jobs, reason};
use crate::partition::{Partition, of_row};
use crate::schema;
use arrow::array::{Array, AsArray, RecordBatch};
use arrow::datatypes::{Float64Type, SchemaRef};
use arrow::error::ArrowError;
use datafusion::common::Column;
use datafusion::logical_expr::{Expr, lit};
use datafusion::prelude::SessionContext;
use std::collections::BTreeMap;

/// What can be passed over: a dataset, the study whose model its rows are asked with, and where that is done.
pub(crate) struct Pass<'a> {
    pub session: &'a SessionContext,
    pub data: &'a Dataset,
    /// As RON.
    pub study: &'a str,
    pub parts: &'a [(Partition, Commit)],
    pub rows_per_job: usize,
}

/// What the rows of one group say; those of no group under `None`.
pub(crate) type ByGroup = BTreeMap<Option<String>, Totals>;

/// What those of every partition say.
pub(crate) type Found = BTreeMap<Partition, ByGroup>;

/// What all say, group by group, and partition by partition.
pub(crate) fn added_up(found: &Found, p: usize) -> (ByGroup, BTreeMap<Partition, Totals>) {
    let mut groups = ByGroup::new();
    let mut parts: BTreeMap<Partition, Totals> = BTreeMap::new();
    for (part, said) in found {
        let of_part = parts.entry(part.clone()).or_insert_with(|| Totals::zero(p));
        for (group, said) in said {
            let of_group = groups.entry(group.clone());
            of_group.or_insert_with(|| Totals::zero(p)).add(said);
            of_part.add(said);
        }
    }
    (groups, parts)
}

impl Pass<'_> {
    /// What the rows of every partition say at these sizes, group by group.
    ///
    /// # Errors
    /// [`PlantError::Pass`] names the partitions that could not be asked, or whose rows did not all come back once.
    pub async fn said(&self, held: &Held) -> Result<Found, PlantError> {
        let text = serde_json::to_string(held)?;
        let mut all = Found::new();
        let mut failed = Vec::new();
        for job in jobs(self.parts, self.rows_per_job) {
            match self.whole(job, held, &text).await {
                Ok(found) => all.extend(found),
                Err(error) if job.len() == 1 => failed.push((job[0].0.to_string(), reason(&error))),
                Err(error) => {
                    tracing::warn!(partitions = job.len(), %error, "a job of a pass failed");
                    for part in job {
                        match self.whole(std::slice::from_ref(part), held, &text).await {
                            Ok(found) => all.extend(found),
                            Err(error) => failed.push((part.0.to_string(), reason(&error))),
                        }
                    }
                }
            }
        }
        if !failed.is_empty() {
            return Err(PlantError::Pass {
                failed,
                partitions: self.parts.len(),
            });
        }
        Ok(all)
    }

    /// The same of some partitions, each of which came back whole.
    async fn whole(
        &self,
        job: &[(Partition, Commit)],
        held: &Held,
        text: &str,
    ) -> Result<Found, PlantError> {
        let found = self.asked(job, held, text).await?;
        for (part, commit) in job {
            let rows: f64 = (found.get(part).into_iter())
                .flat_map(BTreeMap::values)
                .map(|said| said.rows)
                .sum();
            if rows != commit.rows() as f64 {
                return Err(PlantError::Rows {
                    partition: part.to_string(),
                    stored: commit.rows(),
                    came: rows as usize,
                });
            }
        }
        Ok(found)
    }

    async fn asked(
        &self,
        job: &[(Partition, Commit)],
        held: &Held,
        text: &str,
    ) -> Result<Found, PlantError> {
        let urls = self.data.urls(job.iter().map(|(_, commit)| commit));
        let rows = rows_of(self.session, urls, &schema::tightenings()).await?;
        let taken = |schema: &SchemaRef| -> Vec<Expr> {
            let names = schema.fields().iter().map(|field| field.name().clone());
            names
                .map(|name| Expr::Column(Column::from_name(name)))
                .collect()
        };
        let asked = [vec![lit(self.study), lit(text)], taken(&ASKED)].concat();
        let group = match held.sharing.factor {
            Some(_) => group_function().call([vec![lit(text)], taken(&GROUPED)].concat()),
            None => lit(datafusion::common::ScalarValue::Utf8(None)),
        };
        let named = |name: &str| Expr::Column(Column::from_name(name));
        let said = rows.select(vec![
            named("day"),
            named("tool"),
            group.alias("sharing"),
            block_function().call(asked).alias("said"),
        ])?;
        let by = vec![named("day"), named("tool"), named("sharing")];
        let sums = vec![sum_function().call(vec![named("said")]).alias("sums")];
        let count = job.iter().map(|(_, commit)| commit.rows()).sum();
        let batches = answered(said.aggregate(by, sums)?, count).await?;
        let mut found = Found::new();
        for batch in &batches {
            read(batch, held.all.len(), &mut found)?;
        }
        Ok(found)
    }
}

/// The sums of a batch, by partition and group.
fn read(batch: &RecordBatch, p: usize, found: &mut Found) -> Result<(), PlantError> {
    let groups = batch.column(2).as_string::<i32>();
    let sums = batch.column(3).as_list::<i32>();
    for row in 0..batch.num_rows() {
        let partition = of_row(batch.column(0), batch.column(1), row)?;
        let group = groups.is_valid(row).then(|| groups.value(row).to_owned());
        let list = sums.value(row);
        let list = list.as_primitive::<Float64Type>().values();
        let foreign = || {
            let text = format!("{} sums came of {p} sizes", list.len());
            PlantError::columns("a pass")(ArrowError::SchemaError(text))
        };
        let said = Totals::from_list(p, list).ok_or_else(foreign)?;
        let of_part = found.entry(partition).or_default();
        of_part
            .entry(group)
            .or_insert_with(|| Totals::zero(p))
            .add(&said);
    }
    Ok(())
}
