//! Questions in SQL over a dataset, its findings and results.

use crate::engine::{reading_session, rows_of};
use crate::error::PlantError;
use crate::functions::results;
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::schema;
use crate::storage::store::Store;
use arrow::array::RecordBatch;
use arrow::datatypes::SchemaRef;
use arrow::util::pretty::pretty_format_batches;
use datafusion::execution::context::SQLOptions;
use datafusion::prelude::SessionContext;

/// What a query may ask: tables `tightenings` and `findings` of a dataset, `results` of a fit.
#[derive(Debug, Clone, Default)]
pub struct Tables {
    /// A dataset.
    pub data: Option<Store>,
    /// Results of a fit.
    pub results: Option<Store>,
}

/// The answer to a query.
///
/// # Errors
/// [`PlantError::Engine`] for what is no query, [`PlantError::Nothing`] where a place holds no table.
pub async fn query(tables: &Tables, text: &str) -> Result<Vec<RecordBatch>, PlantError> {
    let stores: Vec<&Store> = tables.data.iter().chain(&tables.results).collect();
    let session = reading_session(&stores);
    if let Some(store) = &tables.data {
        let data = Dataset::open(store.clone(), "tightenings", "import").await?;
        register(
            &session,
            "tightenings",
            &data,
            &schema::tightenings(),
            |commit| &commit.files,
        )
        .await?;
        register(&session, "findings", &data, &schema::findings(), |commit| {
            &commit.findings
        })
        .await?;
    }
    if let Some(store) = &tables.results {
        let results = Dataset::open(store.clone(), "results", "fit").await?;
        let schema = results::results(&results.study()?)?;
        register(&session, "results", &results, &schema, |commit| {
            &commit.files
        })
        .await?;
    }
    let only_reading = SQLOptions::new()
        .with_allow_ddl(false)
        .with_allow_dml(false)
        .with_allow_statements(false);
    let answer = session.sql_with_options(text, only_reading).await?;
    Ok(answer.collect().await?)
}

async fn register(
    session: &SessionContext,
    name: &str,
    dataset: &Dataset,
    schema: &SchemaRef,
    files: fn(&Commit) -> &Vec<crate::storage::dataset::CommittedFile>,
) -> Result<(), PlantError> {
    let commits = dataset.partitions().await?;
    let files = commits.iter().flat_map(|(_, commit)| files(commit));
    let urls: Vec<String> = files.map(|file| dataset.store.url_of(&file.name)).collect();
    let rows = match urls.is_empty() {
        true => session.read_batch(RecordBatch::new_empty(schema.clone()))?,
        false => rows_of(session, urls, schema).await?,
    };
    session.register_table(name, rows.into_view())?;
    Ok(())
}

/// An answer as a table of text.
///
/// # Errors
/// [`PlantError::Columns`] for a value that has no text.
pub fn as_text(batches: &[RecordBatch]) -> Result<String, PlantError> {
    let table = pretty_format_batches(batches).map_err(PlantError::columns("the answer"))?;
    Ok(table.to_string())
}
