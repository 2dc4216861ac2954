//! The engine: DataFusion in this process on all cores, or the same plans on a Ballista cluster.

mod cluster;
mod stalled;
pub(crate) mod thresholds;

pub use cluster::{SchedulerSettings, WorkerSettings, scheduler, worker};

use crate::error::PlantError;
use crate::functions::scalar_functions;
use crate::functions::sum::sum_function;
use crate::storage::store::Places;
use crate::storage::store::Store;
use arrow::array::RecordBatch;
use ballista::prelude::{SessionConfigExt, SessionContextExt};
use ballista_core::execution_plans::execute_physical_plan;
use datafusion::common::{DataFusionError, internal_err};
use datafusion::dataframe::DataFrame;
use datafusion::datasource::file_format::options::ParquetReadOptions;
use datafusion::execution::SessionStateBuilder;
use datafusion::execution::runtime_env::{RuntimeEnv, RuntimeEnvBuilder};
use datafusion::physical_plan::aggregates::{AggregateExec, AggregateMode};
use datafusion::physical_plan::{ExecutionPlan, collect};
use datafusion::physical_planner::{DefaultPhysicalPlanner, PhysicalPlanner};
use datafusion::prelude::{SessionConfig, SessionContext};
use datafusion_proto::protobuf::PhysicalPlanNode;
use futures::TryStreamExt;
use std::sync::Arc;
use std::thread::available_parallelism;

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
    pub(crate) async fn session(&self, stores: &[&Store]) -> Result<Session, PlantError> {
        let context = match self {
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
            .for_each(|one| context.register_udf(one));
        context.register_udaf(sum_function());
        register(&context, stores);
        let scheduler = match self {
            Self::Embedded => None,
            Self::Cluster { address, .. } => Some(format!("http://{address}")),
        };
        Ok(Session { context, scheduler })
    }
}

/// Where plans are carried out, ready to be asked.
pub(crate) struct Session {
    /// What plans are made with.
    pub context: SessionContext,
    /// URL of the scheduler; `None` in this process.
    scheduler: Option<String>,
}

impl Session {
    /// What the parts of an aggregate over so many rows answer, each by itself: its groups, then the states of its functions, a group
    /// once or more often. No part waits for another: where a worker dies, what it had is done again and nothing else.
    ///
    /// # Errors
    /// As [`Session::answer_of`].
    pub async fn states_of(&self, aggregate: DataFrame) -> Result<Vec<RecordBatch>, PlantError> {
        let context = Arc::new(aggregate.task_ctx());
        let plan = of_each_part(&planned(aggregate).await?)?;
        let Some(scheduler) = &self.scheduler else {
            return Ok(collect(plan, context).await?);
        };
        let config = context.session_config().clone();
        let codec = config.ballista_physical_extension_codec();
        let ballista = config.ballista_config();
        let answer = async {
            let batches = execute_physical_plan::<PhysicalPlanNode>(
                scheduler.clone(),
                &ballista,
                plan,
                codec.as_ref(),
                context.session_id(),
                config,
            );
            batches.await?.try_collect().await
        };
        self.heard(answer.await)
    }

    /// What a job answers.
    ///
    /// # Errors
    /// [`PlantError::Engine`], [`PlantError::StandsStill`] where a cluster's scheduler gave it up.
    pub async fn answer_of(&self, frame: DataFrame) -> Result<Vec<RecordBatch>, PlantError> {
        self.heard(frame.collect().await)
    }

    fn heard<T>(&self, answer: Result<T, DataFusionError>) -> Result<T, PlantError> {
        answer.map_err(|error| match &self.scheduler {
            Some(scheduler) if error.to_string().contains(GIVEN_UP) => PlantError::StandsStill {
                scheduler: scheduler.clone(),
            },
            _ => error.into(),
        })
    }
}

/// What a client hears of a job that its scheduler ended: nobody but the scheduler itself ends one.
const GIVEN_UP: &str = "failed: Cancelled";

/// What reads every place that a plan may name.
pub(crate) fn runtime(spills_to: Option<&str>) -> Result<RuntimeEnv, DataFusionError> {
    let mut builder =
        RuntimeEnvBuilder::new().with_object_store_registry(Arc::new(Places::default()));
    if let Some(folder) = spills_to {
        builder = builder.with_temp_file_path(folder);
    }
    builder.build()
}

