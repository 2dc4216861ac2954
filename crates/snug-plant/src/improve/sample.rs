//! A sample of a dataset, stratified by tool, part of the time, joint and person.
//!
//! In two stages, so that only as many partitions are read as rows are wanted, however large the dataset: tools and parts of the time
//! are in the partitions' names; of those that are taken the rows' joints and persons are read, and then the rows.

use super::thresholds::{EACH, FAMILY_Z, FEWEST, MOST, SHOWN_SD, WHERE_IT_SHOWS};
use crate::engine::{reading_session, rows_of};
use crate::error::PlantError;
use crate::fit::reason;
use crate::functions::question::States;
use crate::rows;
use crate::storage::dataset::{Commit, Dataset, digest};
use crate::storage::partition::Partition;
use crate::storage::schema;
use arrow::array::{Array, AsArray, RecordBatch};
use arrow::compute::concat_batches;
use datafusion::common::Column;
use datafusion::logical_expr::{Expr, lit};
use serde::Serialize;
use snug_preprocess::Prepared;
use snug_statistics::distributions::normal_quantile;
use std::collections::{BTreeMap, BTreeSet};

/// Why a sample has the size it has; its numbers have no unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SampleSize {
    /// Smallest share of the tightenings that have an effect which must not be missed.
    pub share: f64,
    /// Probability with which it is not.
    pub power: f64,
    /// How strong it is in one tightening, in standard deviations of chance.
    pub shown_standard_deviations: f64,
    /// Rows wanted: ((3.0 + z of the power) / strength)² / share.
    pub rows: usize,
}

impl SampleSize {
    /// What power and share ask for.
    ///
    /// # Errors
    /// [`PlantError::Setting`] for what is no power or share, and for a share that asks for more rows than are ranked.
    pub fn of(power: f64, share: f64) -> Result<Self, PlantError> {
        if !(0.5..1.0).contains(&power) {
            let text = power.to_string();
            return Err(PlantError::setting("power", &text, "0.5 to below 1"));
        }
        let of_one = ((FAMILY_Z + normal_quantile(power)) / SHOWN_SD).powi(2);
        if !(of_one / MOST as f64..=1.0).contains(&share) {
            let least = (of_one / MOST as f64 * 1e4).ceil() / 1e4;
            let allowed = format!("{least} to 1: less would ask for more than {MOST} rows");
            return Err(PlantError::setting("share", &share.to_string(), &allowed));
        }
        Ok(Self {
            share,
            power,
            shown_standard_deviations: SHOWN_SD,
            rows: ((of_one / share).ceil() as usize).max(FEWEST),
        })
    }
}

/// A sample.
#[derive(Debug, Clone)]
pub struct Sample {
    /// The tightenings, tool by tool and day by day; each is known by its tool and that tool's state.
    pub prepared: Vec<Prepared>,
    /// Their rows' identity, as the table `tightenings` has it.
    pub identity: RecordBatch,
    /// Tools and parts of the time that they are of.
    pub strata: usize,
    /// Parts of the time.
    pub parts_of_time: usize,
    /// Rows of it that are of tools in a state of their own.
    pub in_states: usize,
    /// Partitions that were read.
    pub partitions: usize,
}

