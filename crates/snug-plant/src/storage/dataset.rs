//! What lies where: the manifest, one folder of Parquet files a partition, and a marker that says which of them count.
//!
//! ```text
//! dataset.json                           the study that tightenings were prepared by, schema version
//! tightenings/2026-03-01/T07/….parquet   rows
//! findings/2026-03-01/T07/….parquet      what was found of the same files
//! commits/2026-03-01/T07.json            files that count; written last
//! ```
//!
//! A file that no marker names is not there: it is what a killed process left, and the next one writes it anew.

use crate::error::PlantError;
use crate::storage::parquet_file;
use crate::storage::partition::Partition;
use crate::storage::schema::SCHEMA_VERSION;
use crate::storage::store::Store;
use arrow::array::RecordBatch;
use arrow::datatypes::SchemaRef;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use snug_study::Study;
use std::path::Path;

const MANIFEST: &str = "dataset.json";

/// What a dataset or its results were made with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// `tightenings` or `results`.
    pub table: String,
    /// Of all tables.
    pub schema_version: u32,
    /// The study, every default written out (RON); it names no place.
    pub study: String,
}

/// A Parquet file that counts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CommittedFile {
    /// Its name below the dataset's place.
    pub name: String,
    /// Its rows.
    pub rows: usize,
    /// Its size.
    pub bytes: usize,
    /// SHA-256 of its content, hexadecimal.
    pub sha256: String,
}

/// What of a partition counts.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Commit {
    /// Files of rows.
    pub files: Vec<CommittedFile>,
    /// Files of findings.
    #[serde(default)]
    pub findings: Vec<CommittedFile>,
    /// Digests of the measurement files whose rows and findings these are.
    #[serde(default)]
    pub sources: Vec<String>,
    /// Of results: the digest of the marker that they were made from.
    #[serde(default)]
    pub made_from: Option<String>,
}

impl Commit {
    /// Rows of all files.
    pub fn rows(&self) -> usize {
        self.files.iter().map(|file| file.rows).sum()
    }

    /// What changes when anything of the partition does.
    pub fn digest(&self) -> String {
        let names = self.files.iter().map(|file| file.sha256.as_str());
        digest(names.collect::<Vec<_>>().join(" ").as_bytes())
    }
}

