//! The workbench as a browser has it: a server that is started, and driven over HTTP and server-sent events.
#![allow(clippy::unwrap_used)]

mod browser;
mod mystery;
mod strangers;
mod stretch;