/// Draws a sample of so many rows, half of them of tools in a state of their own; `seed` decides which.
///
/// # Errors
/// [`PlantError::Engine`] for partitions that cannot be read.
pub async fn sample(
    data: &Dataset,
    parts: &[(Partition, Commit)],
    states: &States,
    wanted: usize,
    seed: u64,
) -> Result<Sample, PlantError> {
    let times = times(parts, wanted);
    let is_in = |part: &Partition| states.of(&part.tool, part.days()).is_some();
    let (there, elsewhere) = (
        strata(parts, &times, &is_in),
        strata(parts, &times, &|part| !is_in(part)),
    );
    let room =
        |strata: &[Stratum]| -> usize { strata.iter().flatten().map(|(_, rows)| rows).sum() };
    let half = (WHERE_IT_SHOWS * wanted as f64) as usize;
    let in_states = (half.max(wanted.saturating_sub(room(&elsewhere)))).min(room(&there));
    let mut wanted_of = first_stage(&there, in_states);
    wanted_of.extend(first_stage(&elsewhere, wanted - in_states.min(wanted)));
    let taken: Vec<(&Partition, &Commit, usize)> = (wanted_of.iter())
        .map(|(&index, &rows)| (&parts[index].0, &parts[index].1, rows))
        .collect();
    let rows = match drawn(data, &taken, seed).await {
        Ok(rows) => rows,
        Err(error) => return Err(unreadable(data, &taken, parts.len()).await.unwrap_or(error)),
    };
    let failed = PlantError::columns("a sample");
    let by = ["tool", "day", "file", "number", "key"];
    let rows = rows::sorted(&rows, &by).map_err(&failed)?;
    let mut prepared = rows::prepared(&rows).map_err(&failed)?;
    let names = rows::names_of(&rows, &|tool, day| states.name(tool, day)).map_err(&failed)?;
    let mut counts: BTreeMap<String, u32> = BTreeMap::new();
    for (one, name) in prepared.iter_mut().zip(names) {
        let number = counts.entry(name.clone()).or_insert(0);
        *number += 1;
        (one.tightening.id.file, one.tightening.id.number) = (name, *number);
    }
    let identity: Vec<usize> = (0..schema::IDENTITY.len()).collect();
    Ok(Sample {
        identity: rows.project(&identity).map_err(&failed)?,
        prepared,
        strata: there.len() + elsewhere.len(),
        parts_of_time: times.len(),
        in_states,
        partitions: taken.len(),
    })
}

/// Partitions by their places in the list of all, with their rows.
type Stratum = Vec<(usize, usize)>;

/// Partitions that a sample is drawn from, and how many rows of each.
type Taken<'a> = [(&'a Partition, &'a Commit, usize)];

/// The rows of a sample.
async fn drawn(data: &Dataset, taken: &Taken<'_>, seed: u64) -> Result<RecordBatch, PlantError> {
    let session = reading_session(&[&data.store]);
    let named = |name: &str| Expr::Column(Column::from_name(name));
    let urls = data.urls(taken.iter().map(|(_, commit, _)| *commit));
    let all = rows_of(&session, urls, &schema::tightenings()).await?;
    let who = ["key", "day", "tool", "joint", "participant"].map(named);
    let who = all.clone().select(who.to_vec())?.collect().await?;
    let keys = second_stage(&who, taken, seed)?;
    let wanted_keys = keys.into_iter().map(lit).collect();
    let rows = all
        .filter(named("key").in_list(wanted_keys, false))?
        .collect()
        .await?;
    concat_batches(&schema::tightenings(), &rows).map_err(PlantError::columns("a sample"))
}

/// The error that names those partitions that cannot be read; `None` where each by itself can be.
async fn unreadable(data: &Dataset, taken: &Taken<'_>, partitions: usize) -> Option<PlantError> {
    let mut failed = Vec::new();
    for (part, commit, _) in taken {
        let session = reading_session(&[&data.store]);
        let rows = rows_of(&session, data.urls([*commit]), &schema::tightenings()).await;
        let read = match rows {
            Ok(rows) => rows.collect().await.map_err(PlantError::from),
            Err(error) => Err(error),
        };
        failed.extend(read.err().map(|error| (part.to_string(), reason(&error))));
    }
    (!failed.is_empty()).then_some(PlantError::Pass { failed, partitions })
}

/// Last days of so many parts of the time that two rows of every tool come of each; fewer where there are more tools.
fn times(parts: &[(Partition, Commit)], wanted: usize) -> Vec<i32> {
    let tools: BTreeSet<&str> = parts.iter().map(|(part, _)| part.tool.as_str()).collect();
    let days: BTreeSet<i32> = parts.iter().filter_map(|(part, _)| part.days()).collect();
    let days: Vec<i32> = days.into_iter().collect();
    let count = (wanted / (EACH * tools.len().max(1))).clamp(1, days.len().max(1));
    let ends = (0..count).filter_map(|part| days.get((part + 1) * days.len() / count - 1));
    ends.copied().collect()
}

