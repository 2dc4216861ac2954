//! Tests of exchange and refusal against real folders, and against disks that fail on purpose.
#![allow(clippy::unwrap_used)]

mod apart;
mod every_fault;
mod results;
