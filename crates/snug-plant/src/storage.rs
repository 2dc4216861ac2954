//! What lies where: stores, partitions, the columns of tables, files of them, and which of these count.

pub(crate) mod dataset;
pub(crate) mod parquet_file;
pub(crate) mod partition;
pub(crate) mod schema;
pub(crate) mod store;