/// Those partitions that are `wanted`, with their rows, of every tool in every part of the time, which ends on these days; tool by tool.
fn strata(
    parts: &[(Partition, Commit)],
    times: &[i32],
    wanted: &dyn Fn(&Partition) -> bool,
) -> Vec<Stratum> {
    let mut strata: BTreeMap<(&str, Option<usize>), Stratum> = BTreeMap::new();
    for (index, (part, commit)) in parts.iter().enumerate() {
        let time = (part.days()).map(|day| times.partition_point(|last| *last < day));
        if wanted(part) {
            let stratum = strata.entry((part.tool.as_str(), time)).or_default();
            stratum.push((index, commit.rows()));
        }
    }
    strata.into_values().collect()
}

/// How many rows are taken of which partition: of every stratum as many pairs, evenly spread over its partitions; where one has too few,
/// the others have more.
fn first_stage(strata: &[Stratum], wanted: usize) -> BTreeMap<usize, usize> {
    let room: Vec<usize> = strata
        .iter()
        .map(|parts| parts.iter().map(|(_, rows)| rows).sum())
        .collect();
    let mut of_stratum: Vec<usize> = vec![0; strata.len()];
    let mut left = wanted.min(room.iter().sum());
    while left > 0 {
        let open: Vec<usize> = (0..strata.len())
            .filter(|&i| of_stratum[i] < room[i])
            .collect();
        let pairs = left.div_ceil(EACH);
        for (place, &stratum) in open.iter().enumerate() {
            let upto = |place: usize| place * pairs / open.len();
            let more = (EACH * (upto(place + 1) - upto(place))).min(left);
            let more = more.min(room[stratum] - of_stratum[stratum]);
            of_stratum[stratum] += more;
            left -= more;
        }
    }
    let mut taken = BTreeMap::new();
    for (parts, rows) in strata.iter().zip(of_stratum) {
        let mut rest = rows;
        // Round and round, as evenly spread as one round allows.
        while rest > 0 {
            let open: Vec<&(usize, usize)> = (parts.iter())
                .filter(|(index, room)| taken.get(index).copied().unwrap_or(0) < *room)
                .collect();
            let now = rest.min(open.len());
            for turn in 0..now {
                let (index, _) = open[(2 * turn + 1) * open.len() / (2 * now)];
                *taken.entry(*index).or_insert(0) += 1;
            }
            rest -= now;
        }
    }
    taken
}

