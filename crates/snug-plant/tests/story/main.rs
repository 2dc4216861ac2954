//! A plant's day: brought in once, fitted on one machine and on a cluster, damaged, resumed, watched.
#![allow(clippy::unwrap_used)]

mod buckets;
mod cluster;
mod disks;
mod faults;
mod import;
mod improve;
mod kills;
mod plant;
mod store;
mod watch;