/// The plan that the engine would carry out in this process.
async fn planned(frame: DataFrame) -> Result<Arc<dyn ExecutionPlan>, DataFusionError> {
    let (state, plan) = frame.into_parts();
    let plan = state.optimize(&plan)?;
    let planner = DefaultPhysicalPlanner::default();
    planner.create_physical_plan(&plan, &state).await
}

/// An aggregate's plan without what puts parts together.
fn of_each_part(plan: &Arc<dyn ExecutionPlan>) -> Result<Arc<dyn ExecutionPlan>, DataFusionError> {
    let (mut node, mut found) = (plan, None);
    loop {
        found = node.downcast_ref::<AggregateExec>().or(found);
        match node.children()[..] {
            [only] => node = only,
            _ => break,
        }
    }
    let Some(aggregate) = found else {
        return internal_err!("the plan of a sum has no aggregate");
    };
    Ok(Arc::new(AggregateExec::try_new(
        AggregateMode::Partial,
        aggregate.group_expr().clone(),
        aggregate.aggr_expr().to_vec(),
        aggregate.filter_expr().to_vec(),
        aggregate.input().clone(),
        aggregate.input_schema(),
    )?))
}

/// A session of this process for questions, which reads `stores`.
pub(crate) fn reading_session(stores: &[&Store]) -> SessionContext {
    let cores = available_parallelism().map_or(1, usize::from);
    let config = configured(SessionConfig::new(), cores).with_batch_size(ROWS_READ);
    let session = SessionContext::new_with_config(config);
    register(&session, stores);
    session
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::storage::schema;
    use datafusion::common::Column;
    use datafusion::logical_expr::{Expr, lit};

    fn names(plan: &Arc<dyn ExecutionPlan>, found: &mut Vec<String>) {
        found.push(plan.name().to_owned());
        plan.children().iter().for_each(|one| names(one, found));
    }

    /// What a worker hands to another is lost with it, and the scheduler may wait for it for ever.
    #[tokio::test]
    async fn nothing_passes_between_the_parts_of_a_clusters_plans() {
        let engine = Engine::Cluster {
            address: "127.0.0.1:1".to_owned(),
            parts: 4,
        };
        let session = engine.session(&[]).await.unwrap();
        let folder = tempfile::tempdir().unwrap();
        let table = schema::tightenings();
        let file = |number: usize| {
            let path = folder.path().join(format!("{number}.parquet"));
            let bytes = crate::storage::parquet_file::written("a", &table, &[]).unwrap();
            std::fs::write(&path, bytes).unwrap();
            path.to_str().unwrap().to_owned()
        };
        let urls: Vec<String> = (0..4).map(file).collect();
        let rows = || rows_of(&session.context, urls.clone(), &table);
        let named = |name: &str| Expr::Column(Column::from_name(name));
        let list = sum_function().call(vec![named("torque_nm")]);
        let keys = vec![named("day"), named("tool")];
        let summed = rows().await.unwrap().aggregate(keys, vec![list]).unwrap();
        let study = lit(snug_study::Study::default().to_ron().unwrap());
        let taken = crate::functions::fit::TAKEN.fields().iter();
        let taken = std::iter::once(study).chain(taken.map(|field| named(field.name())));
        let fitted = crate::functions::fit::function()
            .call(taken.collect())
            .alias("fit");
        let fitted = rows().await.unwrap().select(vec![named("key"), fitted]);
        let mut whole = Vec::new();
        let summed = planned(summed).await.unwrap();
        names(&summed, &mut whole);
        let (mut of_parts, mut of_fit) = (Vec::new(), Vec::new());
        names(&of_each_part(&summed).unwrap(), &mut of_parts);
        names(&planned(fitted.unwrap()).await.unwrap(), &mut of_fit);
        let passes = |name: &String| name.contains("Repartition") || name.contains("Coalesce");
        assert!(whole.iter().any(passes), "{whole:?}");
        assert_eq!(of_parts[0], "AggregateExec");
        assert!(!of_parts.iter().any(passes), "{of_parts:?}");
        assert!(!of_fit.iter().any(passes), "{of_fit:?}");
    }
}
