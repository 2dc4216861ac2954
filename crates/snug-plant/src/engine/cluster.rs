//! The engine's own processes, with Snug's functions registered: a scheduler and as many workers as wanted.

use super::runtime;
use super::stalled::{Server, end_what_stands_still};
use super::thresholds::{DEAD_AFTER_S, HEARTBEAT_S};
use crate::error::PlantError;
use crate::functions::scalar_functions;
use crate::functions::sum::sum_function;
use ballista_core::registry::BallistaFunctionRegistry;
use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::SchedulerConfig;
use ballista_scheduler::scheduler_process::{create_scheduler, start_grpc_service};
use datafusion::execution::{FunctionRegistry, SessionState, SessionStateBuilder};
use datafusion::prelude::SessionConfig;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

/// How a scheduler is started.
#[derive(Debug, Clone)]
pub struct SchedulerSettings {
    /// Address that it binds to.
    pub bind: SocketAddr,
    /// A job that stands still for so long is given up \[s\].
    pub give_up_after_s: u64,
}

/// How a worker is started.
#[derive(Debug, Clone)]
pub struct WorkerSettings {
    /// `host:port` of the scheduler.
    pub scheduler: SocketAddr,
    /// Address that it binds to.
    pub bind: std::net::IpAddr,
    /// Port for data.
    pub port: u16,
    /// Port for commands.
    pub command_port: u16,
    /// Tasks at a time; `None` for one a core.
    pub cores: Option<usize>,
    /// Folder for what is handed between stages; `None` for one of its own that ends with it.
    pub work_dir: Option<String>,
}

fn state(config: SessionConfig) -> datafusion::error::Result<SessionState> {
    let mut state = SessionStateBuilder::new()
        .with_config(config)
        .with_runtime_env(Arc::new(runtime(None)?))
        .with_default_features()
        .build();
    for one in scalar_functions() {
        state.register_udf(Arc::new(one))?;
    }
    state.register_udaf(Arc::new(sum_function()))?;
    Ok(state)
}

/// Runs a scheduler until the process ends.
///
/// # Errors
/// [`PlantError::Setting`] for a time of nothing, [`PlantError::Cluster`] where it cannot be bound.
pub async fn scheduler(settings: &SchedulerSettings) -> Result<(), PlantError> {
    let (address, after_s) = (settings.bind, settings.give_up_after_s);
    if after_s == 0 {
        return Err(PlantError::setting("give-up-after", "0", "1 s and more"));
    }
    let failed = |reason: String| PlantError::Cluster {
        what: "scheduler",
        address: address.to_string(),
        reason,
    };
    let mut config = SchedulerConfig::default()
        .with_hostname(address.ip().to_string())
        .with_port(address.port())
        .with_override_session_builder(Arc::new(state));
    config.bind_host = address.ip().to_string();
    config.executor_timeout_seconds = DEAD_AFTER_S;
    config.expire_dead_executor_interval_seconds = HEARTBEAT_S;
    let cluster = BallistaCluster::new_from_config(&config)
        .await
        .map_err(|error| failed(error.to_string()))?;
    let server: Server = create_scheduler(cluster, Arc::new(config))
        .await
        .map_err(|error| failed(error.to_string()))?;
    let after = Duration::from_secs(after_s);
    let watched = tokio::spawn(end_what_stands_still(server.clone(), after));
    let served = start_grpc_service(address, server).await;
    watched.abort();
    served.map_err(|error| failed(error.to_string()))
}

/// Runs a worker until the process ends.
///
/// # Errors
/// [`PlantError::Cluster`] where it cannot be bound, or finds no scheduler.
pub async fn worker(settings: &WorkerSettings) -> Result<(), PlantError> {
    let mut registry = BallistaFunctionRegistry::default();
    for one in scalar_functions() {
        let name = one.name().to_owned();
        registry.scalar_functions.insert(name, Arc::new(one));
    }
    let sum = sum_function();
    let name = sum.name().to_owned();
    registry.aggregate_functions.insert(name, Arc::new(sum));
    let reads = Arc::new(runtime(settings.work_dir.as_deref())?);
    let mut config = ExecutorProcessConfig {
        bind_host: settings.bind.to_string(),
        external_host: Some(settings.bind.to_string()),
        port: settings.port,
        grpc_port: settings.command_port,
        scheduler_host: settings.scheduler.ip().to_string(),
        scheduler_port: settings.scheduler.port(),
        scheduler_connect_timeout_seconds: 30,
        work_dir: settings.work_dir.clone(),
        executor_heartbeat_interval_seconds: HEARTBEAT_S,
        override_function_registry: Some(Arc::new(registry)),
        override_runtime_producer: Some(Arc::new(move |_| Ok(Arc::clone(&reads)))),
        ..ExecutorProcessConfig::default()
    };
    if let Some(cores) = settings.cores {
        config.vcores = cores;
    }
    let served = start_executor_process(Arc::new(config)).await;
    served.map_err(|error| PlantError::Cluster {
        what: "worker",
        address: format!("{}:{}", settings.bind, settings.port),
        reason: error.to_string(),
    })
}
