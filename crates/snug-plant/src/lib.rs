//! Thousands of tightenings as columns: kept, fitted and watched on an existing engine, on one machine or many.
#![doc = include_str!("../README.md")]

mod bench;
mod engine;
mod error;
mod fit;
mod functions;
mod improve;
mod intake;
mod pooled;
mod rows;
mod sql;
mod storage;
mod watch;

// Declared for their features alone: the program and its tests share one build of the engine.
use arrayvec as _;
use digest as _;
use simdutf8 as _;
use subtle as _;

pub use bench::{BenchSettings, Figures, bench};
pub use engine::thresholds::{GIVEN_UP_AFTER_S, STANDS_STILL_AFTER_S};
pub use engine::{CLUSTER_PARTS, Engine, SchedulerSettings, WorkerSettings, scheduler, worker};
pub use error::PlantError;
pub use fit::{FitSettings, Fitted, fit};
pub use improve::{ImproveSettings, Improved, improve};
pub use intake::import::{Imported, import};
pub use intake::naming::{Named, Naming};
pub use intake::simulate::{Simulation, simulate_plant};
pub use sql::{Tables, as_text, query};
pub use storage::dataset::{Commit, CommittedFile, Dataset, Manifest};
pub use storage::partition::Partition;
pub use storage::schema::SCHEMA_VERSION;
pub use storage::store::Store;
pub use watch::{Found, WatchSettings, Watched, watch};