/// Keys of the rows that are taken: of every partition as many as wanted, joints and persons by turns, which of theirs by lot.
fn second_stage(
    who: &[RecordBatch],
    taken: &Taken<'_>,
    seed: u64,
) -> Result<Vec<String>, PlantError> {
    type Lots = BTreeMap<(Option<String>, Option<String>), Vec<(String, String)>>;
    let mut by_part: BTreeMap<Partition, Lots> = BTreeMap::new();
    for batch in who {
        let text = |at: usize| batch.column(at).as_string::<i32>();
        let (keys, joints, people) = (text(0), text(3), text(4));
        let value = |column: &arrow::array::StringArray, row: usize| {
            column.is_valid(row).then(|| column.value(row).to_owned())
        };
        for row in 0..batch.num_rows() {
            let part = crate::storage::partition::of_row(batch.column(1), batch.column(2), row)?;
            let key = keys.value(row).to_owned();
            let lot = digest(format!("{seed} {key}").as_bytes());
            let group = (value(joints, row), value(people, row));
            let lots = by_part.entry(part).or_default();
            lots.entry(group).or_default().push((lot, key));
        }
    }
    let mut keys = Vec::new();
    for (turn, (part, _, rows)) in taken.iter().enumerate() {
        let Some(lots) = by_part.get_mut(part) else {
            continue;
        };
        lots.values_mut().for_each(|lots| lots.sort());
        let mut groups: Vec<Vec<String>> = (lots.values())
            .map(|lots| lots.iter().rev().map(|(_, key)| key.clone()).collect())
            .collect();
        let first = turn % groups.len().max(1);
        groups.rotate_left(first);
        let mut left = *rows;
        while left > 0 && groups.iter().any(|group| !group.is_empty()) {
            for group in &mut groups {
                if let Some(key) = group.pop().filter(|_| left > 0) {
                    keys.push(key);
                    left -= 1;
                }
            }
        }
    }
    Ok(keys)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::storage::dataset::CommittedFile;

    /// SciPy 1.17.1: `(3 + norm.ppf(0.9))**2 / 0.1` is 183.3; at half the share twice as many.
    #[test]
    fn the_size_follows_from_power_and_share() {
        assert_eq!(SampleSize::of(0.9, 0.1).unwrap().rows, 184);
        assert_eq!(SampleSize::of(0.9, 0.05).unwrap().rows, 367);
        assert_eq!(SampleSize::of(0.9, 1.0).unwrap().rows, FEWEST);
        let error = SampleSize::of(0.9, 0.001).unwrap_err().to_string();
        assert!(
            error.contains("share") && error.contains("0.0092"),
            "{error}"
        );
        assert!(SampleSize::of(1.0, 0.1).is_err());
    }

    fn plant(tools: usize, days: usize, rows: impl Fn(usize) -> usize) -> Vec<(Partition, Commit)> {
        let part = |day: usize, tool: usize| {
            let file = CommittedFile {
                name: String::new(),
                rows: rows(tool),
                bytes: 0,
                sha256: String::new(),
            };
            let commit = Commit {
                files: vec![file],
                ..Commit::default()
            };
            let day = format!("2026-03-{:02}", day + 1);
            (
                Partition::new(&day, &format!("T{tool:04}")).unwrap(),
                commit,
            )
        };
        (0..days)
            .flat_map(|day| (0..tools).map(move |tool| part(day, tool)))
            .collect()
    }

    #[test]
    fn every_tool_is_asked_in_every_part_of_the_time() {
        let parts = plant(12, 20, |_| 20);
        let times = times(&parts, 184);
        let strata = strata(&parts, &times, &|_| true);
        assert_eq!((strata.len(), times.len()), (84, 7));
        let taken = first_stage(&strata, 184);
        assert_eq!(taken.values().sum::<usize>(), 184);
        for stratum in &strata {
            let own: usize = stratum
                .iter()
                .filter_map(|(index, _)| taken.get(index))
                .sum();
            assert!((2..=4).contains(&own), "{own}");
        }
    }

    #[test]
    fn where_a_tool_has_few_rows_others_have_more() {
        let parts = plant(3, 2, |tool| if tool == 1 { 1 } else { 50 });
        let strata = strata(&parts, &times(&parts, 60), &|_| true);
        let taken = first_stage(&strata, 60);
        assert_eq!(taken.values().sum::<usize>(), 60);
        assert!(
            taken
                .iter()
                .all(|(&index, &rows)| rows <= parts[index].1.rows())
        );
        let few = plant(2, 2, |_| 3);
        let all = super::strata(&few, &times(&few, 60), &|_| true);
        assert_eq!(first_stage(&all, 60).values().sum::<usize>(), 12);
    }

    #[test]
    fn of_a_thousand_tools_some_are_asked_evenly_spread() {
        let parts = plant(1000, 3, |_| 5);
        let strata = strata(&parts, &times(&parts, 100), &|_| true);
        assert_eq!(strata.len(), 1000);
        let tools: Vec<usize> = (first_stage(&strata, 100).into_keys())
            .map(|index| index % 1000)
            .collect();
        let mut sorted = tools.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert!(sorted.windows(2).all(|pair| pair[1] - pair[0] == 20));
    }
}
