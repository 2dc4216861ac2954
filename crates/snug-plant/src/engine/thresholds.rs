//! When a job, a worker or a whole fit is given up; every number says its unit.

/// A worker says so often that it is alive \[s\]. Chosen: a scheduler of a thousand workers hears 500 of these a second.
pub const HEARTBEAT_S: u64 = 2;

/// A worker that was silent for so long is dead, and its work is another's \[s\]. Five heartbeats: of a machine whose cores were all taken
/// the longest silence seen was three.
pub const DEAD_AFTER_S: u64 = 10;

/// A job stands still when for so long no part of it was finished or begun, and none ran at a worker that is alive \[s\]. Three times
/// what a scheduler takes to hand on a dead worker's parts: a worker that is started anew is there by then.
pub const STANDS_STILL_AFTER_S: u64 = 30;

/// A fit or a pass is given up when for so long no partition was finished and those that were tried failed \[s\]. Twice what a store's
/// request may take with all its repetitions.
pub const GIVEN_UP_AFTER_S: u64 = 120;

/// Partitions, or jobs, that failed one after another before anything is given up: damaged files are rarely neighbours.
pub const GIVEN_UP_AFTER: usize = 3;
