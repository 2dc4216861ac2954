//! Thousands of tightenings as columns: kept, fitted and watched on an existing engine, on one machine or many.
#![doc = include_str!("../README.md")]

mod bench;
mod dataset;
mod engine;
mod error;
mod fit;
mod import;
mod improve;
mod naming;
mod parquet_file;
mod partition;
mod pooled;
mod rows;
mod schema;
mod simulate;
mod sql;
mod store;
mod watch;

pub use bench::{BenchSettings, Figures, bench};
pub use dataset::{Commit, CommittedFile, Dataset, Manifest};
pub use engine::thresholds::{GIVEN_UP_AFTER_S, STANDS_STILL_AFTER_S};
pub use engine::{CLUSTER_PARTS, Engine, SchedulerSettings, WorkerSettings, scheduler, worker};
pub use error::PlantError;
pub use fit::{FitSettings, Fitted, fit};
pub use import::{Imported, import};
pub use improve::{ImproveSettings, Improved, improve};
pub use naming::{Named, Naming};
pub use partition::Partition;
pub use schema::SCHEMA_VERSION;
pub use simulate::{Simulation, simulate_plant};
pub use sql::{Tables, as_text, query};
pub use store::Store;
pub use watch::{Found, WatchSettings, Watched, watch};
