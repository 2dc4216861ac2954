use crate::arguments::{LogFormat, LogOptions};
use std::io::IsTerminal;
use tracing_subscriber::EnvFilter;

/// Sends `tracing` to standard error, as text or as JSON lines.
pub fn start(options: &LogOptions) {
    let filter = match EnvFilter::try_new(&options.log_level) {
        Ok(filter) => filter,
        Err(error) => {
            eprintln!(
                "--log-level {}: {error}; using warn instead",
                options.log_level
            );
            EnvFilter::new("warn")
        }
    };
    let subscriber = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(std::io::stderr().is_terminal())
        .with_writer(std::io::stderr);
    match options.log {
        LogFormat::Text => subscriber.init(),
        LogFormat::Json => subscriber.json().init(),
    }
}
