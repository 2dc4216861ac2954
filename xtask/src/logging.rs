use crate::arguments::{LogFormat, LogOptions};
use crate::terminal::Printable;
use tracing_subscriber::EnvFilter;

/// Sends `tracing` to standard error, as text or as JSON lines.
///
/// # Errors
/// What is wrong with the filter.
pub fn start(options: &LogOptions) -> Result<(), String> {
    let filter = EnvFilter::try_new(&options.log_level)
        .map_err(|error| format!("--log-level {}: {error}", options.log_level))?;
    let subscriber = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(false)
        .with_writer(Printable::stderr)
        // A full disk behind standard error is no reason to end a run.
        .log_internal_errors(false);
    match options.log {
        LogFormat::Text => subscriber.init(),
        LogFormat::Json => subscriber.json().init(),
    }
    Ok(())
}