/// SHA-256, its first 16 bytes in hexadecimal: as long as no two files of a plant ever share.
pub fn digest(bytes: &[u8]) -> String {
    let whole = Sha256::digest(bytes);
    whole[..16]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// A dataset or its results.
#[derive(Debug, Clone)]
pub struct Dataset {
    /// Where.
    pub store: Store,
    /// What it was made with.
    pub manifest: Manifest,
}

impl Dataset {
    /// Opens what is there.
    ///
    /// # Errors
    /// [`PlantError::Nothing`] where there is none, [`PlantError::Version`] where it is another program's.
    pub async fn open(
        store: Store,
        table: &'static str,
        by: &'static str,
    ) -> Result<Self, PlantError> {
        match Self::find(store.clone(), table).await? {
            Some(found) => Ok(found),
            None => Err(PlantError::Nothing {
                url: store.url().to_owned(),
                what: table,
                by,
            }),
        }
    }

    async fn find(store: Store, table: &str) -> Result<Option<Self>, PlantError> {
        let Some(manifest) = json::<Manifest>(&store, MANIFEST).await? else {
            return Ok(None);
        };
        if manifest.schema_version != SCHEMA_VERSION {
            return Err(PlantError::Version {
                object: store.url_of(MANIFEST),
                found: manifest.schema_version,
                known: SCHEMA_VERSION,
            });
        }
        if manifest.table != table {
            return Err(PlantError::Marker {
                object: store.url_of(MANIFEST),
                reason: format!("it is of {}, wanted are {table}", manifest.table),
            });
        }
        Ok(Some(Self { store, manifest }))
    }

    /// Opens what is there, or begins it; what is there was made with the same study.
    ///
    /// # Errors
    /// [`PlantError::Other`] where it was made with another.
    pub async fn make(store: Store, table: &str, study: &Study) -> Result<Self, PlantError> {
        let wanted = portable(study).to_ron()?;
        if let Some(found) = Self::find(store.clone(), table).await? {
            return match found.manifest.study == wanted {
                true => Ok(found),
                false => Err(PlantError::Other {
                    url: store.url().to_owned(),
                    what: if table == "results" {
                        "model"
                    } else {
                        "preparation"
                    },
                }),
            };
        }
        let manifest = Manifest {
            table: table.to_owned(),
            schema_version: SCHEMA_VERSION,
            study: wanted,
        };
        let text = serde_json::to_vec_pretty(&manifest)?;
        store.put(MANIFEST, text).await?;
        Ok(Self { store, manifest })
    }

    /// The study that it was made with.
    ///
    /// # Errors
    /// [`PlantError::Study`] where the manifest holds none.
    pub fn study(&self) -> Result<Study, PlantError> {
        Ok(Study::parse(&self.manifest.study, Path::new(MANIFEST))?)
    }

    /// What of a partition counts; `None` where nothing does.
    pub async fn commit_of(&self, partition: &Partition) -> Result<Option<Commit>, PlantError> {
        json(&self.store, &marker(partition)).await
    }

    /// Every partition of which something counts, in the order of days and tools.
    ///
    /// # Errors
    /// [`PlantError::Marker`] for a marker that cannot be read.
    pub async fn partitions(&self) -> Result<Vec<(Partition, Commit)>, PlantError> {
        let mut found = Vec::new();
        for name in self.store.list("commits").await? {
            let foreign = || PlantError::Marker {
                object: self.store.url_of(&name),
                reason: "its name is none of DAY/TOOL.json".to_owned(),
            };
            let place = name
                .strip_prefix("commits/")
                .and_then(|rest| rest.strip_suffix(".json"));
            let (day, tool) = place
                .and_then(|place| place.split_once('/'))
                .ok_or_else(foreign)?;
            let partition = Partition::new(day, tool)?;
            if let Some(commit) = self.commit_of(&partition).await? {
                found.push((partition, commit));
            }
        }
        found.sort_by(|(one, _), (other, _)| one.cmp(other));
        Ok(found)
    }

    /// Writes one file of a partition; it counts once a marker names it.
    pub(crate) async fn write(
        &self,
        table: &str,
        partition: &Partition,
        schema: &SchemaRef,
        batches: &[RecordBatch],
    ) -> Result<CommittedFile, PlantError> {
        let bytes = parquet_file::written(table, schema, batches)?;
        let content = digest(&bytes);
        let file = CommittedFile {
            name: format!("{table}/{partition}/{content}.parquet"),
            rows: batches.iter().map(RecordBatch::num_rows).sum(),
            bytes: bytes.len(),
            sha256: content,
        };
        self.store.put(&file.name, bytes).await?;
        Ok(file)
    }

    /// Makes a partition's files count.
    pub(crate) async fn publish(
        &self,
        partition: &Partition,
        commit: &Commit,
    ) -> Result<(), PlantError> {
        let text = serde_json::to_vec_pretty(commit)?;
        self.store.put(&marker(partition), text).await
    }

    /// URLs of the files of rows that count.
    pub(crate) fn urls<'a>(&self, commits: impl IntoIterator<Item = &'a Commit>) -> Vec<String> {
        let files = commits.into_iter().flat_map(|commit| &commit.files);
        files.map(|file| self.store.url_of(&file.name)).collect()
    }
}

fn marker(partition: &Partition) -> String {
    format!("commits/{partition}.json")
}

async fn json<T: DeserializeOwned>(store: &Store, name: &str) -> Result<Option<T>, PlantError> {
    let Some(bytes) = store.get(name).await? else {
        return Ok(None);
    };
    let read = serde_json::from_slice(&bytes).map_err(|error| PlantError::Marker {
        object: store.url_of(name),
        reason: error.to_string(),
    });
    read.map(Some)
}

/// The study without the place of its data, which is another's on every machine, and may be nobody's business.
fn portable(study: &Study) -> Study {
    let mut study = study.clone();
    study.source.path = std::path::PathBuf::new();
    study.source.files = Vec::new();
    study
}
