//! One pass over a dataset: every row is asked, what the rows of a partition and a group say is added up by the engine part by part, and
//! here the parts.

use crate::engine::{Session, rows_of};
use crate::error::PlantError;
use crate::fit::{InVain, jobs, reason};
use crate::functions::block::{ASKED, GROUPED, block_function, group_function};
use crate::functions::question::{Held, Totals};
use crate::functions::sum::{Places, sum_function};
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::partition::{COLUMNS, Partition, of_row};
use crate::storage::schema;
use arrow::array::{Array, AsArray, RecordBatch};
use arrow::datatypes::{Float64Type, SchemaRef};
use arrow::error::ArrowError;
use datafusion::common::Column;
use datafusion::logical_expr::{Expr, lit};
use std::collections::BTreeMap;
use std::time::Duration;

/// What can be passed over: a dataset, the study whose model its rows are asked with, and where that is done.
pub(crate) struct Pass<'a> {
    pub session: &'a Session,
    pub data: &'a Dataset,
    /// As RON.
    pub study: &'a str,
    pub parts: &'a [(Partition, Commit)],
    pub rows_per_job: usize,
    /// Given up when for so long nothing came out.
    pub given_up_after: Duration,
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
        let mut in_vain = InVain::none(self.given_up_after);
        for job in jobs(self.parts, self.rows_per_job) {
            if in_vain.given_up().is_none() {
                match self.whole(job, held, &text).await {
                    Ok(found) => {
                        in_vain.count(true);
                        all.extend(found);
                        continue;
                    }
                    Err(error) => {
                        tracing::warn!(partitions = job.len(), %error, "a job of a pass failed");
                    }
                }
            }
            for part in job {
                if let Some(why) = in_vain.given_up() {
                    failed.push((part.0.to_string(), why));
                    continue;
                }
                let found = self.whole(std::slice::from_ref(part), held, &text).await;
                in_vain.count(found.is_ok());
                match found {
                    Ok(found) => all.extend(found),
                    Err(error) => failed.push((part.0.to_string(), reason(&error))),
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
        let rows = rows_of(&self.session.context, urls, &schema::tightenings()).await?;
        let taken = |schema: &SchemaRef| -> Vec<Expr> {
            let names = schema.fields().iter().map(|field| field.name().clone());
            names
                .map(|name| Expr::Column(Column::from_name(name)))
                .collect()
        };
        let asked = [vec![lit(self.study), lit(text)], taken(&ASKED)].concat();
        let named = |name: &str| Expr::Column(Column::from_name(name));
        let mut by = Vec::from(COLUMNS.map(named));
        let mut wanted = by.clone();
        if held.sharing.factor.is_some() {
            let taken = [vec![lit(text)], taken(&GROUPED)].concat();
            wanted.push(group_function().call(taken).alias("sharing"));
            by.push(named("sharing"));
        }
        wanted.push(block_function().call(asked).alias("said"));
        let sums = vec![sum_function().call(vec![named("said")]).alias("sums")];
        let said = rows.select(wanted)?.aggregate(by, sums)?;
        let mut sums = Sums::new();
        for batch in self.session.states_of(said).await? {
            read(&batch, held.sharing.factor.is_some(), &mut sums)?;
        }
        let mut found = Found::new();
        for ((partition, group), places) in sums {
            let said = totals(&places.sums(), held.all.len())?;
            found.entry(partition).or_default().insert(group, said);
        }
        Ok(found)
    }
}

/// Sums that parts of the rows of a partition and a group add to.
type Sums = BTreeMap<(Partition, Option<String>), Places>;

/// Adds what a batch says: day, tool, group where there are some, and the state of the sums.
fn read(batch: &RecordBatch, by_group: bool, sums: &mut Sums) -> Result<(), PlantError> {
    let foreign = || {
        let text = format!("its sums came as {}", batch.schema());
        PlantError::columns("a pass")(ArrowError::SchemaError(text))
    };
    let states = batch
        .columns()
        .last()
        .and_then(|all| all.as_list_opt::<i32>());
    let states = states.ok_or_else(foreign)?;
    let groups = match by_group {
        true => Some(batch.column(2).as_string_opt::<i32>().ok_or_else(foreign)?),
        false => None,
    };
    for row in 0..batch.num_rows() {
        let partition = of_row(batch.column(0), batch.column(1), row)?;
        let group = groups.filter(|groups| groups.is_valid(row));
        let group = group.map(|groups| groups.value(row).to_owned());
        let state = states.value(row);
        let state = state
            .as_primitive_opt::<Float64Type>()
            .ok_or_else(foreign)?;
        let places = sums.entry((partition, group)).or_default();
        places.merge(state.values());
    }
    Ok(())
}

fn totals(sums: &[f64], p: usize) -> Result<Totals, PlantError> {
    let foreign = || {
        let text = format!("{} sums came of {p} sizes", sums.len());
        PlantError::columns("a pass")(ArrowError::SchemaError(text))
    };
    Totals::from_list(p, sums).ok_or_else(foreign)
}
