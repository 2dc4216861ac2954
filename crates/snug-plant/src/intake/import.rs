//! Measurement files to a dataset: each file once, partition after partition, so that memory holds one part of one.

use crate::error::PlantError;
use crate::intake::naming::{Named, Naming};
use crate::rows::{Row, batch};
use crate::storage::dataset::{Commit, CommittedFile, Dataset, digest};
use crate::storage::partition::Partition;
use crate::storage::schema;
use crate::storage::store::Store;
use arrow::array::{ArrayRef, Date32Array, RecordBatch, StringArray, UInt32Array};
use rayon::prelude::*;
use snug_campaign::{Finding, Severity};
use snug_study::{FileTightenings, Study, fitted_files, read_tightenings, settled};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::Arc;

/// Rows of one Parquet file at most: four row groups, at 3000 samples of two channels some 50 MB.
pub const MOST_ROWS: usize = 1024;

/// Files that are read side by side before their rows are written.
const FILES_AT_ONCE: usize = 16;

/// What an import came to.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Imported {
    /// Rows that came.
    pub rows: usize,
    /// Findings that came.
    pub findings: usize,
    /// Measurement files that were read.
    pub files: usize,
    /// Measurement files that were there already.
    pub known: usize,
    /// Partitions that changed.
    pub partitions: usize,
}

/// A measurement file and its digest.
type Source = (PathBuf, Named);

/// Brings the files of a study into the dataset at `to`; what is there already stays as it is.
///
/// # Errors
/// A setting that is not allowed, a name that does not follow the template, a store that fails. What is wrong with a file is a
/// finding.
pub async fn import(study: &Study, naming: &Naming, to: Store) -> Result<Imported, PlantError> {
    let study = settled(study)?;
    let dataset = Dataset::make(to, "tightenings", &study).await?;
    let (files, listed) = fitted_files(&study)?;
    let mut by_partition: BTreeMap<Partition, Vec<Source>> = BTreeMap::new();
    for file in files {
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let named = naming.of(&stem)?;
        let sources = by_partition.entry(named.partition.clone()).or_default();
        sources.push((file, named));
    }
    let mut imported = Imported::default();
    for finding in &listed {
        tracing::warn!(file = finding.file, "{}", finding.message);
    }
    for (partition, sources) in by_partition {
        let before = dataset.commit_of(&partition).await?.unwrap_or_default();
        let mut growing = Growing::new(&dataset, partition, before);
        for some in sources.chunks(FILES_AT_ONCE) {
            growing
                .take(read(&study, some, &growing.known)?, &mut imported)
                .await?;
        }
        growing.finish(&mut imported).await?;
    }
    Ok(imported)
}

/// A file's digest, what its name says, and what it holds.
pub(crate) type Read = (String, Named, FileTightenings);

/// Files whose rows are `known` are not prepared.
fn read(
    study: &Study,
    sources: &[Source],
    known: &BTreeSet<String>,
) -> Result<Vec<Read>, PlantError> {
    let each = sources.par_iter().map(|(path, named)| {
        let bytes = std::fs::read(path).map_err(|source| PlantError::Read {
            path: path.clone(),
            source,
        })?;
        let source = digest(&bytes);
        drop(bytes);
        let file = match known.contains(&source) {
            true => FileTightenings::default(),
            false => read_tightenings(study, path)?,
        };
        Ok((source, named.clone(), file))
    });
    each.collect()
}

/// A partition that rows are put to.
pub(crate) struct Growing<'a> {
    dataset: &'a Dataset,
    partition: Partition,
    commit: Commit,
    known: BTreeSet<String>,
    rows: Vec<Row>,
    findings: Vec<(String, Finding)>,
    has_grown: bool,
}

impl<'a> Growing<'a> {
    pub fn new(dataset: &'a Dataset, partition: Partition, commit: Commit) -> Self {
        Self {
            known: commit.sources.iter().cloned().collect(),
            dataset,
            partition,
            commit,
            rows: Vec::new(),
            findings: Vec::new(),
            has_grown: false,
        }
    }

    pub async fn take(
        &mut self,
        files: Vec<Read>,
        imported: &mut Imported,
    ) -> Result<(), PlantError> {
        for (source, named, file) in files {
            if !self.known.insert(source.clone()) {
                imported.known += 1;
                continue;
            }
            self.has_grown = true;
            imported.files += 1;
            self.commit.sources.push(source.clone());
            let row = |prepared| Row {
                source: source.clone(),
                station: named.station.clone(),
                time_of_day_s: named.time_of_day_s,
                prepared,
            };
            self.rows.extend(file.tightenings.into_iter().map(row));
            let found = file.findings.into_iter();
            self.findings
                .extend(found.map(|finding| (source.clone(), finding)));
            while self.rows.len() >= MOST_ROWS {
                let rest = self.rows.split_off(MOST_ROWS);
                self.write(imported).await?;
                self.rows = rest;
            }
        }
        Ok(())
    }

    async fn write(&mut self, imported: &mut Imported) -> Result<(), PlantError> {
        let rows = std::mem::take(&mut self.rows);
        if rows.is_empty() {
            return Ok(());
        }
        let batch = batch(&self.partition, &rows)?;
        imported.rows += rows.len();
        let file = self.write_table("tightenings", batch).await?;
        self.commit.files.push(file);
        Ok(())
    }

    async fn write_table(
        &self,
        table: &str,
        batch: RecordBatch,
    ) -> Result<CommittedFile, PlantError> {
        let schema = batch.schema();
        self.dataset
            .write(table, &self.partition, &schema, &[batch])
            .await
    }

    /// Writes what is left, and then the marker.
    pub async fn finish(mut self, imported: &mut Imported) -> Result<(), PlantError> {
        if !self.has_grown {
            return Ok(());
        }
        self.write(imported).await?;
        if !self.findings.is_empty() {
            imported.findings += self.findings.len();
            let batch = findings_batch(&self.partition, &self.findings)?;
            let file = self.write_table("findings", batch).await?;
            self.commit.findings.push(file);
        }
        imported.partitions += 1;
        self.dataset.publish(&self.partition, &self.commit).await
    }
}

fn findings_batch(
    partition: &Partition,
    findings: &[(String, Finding)],
) -> Result<RecordBatch, PlantError> {
    let text = |read: fn(&(String, Finding)) -> Option<&str>| -> ArrayRef {
        Arc::new(findings.iter().map(read).collect::<StringArray>())
    };
    let numbers: UInt32Array = findings
        .iter()
        .map(|(_, finding)| finding.tightening)
        .collect();
    let days: Date32Array = findings.iter().map(|_| partition.days()).collect();
    let tools: StringArray = findings
        .iter()
        .map(|_| Some(partition.tool.as_str()))
        .collect();
    let columns = vec![
        text(|(source, _)| Some(source)),
        text(|(_, finding)| Some(&finding.file)),
        Arc::new(numbers),
        Arc::new(days),
        Arc::new(tools),
        text(|(_, finding)| Some(severity(finding.severity))),
        text(|(_, finding)| Some(&finding.code)),
        text(|(_, finding)| finding.channel.as_deref()),
        text(|(_, finding)| Some(&finding.message)),
    ];
    RecordBatch::try_new(schema::findings(), columns)
        .map_err(PlantError::columns(&partition.to_string()))
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Repaired => "repaired",
        Severity::LeftOut => "left_out",
    }
}
