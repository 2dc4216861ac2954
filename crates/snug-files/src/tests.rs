#![allow(clippy::unwrap_used)]

mod apart;
mod every_fault;
mod results;
