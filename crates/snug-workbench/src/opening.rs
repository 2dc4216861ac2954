//! The page of a study for whoever sits at this machine: its door and browser opened, until Ctrl-C or a signal ends it.

use crate::bench::Bench;
use crate::error::WorkbenchError;
use crate::server::{Doors, runtime, serve};
use snug_study::Study;
use std::path::PathBuf;
use std::sync::Arc;

/// What is worked on, and where.
#[derive(Debug)]
pub struct Opening {
    /// The study, with its data.
    pub study: Study,
    /// The file it was read from, beside which studies are saved.
    pub study_file: Option<PathBuf>,
    /// Port of 127.0.0.1, no unit; 0 for any free one, `None` for [`Self::USUAL_PORT`].
    pub port: Option<u16>,
    /// Whether a browser is opened, too.
    pub is_browser_opened: bool,
}

impl Opening {
    /// The port that is listened at where nobody names one; no unit.
    pub const USUAL_PORT: u16 = 7624;
}

/// What whoever opened the workbench is to be told while it is open.
#[derive(Debug)]
#[non_exhaustive]
pub enum Notice {
    /// The page is there.
    Open {
        /// Its address.
        address: String,
    },
    /// No browser could be opened; the page is there all the same.
    NoBrowser {
        /// Why.
        source: std::io::Error,
    },
}

/// Opens the page and answers until Ctrl-C or SIGTERM; `tell` hears what is to be told meanwhile.
///
/// # Errors
/// [`WorkbenchError::Runtime`], [`WorkbenchError::PortTaken`], [`WorkbenchError::Port`] and [`WorkbenchError::Server`].
pub fn open(opening: Opening, tell: &dyn Fn(Notice)) -> Result<(), WorkbenchError> {
    let runtime = runtime()?;
    let ended = runtime.block_on(attend(opening, tell));
    // A fit that is under way is nobody's any more.
    runtime.shutdown_background();
    ended
}

async fn attend(opening: Opening, tell: &dyn Fn(Notice)) -> Result<(), WorkbenchError> {
    let doors = Doors::open(opening.port.unwrap_or(Opening::USUAL_PORT)).await?;
    let address = doors.address();
    let bench = Bench::new(opening.study, opening.study_file);
    let reader = Arc::clone(&bench);
    std::thread::spawn(move || reader.read());
    tell(Notice::Open {
        address: address.clone(),
    });
    if opening.is_browser_opened
        && let Err(source) = open::that_detached(&address)
    {
        tell(Notice::NoBrowser { source });
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
