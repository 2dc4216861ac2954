//! The program's log, apart from its summary on standard output; a log that cannot be written ends no run.

use crate::arguments::{LogFormat, LogOptions};
use crate::terminal::Printable;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;
use tracing_subscriber::{fmt, registry};

/// Sends `tracing` to standard error, as text or as JSON lines.
///
/// # Errors
/// What is wrong with the filter.
pub fn start(options: &LogOptions) -> Result<(), String> {
    let filter: Targets = (options.log_level.parse())
        .map_err(|error| format!("--log-level {}: {error}", options.log_level))?;
    let lines = fmt::layer()
        .with_ansi(false)
        .with_writer(Printable::stderr)
        // A full disk behind standard error is no reason to end a run.
        .log_internal_errors(false);
    let subscriber = registry().with(filter);
    match options.log {
        LogFormat::Text => subscriber.with(lines).init(),
        LogFormat::Json => subscriber.with(lines.json()).init(),
    }
    Ok(())
}
