//! The engine: DataFusion in this process on all cores, or the same plans on a Ballista cluster.

use crate::fit::function::function;
use crate::pooled::{block_function, group_function, sum_function};
use crate::{PlantError, Store};
use arrow::array::RecordBatch;
use ballista::prelude::{SessionConfigExt, SessionContextExt};
use datafusion::common::DataFusionError;
use datafusion::dataframe::DataFrame;
use datafusion::datasource::file_format::options::ParquetReadOptions;
use datafusion::execution::SessionStateBuilder;
use datafusion::logical_expr::ScalarUDF;
use datafusion::prelude::{SessionConfig, SessionContext};
use std::thread::available_parallelism;
use std::time::Duration;

/// Rows that an operator hands on at a time: four batches of side-by-side fits, some 3 MB of signals.
const ROWS_AT_ONCE: usize = 64;

/// Rows that an operator hands on at a time where nothing is fitted.
const ROWS_READ: usize = 1024;

/// Parts that a cluster's plans are cut into, unless told otherwise: enough for the cores of a few workers, each part large enough.
pub const CLUSTER_PARTS: usize = 16;

/// Where plans are carried out.
#[derive(Debug, Clone, Default)]
pub enum Engine {
    /// In this process, with so many threads; `None` for one a core.
    #[default]
    Embedded,
    /// By the cluster whose scheduler is at `host:port`, in so many parts.
    Cluster {
        /// `host:port` of the scheduler.
        address: String,
        /// Parts of a plan that workers take at the same time.
        parts: usize,
    },
}

impl Engine {
    /// A session that knows Snug's functions and reads `stores`.
    ///
    /// # Errors
    /// [`PlantError::Cluster`] where no scheduler can be spoken to.
    pub(crate) async fn session(&self, stores: &[&Store]) -> Result<SessionContext, PlantError> {
        let session = match self {
            Self::Embedded => {
                let cores = available_parallelism().map_or(1, usize::from);
                SessionContext::new_with_config(configured(SessionConfig::new(), cores))
            }
            Self::Cluster { address, parts } => {
                let config = configured(SessionConfig::new_with_ballista(), *parts);
                let state = SessionStateBuilder::new()
                    .with_config(config)
                    .with_default_features()
                    .build();
                let connected =
                    SessionContext::remote_with_state(&format!("df://{address}"), state).await;
                connected.map_err(|error| PlantError::Cluster {
                    what: "scheduler",
                    address: address.clone(),
                    reason: error.to_string(),
                })?
            }
        };
        // A connected session has forgotten what its state knew: the functions are told to it afterwards.
        scalar_functions()
            .into_iter()
            .for_each(|one| session.register_udf(one));
        session.register_udaf(sum_function());
        register(&session, stores);
        Ok(session)
    }
}

/// A session of this process for questions, which reads `stores`.
pub(crate) fn reading_session(stores: &[&Store]) -> SessionContext {
    let cores = available_parallelism().map_or(1, usize::from);
    let config = configured(SessionConfig::new(), cores).with_batch_size(ROWS_READ);
    let session = SessionContext::new_with_config(config);
    register(&session, stores);
    session
}

/// Snug's functions of single rows.
pub(crate) fn scalar_functions() -> [ScalarUDF; 3] {
    [function(), block_function(), group_function()]
}

fn register(session: &SessionContext, stores: &[&Store]) {
    for store in stores {
        let (url, objects) = store.engine_store();
        session.register_object_store(&url, objects);
    }
}

fn configured(config: SessionConfig, parts: usize) -> SessionConfig {
    let mut config = config
        .with_target_partitions(parts)
        .with_batch_size(ROWS_AT_ONCE)
        .with_information_schema(true);
    let options = config.options_mut();
    // Field by field of what the function answers cannot be sent to a cluster once it is pushed down.
    options.optimizer.enable_leaf_expression_pushdown = false;
    // A tool's day is a few megabytes: it, too, is shared out among cores.
    options.optimizer.repartition_file_min_size = 1 << 20;
    // Texts as the files hold them.
    options.execution.parquet.schema_force_view_types = false;
    config
}

/// The rows of these files, all of one schema.
pub(crate) async fn rows_of(
    session: &SessionContext,
    urls: Vec<String>,
    schema: &arrow::datatypes::SchemaRef,
) -> Result<DataFrame, PlantError> {
    let options = ParquetReadOptions::default().schema(schema);
    Ok(session.read_parquet(urls, options).await?)
}

/// A job that has not ended after this time, and so much for each of its rows, is given up \[s\]. A scheduler that loses a worker in the
/// instant in which it hands it work may wait for ever; a row takes 0.08 s with an effect that is tried from several starts.
const GIVEN_UP_AFTER_S: f64 = 60.0;
/// See [`GIVEN_UP_AFTER_S`].
const GIVEN_UP_AFTER_S_PER_ROW: f64 = 1.0;

/// What a job over so many rows answers.
///
/// # Errors
/// [`PlantError::Engine`], also where it does not end.
pub(crate) async fn answered(
    frame: DataFrame,
    rows: usize,
) -> Result<Vec<RecordBatch>, PlantError> {
    let longest_s = GIVEN_UP_AFTER_S + GIVEN_UP_AFTER_S_PER_ROW * rows as f64;
    let longest = Duration::from_secs_f64(longest_s);
    match tokio::time::timeout(longest, frame.collect()).await {
        Ok(answer) => Ok(answer?),
        Err(_) => {
            let text = format!("the job did not end within {longest_s:.0} s and was given up");
            Err(DataFusionError::Execution(text).into())
        }
    }
}
