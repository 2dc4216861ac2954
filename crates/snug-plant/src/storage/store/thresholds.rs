//! How long a store may take before it does not answer; every number says its unit.

/// Time in which a connection to a bucket is made \[s\]. The object store's own default: beyond it nothing listens.
pub const CONNECTS_WITHIN_S: u64 = 5;

/// Time in which a request to a bucket is answered to its last byte \[s\]; `AWS_TIMEOUT` sets another. Chosen: the largest that is
/// asked for in one request is a file of some 50 MB, which a store that gives less than 3 MB/s would not bring in time.
pub const REQUEST_WITHIN_S: u64 = 20;

/// Times that a request is made again that was refused for the moment (5xx, 429) or not answered. Chosen: with waits of 0.1 s that double
/// they span what the next limit leaves.
pub const MOST_RETRIES: usize = 6;

/// Time from a request's beginning after which it is not made again \[s\]. Chosen: three requests that are not answered; a store that is
/// started anew is there by then.
pub const RETRIED_FOR_S: u64 = 60;
