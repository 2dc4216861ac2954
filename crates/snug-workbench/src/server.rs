//! The server: on this machine alone, until it is told to end.

pub(crate) mod benches;
pub(crate) mod guard;
pub(crate) mod routes;

use crate::bench::Bench;
use crate::error::WorkbenchError;
use crate::server::guard::Guard;
use crate::server::routes::router;
use std::io::ErrorKind;
use std::net::Ipv4Addr;
use std::sync::Arc;
use tokio::net::TcpListener;
use tokio::runtime::{Builder, Runtime};

/// A port of this machine that is listened at.
pub struct Doors {
    listener: TcpListener,
    port: u16,
}

impl Doors {
    /// Listens at a port of 127.0.0.1, or at any free one where that is 0. Whoever comes waits until it is [served](serve).
    ///
    /// # Errors
    /// [`WorkbenchError::PortTaken`] and [`WorkbenchError::Port`].
    pub async fn open(port: u16) -> Result<Self, WorkbenchError> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).await;
        let listener = listener.map_err(|source| match source.kind() {
            ErrorKind::AddrInUse => WorkbenchError::PortTaken { port },
            _ => WorkbenchError::Port { port, source },
        })?;
        let bound = listener.local_addr();
        let bound = bound.map_err(|source| WorkbenchError::Port { port, source })?;
        Ok(Self {
            listener,
            port: bound.port(),
        })
    }

    /// The port; no unit.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The page's address.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }
}

/// Threads that work out what pages ask for beside their fits. Of more, each keeps scattered memory that the others do not use: with
/// as many as tokio begins by itself, and the system's allocator, a day of 500 clicks left 100 MB more from noon to evening.
const ASIDE: usize = 3;

/// What pages are answered on.
///
/// # Errors
/// [`WorkbenchError::Runtime`].
pub fn runtime() -> Result<Runtime, WorkbenchError> {
    let runtime = Builder::new_multi_thread()
        .enable_all()
        .max_blocking_threads(ASIDE)
        .build();
    runtime.map_err(|source| WorkbenchError::Runtime { source })
}

/// Answers whoever comes, for as long as the future lives.
///
/// # Errors
/// [`WorkbenchError::Server`].
pub async fn serve(doors: Doors, bench: Arc<Bench>) -> Result<(), WorkbenchError> {
    let router = router(bench, Guard::at(doors.port));
    axum::serve(doors.listener, router)
        .await
        .map_err(|source| WorkbenchError::Server { source })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[tokio::test]
    async fn a_port_that_is_taken_is_named() {
        let first = Doors::open(0).await.unwrap();
        let Err(refused) = Doors::open(first.port()).await else {
            panic!("two have one port");
        };
        let told = refused.to_string();
        assert!(
            told.starts_with(&format!("port {} is taken", first.port())),
            "{told}"
        );
        assert!(told.contains("--port"), "{told}");
    }
}
