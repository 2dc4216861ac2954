//! The workbench in a real browser, as somebody uses it who has read nothing but the page.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod access;
mod browser;
mod devtools;
mod early;
mod mystery;
mod opened;
mod server;
mod stretch;
