//! The program: reads its arguments, opens the page, and ends with Ctrl-C.

use clap::Parser;
use snug_study::{Study, StudyError};
use snug_workbench::{Bench, Doors, WorkbenchError, serve};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use tracing_subscriber::filter::LevelFilter;

/// Tries physical effects on measured tightenings, on a page of this machine: click one and watch the error fall.
#[derive(Debug, Parser)]
#[command(
    name = "cargo xtask workbench",
    bin_name = "cargo xtask workbench",
    version
)]
struct Arguments {
    /// Study file (RON); without it, the thesis' rig and file layout.
    #[arg(long, value_name = "FILE.ron")]
    study: Option<PathBuf>,
    /// Folder (or file) with the data; overrides the study's. Without both, the campaign embedded in fixtures/.
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Port of 127.0.0.1 to listen at; 0 for any free one.
    #[arg(long, value_name = "N", default_value_t = 7624)]
    port: u16,
    /// Does not open the browser.
    #[arg(long)]
    no_open: bool,
}

/// The campaign that ships with Snug.
const EMBEDDED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/campaign");

fn main() -> ExitCode {
    snug_campaign::words::program::set_program("cargo xtask");
    let arguments = Arguments::parse();
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_max_level(LevelFilter::WARN)
        .init();
    let study = match study(&arguments) {
        Ok(study) => study,
        Err(error) => {
            complain(&error.to_string());
            return ExitCode::from(if error.is_bad_argument() { 2 } else { 1 });
        }
    };
    let runtime = match tokio::runtime::Runtime::new() {
        Ok(runtime) => runtime,
        Err(error) => {
            complain(&format!("the server cannot be started: {error}"));
            return ExitCode::FAILURE;
        }
    };
    let ended = runtime.block_on(work(&arguments, study));
    // A fit that is under way is nobody's any more.
    runtime.shutdown_background();
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&error.to_string());
            ExitCode::FAILURE
        }
    }
}

/// The study that is worked on.
fn study(arguments: &Arguments) -> Result<Study, StudyError> {
    let mut study = match &arguments.study {
        Some(path) => Study::read(path)?,
        None => Study::on(PathBuf::from(EMBEDDED)),
    };
    if let Some(data) = &arguments.data {
        study.set_data(data);
    }
    study.check()?;
    Ok(study)
}

async fn work(arguments: &Arguments, study: Study) -> Result<(), WorkbenchError> {
    let doors = Doors::open(arguments.port).await?;
    let address = doors.address();
    let bench = Bench::new(study, arguments.study.clone());
    let reader = Arc::clone(&bench);
    std::thread::spawn(move || reader.read());
    say(&format!("The workbench is at {address}; Ctrl-C ends it."));
    if !arguments.no_open
        && let Err(error) = open::that_detached(&address)
    {
        complain(&format!(
            "no browser could be opened ({error}): open the address yourself"
        ));
    }
    tokio::select! {
        ended = serve(doors, bench) => ended,
        () = told_to_end() => Ok(()),
    }
}

/// Ctrl-C, or the signal by which a system ends a program.
#[cfg(unix)]
async fn told_to_end() {
    use tokio::signal::unix::{SignalKind, signal};
    match signal(SignalKind::terminate()) {
        Ok(mut terminated) => tokio::select! {
            _ = tokio::signal::ctrl_c() => (),
            _ = terminated.recv() => (),
        },
        Err(_) => {
            tokio::signal::ctrl_c().await.ok();
        }
    }
}

#[cfg(not(unix))]
async fn told_to_end() {
    tokio::signal::ctrl_c().await.ok();
}

/// Prints a line to standard output, as far as that is possible.
fn say(text: &str) {
    let mut output = std::io::stdout().lock();
    output.write_all(format!("{text}\n").as_bytes()).ok();
    output.flush().ok();
}

/// Prints a line to standard error, as far as that is possible.
fn complain(text: &str) {
    std::io::stderr()
        .write_all(format!("{text}\n").as_bytes())
        .ok();
}
