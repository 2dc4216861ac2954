//! A scheduler and workers as processes of their own on loopback, which end with whoever holds them.

use super::process::Resources;
use super::program;
use crate::error::PlantError;
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How long a process may take to listen.
const LISTENS_WITHIN: Duration = Duration::from_secs(30);

/// A process that is killed when it is let go.
pub struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

impl Process {
    /// Largest memory so far \[byte\].
    pub fn peak_bytes(&self) -> Result<u64, PlantError> {
        Resources::of(self.0.id())?.peak_bytes()
    }
}

/// A scheduler.
pub struct Cluster {
    port: u16,
    _scheduler: Process,
}

impl Cluster {
    pub async fn start() -> Result<Self, PlantError> {
        let port = free_port()?;
        let bind = format!("--bind=127.0.0.1:{port}");
        let scheduler = started("scheduler", &[bind], port).await?;
        Ok(Self {
            port,
            _scheduler: scheduler,
        })
    }

    pub fn address(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    /// A worker that has one core.
    pub async fn worker(&self) -> Result<Process, PlantError> {
        let (port, command_port) = (free_port()?, free_port()?);
        let arguments = [
            format!("--scheduler=127.0.0.1:{}", self.port),
            format!("--port={port}"),
            format!("--command-port={command_port}"),
            "--cores=1".to_owned(),
        ];
        started("worker", &arguments, port).await
    }
}

fn failed(what: &'static str, port: u16, reason: String) -> PlantError {
    PlantError::Cluster {
        what,
        address: format!("127.0.0.1:{port}"),
        reason,
    }
}

fn free_port() -> Result<u16, PlantError> {
    let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    free.map(|address| address.port())
        .map_err(|error| failed("a free port", 0, error.to_string()))
}

async fn started(
    what: &'static str,
    arguments: &[String],
    port: u16,
) -> Result<Process, PlantError> {
    let mut command = Command::new(program()?);
    command.arg(what).args(arguments).env("RUST_LOG", "error");
    command.stdout(Stdio::null()).stderr(Stdio::inherit());
    let child = command.spawn();
    let process = Process(child.map_err(|error| failed(what, port, error.to_string()))?);
    let until = Instant::now() + LISTENS_WITHIN;
    while TcpStream::connect(("127.0.0.1", port)).is_err() {
        if Instant::now() > until {
            return Err(failed(what, port, "it does not listen".to_owned()));
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    Ok(process)
}
